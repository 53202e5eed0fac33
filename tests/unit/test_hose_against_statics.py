"""How hose and core of a run share the tension, beside the estimate of statics: marked, compared, with a direction.

An array that no drag pulls and whose bulkheads hold in the bend has one strain in both layers everywhere, so that the
estimate is the hose's share of the stiffness.
"""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from fairlead.analysis.margins.quasi_static import against_statics
from fairlead.analysis.statics.route_record import route_records
from fairlead.cli import app
from fairlead.cli.summary import summary_rows
from fairlead.results import Result, RunDirectory, Signal

ARRAY = """
components:
  line:
    {type: ArrayModule, length: 14 m, element: 0.25 m, start: -6 m, tension: 100 N,
     hose: {mass: 1 kg/m, stiffness: 8 kN}, core: {mass: 4 kg/m, stiffness: 500 kN},
     bulkhead_friction: 0.5, ruck_force: 50 N}
  route:
    type: Route
    stations:
      - {type: Bend, start: 2 m, angle: 1 rad, radius: 1 m, friction: 0.3}
      - {name: belts, type: Deployer, start: 4 m, length: 1 m, friction: 0.5, clamp: 1 kN/m}
  drive: {type: MotionSource, velocity: {ramp: {to: 0.5 m/s, over: 1 s}}}
  back: {type: ForceSource, force: -100 N}
  load: {type: ForceSource, force: 60 N}
connections:
  - [line.path, route.path]
  - [drive.flange, route.belts.belt]
  - [back.flange, line.inboard]
  - [load.flange, line.outboard]
run: {stop: 5 s}
record: {every: 20 ms, signals: ["line.hose[*].tension", "line.core[*].tension", "line.hose_node[*].x"]}
"""
SHARE = 8 / 508
DIP = (100, 30)  # row, element: at 2 s


def written(model, path, shifted, dip=None):
    """Results of the array under the closed form's tensions, the hose's `shifted` N off; `dip`: its tension once."""
    t = np.linspace(0.0, 5.0, 251)
    way = np.where(t < 1, 0.25 * t**2, 0.25 + 0.5 * (t - 1))
    nodes = way[:, None] + np.arange(57) * 0.25 - 6
    middle = (nodes[:, 1:] + nodes[:, :-1]) / 2
    total = np.where(middle < 4, 100 * np.exp(0.3 * np.clip(middle - 2, 0, 1)), 60)
    hose = SHARE * total + shifted
    core = total - hose
    if dip is not None:
        hose[DIP] = dip
    names = [f"line.{layer}[{k}].tension" for layer in ("hose", "core") for k in range(56)]
    names += [f"line.hose_node[{k}].x" for k in range(57)]
    header = {"routes": route_records(model.flat)}
    with RunDirectory.create(path, [Signal(name, "N") for name in names], header) as directory:
        directory.append(t, np.hstack([hose, core, nodes]), np.zeros(len(t)))
    return Result.open(path)


def told(found):
    return dict(summary_rows({"against_statics": found}, "x"))


def test_layers_are_compared_though_their_sum_agrees(scene, tmp_path):
    model = scene(ARRAY)
    found = against_statics(model.flat, written(model, tmp_path / "run", -20.0))
    assert found["difference"] < 1e-9
    assert found["shares"]["too_high"] == pytest.approx(20, abs=1e-6)
    core = found["shares"]["core"]
    assert core["run"] - core["statics"] == pytest.approx(20, abs=1e-6)
    assert "20 N too high" in told(found)["hose and core"]


def test_an_estimate_that_is_right_is_off_by_nothing(scene, tmp_path):
    model = scene(ARRAY)
    found = against_statics(model.flat, written(model, tmp_path / "run", 0.0))
    assert abs(found["shares"]["too_high"]) < 1e-6


def test_the_lowest_hose_is_told_with_place_time_and_both_margins(scene, tmp_path):
    """By statics 60 N outboard of the belts leave the hose 0.94 N, no compression. The run has 80 of 50 N borne."""
    model = scene(ARRAY)
    found = against_statics(model.flat, written(model, tmp_path / "run", 0.0, dip=-80.0))
    lowest = found["lowest"]
    assert lowest["run"] == -80
    assert lowest["statics"] == pytest.approx(60 * SHARE)
    assert lowest["t"] == pytest.approx(2.0)
    assert lowest["place"] == pytest.approx(0.25 + 0.5 + 30 * 0.25 - 6 + 0.125)
    assert lowest["station"] == "bend"
    assert lowest["run_margin"] == pytest.approx(50 / 80)
    assert lowest["statics_margin"] is None
    row = told(found)["lowest hose"]
    assert "ruck margin 0.62 for none (no compression)" in row
    assert row.endswith("80.9 N too high, on the unsafe side")


def test_an_estimate_on_the_safe_side_is_not_called_unsafe(scene, tmp_path):
    model = scene(ARRAY)
    found = against_statics(model.flat, written(model, tmp_path / "run", 20.0))
    assert "20 N too low" in told(found)["lowest hose"]
    assert "unsafe" not in told(found)["lowest hose"]


def test_the_lowest_hose_is_compared_where_the_total_cannot_be(scene, tmp_path):
    """A moved outboard end leaves the total open; its table has a ruck margin all the same."""
    moved = "load: {type: MotionSource, velocity: {ramp: {to: 0.5 m/s, over: 1 s}}}"
    model = scene(ARRAY.replace("load: {type: ForceSource, force: 60 N}", moved))
    found = against_statics(model.flat, written(model, tmp_path / "run", 0.0, dip=-80.0))
    assert found["difference"] is None
    assert found["lowest"]["run"] == -80
    assert "not compared" in told(found)["against statics"]


@pytest.mark.slow
def test_the_table_of_statics_marks_what_is_an_estimate():
    answer = CliRunner().invoke(app, ["statics", "guidance_route_ideal", "--set", "mu=0.6"])
    (bend, *_) = [line.split() for line in answer.output.splitlines() if line.strip().startswith("bend_a")]
    assert bend[4:7] == ["200", "513", "513"]  # two tensions and a load in closed form
    assert [cell[0] for cell in (bend[7], bend[8], bend[10])] == ["~", "~", "~"]  # core, hose, ruck margin
    assert "~ is an estimate" in answer.output
    (found,) = json.loads(CliRunner().invoke(app, ["statics", "guidance_route_ideal", "--json"]).output)
    assert {"hose", "core", "ruck_margin"} <= set(found["states"][0]["estimated"])


def test_a_line_of_one_layer_has_no_estimate():
    answer = CliRunner().invoke(app, ["statics", "capstan"])
    assert "~" not in answer.output
