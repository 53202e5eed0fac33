"""The handling system of benchmarks/coupled_route.py: plant and electronics as two programs, beside one model."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))  # scripts that import each other by name
import coupled_route

STOP, ACCURACY = 1.0, 1e-4


@pytest.fixture(scope="module")
def one():
    """What is measured in the one model."""
    return coupled_route.together(STOP, ACCURACY)


def most(found, one, held):
    """The largest difference of all signals, over their largest values."""
    return max(largest for largest, _ in coupled_route.off(found, one, held).values())


def test_electronics_called_at_every_sample_are_those_of_the_one_model(one):
    """Only sampled signals are exchanged, so nothing but the tolerance of the engine is between the two."""
    assert most(coupled_route.coupled(1, STOP, ACCURACY), one, 1) < 1e-5
    assert one["belt_speed"].max() > 0.2  # it moves


@pytest.mark.slow
def test_a_long_step_of_communication_is_told_apart(one):
    assert most(coupled_route.coupled(10, STOP, ACCURACY), one, 10) > 1e-3


@pytest.mark.slow
def test_electronics_without_the_sample_of_delay_are_told_apart(one, monkeypatch):
    """The first test can fail."""

    def at_once(self, reference, measured, ahead=0.0, sample=coupled_route.Pi.sample):
        self.before = measured
        sample(self, reference, measured, ahead)

    monkeypatch.setattr(coupled_route.Pi, "sample", at_once)
    assert most(coupled_route.coupled(1, STOP, ACCURACY), one, 1) > 1e-4


@pytest.mark.slow
def test_at_two_samples_it_swings_up_and_at_five_it_calms_down():
    """The verdicts of docs/coupling.md: the last four seconds beside the four before them."""
    one = coupled_route.together(coupled_route.LONG, ACCURACY)["belt_speed"]
    grown = {}
    for held in (2, 5):
        found = coupled_route.coupled(held, coupled_route.LONG, ACCURACY)["belt_speed"]
        *_, before, last = coupled_route.swings(found, one, held)
        grown[held] = last / before
    assert grown[2] > 3
    assert grown[5] < 1
