"""A result in the hands of Python: elements by time and place, unique times, workbooks, tables, figures."""

import builtins
import pathlib

import numpy as np
import pandas
import pytest

import fairlead
from fairlead.analysis.margins.margins import margins
from fairlead.errors import FairleadError, ModelError, UsageError

STICK_SLIP = """
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg, velocity: 0.2 m/s}
  belt: {type: MotionSource, velocity: 0.2 m/s}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 1.0, coulomb: 0.6}}
connections: [[wall.flange, spring.a], [spring.b, block.flange, pad.b], [belt.flange, pad.a]]
run: {stop: 3 s, accuracy: 1e-6}
limits: {spring.tension: {below: 5 N}, block.x: {above: -1 m}}
"""


@pytest.fixture(scope="module")
def route():
    return fairlead.load("guidance_route", set={"run.stop": "0.2 s"}).run(out=None)


@pytest.fixture
def belt(scene):
    return scene(STICK_SLIP).run(out=None)


def test_every_column_is_explained_in_the_documentation(belt):
    page = (pathlib.Path(__file__).parents[2] / "docs" / "python.md").read_text(encoding="utf-8")
    told = page.partition("The columns of these tables")[2].partition("```")[0]
    rows = {name: row for row in told.splitlines() if (name := row.partition("`")[2].partition("`")[0])}
    for name, table in (("margins()", belt.margins()), ("switches()", belt.switches()), ("limits", belt.limits),
                        ("energy", belt.energy)):  # fmt: skip
        assert [column for column in table.columns if f"`{column}`" not in rows[name]] == []


# Elements


@pytest.mark.slow
def test_elements_are_the_signals_side_by_side_with_their_places_along_the_line(route):
    found = route.elements("line.hose[*].tension")
    assert found.dims == ("time", "element")
    assert found.attrs["units"] == "N"
    for k in (0, 7, 159):
        assert np.array_equal(found.values[:, k], route[f"line.hose[{k}].tension"])
    assert np.allclose(found["along"], 0.25 * (np.arange(160) + 0.5))  # 40 m in elements of 0.25 m, their middles
    x = [route[f"line.hose_node[{k}].x"] for k in (7, 8)]
    assert np.allclose(found["place"].values[:, 7], (x[0] + x[1]) / 2)


@pytest.mark.slow
def test_nodes_have_the_places_of_nodes_also_where_some_have_none(route):
    nodes = route.elements("line.hose_node.x")
    assert np.allclose(nodes["along"], 0.25 * np.arange(161))
    assert np.array_equal(nodes["place"].values, nodes.values)
    inner = route.elements("line.inner[*].slip")  # none at the ends
    assert list(inner["element"].values) == list(range(1, 160))
    assert np.allclose(inner["along"], 0.25 * np.arange(1, 160))


def test_an_element_is_found_by_time_and_by_its_place(route):
    found = route.elements("line.core[*].tension", side="right")
    one = found.sel(time=0.1, along=5.05, method="nearest")
    assert one["element"] == 20
    at = np.abs(found["time"].values - 0.1).argmin()
    assert one.item() == route.elements("line.core[*].tension", side="right").values[at, 20]
    assert found.sel(element=20).dims == ("time",)
    assert np.allclose(found.interp(time=0.1).values[20], found.sel(element=20).interp(time=0.1))


def test_what_is_not_one_family_is_refused_by_name(route, belt):
    with pytest.raises(UsageError, match=r"stands for 2 families of elements: .*hose.*core.*\n.*families\(\)"):
        route.elements("line.*.tension")
    with pytest.raises(UsageError, match=r"block\.x stands for no elements"):
        belt.elements("block.x")
    with pytest.raises(FairleadError, match="was not recorded"):
        route.elements("line.hoose[*].tension")


def test_families_are_listed(route):
    table = route.families()
    row = next(row for row in table if row["family"] == "line.inner[*].slip")
    assert (row["unit"], row["count"], row["first"], row["last"]) == ("m/s", 159, 1, 159)


def test_elements_outside_a_route_have_their_numbers():
    result = fairlead.load("hundred_blocks", set={"run.stop": "10 ms", "blocks": 5}).run(out=None)
    name = result.families()["family"][0]
    found = result.elements(name)
    assert "along" not in found.coords
    assert found.sizes["element"] == 5


# Unique times


