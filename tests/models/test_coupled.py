"""The winch of benchmarks/coupled.py: plant and sampled controller as two programs, beside both as one model."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))  # scripts that import each other by name
import coupled

STOP = 2.0


@pytest.fixture(scope="module")
def one():
    """Speed of the line in the one model [m/s]."""
    return coupled.together(STOP)


def off(held, one):
    """Largest difference over the largest speed."""
    return float(np.max(np.abs(coupled.coupled(held, STOP) - one[::held])) / np.max(np.abs(one)))


def test_coupled_at_every_sample_is_the_one_model(one):
    """Only sampled signals are exchanged: the tolerance of the engine, 1e-5 of the speed, is all between them."""
    assert off(1, one) < 1e-5
    assert np.max(np.abs(one)) == pytest.approx(0.3, rel=0.1)


def test_a_longer_hold_is_a_longer_delay(one):
    """What is exchanged every 2, 5, 10 samples is further off each time, and far more than the engine's tolerance."""
    errors = [off(held, one) for held in (2, 5, 10)]
    assert 1e-3 < errors[0] < errors[1] < errors[2]


def test_a_controller_with_another_law_is_told_apart(one, monkeypatch):
    """Without the sample of delay the two do not agree: the first test can fail."""

    def at_once(self, reference, measured, sample=coupled.Electronics.sample):
        self.before = measured
        return sample(self, reference, measured)

    monkeypatch.setattr(coupled.Electronics, "sample", at_once)
    assert off(1, one) > 1e-4
