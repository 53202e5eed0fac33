"""A step of `stepping` is cut where a law was told to jump, and none does: it is not told again and again."""

from __future__ import annotations

from tests.invariance.lockstep import twins
from tests.invariance.plays import random_plays

SEED = 9049
"""A line of which two contacts of one node are near lifting; a long step tells a jump of one 40 ns ahead, again and
again. With the instances in their order it did not (248 steps), in another it did (948)."""


def test_a_place_that_was_told_wrongly_is_not_told_again_and_again(tmp_path):
    (route,) = (one for one in random_plays(range(0), range(SEED, SEED + 1)))
    here, other = (model.run(out=None).run for model in twins(route, "instances", tmp_path))
    assert abs(other["steps"] - here["steps"]) <= 0.02 * here["steps"]
    assert other["switches"] == here["switches"]
    assert here["counters"]["located"] < 0.1 * here["steps"]
