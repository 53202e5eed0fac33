"""Indices and pictures of a sweep, from its table alone."""

import math

import pytest
from matplotlib.figure import Figure
from typer.testing import CliRunner

from fairlead.cases import Cases
from fairlead.cli import app
from fairlead.errors import UsageError
from fairlead.studies.sweeps.design import Design, Sample
from fairlead.studies.sweeps.distributions import read_distribution
from fairlead.studies.sweeps.sweep import sweep
from tests.studies.jobs import ishigami, job, square

pytest.importorskip("pyarrow", reason="pyarrow is not installed; pip install 'fairlead[sweep]'")
from fairlead.studies.pictures.draw import draw, fitting
from fairlead.studies.pictures.indices import morris_indices, sobol_indices
from fairlead.studies.pictures.rows import Rows
from fairlead.studies.pictures.tornado import tornado

LAW = read_distribution(f"uniform({-math.pi!r}, {math.pi!r})")


def swept(tmp_path, kind, samples):
    sample = Sample(kind, samples, dict.fromkeys("abc", LAW), seed=1)
    sweep(job(ishigami, "f"), Design(sample=sample), tmp_path, processes=0)
    return Rows.read(tmp_path)


@pytest.mark.slow
def test_sobol_indices_of_the_ishigami_function_are_those_of_its_variance(tmp_path) -> None:
    # V = a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2 with a = 7, b = 0.1; Sobol and Levitan (1999), eq. 4
    whole = 49 / 8 + 0.1 * math.pi**4 / 5 + 0.01 * math.pi**8 / 18 + 0.5
    alone = 0.5 * (1 + 0.1 * math.pi**4 / 5) ** 2
    together = 0.01 * math.pi**8 * (1 / 18 - 1 / 50)
    first, total = (alone, 49 / 8, 0.0), (alone + together, 49 / 8, together)
    found = sobol_indices(swept(tmp_path, "saltelli", 1024), "f")
    for index, one, other in zip(found, first, total, strict=True):
        assert index.first == pytest.approx(one / whole, abs=0.05)  # of 1024 points: 0.03 from seed to seed
        assert index.total == pytest.approx(other / whole, abs=0.05)
        assert index.total_interval[0] < other / whole < index.total_interval[1]


def test_morris_tells_a_straight_line_exactly(tmp_path) -> None:
    pytest.importorskip("SALib", reason="SALib is not installed; pip install 'fairlead[sweep]'")
    over = {"x": read_distribution("uniform(0, 2)"), "y": read_distribution("uniform(0, 5)")}
    sample = Sample("morris", 6, over)
    sweep(job(line, "z"), Design(sample=sample), tmp_path, processes=0)
    x, y = morris_indices(Rows.read(tmp_path), "z")
    # The elementary effect of 3 x over a range of 2 is 6, of -y over 5 it is 5, though points keep off its ends.
    assert x.total == pytest.approx(6, rel=1e-9)
    assert y.total == pytest.approx(5, rel=1e-9)
    assert x.first == pytest.approx(0, abs=1e-9)


def line(values):
    return {"z": 3 * values["x"] - values["y"]}


def test_a_tornado_averages_over_the_others(tmp_path) -> None:
    grid = {"x": ["0", "1", "2"], "y": ["0", "10"]}
    sweep(job(line, "z"), Design(grid=grid), tmp_path, processes=0)
    wide, narrow = tornado(Rows.read(tmp_path), "z")
    assert (wide.parameter, wide.low, wide.high, wide.at_low, wide.at_high) == ("y", -7.0, 3.0, "10", "0")
    assert (narrow.parameter, narrow.width) == ("x", 6.0)


@pytest.mark.slow
def test_pictures_are_those_that_fit_the_design(tmp_path) -> None:
    sweep(job(line, "z"), Design(grid={"x": ["0", "1"], "y": ["0", "10"]}), tmp_path / "grid", processes=0)
    drawn, _ = draw(Rows.read(tmp_path / "grid"), "z", tmp_path / "figures")
    assert [file.stem for file in drawn] == ["response", "heat_map", "tornado", "failures"]
    drawn, _ = draw(swept(tmp_path / "sample", "saltelli", 8), "f", tmp_path / "others")
    assert [file.stem for file in drawn] == ["scatter", "tornado", "failures", "indices"]
    assert all(file.stat().st_size > 5000 for file in drawn)


def test_a_sweep_without_a_row_and_an_unknown_figure_are_sentences(tmp_path) -> None:
    with pytest.raises(UsageError, match="no table"):
        Rows.read(tmp_path)
    sweep(job(square), Design(grid={"x": ["1", "2"]}), tmp_path, processes=0)
    with pytest.raises(UsageError, match="There are y"):
        Rows.read(tmp_path).figure("z")


def test_the_legend_of_a_picture_stands_beside_its_data(tmp_path) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    grid = {"x": ["0", "1", "2"], "y": ["0", "10"]}
    sweep(job(line, "z"), Design(grid=grid), tmp_path, processes=0)
    rows = Rows.read(tmp_path)
    for name, make, size in fitting(rows):
        made = Figure(figsize=size, layout="constrained")
        make(made, rows, "z")
        FigureCanvasAgg(made).draw()
        legends = [*made.legends, *(ax.get_legend() for ax in made.axes if ax.get_legend())]
        assert not any(one.get_window_extent().overlaps(ax.bbox) for one in legends for ax in made.axes), name


def never(values):
    """A figure of events that never come, and one of events that come for some."""
    return {"never": math.nan, "late": values["x"] if values["x"] > 1 else math.nan, "z": values["x"]}


