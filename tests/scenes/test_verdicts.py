"""A hundred random scenes of all classes are right by every oracle; the counts and bounds of the command.

All that count are played by `python -m tests.scenes.verdicts`, whose counts are in docs/random_scenes.md.
"""

import collections

import pytest

from tests.scenes.classes import CLASSES, SCENES
from tests.scenes.known import KNOWN
from tests.scenes.verdict import Verdict, judge
from tests.scenes.verdicts import Count, table

PLAYED = {"networks": 10, "impacts": 15, "catches": 15, "ties": 12, "limits": 12, "ratios": 12, "jumps": 10,
          "starts": 12, "routes": 2}  # fmt: skip
"""How many scenes of each class the tests play, from seed 0: a hundred."""
SPREAD = 23
"""Every so many of the seeds that count: what a seed gives in its place in the list says its kind."""


def seeds(kind):
    return [(SPREAD * k) % SCENES for k in range(PLAYED[kind])]


@pytest.mark.parametrize(("kind", "seed"), [(kind, seed) for kind in PLAYED for seed in seeds(kind)])
def test_a_random_scene_is_right(kind, seed):
    if seed in KNOWN.get(kind, {}):
        pytest.skip(KNOWN[kind][seed])
    pytest.importorskip("sksundae.ida", reason="needs scikit-sundae: pip install 'fairlead[ida]'")
    verdict = judge(CLASSES[kind](seed))
    assert verdict.word == "right", verdict.why


def test_a_hundred_scenes_of_all_classes_are_played():
    assert set(PLAYED) == set(CLASSES)
    assert sum(PLAYED.values()) == 100
    assert all(len(set(seeds(kind))) == PLAYED[kind] for kind in PLAYED)


@pytest.mark.parametrize("kind", CLASSES)
def test_a_seed_gives_the_same_scene_and_another_one_another(kind):
    assert CLASSES[kind](3) == CLASSES[kind](3)
    assert len({CLASSES[kind](seed).text for seed in range(30)}) == 30


def count(**words):
    made = Count("catches")
    made.words = collections.Counter(words)
    return made


@pytest.mark.parametrize(
    ("words", "within"),
    [({"right": 80, "ended": 20}, True), ({"right": 79, "ended": 21}, False), ({"right": 96, "aside": 4}, True),
     ({"right": 95, "aside": 5}, False), ({"right": 90, "refused": 10}, True)],
)  # fmt: skip
def test_a_class_keeps_its_bounds_or_not(words, within):
    assert count(**words).within == within


def test_a_scene_that_is_wrong_and_not_listed_breaks_the_bounds(monkeypatch):
    made = count(right=99)
    made.take(1, Verdict("wrong", "energy"), 0.1)
    assert not made.within
    monkeypatch.setitem(KNOWN, "catches", {1: "its cause"})
    made = count(right=99)
    made.take(1, Verdict("wrong", "energy"), 0.1)
    assert made.within
    assert "| catches | 100 | 99 (99%) | 0 | 0 | 0 | 0 | 1 |" in table([made])
