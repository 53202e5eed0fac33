"""Tensions that can be held along a line at rest, against linear programming over all of them at once."""

from __future__ import annotations

import itertools
import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import linprog

from fairlead.analysis.statics.cone import ANY, Held, HeldPassage, _ends
from fairlead.analysis.statics.sliding import Piece


def linear_ranges(changes, ends, narrow=None):
    """By place the least and the most of a quantity that changes from place to place by so much at least and at most.

    `ends` are what is known of the first and of the last; `narrow` is a place and a range. None where nothing agrees.
    """
    n = len(changes) + 1
    rows, limits = [], []
    for k, (least, most) in enumerate(changes):
        step = np.zeros(n)
        step[k + 1], step[k] = 1.0, -1.0
        rows += [step, -step]
        limits += [most, -least]
    bounds = [(None, None)] * n
    given = [(0, ends[0]), (n - 1, ends[1]), *([narrow] if narrow else [])]
    for k, (low, high) in given:
        before = bounds[k]
        low = low if before[0] is None else max(low, before[0])
        high = high if before[1] is None else min(high, before[1])
        bounds[k] = (low, high)
    if any(low is not None and low > high for low, high in bounds):
        return None
    bounds = [tuple(None if one is None or math.isinf(one) else one for one in pair) for pair in bounds]
    found = []
    for k in range(n):
        pair = []
        for sign in (1, -1):
            goal = np.zeros(n)
            goal[k] = sign
            answer = linprog(goal, A_ub=np.array(rows), b_ub=np.array(limits), bounds=bounds)
            if answer.status == 2:
                return None
            pair.append(answer.x[k] if answer.status == 0 else -sign * math.inf)
        found.append(tuple(pair))
    return found


def cone(laid, known, kept=(-1, ANY), *, pushes=True):
    """The ranges at all borders of these pieces."""
    found = _ends(SimpleNamespace(pushes=pushes), laid, 0.0, known, kept)
    for one, other in itertools.pairwise(found):
        assert one[1] == pytest.approx(other[0], rel=1e-9)
    return [found[0][0], *(outer for _, outer in found)]


def some_range(chance, low, high):
    """A range, a number, or nothing known."""
    kind = chance.integers(0, 4)
    if kind == 0:
        return ANY
    one, other = sorted(chance.uniform(low, high, 2))
    return (one, one) if kind == 1 else (float(one), float(other))


def check(found, wanted):
    """The same ranges; or both say that nothing can be held."""
    if wanted is None:
        assert any(low > high - 1e-9 * abs(high) for low, high in found)
        return
    for one, other in zip(found, wanted, strict=True):
        assert one == pytest.approx(other, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("seed", range(15))
def test_guides_that_press_a_line_hold_what_they_can_together(seed):
    """Straight ones, of which some hang: tension changes by the weight, and by friction either way."""
    chance = np.random.default_rng(seed)
    laid, changes, at = [], [], 0.0
    for _ in range(int(chance.integers(1, 6))):
        length, pressed, load = chance.uniform(0.5, 2), chance.choice([0.0, 30.0, 80.0]), chance.uniform(-50, 50)
        friction = float(chance.uniform(0.1, 0.6))
        laid.append((None, Piece(at, at + length, 0.0, float(pressed), float(load)), friction))
        changes.append((float(-load - friction * pressed) * length, float(-load + friction * pressed) * length))
        at += length
    known = (some_range(chance, 50, 400), some_range(chance, 50, 400))
    if known == (ANY, ANY):
        known = ((100.0, 100.0), ANY)
    kept = (int(chance.integers(0, len(laid))), some_range(chance, 50, 400)) if chance.random() < 0.5 else (-1, ANY)
    narrow = kept if kept[0] >= 0 else None
    check(cone(laid, known, kept), linear_ranges(changes, known, narrow))


@pytest.mark.parametrize("seed", range(15))
def test_bends_hold_by_the_formula_of_the_capstan_together(seed):
    """Logarithms of tensions change by mu times the angle either way."""
    chance = np.random.default_rng(100 + seed)
    laid, changes, at = [], [], 0.0
    for _ in range(int(chance.integers(1, 6))):
        length, curvature, friction = (float(one) for one in chance.uniform((0.5, 0.2, 0.1), (2.0, 1.5, 0.6)))
        laid.append((None, Piece(at, at + length, curvature), friction))
        turn = friction * curvature * length
        changes.append((-turn, turn))
        at += length
    known = (some_range(chance, 50, 400), (100.0, 100.0) if chance.random() < 0.5 else some_range(chance, 50, 400))
    if known == (ANY, ANY):
        known = (ANY, (100.0, 300.0))

    def logs(pair):
        return tuple(math.log(one) if math.isfinite(one) else one for one in pair)

    wanted = linear_ranges(changes, tuple(logs(one) for one in known))
    wanted = wanted and [tuple(math.exp(one) if math.isfinite(one) else one for one in pair) for pair in wanted]
    check(cone(laid, known), wanted)


def test_a_line_that_cannot_be_pushed_holds_no_tension_below_zero():
    """A guide that could hold 60 N either way, at an end that pulls with 20 N."""
    laid = [(None, Piece(0.0, 2.0, 0.0, 100.0), 0.3)]
    assert cone(laid, (ANY, (20.0, 20.0)), pushes=True)[0] == pytest.approx((-40.0, 80.0))
    assert cone(laid, (ANY, (20.0, 20.0)), pushes=False)[0] == pytest.approx((0.0, 80.0))


@pytest.mark.parametrize(
    ("missing", "ranges"), [(0.0, [(1, 2), (3, 3)]), (4.0, [(1, 2), (7, 3)]), (9.0, [(9, 0), (7, 3)])]
)
def test_what_is_missing_is_the_widest_gap(missing, ranges):
    """Between the least and the most that can be held; nothing where the least is below the most everywhere."""
    passages = tuple(HeldPassage("", None, Piece(0.0, 1.0), inboard, outboard) for inboard, outboard in [ranges])
    found = Held(SimpleNamespace(), 0.0, 0.0, passages)
    assert found.missing == missing
    assert found.holds == (missing == 0.0)