def test_the_time_of_an_event_occurs_twice_unless_one_side_is_asked_for(belt):
    both = belt.to_xarray()
    for side, choose in (("left", "first"), ("right", "last")):
        data, frame = belt.to_xarray(side=side), belt.to_pandas(side=side)
        assert data.indexes["time"].is_unique
        assert frame.index.is_unique
        assert list(frame.index) == sorted(set(both["time"].values))
        kept = belt.to_pandas()[~belt.to_pandas().index.duplicated(keep=choose)]
        assert frame.equals(kept)
    assert not both.indexes["time"].is_unique


def test_one_side_can_be_interpolated_reindexed_and_looked_up(belt):
    data = belt.to_xarray(["spring.tension", "block.x"], side="right")
    times = np.linspace(0.0, 3.0, 7)
    assert np.allclose(data.interp(time=times)["block.x"], belt.at("block.x", times), atol=1e-3)
    assert data.sel(time=1.0, method="nearest")["time"].item() == pytest.approx(1.0, abs=0.1)
    assert data.reindex(time=times, method="nearest")["block.x"].shape == (7,)
    assert belt.to_pandas("block.x", side="right").reindex(times, method="nearest").shape == (7, 1)


@pytest.mark.parametrize("engine", ["h5netcdf", "scipy"])
@pytest.mark.parametrize("folder", [False, True])
def test_a_dataset_is_written_as_netcdf_and_read_again(scene, tmp_path, engine, folder):
    import xarray

    pytest.importorskip(engine)
    result = scene(STICK_SLIP).run(out=tmp_path / "run" if folder else None)
    data, file = result.to_xarray(side="right"), tmp_path / "belt.nc"
    assert any(isinstance(one, bool) for one in result.run.values())
    data.to_netcdf(file, engine=engine)
    with xarray.open_dataset(file, engine=engine) as again:
        assert again.equals(data)
        assert dict(again.attrs) == data.attrs


def test_another_side_is_refused(belt):
    for call in (belt.to_xarray, belt.to_pandas):
        with pytest.raises(UsageError, match="side = middle is none of left, right, both"):
            call(side="middle")


# Excel


@pytest.mark.slow
def test_a_workbook_holds_signals_events_and_the_run(belt, tmp_path):
    pytest.importorskip("openpyxl", reason="the extra fairlead[excel]")
    path = tmp_path / "belt.xlsx"
    belt.to_excel(path, "block.*")
    sheets = pandas.read_excel(path, sheet_name=None)
    signals, events, run = sheets["signals"], sheets["events"], sheets["run"]
    assert list(signals.columns) == ["time [s]", "side", "block.x [m]", "block.v [m/s]"]
    assert np.allclose(signals["block.x [m]"], belt["block.x"], rtol=1e-15, atol=0)  # 16 digits
    assert np.allclose(signals["time [s]"], belt.t, rtol=1e-15, atol=0)
    assert [row.component for row in events.itertuples()] == [event.component for event in belt.events]
    assert run.set_index("entry")["value"]["name"] == "'scene'"
    belt.to_excel(path, ["block.x"], side="right")
    assert pandas.read_excel(path)["time [s]"].is_unique


@pytest.mark.slow
def test_a_text_that_looks_like_a_formula_is_a_text(belt, tmp_path):
    openpyxl = pytest.importorskip("openpyxl", reason="the extra fairlead[excel]")
    belt.run["=1+1"] = "=cmd|calc\x00"
    belt.to_excel(tmp_path / "run.xlsx", ["block.x"])
    cells = [cell for row in openpyxl.load_workbook(tmp_path / "run.xlsx")["run"].iter_rows() for cell in row]
    assert any(cell.value == "=1+1" for cell in cells)
    assert {cell.data_type for cell in cells} == {"s"}


def test_without_openpyxl_the_cure_is_named(belt, tmp_path, monkeypatch):
    real = builtins.__import__

    def missing(name, *given, **more):
        if name == "openpyxl":
            raise ImportError("No module named 'openpyxl'")
        return real(name, *given, **more)

    monkeypatch.setattr(builtins, "__import__", missing)
    with pytest.raises(UsageError, match=r"needs the package openpyxl.*\n    Install it with  pip install 'fairlead\["):
        belt.to_excel(tmp_path / "belt.xlsx")
    assert not list(tmp_path.glob("*.xlsx"))


