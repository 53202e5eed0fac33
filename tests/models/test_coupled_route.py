"""The handling system of benchmarks/coupled_route.py: plant and electronics as two programs, beside one model."""

import sys
from pathlib import Path

import pytest

import fairlead

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
def test_a_weak_clamp_that_is_commanded_lets_the_belts_slip_and_the_hose_is_told_to_ruck():
    """100 N/m on 1.5 m carry 2 * 0.6 * 100 * 1.5 = 180 N; the hose is taken to ruck below -15 N.

    The flag goes by the elastic tension, which damping is no part of, so points near the limit say nothing.
    """
    low = {}
    for clamp in (0.0, -1400.0):
        plant = fairlead.load(coupled_route.PLANT, set={"line.ruck_force": "15 N"}).start(accuracy=ACCURACY)
        hose = [f"line.hose[{k}].tension" for k in range(160)]
        electronics, low[clamp] = coupled_route.Electronics(), []
        plant.set("clamp_command", clamp)
        measured = [plant.get(name) for name in coupled_route.MEASURED]
        for k in range(400):
            for name, value in electronics.sample(*measured).items():
                plant.set(name, value)
            plant.advance(coupled_route.PERIOD * (k + 1))
            measured = [plant.get(name) for name in coupled_route.MEASURED]
            low[clamp].append((min(plant.get(name) for name in hose), plant.get("rucked")))
        assert plant.get("route.deployer.pressing") == pytest.approx(2 * (1500 + clamp), rel=1e-12)
    assert {flag for _, flag in low[0.0]} == {0.0}
    assert min(tension for tension, _ in low[0.0]) > -15
    told = [(tension, flag) for tension, flag in low[-1400.0] if abs(tension + 15) > 1]
    assert {flag for _, flag in told} == {0.0, 1.0}
    assert all(flag == (tension < -15) for tension, flag in told)


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
