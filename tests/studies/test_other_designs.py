"""A sweep into a folder that holds another design tells, draws and computes what is of the design asked for."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from fairlead.cli import app
from fairlead.errors import ModelError, UsageError
from fairlead.studies.pictures.indices import sobol_indices
from fairlead.studies.pictures.rows import Rows
from fairlead.studies.sweeps.breach import breach
from fairlead.studies.sweeps.design import Design, Sample
from fairlead.studies.sweeps.distributions import read_distribution
from fairlead.studies.sweeps.sweep import sweep
from tests.studies.jobs import ishigami, job, square

pytest.importorskip("pyarrow", reason="pyarrow is not installed; pip install 'fairlead[sweep]'")
from fairlead.studies.sweeps import table as tables

SLIDE = """\
schema: 1
name: slide
parameters: {mu: 0.3}
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 2 kg, velocity: 2 m/s}
  pad: {type: Contact, normal_force: 19.62 N, curve: "{mu}"}
connections: [[floor.flange, pad.a], [pad.b, block.flange]]
run: {stop: 2 s}
limits: {block.x: {below: 0.9 m}}
"""
"""It comes to rest after v^2 / (2 mu g) = 0.2039 m / mu, so that the limit is broken where mu is below 0.2265."""


@pytest.fixture
def slide(tmp_path) -> Path:
    file = tmp_path / "slide.yaml"
    file.write_text(SLIDE)
    return file


def told(*words: object) -> dict:
    answer = CliRunner().invoke(app, ["sweep", *map(str, words), "--processes", "0", "--json"])
    assert answer.exit_code == 0, answer.output
    return json.loads(answer.output[answer.output.index("{") :])


def columns(*words: str) -> Design:
    return Design(grid={"x": list(words)})


def test_the_probability_is_that_of_the_sample_asked_for(slide, tmp_path) -> None:
    folder = tmp_path / "table"
    sample = ["--monte-carlo", 6, "--figure", "end(block.x)", "--out", folder]
    low = told(slide, *sample, "--over", "mu=uniform(0.1, 0.2)")
    high = told(slide, *sample, "--over", "mu=uniform(0.3, 0.4)")
    assert [(one["breach"]["broken"], one["breach"]["cases"]) for one in (low, high)] == [(6, 6), (0, 6)]
    assert (high["cases"], high["others"]) == ({"finished": 6}, 6)
    grid = told(slide, "--grid", "mu=0.15,0.35", "--figure", "end(block.x)", "--out", folder)
    assert (grid["broken"], grid["cases"], grid["others"]) == (1, {"finished": 2}, 12)
    again = told(slide, *sample, "--over", "mu=uniform(0.3, 0.4)")
    assert (again["breach"]["cases"], again["reused"], again["computed"]) == (6, 6, 0)


def test_what_is_kept_is_of_the_design_asked_for(slide, tmp_path) -> None:
    common = ["--figure", "far=end(block.x)", "--keep", "highest:far", "--keep", "0", "--out", tmp_path / "t"]
    told(slide, "--grid", "mu=0.1,0.25", *common)
    kept = told(slide, "--grid", "mu=0.3,0.25", *common)["kept"]
    assert [Path(one).name for one in kept] == ["case_1", "case_0"]


@pytest.mark.parametrize(
    ("first", "second", "left"),
    [
        (("1", "2", "3"), ("3", "2", "1"), 0),
        (("1", "3", "5"), ("1", "2", "3", "4", "5"), 0),
        (("1", "2", "3"), ("4", "2"), 2),
        (("1", "1", "2"), ("2", "1"), 0),
        (("1", "2"), ("2", "2", "1"), 0),
    ],
)
def test_rows_bear_the_numbers_of_the_design_asked_for(first, second, left, tmp_path) -> None:
    sweep(job(square), Design(listed=[{"x": one} for one in first]), tmp_path, processes=0)
    table, _ = sweep(job(square), Design(listed=[{"x": one} for one in second]), tmp_path, processes=0)
    assert table.frame()["x"].tolist() == [float(one) for one in second]
    assert table.frame()["case"].tolist() == list(range(len(second)))
    stored = tables.read(tmp_path)[0].to_pandas()
    others = stored[stored["case"] == tables.NO_CASE]
    assert len(others) == len(set(others["key"])) == left
    assert set(others["key"]).isdisjoint(stored["key"][stored["case"] >= 0])
    assert Rows.read(tmp_path).frame["x"].tolist() == [float(one) for one in second]


def test_indices_are_those_of_the_design_asked_for(tmp_path) -> None:
    def design(samples):
        over = {name: read_distribution("uniform(-3.14, 3.14)") for name in "abc"}
        return Design(sample=Sample("saltelli", samples, over))

    sweep(job(ishigami, "f"), design(16), tmp_path / "both", processes=0)
    for folder in ("both", "alone"):
        sweep(job(ishigami, "f"), design(32), tmp_path / folder, processes=0)
    both, alone = (sobol_indices(Rows.read(tmp_path / folder), "f") for folder in ("both", "alone"))
    assert both == alone


def test_words_where_a_sweep_has_numbers_are_refused(tmp_path) -> None:
    sweep(job(square), columns("1", "word"), tmp_path, processes=0)
    with pytest.raises(UsageError, match="has words for x"):
        sweep(job(square), columns("1", "2"), tmp_path, processes=0)


def test_a_probability_counts_a_value_as_often_as_the_sample_has_it(tmp_path) -> None:
    sample = Design(sample=Sample("monte_carlo", 20, {"x": read_distribution("choice(1, 2)")}))
    sweep(job(square), sample, tmp_path, processes=0)
    table, standing = sweep(job(square), sample, tmp_path, processes=0)
    assert (breach(table.frame()).cases, standing.done, standing.reused) == (20, 0, 20)


@pytest.mark.parametrize("values", [("mu=-0.1,0.2,0.3", "mu"), ("mu=0.3,0.2,-0.1", "mu")])
def test_a_number_beyond_its_range_costs_its_row_wherever_it_stands(values, slide, tmp_path) -> None:
    found = told(slide, "--grid", values[0], "--figure", "end(block.x)", "--out", tmp_path / "t")
    assert found["cases"] == {"finished": 2, "refused": 1}


def test_a_sample_with_both_tails_beyond_the_range_runs(slide, tmp_path) -> None:
    cases = tmp_path / "cases.csv"
    cases.write_text("mu\n-1\n0.3\n-2\n")
    found = told(slide, "--cases", cases, "--figure", "end(block.x)", "--out", tmp_path / "t")
    assert found["cases"] == {"finished": 1, "refused": 2}


@pytest.mark.parametrize("grid", [["mu=0.2,0.3", "pad.method=hold,hodl"], ["mu=0.2,0.3", "block.mass=1 kg,2 m"],
                                  ["mu=-1,-2"]])  # fmt: skip
def test_a_word_or_a_dimension_that_nobody_takes_ends_the_sweep_first(grid, slide, tmp_path) -> None:
    words = [word for one in grid for word in ("--grid", one)]
    answer = CliRunner().invoke(app, ["sweep", str(slide), *words, "--out", str(tmp_path / "t")])
    assert answer.exit_code == ModelError.exit_code
    assert "mu = " in answer.output
    assert not (tmp_path / "t").exists()


def test_the_rows_are_written_for_a_spreadsheet(slide, tmp_path) -> None:
    for grid in ("mu=0.2", "mu=0.4,0.3"):
        told(slide, "--grid", grid, "--figure", "end(block.x)", "--out", tmp_path / "t", "--csv", tmp_path / "t.csv")
    head, *lines = (tmp_path / "t.csv").read_text().splitlines()
    assert head.split(",")[:2] == ["case", "key"]
    assert [line.split(",")[2] for line in lines] == ["0.4", "0.3"]


def test_a_sweep_tells_of_broken_limits_at_its_end(slide, tmp_path) -> None:
    answer = CliRunner().invoke(app, ["sweep", str(slide), "--grid", "mu=0.1,0.2,0.4", "--figure", "end(block.x)",
                                      "--out", str(tmp_path / "t"), "--processes", "0"])  # fmt: skip
    assert "limits are broken in 2 of 3 cases" in answer.output
    assert "cases per second" in answer.output
