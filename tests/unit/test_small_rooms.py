"""Weights by accuracy, runs of calls, budgets and limits that are judged again, alone: against plain loops."""

from __future__ import annotations

import itertools
from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.analysis.record.remedy import FEW, budget, remedies
from fairlead.system.arrays.following import runs
from fairlead.system.numbering.tolerances import CREEP_SHARE, GUARD_ROUNDING, Scales, roundings


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3, 1e-5, 1e-7])
def test_a_weight_is_the_accuracy_of_a_size_and_speeds_of_contacts_are_capped(accuracy):
    """A tenth of the creep at ordinary accuracies, by the root below; of a curve its width where that is less."""
    nominal, follows = np.array([1.0, 5.0, 0.1]), np.array([0.0, 1.0, 1.0])
    creep, width = np.array([np.inf, 1e-4, np.inf]), np.array([np.inf, 1e3, 1e-9])
    rounding = roundings(["m/s", "N", "furlong"])
    assert rounding.tolist() == [GUARD_ROUNDING["m/s"], GUARD_ROUNDING["N"], 1e-9]
    made = Scales(nominal, follows, creep, width, rounding).weights(accuracy)
    assert made.absolute == pytest.approx(accuracy * nominal)
    assert made.relative == pytest.approx(accuracy * follows)
    cap = CREEP_SHARE * 1e-4 * (1.0 if accuracy >= 1e-3 else (accuracy / 1e-3) ** 0.5)
    assert made.cap == pytest.approx([np.inf, cap, 1e-9])
    assert made.guard_tolerance == pytest.approx(np.minimum(rounding, 1e-10))  # a tenth of the least speed weight
    wide = Scales(nominal, follows, np.full(3, np.inf), np.full(3, 1e3), rounding).weights(accuracy)
    assert np.isinf(wide.cap).all()
    assert wide.guard_tolerance.tolist() == rounding.tolist()


@pytest.mark.parametrize("seed", range(10))
def test_instances_beside_each_other_are_called_together(seed):
    found = np.flatnonzero(np.random.default_rng(seed).random(20) < 0.5)
    calls = runs(3, found)
    assert [k for _, first, end in calls for k in range(first, end)] == found.tolist()
    assert all(place == 3 and first < end for place, first, end in calls)
    assert all(end < first for (_, _, end), (_, first, _) in itertools.pairwise(calls))  # no two could be one
    assert runs(0, np.zeros(0, np.int64)) == []


def kind(name, advice="", **budgets):
    return type(name, (), {"answers": SimpleNamespace(budget=budgets, advice=advice)})


def test_a_budget_is_what_the_netlist_gives_else_the_least_that_a_class_asks_for():
    some = [kind("A"), kind("B", max_steps=500), kind("C", max_steps=200, max_events=7)]
    assert budget(some, "max_steps", None) == 200
    assert budget(some, "max_events", None) == 7
    assert budget(some, "max_wall", None) is None
    assert budget(some, "max_steps", 10_000) == 10_000


def test_advice_is_told_once_with_the_first_of_those_it_is_about():
    stiff, calm = kind("Stiff", "Soften it."), kind("Calm")
    parts = [SimpleNamespace(path=f"s{k}", type=stiff) for k in range(FEW + 2)]
    assert remedies([*parts, SimpleNamespace(path="c", type=calm)]) == "s0, s1, s2 and 2 more: Soften it."
    assert remedies(parts[:1]) == "s0: Soften it."
    assert remedies([SimpleNamespace(path="c", type=calm)]) == ""
