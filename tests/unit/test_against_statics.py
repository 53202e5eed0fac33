"""A run compared with statics: what is compared, what is told, and why not."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

from fairlead.analysis.margins.quasi_static import against_statics
from fairlead.analysis.statics.route_record import route_records
from fairlead.cli import app
from fairlead.cli.summary import summary_rows
from fairlead.results import Result, RunDirectory, Signal

BENDS = """
components:
  rope: {type: Cable, length: 14 m, element: 0.25 m, start: -6 m, tension: 100 N, mass: 0.5 kg/m, stiffness: 1 MN}
  route:
    type: Route
    stations:
      - {type: Bend, start: 2 m, angle: 1 rad, radius: 1 m, friction: 0.3}
      - {name: belts, type: Deployer, start: 4 m, length: 1 m, friction: 0.5, clamp: 1 kN/m}
  drive: {type: MotionSource, velocity: {ramp: {to: 0.5 m/s, over: 1 s}}}
  back: {type: ForceSource, force: -100 N}
  load: {type: ForceSource, force: 60 N}
connections:
  - [rope.path, route.path]
  - [drive.flange, route.belts.belt]
  - [back.flange, rope.inboard]
  - [load.flange, rope.outboard]
run: {stop: 5 s}
record: {every: 20 ms, signals: ["rope.line[*].tension", "rope.node[*].x"]}
"""


def written(model, path, factor):
    """Results of a rope that moves as the belts do, with tensions of the closed form, `factor` times inboard."""
    t = np.linspace(0.0, 5.0, 251)
    way = np.where(t < 1, 0.25 * t**2, 0.25 + 0.5 * (t - 1))
    nodes = way[:, None] + np.arange(57) * 0.25 - 6
    middle = (nodes[:, 1:] + nodes[:, :-1]) / 2
    angle = np.clip(middle - 2, 0, 1)
    tension = np.where(middle < 4, factor * 100 * np.exp(0.3 * angle), 60)
    names = [f"rope.line[{k}].tension" for k in range(56)] + [f"rope.node[{k}].x" for k in range(57)]
    header = {"routes": route_records(model.flat)}
    with RunDirectory.create(path, [Signal(name, "N") for name in names], header) as directory:
        directory.append(t, np.hstack([tension, nodes]), np.zeros(len(t)))
    return Result.open(path)


def test_tensions_of_the_closed_form_differ_by_nothing(scene, tmp_path):
    model = scene(BENDS)
    found = against_statics(model.flat, written(model, tmp_path / "run", 1.0))
    assert found["difference"] < 1e-9


def test_the_largest_difference_is_told_with_place_and_time(scene, tmp_path):
    model = scene(BENDS)
    found = against_statics(model.flat, written(model, tmp_path / "run", 1.03))
    assert found["difference"] == pytest.approx(0.03)
    assert found["where"] in ("at the inboard end", "outboard of bend")
    assert (found["from"], found["to"]) == (3.0, 5.0)  # the second half of the stretch at 0.5 m/s
    (row,) = [text for name, text in summary_rows({"against_statics": found}, "x") if name == "against statics"]
    assert row.startswith("3 % at most (")


def test_an_end_that_is_moved_has_no_tension_to_compare_with(scene, tmp_path):
    """What pulls there is what the motion needs, which statics cannot know."""
    moved = "load: {type: MotionSource, velocity: {ramp: {to: 0.5 m/s, over: 1 s}}}"
    model = scene(BENDS.replace("load: {type: ForceSource, force: 60 N}", moved))
    found = against_statics(model.flat, written(model, tmp_path / "run", 1.0))
    assert found["difference"] is None
    assert "outboard end is moved" in found["reason"]


def test_what_must_be_recorded_is_said(scene, tmp_path):
    model = scene(BENDS)
    record = {"routes": route_records(model.flat)}
    with RunDirectory.create(tmp_path / "run", [Signal("rope.line[0].tension", "N")], record) as directory:
        directory.append([0.0, 5.0], [[1.0], [1.0]], [0, 0])
    found = against_statics(model.flat, Result.open(tmp_path / "run"))
    assert found["difference"] is None
    assert "record rope.node[*].x" in found["reason"]
    (row,) = [text for name, text in summary_rows({"against_statics": found}, "x") if name == "against statics"]
    assert row == "not compared: record rope.node[*].x to tell where the elements are"


@pytest.mark.slow
def test_a_run_of_a_route_is_compared_and_keeps_it(scene, tmp_path):
    model = scene(BENDS)
    answer = CliRunner().invoke(app, ["run", str(model.netlist.path), "--out", str(tmp_path / "run")])
    assert answer.exit_code == 0, answer.output
    assert "against statics" in answer.output
    found = json.loads((tmp_path / "run" / "run.json").read_text())["against_statics"]
    assert found["difference"] < 0.02  # of the mesh, and of elements that stick and slip one by one
    assert any(found["statics"] == pytest.approx(want) for want in (100.0, 100 * math.exp(0.3), 60.0))


@pytest.mark.slow
def test_a_run_without_a_route_says_nothing_of_statics(tmp_path):
    answer = CliRunner().invoke(app, ["run", "belt", "--set", "run.stop=0.1 s", "--out", str(tmp_path / "run")])
    assert answer.exit_code == 0, answer.output
    assert "against statics" not in answer.output
