"""Pivots that lose accuracy on the way: an FMU chooses others, as fairlead does."""

import numpy as np
import pytest

from fairlead.fmu import export
from tests.fmu.exported import fmpy, needs_compiler, slave
from tests.models.lost_pivots import PAIR, lost_pivots

pytestmark = pytest.mark.slow
H, STEPS = 0.02, 50
ACCURACY = 1e-6
"""Other pivots round otherwise, so steps are others: both runs are within some accuracies of the truth."""


@pytest.mark.parametrize("version", [2, 3])
def test_a_run_that_needs_other_pivots_goes_on_with_them_and_its_state_has_them(scene, library, tmp_path, version):
    fmpy()
    needs_compiler()
    model = scene(lost_pivots(), (library(PAIR),))
    given = {"accuracy": ACCURACY, "engine": "rodas"}
    file = export(model, tmp_path / "pairs.fmu", version=version, outputs=["block?.x"], **given)
    native, rows, own = model.start(**given), [], []
    with slave(file, tmp_path / "a") as one, slave(file, tmp_path / "b") as other:
        one.fmu.exitInitializationMode()
        other.fmu.exitInitializationMode()
        for k in range(STEPS):
            if k == 35:
                other_state(one, other)
            one.step(H)
            native.advance(one.t)
            rows.append(one.get(*one.outputs))
            own.append([native.get(name) for name in one.outputs])
            if k >= 35:
                other.step(H)
                assert other.get(*other.outputs) == rows[-1]
    assert native._memory.number["replans"] > 0  # else the scene shows nothing
    largest = np.abs(own).max()
    assert np.abs(np.subtract(rows, own)).max() <= 10 * ACCURACY * largest


def other_state(one, other):
    """Bring the other to where the first is, by way of bytes."""
    fmu, there = one.fmu, other.fmu
    if one.newer:
        there.setFMUState(there.deserializeFMUState(fmu.serializeFMUState(fmu.getFMUState())))
    else:
        there.setFMUstate(there.deSerializeFMUstate(fmu.serializeFMUstate(fmu.getFMUstate())))
    other.t = one.t
