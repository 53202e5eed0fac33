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
    numbers = {"rows": rows, "events": events, "row_capacity": 10, "event_capacity": 20, "n_zones": 2, "n_guards": 3}
    assert roomy()(memory(numbers)) == enough
