"""The handling system and its electronics as two FMUs of our own, coupled by FMPy, beside the one model."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))  # scripts that import each other by name
import coupled_fmus
import coupled_route

from tests.fmu_import.build import COMPILER, NO_COMPILER


@pytest.mark.slow
@pytest.mark.skipif(COMPILER is None, reason=NO_COMPILER)
@pytest.mark.skipif(sys.platform != "linux", reason="FMUs are exported on Linux")
def test_two_fmus_stepped_from_sample_to_sample_are_the_one_model(tmp_path):
    """Sampled signals are all that passes between them, so only the tolerance of the engine is between the two."""
    pytest.importorskip("fmpy")
    one = coupled_route.together(1.0, 1e-4)
    found = coupled_fmus.coupled(coupled_fmus.exported(tmp_path, 1e-4), 1, 1.0)
    assert max(most for most, _ in coupled_route.off(found, one, 1).values()) < 1e-5
    assert one["belt_speed"].max() > 0.2  # it moves
