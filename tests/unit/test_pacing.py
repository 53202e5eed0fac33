"""Who keeps time with the clock: when a frame begins, what is late by how much, and when rows are handed over."""

from types import SimpleNamespace

import pytest

from fairlead.integrate.codes import TRY
from fairlead.pacing import Pacer


class Clock:
    """A clock that only sleep and work move on."""

    def __init__(self):
        self.now, self.slept = 100.0, []

    def __call__(self):
        return self.now

    def sleep(self, seconds):
        self.slept.append(seconds)
        self.now += seconds


class Going:
    """A run of frames of 1 ms, in which each step takes as long as it is told."""

    def __init__(self, clock, takes, stop):
        self.clock, self.takes, self.handed_over = clock, list(takes), []
        number = {"start": 0.0, "t": 0.0, "stop": stop, "phase": TRY}
        self.active = SimpleNamespace(memory=SimpleNamespace(number=number))
        self.served = True

    def go_on(self, attempts, *, hand_over=True):
        number = self.active.memory.number
        if number["t"] >= number["stop"]:
            self.served = False
        elif attempts:
            self.clock.now += self.takes.pop(0)
            number["t"] = min(number["stop"], round((number["t"] + 1e-3) * 1e3) / 1e3)

    def flush(self):
        self.handed_over.append(self.active.memory.number["t"])


def paced(takes, stop=None):
    clock = Clock()
    going, pacer = Going(clock, takes, stop or 1e-3 * len(takes)), Pacer(1e-3, clock, clock.sleep)
    while going.served:
        pacer(going)
    return going, pacer, clock


def test_steps_that_are_short_begin_when_their_frames_do():
    going, pacer, clock = paced([0.2e-3, 0.5e-3, 0.1e-3])
    assert clock.slept == pytest.approx([0.8e-3, 0.5e-3])  # before the second and the third; none waits at the end
    assert (pacer.frames, pacer.late) == (3, 0)
    assert pacer.longest == pytest.approx(0.5e-3)
    assert pacer.longest_at == pytest.approx(1e-3)
    assert pacer.plain()["mean"] == pytest.approx(0.8e-3 / 3)
    assert going.handed_over == [3e-3]


def test_after_a_late_step_the_next_begin_at_once_until_time_is_made_up():
    """The second ends at 3.5 ms instead of 2, the next two at 3.9 (of 3) and 4.3 (of 4), the fifth at 4.7 (of 5)."""
    _, pacer, clock = paced([0.4e-3, 2.5e-3, 0.4e-3, 0.4e-3, 0.4e-3, 0.4e-3])
    assert clock.slept == pytest.approx([0.6e-3, 0.3e-3])
    assert pacer.late == 3
    assert pacer.most_late == pytest.approx(1.5e-3)


def test_rows_are_handed_over_now_and_then_and_at_the_end():
    going, _, _ = paced([0.1e-3] * 120)
    assert going.handed_over == pytest.approx([0.05, 0.1, 0.12])


def test_a_long_wait_hands_over_meanwhile_so_that_who_watches_may_end_the_run():
    clock = Clock()
    going, pacer = Going(clock, [0.0] * 3, 1.0), Pacer(0.2, clock, clock.sleep)
    going.active.memory.number["t"], pacer._zero = 0.2, 100.0
    pacer._wait(going, 100.175)
    assert clock.slept == pytest.approx([0.05] * 3 + [0.025])
    assert len(going.handed_over) == 3
