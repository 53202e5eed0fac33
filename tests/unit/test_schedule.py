"""What references imply: steady stretches, the way gone, and what limits of rate make of them."""

import math
import pathlib

import pytest

from fairlead.analysis.statics.schedule import Schedule, followed
from fairlead.component.given import Waveform
from fairlead.component.waveforms import read_waveform

STEP = {"table": {"t": [0, 0.01, 4, 4.01], "y": [0, 0.5, 0.5, -0.5]}}


def wave(given):
    return read_waveform(given, Waveform("m/s"), pathlib.Path())


def test_a_trapezoid_has_a_stretch_of_speed_and_one_of_rest():
    schedule = Schedule(wave({"trapezoid": {"to": 0.5, "start": 1, "rise": 1, "stay": 3, "fall": 1}}), 0.0, 10.0)
    assert [(one.begin, one.end, one.speed) for one in schedule.stretches()] == [(0, 1, 0), (2, 5, 0.5), (6, 10, 0)]
    assert schedule.way(10.0) == pytest.approx(0.5 * 4)
    assert schedule.furthest(1) == 5.0
    assert schedule.furthest(-1) is None
    assert sorted(acceleration for _, _, acceleration in schedule.accelerations()) == [-0.5, -0.5, 0.5, 0.5]


def test_a_swinging_speed_counts_where_it_is_fastest():
    schedule = Schedule(wave({"sine": {"amplitude": 0.4, "frequency": 0.5}}), 0.0, 4.0)
    assert schedule.stretches() == []
    assert schedule.steady(1).speed == pytest.approx(0.4, rel=1e-5)
    assert schedule.way(1.0) == pytest.approx(0.4 * 2 / math.pi)  # half a period of a sine of pi rad/s


def test_a_step_that_is_followed_with_limited_rate_becomes_a_ramp():
    shaped = Schedule(followed(wave(STEP), 0.25, 0.0, 10.0), 0.0, 10.0)
    for t, speed in ((1.0, 0.25), (2.0, 0.5), (4.0, 0.5), (6.0, 0.0), (8.0, -0.5), (10.0, -0.5)):
        assert shaped.speed(t) == pytest.approx(speed, abs=0.005), t  # the step takes 10 ms
    assert max(abs(acceleration) for _, _, acceleration in shaped.accelerations()) == pytest.approx(0.25)


def test_what_changes_slowly_is_followed_as_it_is():
    slow = wave({"ramp": {"to": 0.5, "over": 4}})
    shaped = followed(slow, 0.25, 0.0, 10.0)
    assert [shaped(t) for t in (0.0, 1.0, 3.0, 7.0)] == pytest.approx([slow(t) for t in (0.0, 1.0, 3.0, 7.0)])


def test_a_wave_is_scaled_and_differentiated_with_its_sine():
    given = wave({"constant": 1.0, "drift": {"rate": 2.0}, "sine": {"amplitude": 3.0, "frequency": 0.5}})
    assert given.scaled(2.0, 1.0)(0.7) == pytest.approx(2 * given(0.7) + 1)
    assert given.derivative()(0.7) == pytest.approx(2.0 + 3 * math.pi * math.cos(0.7 * math.pi))


@pytest.mark.parametrize("to", [0.5, -0.5])
def test_a_stop_is_a_motion_in_the_direction_that_it_ends(to):
    """The direction decides to which side friction helps: it is not that of the acceleration."""
    schedule = Schedule(wave({"trapezoid": {"to": to, "start": 1, "rise": 1, "stay": 3, "fall": 1}}), 0.0, 10.0)
    changes = list(schedule.accelerations())
    assert [t for t, _, _ in changes] == pytest.approx([1, 2, 5, 6])
    assert [rate for _, _, rate in changes] == pytest.approx([to, to, -to, -to])
    assert all(speed * to > 0 for _, speed, _ in changes)


def test_a_speed_that_swings_comes_to_rest_in_either_direction():
    schedule = Schedule(wave({"sine": {"amplitude": 0.4, "frequency": 0.5}}), 0.0, 4.0)
    assert {(speed > 0, rate > 0) for _, speed, rate in schedule.accelerations()} == {
        (True, True), (True, False), (False, True), (False, False)
    }  # fmt: skip
