"""The room `record` alone: rows and zone changes go to buffers, as long as there is room."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from tests.integrate.rooms import entry, memory


@functools.cache
def written():
    from fairlead.integrate.record.rows import write_row

    return entry(write_row, ("problem", "recorder"), "dii")


@functools.cache
def changed():
    from fairlead.integrate.record.rows import write_event

    return entry(write_event, ("point", "events.settling", "recorder"), "iiii")


@functools.cache
def roomy():
    from fairlead.integrate.record.rows import there_is_room

    return entry(there_is_room, ("problem", "recorder"), "", "b")


def test_rows_stand_one_after_another_with_their_side():
    at = memory({"n_outputs": 2, "row_capacity": 3}, row_t=np.zeros(3), row_side=np.zeros(3), row_values=np.zeros(6))
    for t, side in ((0.5, 0), (1.0, 1), (1.0, 2)):
        written()(at, t, np.array([10.0 * t + side, -t]), side)
    assert at.array["row_t"].tolist() == [0.5, 1.0, 1.0]
    assert at.array["row_side"].tolist() == [0, 1, 2]
    assert at.array["row_values"].tolist() == [5.0, -0.5, 11.0, -1.0, 12.0, -1.0]
    assert at.number["rows"] == 3
    assert at.number["t_row"] == 1.0


def test_a_zone_change_has_its_time_and_pass():
    names = ("machine", "before", "after", "guard", "position")
    buffers = {f"event_{name}": np.zeros(2) for name in ("t", *names)}
    at = memory({"t": 2.5, "passes": 4, "event_capacity": 2, "total_events": 7}, **buffers)
    changed()(at, 3, 0, 1, 9)
    assert [at.array[f"event_{name}"][0] for name in ("t", *names)] == [2.5, 3, 0, 1, 9, 4]
    assert at.number["events"] == 1
    assert at.number["total_events"] == 8


@pytest.mark.parametrize(("rows", "events", "enough"), [(6, 0, True), (7, 0, False), (0, 15, True), (0, 16, False)])
def test_there_is_room_for_a_settlement_or_the_buffer_is_emptied_first(rows, events, enough):
    """Four rows, and a change of every machine and guard: 2 + 3 here."""
    numbers = {"rows": rows, "events": events, "row_capacity": 10, "event_capacity": 20, "n_machines": 2, "n_guards": 3}
    assert roomy()(memory(numbers)) == enough


@functools.cache
def inside():
    from fairlead.integrate.record.rows import rows_inside

    return entry(rows_inside, ("run", "point", "events.settling", "recorder"), result="i")


def piece(D, weight=1e-3, unweighed=0, t_piece=2.0, **numbers):
    """A step of 2 s in which one unknown goes from 1 to 3, by y = 1 + 2 s + s (1 - s)(D_0 + s (D_1 + s D_2))."""
    given = {"n": 1, "t": 0.0, "h": 2.0, "t_piece": t_piece, "between": 1, "on_grid": 1, "most_inside": 3, **numbers}
    arrays = {"y": [1.0], "y_end": [3.0], "y_probe": [0.0], "x": [0.0], "weight": [weight], "unweighed": [unweighed]}
    share = t_piece / 2.0
    end = 1.0 + 2.0 * share + share * (1.0 - share) * (D[0] + share * (D[1] + share * D[2]))
    return memory(given, **arrays, D=D, y_piece=[end])


@pytest.mark.parametrize(
    ("D", "rows"),
    [
        ([0.0, 0.0, 0.0], 0),
        ([0.0039, 0.0, 0.0], 0),  # s (1 - s) D_0 is a quarter in the middle: just below the weight
        ([0.0041, 0.0, 0.0], 1),
        ([5.0, 0.0, 0.0], 1),
        ([5.0, 0.021, 0.0], 1),  # a cubic is off the parabola through its middle by 3/64 D_1 at both quarters
        ([5.0, 0.022, 0.0], 3),
        ([5.0, -0.022, 0.0], 3),
        ([5.0, 0.0, 0.017], 1),  # a quartic by 15/256 D_2 at the last quarter
        ([5.0, 0.0, 0.018], 3),
        ([-2.0, 4.0, 0.0], 0),  # no test sees what is straight in the middle alone
    ],
)
def test_a_piece_on_a_grid_has_as_many_rows_inside_as_its_curve_needs_within_a_weight(D, rows):
    assert inside()(piece(D)) == rows


@pytest.mark.parametrize(
    ("given", "rows"),
    [
        ({"on_grid": 0}, 3),  # every step is recorded with its curve
        ({"between": 0}, 0),
        ({"most_inside": 1}, 1),  # stepping knows parabolas
        ({"most_inside": 1, "passes": 1}, 0),  # in which something switched
        ({"unweighed": 1}, 0),
        ({"t_piece": 0.02}, 0),  # up to a switch at a hundredth of the step, which is straight within its weight
    ],
)
def test_which_rows_a_curved_step_has_depends_on_what_is_recorded(given, rows):
    assert inside()(piece([5.0, 0.5, 0.0], **{"weight": 0.01, **given})) == rows
