"""Every bundled part tells its law, its source and its limits, and its small netlist what it shows."""

import inspect
import pathlib
import re

import pytest

from fairlead.component.registry import known_types
from fairlead.describe.catalogue import innards, record

ROOT = pathlib.Path(__file__).parents[2]
PARTS = {
    name: kind
    for name, kind in known_types().items()
    if name not in innards(known_types()) and kind.__module__.startswith("fairlead.")
}
BY_TABLE = {
    "Cable", "ArrayModule", "Route", "SignalFunction", "StateMachine", "PmDrive", "PowerUnit", "MotionSensor",
    "RotationSensor",
}  # fmt: skip
"""Parts that say in a list or by an expression what they are made of, or read what their outputs are called."""
EQUATION = re.compile(r"[^=<>!]=[^=]|>=|<=|up to|\+=")


@pytest.mark.parametrize("name", PARTS)
def test_a_part_tells_its_law_its_source_and_its_limits(name):
    said = inspect.getdoc(PARTS[name]) or ""
    missing = [word for word in ("Source", "Limits") if word not in said]
    assert missing == []
    assert EQUATION.search(said) or name in BY_TABLE


@pytest.mark.parametrize("name", PARTS)
def test_every_port_parameter_input_and_output_of_a_part_is_told_in_words(name):
    told = record(name, PARTS[name])
    for key in ("ports", "parameters", "inputs", "outputs"):
        for one in told[key]:
            assert one["doc"].strip(), (key, one["name"])
    for key in ("inputs", "outputs"):
        assert all(one["unit"] for one in told[key])


def test_every_small_netlist_says_in_its_first_line_what_it_shows():
    for file in (ROOT / "models" / "single_parts").glob("*.yaml"):
        first = file.read_text(encoding="utf-8").partition("\n")[0]
        assert re.match(r"# \S.{20,}", first), file.name
