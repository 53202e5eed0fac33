"""Figures: what is drawn, under which name, and what happens to odd records."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg

from fairlead.errors import UsageError
from fairlead.report import figures, map, panel
from fairlead.results import Result, RunDirectory, Signal

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
SIGNALS = (
    Signal("haul.force", "N", "pull of the haul"),
    Signal("block.v", "m/s", "speed of the block"),
    *(Signal(f"line.core[{i}].tension", "N", "pull in the core") for i in range(12)),
)


@pytest.fixture
def result(tmp_path: Path) -> Result:
    header = {"name": "bend <1>", "description": "A line & a bend.", "settings": {"accuracy": 1e-3}}
    run = RunDirectory.create(tmp_path / "run", SIGNALS, header)
    t = np.linspace(0, 1, 50)
    run.append(t, np.outer(t, np.arange(len(SIGNALS))), np.r_[np.zeros(49), -1])
    run.append(t + 1, np.outer(t, np.arange(len(SIGNALS))) + 3, np.r_[1, np.zeros(49)])
    run.event(1.0, "line.bulkhead[2]", "stuck", "forward", "slides")
    run.finish("finished", {"steps": 99, "limits_broken": ["line.core[3].tension = 7 N is above 6 N"]})
    return Result.open(tmp_path / "run")


def is_picture(path: Path) -> bool:
    return path.read_bytes().startswith(PNG_SIGNATURE)


@pytest.mark.slow
def test_a_plot_of_the_netlist_becomes_a_picture_in_the_run_directory(result: Result) -> None:
    (path,) = figures.draw(result, [{"signals": ["line.*.tension", "block.v"], "file": "pull.png"}])
    assert path == result.path / "pull.png"
    assert is_picture(path)


def test_plots_with_one_title_get_different_files(result: Result) -> None:
    plots = [{"title": "Pull / N", "signals": "haul.force"}, {"title": "Pull / N", "signals": "block.v"}]
    assert [path.name for path in figures.draw(result, plots)] == ["Pull_N.png", "Pull_N_2.png"]


@pytest.mark.slow
def test_without_plots_every_quantity_gets_a_figure(result: Result) -> None:
    assert [path.name for path in figures.draw(result)] == ["force.png", "v.png", "tension.png"]


def test_a_pattern_that_fits_nothing_is_warned_of(result: Result) -> None:
    with pytest.warns(UserWarning, match=r"no recorded signal fits block\.vv\. Did you mean block\.v\?"):
        assert figures.draw(result, [{"signals": ["block.vv"]}]) == []


@pytest.mark.parametrize("file", ["../out.png", "/out.png", "sub/out.png"])
def test_a_picture_stays_in_the_run_directory(result: Result, file: str) -> None:
    with pytest.raises(UsageError, match="plain file name"):
        figures.draw(result, [{"signals": ["block.v"], "file": file}])


def test_signals_of_different_units_get_panels_of_their_own(result: Result) -> None:
    panels = figures._by_unit(result.signals)
    assert [{signal.unit for signal in panel} for panel in panels] == [{"N"}, {"m/s"}]


def test_a_jump_is_drawn_as_a_vertical(result: Result) -> None:
    from matplotlib.figure import Figure

    ax = Figure().subplots()
    panel.draw_panel(ax, result, [SIGNALS[1]])
    t, y = ax.lines[0].get_data()
    rows = np.flatnonzero(t == 1.0)
    np.testing.assert_array_equal(y[rows], [1.0, 3.0])


def test_axes_carry_quantity_and_unit_and_few_signals_a_legend(result: Result) -> None:
    from matplotlib.figure import Figure

    ax = Figure().subplots()
    panel.draw_panel(ax, result, SIGNALS[2:5])
    assert ax.get_ylabel() == "tension [N]"
    assert [text.get_text() for text in ax.get_legend().get_texts()] == [s.name for s in SIGNALS[2:5]]


def test_many_elements_share_a_colour_scale_and_no_legend(result: Result) -> None:
    from matplotlib.figure import Figure

    ax = Figure().subplots()
    panel.draw_panel(ax, result, SIGNALS[2:])
    assert ax.get_legend() is None
    assert len(ax.collections[0].get_segments()) == 12


def test_thinning_keeps_every_extreme_value() -> None:
    rng = np.random.default_rng(1)
    t, y = np.linspace(0, 1, 100_000), rng.normal(size=100_000)
    y[12_345], y[67_890] = 50.0, -50.0
    few_t, few_y = panel.thinned(t, y)
    assert len(few_t) <= panel.MOST_POINTS + 100
    assert (few_y.max(), few_y.min()) == (50.0, -50.0)
    assert (few_t[0], few_t[-1]) == (0.0, 1.0)


@pytest.mark.slow
def test_a_run_without_rows_is_drawn_empty(tmp_path: Path) -> None:
    RunDirectory.create(tmp_path / "run", SIGNALS, {}).finish("failed", {})
    assert all(is_picture(path) for path in figures.draw(Result.open(tmp_path / "run")))


def test_infinite_and_missing_values_do_not_stop_a_figure(tmp_path: Path) -> None:
    with RunDirectory.create(tmp_path / "run", SIGNALS[:1], {}) as run:
        run.append([0.0, 1.0, 2.0], [[np.nan], [np.inf], [1.0]], [0, 0, 0])
    assert is_picture(figures.draw(Result.open(tmp_path / "run"))[0])


def test_a_later_run_removes_the_pictures_of_an_earlier_one(result: Result) -> None:
    (path,) = figures.draw(result, [{"signals": ["block.v"], "file": "v.png"}])
    RunDirectory.create(result.path, SIGNALS, {}, force=True).finish("finished", {})
    assert not path.exists()


def test_a_map_has_values_between_places_and_none_beyond_them() -> None:
    places, values = np.array([[1.0, 2.0, 4.0], [2.0, 3.0, 5.0]]), np.array([[10.0, 20.0, 40.0]] * 2)
    found = map.gridded(places, values, np.array([0.5, 1.5, 3.0, 4.5]))
    np.testing.assert_allclose(found, [[np.nan, 15.0, 30.0, np.nan], [np.nan, np.nan, 20.0, 35.0]])


@pytest.mark.parametrize("along", ["", "line.core[*].tension"])
def test_a_map_becomes_a_picture(result: Result, along: str) -> None:
    plot = {"signals": ["line.core[*].tension"], "kind": "map", "along": along, "file": "map.png"}
    (path,) = figures.draw(result, [plot | ({"between": [2.0, 12.0]} if along else {})])
    assert is_picture(path)


@pytest.mark.filterwarnings("error")
def test_a_map_of_a_run_that_ended_in_its_first_step_is_drawn_without_a_word(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {"name": "one row"})
    run.append(np.zeros(1), np.zeros((1, len(SIGNALS))), np.zeros(1))
    run.finish("budget", {"steps": 1})
    plot = {"signals": ["line.core[*].tension"], "kind": "map", "file": "map.png"}
    assert is_picture(figures.draw(Result.open(tmp_path / "run"), [plot])[0])


def test_places_of_a_map_may_be_one_more_than_its_values(result: Result) -> None:
    found = map._places(result, [f"line.core[{i}].tension" for i in range(11)], result.match("line.core[*].tension"))
    np.testing.assert_allclose(found[0], np.diff(result.columns(result.match("line.core[*].tension"))[0]) / 2
                               + result.columns(result.match("line.core[*].tension"))[0, :-1])  # fmt: skip


def test_a_map_whose_places_do_not_fit_is_told(result: Result) -> None:
    plot = {"signals": ["haul.force", "block.v"], "kind": "map", "along": "line.core[*].tension"}
    with pytest.raises(UsageError, match="a map of 1 signals needs 1 or 2 places, and `along` fits 12"):
        figures.draw(result, [plot])


def said_of_limits(result: Result, bound: float) -> tuple[list[float], list[str]]:
    """Where a limit on the tensions has a line, and what is written in the picture of two of them, 0 to 9 N."""
    from matplotlib.figure import Figure

    text = f"below {bound:g} N"
    result.run["limits"] = [{"signal": "line.core[*].tension", "sense": "below", "bound": bound, "text": text}]
    ax = Figure().subplots()
    panel.draw_panel(ax, result, SIGNALS[3:5])
    lines = [float(line.get_ydata()[0]) for line in ax.lines if line.get_linestyle() == "--"]
    return lines, [text.get_text() for text in ax.texts]


def test_a_limit_is_a_line_with_its_words(result: Result) -> None:
    lines, said = said_of_limits(result, 6.0)
    assert lines == [6.0]
    assert "limit: below 6 N" in said


def test_a_limit_far_from_its_signals_is_told_and_does_not_make_them_small(result: Result) -> None:
    lines, said = said_of_limits(result, 800.0)
    assert lines == []
    assert "limit: below 800 N (above this picture)" in said


def test_a_limit_of_another_signal_is_not_drawn(result: Result) -> None:
    from matplotlib.figure import Figure

    result.run["limits"] = [{"signal": "haul.force", "sense": "below", "bound": 3.0, "text": "below 3 N"}]
    ax = Figure().subplots()
    panel.draw_panel(ax, result, SIGNALS[3:5])
    assert not [text for text in ax.texts if "limit" in text.get_text()]


def test_few_zone_changes_are_labelled_and_many_are_counted(result: Result, tmp_path: Path) -> None:
    from matplotlib.figure import Figure

    ax = Figure().subplots()
    panel.draw_panel(ax, result, SIGNALS[:1])
    assert [text.get_text() for text in ax.texts] == ["line.bulkhead[2] forward"]
    run = RunDirectory.create(tmp_path / "many", SIGNALS, {"name": "many"})
    run.append(np.linspace(0, 1, 9), np.zeros((9, len(SIGNALS))), np.zeros(9))
    for k in range(9):
        run.event(k / 9, "pad", "stuck", "forward", "slides")
    run.finish("finished", {})
    ax = Figure().subplots()
    panel.draw_panel(ax, Result.open(tmp_path / "many"), SIGNALS[:1])
    assert [text.get_text() for text in ax.texts] == ["9 zone changes"]


def panel_of(folder: Path, signals: tuple[Signal, ...], *values: np.ndarray, changes: int = 0) -> Axes:
    """The first panel of a figure of these signals over 1 s, laid out as it is written."""
    run = RunDirectory.create(folder / "run", signals, {"name": "one"})
    run.append(np.linspace(0, 1, len(values[0])), np.column_stack(values), np.zeros(len(values[0])))
    for k in range(changes):
        run.event(k / changes, "pad", "held", "forward", "")
    run.finish("finished", {})
    names = tuple(one.name for one in signals)
    figure = figures.figure_of(Result.open(folder / "run"), figures.Picture("one", names, "one.png"))
    FigureCanvasAgg(figure).draw()
    return figure.axes[0]


@pytest.mark.parametrize("count", [1, 4, 8])
def test_a_legend_of_long_names_stays_in_the_figure_and_off_the_count_of_changes(tmp_path: Path, count: int) -> None:
    signals = tuple(Signal(f"leaf_spring_of_the_block_with_a_long_name_{k}.tension", "N") for k in range(count))
    ax = panel_of(tmp_path, signals, *np.random.default_rng(0).normal(size=(count, 30)), changes=40)
    legend = ax.get_legend().get_window_extent()
    assert ax.figure.bbox.x0 <= legend.x0
    assert legend.x1 <= ax.figure.bbox.x1
    (note,) = [one for one in ax.texts if "zone changes" in one.get_text()]
    assert not legend.overlaps(note.get_window_extent())


@pytest.mark.parametrize(
    ("size", "unit", "label", "top"),
    [(1.6e7, "Pa", "x [MPa]", 16), (4e-5, "m", "x [\u00b5m]", 40), (2e6, "m^2", "x [m^2]", 2)],
)  # fmt: skip
def test_an_axis_of_large_or_small_values_has_a_prefix_with_its_unit(
    tmp_path: Path, size: float, unit: str, label: str, top: float
) -> None:
    ax = panel_of(tmp_path, (Signal("a.x", unit),), np.linspace(0, size, 30))
    assert ax.get_ylabel() == label
    shown = [float(one.get_text().replace("\u2212", "-")) for one in ax.get_yticklabels()]
    assert max(shown) == pytest.approx(top, rel=0.3)


def test_a_curve_that_lies_on_another_is_dashed_so_that_both_are_seen(tmp_path: Path) -> None:
    t = np.linspace(0, 1, 30)
    ax = panel_of(tmp_path, (Signal("a.x", "m"), Signal("b.x", "m"), Signal("c.x", "m")), t, t, 1 - t)
    assert [line.get_linestyle() for line in ax.get_lines()[:3]] == ["-", "--", "-"]
