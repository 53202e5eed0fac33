"""Between rows of a grid and an event `Result.at` takes the curve of the piece, of which the event's row is one end."""

import numpy as np
import pytest

from fairlead.results.curves import Curves

STEP = 0.1


def pieces(event, left, right, stop=2.0):
    """A grid of STEP and both rows of an event; the curve is `left(t)` before it and `right(t)` after it."""
    grid = np.arange(round(stop / STEP) + 1) * STEP
    before, after = grid[grid < event], grid[grid > event]
    t = np.concatenate([before, [event, event], after])
    side = np.concatenate([0 * before, [-1, 1], 0 * after]).astype(np.int8)
    values = np.concatenate([left(before), [left(event), right(event)], right(after)])
    return Curves(t, side, np.array([event])), values


def errors(event, left, right):
    """The largest error near the event, and the largest of straight lines."""
    curves, values = pieces(event, left, right)
    near = np.linspace(event - 3 * STEP, event + 3 * STEP, 1201)
    near = near[near != event]
    right_there = np.where(near < event, left(near), right(near))
    lines = np.interp(near, curves.t, values)
    return np.abs(curves.after(values, near) - right_there).max(), np.abs(lines - right_there).max()


def fall(t):
    return 1.0 - 4.905 * (t - 0.3) ** 2


def back(t):
    return 0.4 - 3.0 * (t - 1.03) + 2.0 * (t - 1.03) ** 2 + 0.5 * (t - 1.03) ** 3


@pytest.mark.parametrize("event", [1.03, 1.05, 1.0999, 1.1 - 1e-9, 1.0 + 1e-9, 0.95])
def test_a_cubic_on_each_side_of_an_event_is_met_exactly(event) -> None:
    """Where the event is no nearer to a row of the grid than rounding allows, which the gap divides."""
    found, lines = errors(event, fall, back)
    assert found < 1e-6 < 1e-3 < lines


def test_what_turns_in_the_interval_before_an_event_does_so_between_its_rows() -> None:
    """Its top lies at 1.02 s, between the last row of the grid and the event at 1.09 s."""
    found, lines = errors(1.09, lambda t: 5.0 - 20.0 * (t - 1.02) ** 2, lambda t: 0.0 * t)
    assert found < 1e-9
    assert lines > 0.01


@pytest.mark.parametrize("shift", [0.0, 0.5, -0.5])
def test_a_corner_in_the_interval_next_to_an_event_is_not_rounded_off(shift) -> None:
    """It reaches its limit of 1 at 1.02 s, between two rows: nothing goes beyond the limit."""
    curves, values = pieces(1.09, lambda t: np.minimum(1.0, (t / 1.02) ** 2), lambda t: 0.0 * t + 1.0 + shift)
    near = np.linspace(0.8, 1.0899, 800)
    assert curves.after(values, near).max() <= 1.0 + 1e-12


@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-9])
def test_rows_with_the_error_of_a_run_beside_an_event_give_no_more_than_theirs(gap) -> None:
    rng = np.random.default_rng(0)
    for _ in range(100):
        event = 1.0 + gap
        curves, values = pieces(event, fall, back)
        noisy = values + 1e-4 * rng.uniform(-1, 1, len(values))
        near = np.linspace(0.8, event, 50)[:-1]
        lines = np.abs(np.interp(near, curves.t, values) - fall(near))
        assert (np.abs(curves.after(noisy, near) - fall(near)) <= lines + 5e-4).all()
