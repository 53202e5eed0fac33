"""What is kept of a run, and what is told of it, does not depend on where its rows were cut into blocks."""

import math
import random

import numpy as np
import pytest

from fairlead.analysis.record.creep import WorstCreep
from fairlead.analysis.record.energy import Ledger
from fairlead.analysis.record.event_rows import AFTER, BEFORE, EventRows, Rows
from fairlead.analysis.record.extremes import Extremes
from fairlead.analysis.record.limits import Limit
from fairlead.analysis.record.step_rows import Batches

LEAST = np.array([1e-3, 1e-3, np.inf])


def recorded(seed, count=400):
    """Rows of a signal that grows and jumps, one that has kinks, a stair; now and then a value is no number."""
    r = random.Random(seed)
    rows, t, level = [], 0.0, 0.0
    while len(rows) < count:
        t += r.random()
        now = [level + math.sin(t), abs(math.sin(3 * t)) * (1 + t), math.floor(t)]
        if r.random() < 0.05:
            now[1] = math.nan
        if r.random() < 0.4:
            level += r.choice([0.0, 1e-5, 0.02, 0.3])
            rows += [(t, now, BEFORE), (t, [level + math.sin(t), now[1], now[2] + 1], AFTER)]
        else:
            rows.append((t, now, 0))
    rows.append((t + 1.0, [0.0, 0.0, 0.0], BEFORE))  # the run ended at an event
    t, values, side = zip(*rows, strict=True)
    return Rows(np.array(t), np.array(values), np.array(side, dtype=np.int8))


def cut(rows, seed):
    """The same in blocks, some of them empty."""
    r = random.Random(seed)
    places = sorted(r.randrange(len(rows.t) + 1) for _ in range(r.choice([0, 3, 60, 600])))
    return [rows.where(slice(a, b)) for a, b in zip([0, *places], [*places, len(rows.t)], strict=True)]


def told(blocks):
    """All that is kept and told of these blocks."""
    kept, creep, ledger = EventRows(LEAST), WorstCreep(["one", "two", "three"]), Ledger()
    limit = Limit("below 3", np.arange(3), ["one", "two", "three"], 1.0, 3.0, "m")
    written, batches, extremes = [], Batches(3), Extremes(3)
    for block in blocks:
        written.append(kept.take(block))
        creep.watch(block.t, block.values)
        ledger.watch(block.values)
        for batch in batches.take(block):
            extremes.watch(batch)
    extremes.watch(batches.rest())
    limit.take(extremes)
    written += [rest] if (rest := kept.rest()) is not None else []
    rows = [np.concatenate(parts).tobytes() for parts in zip(*written, strict=True)]
    figures = creep.summary(), ledger.summary(), limit.nearest, vars(extremes)
    return rows, kept.kept, kept.jumps.tolist(), repr(figures)


@pytest.mark.parametrize("seed", range(20))
def test_blocks_cut_anywhere_leave_the_same_rows_and_figures(seed):
    rows = recorded(seed)
    assert told(cut(rows, seed)) == told([rows])


def test_a_side_of_an_event_that_ends_a_block_is_written_at_the_end_of_the_run():
    kept = EventRows(np.array([0.0]))
    assert len(kept.take(Rows(np.zeros(1), np.ones((1, 1)), np.array([BEFORE], np.int8))).t) == 0
    assert kept.rest() is not None


def test_a_jump_is_judged_by_what_was_seen_before_it_and_not_by_what_comes_later():
    """0.001 of a metre is a jump as long as the signal was below a metre; that it is a kilometre later says nothing."""
    t, side = np.array([0.0, 1.0, 1.0, 2.0, 3.0, 3.0]), np.array([0, BEFORE, AFTER, 0, BEFORE, AFTER], np.int8)
    values = np.array([[0.1], [0.1], [0.101], [1000.0], [0.1], [0.101]])
    kept = EventRows(np.array([1e-3])).take(Rows(t, values, side))
    assert kept.t.tolist() == [0.0, 1.0, 1.0, 2.0]


@pytest.mark.parametrize("seed", range(8))
def test_what_is_kept_is_what_the_rule_says_row_by_row(seed):
    rows = recorded(seed)
    largest, keep, counts, events = np.zeros(3), np.ones(len(rows.t), dtype=bool), np.zeros(3, dtype=int), 0
    for k in range(len(rows.t)):
        largest = np.fmax(largest, np.abs(rows.values[k]))
        if k and rows.side[k - 1] == BEFORE and rows.side[k] == AFTER:
            jumps = np.abs(rows.values[k] - rows.values[k - 1]) > LEAST * (largest + 1e-9)
            counts, events = counts + jumps, events + bool(jumps.any())
            keep[k - 1 : k + 1] = jumps.any()
    kept = EventRows(LEAST)
    written = [kept.take(block) for block in cut(rows, seed)] + [kept.rest()]
    assert np.concatenate([one.t for one in written]).tolist() == rows.t[keep].tolist()
    assert (kept.kept, kept.jumps.tolist()) == (events, counts.tolist())
    assert 0 < events < np.count_nonzero(rows.side == AFTER)
