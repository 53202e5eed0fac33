"""A row of the record asks only for what is recorded or stored: each number is the same as when all is recorded."""

import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run
from fairlead.system.compiled.asking import call

MODELS = {"winch_drive": "*.torque", "single_bend": "line.core[3].tension", "torsion": "*.slip", "sandwich": "*"}


def shown(system, patterns, y):
    """Recorded values at y by name, and the stored energy."""
    system = system.instance(Run(stop=1.0, record=patterns))
    out = np.full(system.n_outputs, np.nan)
    call(system, "outputs", 0.1, y, out)
    return {signal.name: value for signal, value in zip(system.recorded, out[:-1], strict=True)}, out[-1]


@pytest.mark.parametrize("name", MODELS)
def test_a_value_does_not_depend_on_what_else_is_recorded(name):
    system = fairlead.load(name).system
    y = system.initial + 1e-3 * np.random.default_rng(2).uniform(-1, 1, system.n)
    everything, energy = shown(system, ["*"], y)
    some, alone = shown(system, [MODELS[name]], y)
    nothing, bare = shown(system, [], y)
    assert nothing.keys() <= some.keys() <= everything.keys()
    for few in (some, nothing):
        assert all(np.array_equal(value, everything[key], equal_nan=True) for key, value in few.items())
    assert energy == alone == bare
