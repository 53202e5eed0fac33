"""YAML 1.2 core schema with places and bounds."""

import math

import pytest

from fairlead.errors import Location
from fairlead.netlist.limits import DEEPEST, MOST_ALIASES, Meter
from fairlead.netlist.yaml12 import read_yaml, resolve


def read(text):
    value, faults = read_yaml(text, "x.yaml")
    assert not faults, [str(fault) for fault in faults]
    return value.plain()


def faults_of(text):
    return [str(fault) for fault in read_yaml(text, "x.yaml")[1]]


# YAML 1.2.2 section 10.3.2 (core schema, tag resolution) and what YAML 1.1 makes of the same texts.
@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        ("no", "no"), ("yes", "yes"), ("on", "on"), ("off", "off"), ("y", "y"), ("n", "n"),
        ("true", True), ("False", False), ("TRUE", True), ("tRUE", "tRUE"),
        ("null", None), ("~", None), ("", None), ("Null", None), ("nUll", "nUll"),
        ("1e-3", 1e-3), ("1e3", 1e3), ("1E+3", 1e3), (".5", 0.5), ("5.", 5.0), ("-0.0", -0.0),
        ("12", 12), ("-12", -12), ("+12", 12), ("012", 12), ("0o17", 15), ("0x1F", 31), ("-0x1F", "-0x1F"),
        ("12:30", "12:30"), ("1:30:00", "1:30:00"), ("2001-01-01", "2001-01-01"), ("1_000", "1_000"),
        ("0b11", "0b11"), ("=", "="), (".", "."), ("-", "-"), ("1e", "1e"), ("e3", "e3"), ("12 kN", "12 kN"),
        (".inf", math.inf), ("-.INF", -math.inf), ("+.Inf", math.inf), ("inf", "inf"), ("nan", "nan"),
    ],
)  # fmt: skip
def test_a_plain_scalar_means_what_the_core_schema_says(text, meaning):
    assert resolve(text) == meaning
    assert type(resolve(text)) is type(meaning)


def test_not_a_number_is_a_float():
    assert math.isnan(resolve(".nan"))


def test_quoted_and_block_texts_stay_texts():
    assert read("a: '12'\nb: \"true\"\nc: |\n  12\nd: >\n  no\n") == {
        "a": "12",
        "b": "true",
        "c": "12\n",
        "d": "no\n",
    }


def test_every_value_knows_its_place_and_the_place_of_its_key():
    value, _ = read_yaml("a: 1\nbb:\n  - {c: 12 kN}\n", "x.yaml")
    inner = value.entries["bb"].content[0].entries["c"]
    assert inner.where == Location("x.yaml", 3, 9)
    assert inner.key_where == Location("x.yaml", 3, 6)


def test_an_alias_stands_for_its_anchor():
    assert read("a: &x {b: 1}\nc: *x\nd: [*x, *x]\n") == {
        "a": {"b": 1},
        "c": {"b": 1},
        "d": [{"b": 1}, {"b": 1}],
    }


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("a: 1\nb: 2\na: 3\n", "x.yaml:3:1: a is given twice\n    It stands at x.yaml:1:1 already."),
        ("a: {b: 1, b: 1}", "x.yaml:1:11: b is given twice"),
        ("x: &x {a: 1}\ny: {<<: *x}\n", "x.yaml:2:5: <<: merge keys are not part of YAML 1.2"),
        (
            "a: !!python/object/apply:os.system [ls]",
            "x.yaml:1:4: tag tag:yaml.org,2002:python/object/apply:os.system",
        ),
        ("a: !!str 12", "x.yaml:1:4: tag tag:yaml.org,2002:str is not allowed"),
        ("a: !foo 12", "x.yaml:1:4: tag !foo is not allowed"),
        ("a: *nope", "x.yaml:1:4: *nope has no anchor before it"),
        ("a: &x [*x]", "x.yaml:1:8: *x stands for itself"),
        ("? [1, 2]\n: 3\n", "a key is a name"),
        ("a: 1e999", "x.yaml:1:4: 1e999: beyond the largest number"),
        ("a: " + "9" * 5000, "a number of so many digits"),
        ("a: 1\n---\nb: 2\n", "x.yaml:2:1: a second document begins here"),
        ("a: {2*mu} N", 'An expression goes in quotes: "{2*mu} N"'),
        ("a:\n\t- b", "YAML takes no tabs"),
        ("a: b: c", "A text that holds a colon and a space goes in quotes"),
        ("a: @b", "goes in quotes"),
        ("a: [*.tension]", "goes in quotes"),
        ("a: 'open", "x.yaml:1:"),
        ("%FOO\n---\na: 1", "x.yaml:1:"),
    ],
)
def test_a_mistake_is_named_at_its_place(text, fault):
    assert fault in "\n".join(faults_of(text))


def test_several_mistakes_are_found_in_one_go():
    assert len(faults_of("a: 1\na: 2\nb: !!int 3\nc: *nope\nd: 1e999\n")) == 4


def test_nothing_gives_nothing():
    assert read_yaml("", "x.yaml") == (None, [])
    assert read_yaml("# a comment\n", "x.yaml") == (None, [])


def test_nesting_is_bounded_at_sixty_four():
    depth = DEEPEST - 1
    assert not faults_of("a: " + "[" * (depth - 1) + "1" + "]" * (depth - 1))
    assert "nested more than 64 levels" in faults_of("a: " + "[" * DEEPEST + "]" * DEEPEST)[0]


def test_nesting_through_aliases_is_bounded_too():
    tower = ["a0: &a0 " + "[" * 30 + "1" + "]" * 30]
    tower += [f"a{i}: &a{i} " + "[" * 30 + f"*a{i - 1}" + "]" * 30 for i in range(1, 900)]
    assert "nested more than 64 levels" in faults_of("\n".join(tower))[0]


def test_a_billion_laughs_end_in_a_message():
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, 20)]
    assert "more than 400000 values" in faults_of("\n".join(lines))[0]


def test_anchors_and_aliases_are_bounded():
    anchors = "[" + ", ".join(f"&a{i} 1" for i in range(MOST_ALIASES + 1)) + "]"
    aliases = "[&a 1, " + ", ".join("*a" for _ in range(MOST_ALIASES + 1)) + "]"
    assert "more than 1000 anchors" in faults_of(anchors)[0]
    assert "more than 1000 aliases" in faults_of(aliases)[0]


def test_reading_stops_at_the_bound_and_not_at_the_end_of_the_text():
    """A hundred levels: libyaml bounds depth itself, in newer releases at a thousand."""
    meter = Meter()
    read_yaml("[" * 100 + "1, " * 300_000, "x.yaml", meter)
    assert meter.nodes == DEEPEST + 1
