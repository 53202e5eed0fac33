"""docs/treatments says what the classes say: every treatment has a page, with equation, zones, limits and source."""

import importlib.util
import pathlib

import pytest

from fairlead.component.registry import known_types

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