def test_what_does_not_fit_on_a_sheet_is_refused(belt, tmp_path, monkeypatch):
    pytest.importorskip("openpyxl", reason="the extra fairlead[excel]")
    monkeypatch.setattr("fairlead.results.excel.MOST_ROWS", 10)
    with pytest.raises(UsageError, match="do not fit on a sheet, which has 10 rows"):
        belt.to_excel(tmp_path / "belt.xlsx")


# Tables


def test_margins_are_those_of_the_command_line_in_a_table(route):
    table, (line,) = route.margins(), margins(route)
    frame = table.to_pandas()
    for station in (*line.stations, line.whole):
        of_station = frame[frame["station"] == station.name].set_index("quantity")
        assert of_station.loc["peak", "value"] == station.peak.value
        assert of_station.loc["peak", "t"] == station.peak.t
        assert of_station.loc["hose", "signal"] == station.hose.signal
        assert of_station.loc["hose", "margin"] == line.ruck_margin(station)
    assert len(frame) > 10


def test_limits_tell_the_nearest_value_and_whether_they_are_broken(belt):
    """Let go at stiction, 10 N, with 0.2 m/s, the block swings about 6 N:  6 N + sqrt((4 N)^2 + (v sqrt(k m))^2)."""
    tension, position = belt.limits
    assert (tension["signal"], tension["allowed"], tension["broken"]) == ("spring.tension", "below 5 N", True)
    assert tension["value"] == pytest.approx(6 + np.hypot(4.0, 0.2 * 10.0), rel=1e-5)
    assert not position["broken"]


def test_the_entries_of_the_energy_add_up(belt):
    found = dict(zip(belt.energy["entry"], belt.energy["energy"], strict=True))
    assert found["missing"] == found["stored"] + found["dissipated"] - found["supplied"]
    assert abs(found["missing"]) < 1e-6 * found["supplied"]
    assert found["supplied"] == pytest.approx(belt["energy.supplied"][-1] - belt["energy.supplied"][0])


def test_switches_count_the_events_of_each_component(belt):
    table = belt.switches()
    assert sum(table["count"]) == len(belt.events)
    row = table[0]
    same = [e.t for e in belt.events if tuple(e)[1:4] == (row["component"], row["zone_from"], row["zone_to"])]
    assert (row["count"], row["first"], row["last"]) == (len(same), min(same), max(same))
    assert len(belt.switches("pad")) == len(table)
    with pytest.raises(UsageError, match=r"No component of the name pda changes zone\. Did you mean pad\?"):
        belt.switches("pda")


# Figures


@pytest.mark.slow
def test_a_plot_is_a_figure_with_a_panel_for_each_unit(belt, tmp_path):
    figure = belt.plot(["block.*", "spring.tension"], between=(1.0, "2 s"), title="stick", file=tmp_path / "stick.png")
    assert [ax.get_ylabel() for ax in figure.axes] == ["x [m]", "v [m/s]", "tension [N]"]
    assert figure.axes[0].get_xlim() == (1.0, 2.0)
    assert figure._repr_png_().startswith(b"\x89PNG")
    assert (tmp_path / "stick.png").read_bytes().startswith(b"\x89PNG")
    assert "matplotlib.pyplot" not in str(type(figure))


def test_elements_are_drawn_with_one_colour_scale(route):
    figure = route.plot("line.hose[*].tension")
    assert len(figure.axes) == 2  # curves and the bar of colours


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"names": "block.y"}, "block.y was not recorded"),
        ({"names": []}, "there is no signal to draw"),
        ({"names": "block.x", "between": (2.0, 1.0)}, r"Result.plot: between = \(2, 1\) are not two numbers"),
        ({"names": "block.x", "between": 3}, "Result.plot: between = 3 are not two numbers"),
        ({"names": "block.x", "between": ("a", "b")}, r"between\[0\] = a is not a quantity"),
        ({"names": "block.x", "file": "x.gif"}, r"x\.gif is no figure that can be drawn\.\n    Formats are \.png"),
        ({"names": "block.x", "file": 3}, "Result.plot: file = 3 is not a path"),
    ],
)
def test_a_plot_that_cannot_be_drawn_is_refused_by_name(belt, given, says):
    with pytest.raises((FairleadError, ModelError), match=says):
        belt.plot(given.pop("names"), **given)
