"""docs/treatments says what the classes say: every treatment has a page, with equation, zones, limits and source."""

import importlib.util
import pathlib
import re

import pytest

from fairlead.component.registry import known_types
from fairlead.describe.part_names import COMBINED, NAMES, shown_types

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"


def made():
    """The module docs/make.py."""
    spec = importlib.util.spec_from_file_location("docs_make", DOCS / "make.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_pages_are_those_that_the_classes_give():
    written = {path: path.read_text(encoding="utf-8") for path in (DOCS / "treatments").glob("*.md")}
    assert written == made().pages(), "run python docs/make.py pages"


def test_the_table_of_stepping_is_the_one_that_check_goes_by():
    path, text = made().stepping()
    assert path.read_text(encoding="utf-8") == text, "run python docs/make.py pages"


def test_the_page_that_leads_to_a_part_has_every_bundled_type_and_its_sentence():
    path, text = made().which_part()
    assert path.read_text(encoding="utf-8") == text, "run python docs/make.py pages"


@pytest.mark.parametrize(("word", "name"), [
    ("planetary gear", "Planetary"), ("worm gear", "Worm"), ("belt drive", "BeltDrive"), ("backlash", "Backlash"),
    ("counterbalance valve", "CounterbalanceValve"), ("dead band", "DeadZone"), ("freewheel", "OneWayClutch"),
    ("lead screw", "LeadScrew"), ("hydraulic cylinder", "Cylinder"), ("variable pump", "VariablePump"),
])  # fmt: skip
def test_a_part_is_found_by_what_an_engineer_calls_it(word: str, name: str):
    lines = (DOCS / "howto" / "parts.md").read_text(encoding="utf-8").splitlines()
    assert any(line.startswith(f"| {word}") and f"[{name}]" in line for line in lines)


def test_names_are_of_types_that_there_are():
    shown = {name for names in shown_types(known_types()).values() for name in names}
    assert set(NAMES) == shown
    for parts in COMBINED.values():
        assert set(re.findall(r"`([A-Z]\w+)`", parts)) <= shown


def test_no_part_goes_by_its_type_in_small_letters_alone():
    alone = [name for name, words in NAMES.items() if words == re.sub(r"(?<=[a-z])(?=[A-Z0-9])", " ", name).lower()]
    assert not set(alone) - {"Spring"}  # nobody calls it otherwise


@pytest.mark.parametrize(
    ("word", "part"),
    [
        ("quantiser", "SampledSensor"), ("noise", "SampledSensor"), ("ADC", "SampledSensor"), ("comparator", "Relay"),
        ("slew-rate limiter", "ReferenceShaper"), ("dead time", "SignalDelay"), ("delay", "SignalDelay"),
        ("edge", "SignalEdge"), ("counter", "SignalEdge"), ("pulse", "SignalSource"), ("CSV", "SignalSource"),
        ("data file", "SignalSource"), ("minimum", "SignalSelect"), ("maximum", "SignalSelect"),
        ("absolute value", "SignalSize"), ("map in two dimensions", "SignalTable2"), ("multiplier", "SignalProduct"),
        ("rolling resistance", "MassOnSlope"), ("incline", "MassOnSlope"), ("web break", "WebSpan"),
        ("isothermal", "Accumulator"), ("converter", "DcDrive"), ("planetary", "Planetary"), ("diode", "Diode"),
    ],
)  # fmt: skip
def test_a_part_is_found_by_the_word_that_an_engineer_uses(word, part):
    page = (DOCS / "howto" / "parts.md").read_text(encoding="utf-8")
    assert re.search(rf"^\|[^|]*\b{word}\b[^|]*\| \[{part}\]", page, flags=re.MULTILINE)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::fairlead.RunWarning")
def test_every_run_behind_a_figure_of_the_documentation_ends(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch):
    """`make docs` stops where one does not, as once where a treatment that does not work used its steps up."""
    make, keeps = made(), DOCS / "figures"
    monkeypatch.setattr(make, "FIGURES", tmp_path)
    make.figures()
    drawn = {one.name for one in tmp_path.iterdir()}
    assert {"steps.png", "compare.png", "literal.png"} < drawn
    assert drawn <= {one.name for one in keeps.iterdir()}


BUNDLED = {w: m for w, m in known_types()["Contact"].members.items() if m.__module__.startswith("fairlead.")}


@pytest.mark.parametrize("word", BUNDLED)
def test_a_page_has_equation_zones_limits_source_and_its_figure(word: str):
    text = (DOCS / "treatments" / f"{word}.md").read_text(encoding="utf-8")
    for part in ("T = ", "Source:", "## Zones"):
        assert part in text, part
    assert "Limits:" in text or word.startswith("naive")  # theirs is that they do not work
    for figure in [line.partition("](")[2].rstrip(")") for line in text.splitlines() if line.startswith("![")]:
        assert (DOCS / "treatments" / figure).stat().st_size < 30_000


def test_every_zone_of_a_treatment_is_on_its_page():
    for word, member in BUNDLED.items():
        text = (DOCS / "treatments" / f"{word}.md").read_text(encoding="utf-8")
        for zone in member.declaration.zones:
            stem = zone.removesuffix("_forward").removesuffix("_backward")
            assert stem in text, (word, zone)