def test_a_figure_without_a_value_is_a_sentence(tmp_path) -> None:
    """It was a traceback of the tornado."""
    grid = {"x": ["1", "2", "3"], "y": ["0", "10"]}
    sweep(job(never, "never", "late", "z"), Design(grid=grid), tmp_path, processes=0)
    rows = Rows.read(tmp_path)
    with pytest.raises(UsageError, match=r"never has no value in any case(?s:.*)Figures with values: late, z"):
        rows.figure("never")
    assert rows.figure("") == "late"
    written, reasons = draw(rows, "late", tmp_path / "figures")
    assert [file.stem for file in written] == ["response", "heat_map", "tornado", "failures"]
    assert not reasons


def fails_above(values):
    if values["a"] > 2:
        raise ValueError("too far")
    return ishigami(values)


def test_pictures_are_named_beside_a_reason_why_one_cannot_be_drawn(tmp_path) -> None:
    """They were written and not named: the command ended with the reason alone."""
    sample = Sample("saltelli", 8, dict.fromkeys("abc", LAW), seed=1)
    sweep(job(fails_above, "f"), Design(sample=sample), tmp_path / "sweep", processes=0)
    outcome = CliRunner().invoke(app, ["plot", str(tmp_path / "sweep"), "--out", str(tmp_path / "drawn")])
    assert outcome.exit_code == 0, outcome.output
    assert "Indices need every case" in outcome.output
    for name in ("scatter", "tornado", "failures"):
        assert f"{name}.png" in outcome.stdout


def of_a_word(values):
    return {"z": float(len(values["word"]))}


def test_of_words_the_ends_of_cases_are_drawn_and_of_one_case_nothing(tmp_path) -> None:
    """Both wrote nothing and said nothing."""
    sweep(job(of_a_word, "z"), Design(grid={"word": ["hold", "tanh"]}), tmp_path / "words", processes=0)
    written, _ = draw(Rows.read(tmp_path / "words"), "z", tmp_path / "figures")
    assert [file.stem for file in written] == ["failures"]
    sweep(job(of_a_word, "z"), Design(grid={"word": ["hold"]}), tmp_path / "one", processes=0)
    with pytest.raises(UsageError, match="All cases have the same values"):
        draw(Rows.read(tmp_path / "one"), "z", tmp_path / "none")


def test_cases_that_stand_twice_in_a_design_were_not_there_before(tmp_path) -> None:
    _, standing = sweep(job(square), Design(grid={"x": ["1", "2", "1"]}), tmp_path, processes=0)
    assert (standing.reused, standing.twice) == (1, 1)
    _, standing = sweep(job(square), Design(grid={"x": ["1", "2", "1"]}), tmp_path, processes=0)
    assert (standing.reused, standing.twice) == (3, 0)


PUSHED = """
    parameters: {push: 2 kN, share: 0.2}
    components:
      floor: {type: Ground}
      crate: {type: Mass, mass: 2 kg}
      skid: {type: Contact, normal_force: 10 N, curve: "{share}"}
      hand: {type: ForceSource, force: "{push}"}
    connections: [[floor.flange, skid.a], [crate.flange, skid.b, hand.flange]]
    run: {stop: 0.1 s}
"""


def test_parameters_of_pictures_have_units_and_what_they_are(scene, tmp_path) -> None:
    """Values of a table are in SI; a parameter that the scene does not give, such as `position`, has a unit too."""
    grid = {"push": ["1 kN", "2 kN"], "skid.normal_force": ["5 N", "10 N"], "crate.position": ["0 m", "5 mm"]}
    sweep(Cases(scene(PUSHED), {"end": "end(crate.x)"}), Design(grid=grid), tmp_path / "sweep", processes=0)
    rows, drawn = Rows.read(tmp_path / "sweep"), {}
    for name, make, _ in fitting(rows):
        make(figure := Figure(), rows, "end")
        drawn[name] = figure
    ax, bar = drawn["heat_map"].axes
    assert ax.get_xlabel() == "push [N]"
    assert ax.get_ylabel().splitlines()[0] == "skid.normal_force [N]"
    assert ax.get_ylabel().splitlines()[1].startswith("Normal force")
    assert bar.get_ylabel() == "end [m], mean over crate.position"
    (legend,) = drawn["response"].legends
    told = [text.get_text().replace("\u00a0", " ") for text in legend.get_texts()]
    assert told[1] == "skid.normal_force = 5 N, crate.position = 0.005 m"
    ends = {text.get_text().strip().replace("\u00a0", " ") for text in drawn["tornado"].axes[0].texts}
    assert {"1000 N", "2000 N", "5 N", "10 N"} <= ends


def test_a_tornado_of_a_grid_takes_its_values_however_many_there_are(tmp_path) -> None:
    grid = {"x": [str(k) for k in range(11)], "y": ["0", "10"]}
    sweep(job(line, "z"), Design(grid=grid), tmp_path, processes=0)
    wide, _ = tornado(Rows.read(tmp_path), "z")
    assert (wide.at_low, wide.at_high, wide.low, wide.high) == ("0", "10", -5.0, 25.0)


def test_a_table_from_before_units_of_parameters_is_drawn_without_them(tmp_path) -> None:
    sweep(job(line, "z"), Design(grid={"x": ["0", "1"], "y": ["0", "10"]}), tmp_path, processes=0)
    rows = Rows.read(tmp_path)
    del rows.heading["about"]
    assert (rows.label("x"), rows.value("x", 0.5)) == ("x", "0.5")
