"""`fairlead plot`: every figure in every format, what is in it, and what is refused by name."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.component.parameters import make
from fairlead.component.registry import known_types
from fairlead.errors import ModelError, UsageError
from fairlead.report import page
from fairlead.report.friction_figure import MOST_DECADES, decades
from fairlead.report.printed import WHATS, printed
from fairlead.report.printed.along import profile
from fairlead.report.printed.ledger import ledger
from fairlead.report.printed.paper import figure6, prism
from fairlead.report.printed.zone_chart import HUES, MOST_LABELS, OWN, row_labels, spans, zone_chart
from fairlead.results import Result, RunDirectory, Signal

matplotlib.use("agg")
BEGINNINGS = {".png": b"\x89PNG", ".svg": b"<?xml", ".pdf": b"%PDF"}
ROUTE = {
    "line": "line", "route": "route", "layers": ["hose"], "outer": "hose_node", "nodes": 4, "ruck_force": 5.0,
    "side_wall": None, "places": [0.0, 1.0, 2.0, 3.0],
    "stations": [{"name": "bend", "type": "Bend", "begin": 1.0, "end": 2.0, "curvature": 1.0, "contact": "outer",
                  "moves": False}],
}  # fmt: skip


@pytest.fixture
def result(tmp_path: Path) -> Result:
    """A line of three elements that moves inboard by 1 m in 2 s; its tension is time plus element."""
    signals = [Signal(f"line.hose_node[{k}].{q}", u) for q, u in (("x", "m"), ("v", "m/s")) for k in range(4)]
    signals += [Signal(f"line.core_node[{k}].v", "m/s") for k in range(4)]
    signals += [Signal(f"line.hose[{k}].tension", "N") for k in range(3)]
    t = np.linspace(0, 2, 41)
    columns = [k - t / 2 for k in range(4)] + [t * 0 - 0.5] * 8 + [t + k - 9.0 for k in range(3)]
    energy = {"supplied": 10.0, "dissipated": 7.0, "stored_change": 2.0, "closure": 0.0}
    zones = {"family": "line.hose[*]", "zones": ["sound", "beyond"], "elements": [0, 1], "start": [0, 0]}
    header = {"name": "line", "routes": [ROUTE], "zones": [zones]}
    run = RunDirectory.create(tmp_path / "run", signals, header)
    run.append(t, np.column_stack(columns), np.zeros(41))
    run.event(0.5, "line.hose[1]", "sound", "beyond", "rucks")
    run.event(1.5, "line.hose[1]", "beyond", "sound", "recovers")
    run.event(1.0, "line.load[1]", "piece 0", "piece 1", "next")
    run.finish("finished", {"energy": energy, "lost": {"stop": 0.5}})
    return Result.open(tmp_path / "run")


@pytest.mark.parametrize("what", WHATS)
@pytest.mark.parametrize("ending", BEGINNINGS)
def test_every_figure_is_written_in_every_format(result: Result, tmp_path: Path, what: str, ending: str) -> None:
    file = printed(result, what, tmp_path / "made" / f"{what}{ending}")
    assert file.read_bytes().startswith(BEGINNINGS[ending])


def test_a_profile_has_the_places_and_values_of_its_times(result: Result) -> None:
    one, other = profile(result, ["line.hose[*].tension"], [0.0, 2.0]).axes[0].lines
    np.testing.assert_allclose(one.get_data(), [[0.5, 1.5, 2.5], [-9.0, -8.0, -7.0]])
    np.testing.assert_allclose(other.get_data(), [[-0.5, 0.5, 1.5], [-7.0, -6.0, -5.0]])


def test_times_outside_the_run_are_refused(result: Result) -> None:
    with pytest.raises(UsageError, match="1 to 8 times within 0 to 2 s"):
        profile(result, [], [3.0])


def test_spans_fill_the_run_from_its_start_zone(result: Result) -> None:
    assert spans(result)["line.hose[1]"] == [(0.0, 0.5, "sound"), (0.5, 1.5, "beyond"), (1.5, 2.0, "sound")]


def test_pieces_of_tables_are_drawn_on_request_only(result: Result) -> None:
    assert [one.get_text() for one in zone_chart(result, [], []).axes[0].get_yticklabels()] == ["line.hose[1]"]
    assert [one.get_text() for one in zone_chart(result, ["*"], []).axes[0].get_yticklabels()] == [
        "line.hose[1]", "line.load[1]",
    ]  # fmt: skip
    with pytest.raises(UsageError, match="changed its zone"):
        zone_chart(result, ["pad"], [])


def test_the_ledger_adds_up(result: Result) -> None:
    bars = [bar.get_width() for bar in ledger(result).axes[0].patches]
    assert bars == [10.0, 7.0, 2.0, 0.5, 0.5]  # the last is what nothing accounts for


@pytest.mark.slow
def test_the_prism_of_figure_5_is_that_of_the_law() -> None:
    """From the forces of the class: T - S over slip, with S the line of transit (docs/physics.md 1)."""
    from fairlead.analysis.characteristic import characteristic

    curve = {"curve": "hump", "stiction": 0.35, "peak": 0.5, "peak_velocity": 0.1, "coulomb": 0.4}
    p = make(known_types()["Contact"].members["binding"], form="literal", curve=curve, creep=1e-4)
    found = characteristic(p, 100.0)
    branches = {**found.driven, **found.caught, **found.branches}
    for zone in ("plateau", "ramp_forward"):
        v, force = branches[zone]
        v, force = v[np.abs(v) > 1e-6], force[np.abs(v) > 1e-6]
        assert len(v)
        np.testing.assert_allclose(prism(p, 100.0, v, 0 * v), force / v - 100.0 * p.mu_n / p.v_n, rtol=1e-9, atol=1e-3)
    assert prism(p, 100.0, np.array([0.0]), np.array([100.0 * p.mu_s * 1.001])) == 0.0


def test_figure_6_marks_the_ruck_where_the_run_has_it(result: Result) -> None:
    ax = figure6([result], ["mu = 0.60"]).axes[0]
    assert "rucks" in ax.get_title()
    assert any("0.5 s" in text.get_text() for text in ax.texts)
    assert [line.get_label() for line in ax.lines][:2] == ["hose", "bulkhead"]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ([], "what to draw"),
        (["RUN", "map", "--out", "x.bmp"], "Formats are .png, .svg, .pdf"),
        (["RUN", "ledger", "--set", "mu=1"], "a run is over"),
        (["belt", "map", "--set", "run.stop=0.1 s"], "has no line on a route"),
    ],
)
def test_what_cannot_be_drawn_is_told(result: Result, words: list[str], told: str) -> None:
    answer = CliRunner().invoke(app, ["plot", *(str(result.path) if word == "RUN" else word for word in words)])
    assert answer.exit_code == 2
    assert told in " ".join(answer.output.replace("│", " ").split())


@pytest.mark.slow
def test_the_figures_of_the_paper_are_made(tmp_path: Path) -> None:
    answer = CliRunner().invoke(app, ["plot", "--paper", "--out", str(tmp_path)])
    assert answer.exit_code == 0, answer.output
    names = sorted(file.name for file in tmp_path.iterdir())
    assert names == [f"figure{k}.{ending}" for k in (3, 5, 6) for ending in ("pdf", "png")]


@pytest.mark.slow
def test_friction_of_a_model_is_drawn_for_every_kind_of_contact(tmp_path: Path) -> None:
    file = tmp_path / "friction.svg"
    answer = CliRunner().invoke(app, ["plot", "single_bend", "friction", "--out", str(file)])
    assert answer.exit_code == 0, answer.output
    drawing = file.read_text(encoding="utf-8")
    for kind in ("line.outer", "line.inner"):  # hose on the bend, core inside the hose
        assert kind in drawing


def test_few_rows_of_a_zone_chart_have_their_names_and_of_many_each_kind_has_its_own_and_numbers() -> None:
    few = ["pad", "line.hose[0]", "line.hose[1]"]
    assert row_labels(few) == (dict(enumerate(few)), [0, 1])
    many = [f"line.hose[{k}]" for k in range(100)] + ["pad"] + [f"line.inner[{k}]" for k in range(60)]
    labels, begin = row_labels(many)
    assert begin == [0, 100, 101]
    assert labels[0] == "line.hose[0]"
    assert labels[4] == "[4]"
    assert {"pad", "line.inner[0]"} & set(labels.values())
    places = sorted(labels)
    assert len(places) <= MOST_LABELS
    assert min(after - before for before, after in pairwise(places)) >= 4


@pytest.mark.parametrize("what", ["friction", "work-precision"])
def test_what_is_drawn_of_a_model_says_so_of_a_folder_and_names_its_netlist(tmp_path: Path, what: str) -> None:
    RunDirectory.create(tmp_path / "run", [Signal("x", "m")], {"name": "belt", "netlist": "mine/belt.yaml"}).finish(
        "finished", {}
    )
    answer = CliRunner().invoke(app, ["plot", str(tmp_path / "run"), what], terminal_width=500)
    assert answer.exit_code == 2
    said = " ".join(answer.output.replace("│", " ").split())
    assert f"{what} is drawn of a model, not of a run" in said
    assert f"fairlead plot mine/belt.yaml {what}" in said


@pytest.mark.parametrize("more", [["--at", "1 s"], ["--signals", "block.x"]])
def test_friction_of_a_model_refuses_what_it_would_not_look_at(more: list[str]) -> None:
    answer = CliRunner().invoke(app, ["plot", "belt", "friction", *more], terminal_width=500)
    assert answer.exit_code == 2
    assert "takes neither signals nor --at" in " ".join(answer.output.replace("│", " ").split())


@pytest.mark.parametrize(
    ("what", "times", "told"),
    [("map", [1.0], "a map is of the whole run"), ("ledger", [0.0, 1.0], "a ledger is of the whole run"),
     ("signals", [1.0], "two times limit what is drawn"), ("zones", [0.0, 1.0, 2.0], "two times limit what is drawn")],
)  # fmt: skip
def test_times_that_a_figure_does_not_take_are_refused(result: Result, tmp_path: Path, what, times, told) -> None:
    with pytest.raises(UsageError, match=rf"{what}: {len(times)} times were given\.\n.*{told}"):
        printed(result, what, tmp_path / "x.png", times=times)


def test_a_folder_of_results_is_told_where_a_netlist_is_wanted_and_a_netlist_where_a_folder_is(
    result: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(ModelError, match=r"(?s)a folder, not a netlist.*holds the results of a run: give the netlist"):
        fairlead.load(tmp_path / "run")
    monkeypatch.chdir(tmp_path)
    Path("mine.yaml").write_text("schema: 1")
    with pytest.raises(UsageError, match="It is a netlist: run it first"):
        Result.open("mine.yaml")
    Path("results").mkdir()
    (tmp_path / "run").rename("results/line")
    for name in ("line", "line.yaml"):
        with pytest.raises(UsageError, match=r"Did you mean results.line\?"):
            Result.open(name)


def test_a_zone_of_another_word_has_no_colour_that_means_sticking_or_sliding() -> None:
    assert not {colour.lower() for colour in OWN} & {colour.lower() for colour in HUES.values()}
    script = (Path(page.__file__).parent / "parts" / "colours.js").read_text(encoding="utf-8")
    of_page = re.findall(r"#[0-9a-f]{6}", next(line for line in script.splitlines() if line.startswith("const OWN")))
    assert [colour.lower() for colour in OWN] == of_page


@pytest.mark.parametrize(("low", "high", "linear"), [(-1e-3, 1e-3, 3e-8), (-0.2, 0.2, 3e-7), (-1e-6, 1e-6, 1e-6)])
def test_labels_of_slip_speeds_are_few_and_the_same_on_both_sides_of_zero(
    low: float, high: float, linear: float
) -> None:
    found = decades(low, high, linear)
    assert found == [-x for x in reversed(found)]
    assert 0.0 in found
    assert len(found) <= 2 * MOST_DECADES + 1
    assert all(abs(x) > 3 * linear for x in found if x)
