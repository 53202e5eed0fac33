"""Patterns of signal names fit what they say, and take no time however they are written."""

import random
import re

import pytest

from fairlead.patterns import LONGEST, as_today, matcher, picked
from fairlead.results.signal import matching

PARTS = ("a", "b", ".", "*", "?", "[1]", "1", "[")


def written_out(pattern, any_index):
    """The plain regular expression that a pattern stands for, which may take for ever."""
    segments = pattern.split(".") if any_index else [pattern]
    made = []
    for segment in segments:
        literal = re.escape(segment).replace(r"\*", ".*").replace(r"\?", ".")
        made.append(literal if not any_index or segment.endswith(("]", "*")) else literal + r"(?:\[\d+\])?")
    return re.compile(r"\.".join(made))


@pytest.mark.slow
@pytest.mark.parametrize("any_index", [False, True])
def test_a_pattern_fits_what_its_plain_regular_expression_fits(any_index):
    chance, hits = random.Random(1), 0
    for _ in range(5000):
        pattern = "".join(chance.choice(PARTS) for _ in range(chance.randrange(8)))
        name = "".join(chance.choice(("a", "b", ".", "[1]", "[2]", "1", "]")) for _ in range(chance.randrange(8)))
        expected = written_out(pattern, any_index).fullmatch(name) is not None
        assert matcher(pattern, any_index=any_index)(name) == expected, (pattern, name)
        hits += expected
    assert hits > 100


@pytest.mark.parametrize("pattern", ["*" * 400 + "!", "*a" * 400 + "!", "*?" * 400 + "!", "*a.b" * 200 + "!"])
@pytest.mark.parametrize("any_index", [False, True])
def test_a_pattern_of_many_stars_ends(pattern, any_index):
    assert not matcher(pattern, any_index=any_index)("a.b" * 500)  # backtracking would outlast the sun


def test_a_pattern_longer_than_any_name_fits_nothing():
    assert not matcher("*" * (LONGEST + 1))("block.x")


def test_what_is_read_from_results_takes_the_same_patterns():
    names = ["line.core[1].tension", "line.core[12].tension", "line.core[1].slip"]
    assert matching(names, "line.core.tension") == names[:2]
    assert matching(names, "*" * 300 + "!") == []


@pytest.mark.parametrize(
    ("pattern", "today"),
    [("rotor.rate", "rotor.speed"), ("line.twist[3].turned", "line.twist[3].angle"),
     ("line.twist[*].turned", "line.twist[*].angle"), ("pad.rate", ""), ("rotor.speed", ""), ("rate", "")],
)  # fmt: skip
def test_the_old_name_of_an_output_means_that_of_today_where_nothing_else_has_it(pattern, today):
    names = {"rotor.speed": None, "line.twist[3].angle": None, "pad.rate": None, "pad.speed": None}
    assert as_today(names, pattern) == ([today] if today else [])
    assert picked(names, pattern) == (picked(names, today) if today else [pattern] if pattern in names else [])
