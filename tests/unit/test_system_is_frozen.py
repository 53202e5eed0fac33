"""A compiled model is shared by all its runs, in all threads: nobody writes into it by accident."""

import dataclasses

import numpy as np
import pytest

import fairlead


def test_the_arrays_of_a_system_are_not_written_into():
    system = fairlead.load("belt").system
    with pytest.raises(ValueError, match="read-only"):
        system.initial[0] = 3.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        system.initial = np.zeros(system.n)
    arrays = [value for value in vars(system).values() if isinstance(value, np.ndarray)]
    assert len(arrays) > 10
    assert not [value for value in arrays if value.flags.writeable]
    assert system.instance().zones.flags.writeable  # a run has its own
