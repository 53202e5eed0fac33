"""Margins of a run, from results written by hand, whose numbers can be worked out on paper."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.analysis.margins.margins import margins
from fairlead.cli import app
from fairlead.results import Result, RunDirectory, Signal

STATIONS = [
    {"name": "winch", "type": "Winch", "begin": None, "end": 0.0, "curvature": 0.0, "contact": None, "moves": False},
    {"name": "bend", "type": "Bend", "begin": 1.0, "end": 2.0, "curvature": 0.5, "contact": "outer", "moves": False},
    {"name": "belts", "type": "Deployer", "begin": 2.0, "end": 4.0, "curvature": 0.0, "contact": "outer_belts",
     "moves": True},
]  # fmt: skip
ROUTE = {"line": "line", "route": "route", "layers": ["hose", "core"], "outer": "hose_node", "nodes": 4,
         "ruck_force": 50.0, "side_wall": 100.0, "stations": STATIONS}  # fmt: skip
LIMITS = [{"signal": "line.hose[*].tension", "sense": -1.0, "bound": -30.0, "unit": "N", "text": "above -30 N"}]
TIMES = (0.0, 1.0, 2.0)
HOSE = [[5, 4, 3], [5, -20, 3], [5, 4, -25]]  # N, of three elements at three times
CORE = [[100, 150, 120], [100, 180, 120], [100, 150, 90]]
NODES = [[0.0, 1.0, 2.0, 3.0], [0.5, 1.5, 2.5, 3.5], [1.0, 2.0, 3.0, 4.0]]  # m, paid out at 0.5 m/s
SLIPS = {"outer[1]": 0.5, "outer[2]": 0.5, "outer_belts[2]": 0.1, "outer_belts[3]": 0.3}


def written(path, limits=(), leave_out=(), finish=True, slips=SLIPS):
    """A folder of results with those numbers; a run that is not finished looks like one that was killed."""
    columns = {}
    for k in range(3):
        columns[f"line.hose[{k}].tension"] = [row[k] for row in HOSE]
        columns[f"line.core[{k}].tension"] = [row[k] for row in CORE]
    for k in range(4):
        columns[f"line.hose_node[{k}].x"] = [row[k] for row in NODES]
    columns |= {f"line.{name}.slip": [value] * 3 for name, value in slips.items()}
    columns = {name: values for name, values in columns.items() if not name.startswith(tuple(leave_out) or "?")}
    header = {"routes": [ROUTE], "limits": limits}
    directory = RunDirectory.create(path, [Signal(name, "N") for name in columns], header)
    directory.append(TIMES, np.array(list(columns.values())).T, np.zeros(3))
    if finish:
        directory.finish("finished", {"end_time": 2.0})
    else:
        directory.flush(at_once=True)
    return path


def of(path):
    (found,) = margins(Result.open(path))
    return found, {one.name: one for one in found.stations}


def test_tensions_of_line_that_moves_as_one_body_are_not_judged(tmp_path, monkeypatch):
    """They are those with which it went in; the greatest but for them is at 1.5 m, at the start."""
    monkeypatch.setitem(ROUTE, "rigid_from", 1.8)
    found, _ = of(written(tmp_path))
    assert (found.whole.peak.value, found.whole.peak.t, found.whole.peak.place) == (154, 0.0, 1.5)


def test_the_extremes_of_a_station_are_those_of_the_elements_that_are_in_it(tmp_path):
    found, stations = of(written(tmp_path))
    bend = stations["bend"]  # elements with their middle in 1 ... 2 m: [1] at first, [0] and [1] after 1 s, then [0]
    assert (bend.peak.value, bend.peak.t, bend.peak.signal, bend.peak.place) == (160, 1.0, "line.hose[1]", 2.0)
    assert (bend.lowest.value, bend.lowest.signal) == (105, "line.hose[0]")
    assert (bend.hose.value, bend.hose.t) == (-20, 1.0)
    assert bend.side_wall.value == 160 / 2
    assert found.side_wall_margin(bend) == pytest.approx(100 / 80)
    assert found.ruck_margin(bend) == pytest.approx(50 / 20)
    assert found.ruck_margin(found.whole) == pytest.approx(50 / 25)
    assert "winch" not in stations  # nothing was on it


def test_the_whole_line_has_its_worst_with_time_and_place(tmp_path):
    found, _ = of(written(tmp_path))
    worst = found.whole.hose
    assert (worst.value, worst.t, worst.signal, worst.place) == (-25, 2.0, "line.hose[2]", 3.5)
    assert found.whole.core.value == 90


def test_a_line_of_one_layer_has_every_row_once(tmp_path, monkeypatch):
    """Its lowest tension is that of its hose, with which it may ruck: the margin stands there."""
    monkeypatch.setitem(ROUTE, "layers", ["hose"])
    path = written(tmp_path, leave_out=("line.core",))
    rows = fairlead.Result.open(path).margins().rows
    told = [(station, value, unit, *rest) for _, station, _, value, unit, _, *rest in rows]
    assert len(set(told)) == len(told)
    margin = {(station, quantity): bears for _, station, quantity, _, _, bears, *_ in rows}
    assert margin["line", "lowest"] == pytest.approx(50 / 25)
    assert ("line", "hose") not in margin
    printed = CliRunner().invoke(app, ["margins", str(path)]).stdout
    assert any("lowest" in line and " 2 " in line and "line.hose[2]" in line for line in printed.splitlines())


def test_a_line_of_two_layers_has_the_margin_with_its_hose(tmp_path):
    rows = fairlead.Result.open(written(tmp_path)).margins().rows
    margin = {quantity: bears for _, station, quantity, _, _, bears, *_ in rows if station == "line"}
    assert margin["hose"] == pytest.approx(50 / 25)
    assert margin["lowest"] is None


def test_the_tension_of_both_layers_does_not_bear_the_name_of_one(tmp_path):
    printed = CliRunner().invoke(app, ["margins", str(written(tmp_path))]).stdout
    (peak,) = (line for line in printed.splitlines() if "peak tension" in line)
    assert "peak tension, hose + core" in peak
    assert "160 N" in peak  # -20 N in the hose, 180 N in the core
    assert "line, element 1" in peak
    assert "hose[" not in peak
    (hose,) = (line for line in printed.splitlines() if "lowest hose tension" in line)
    assert "line.hose[2]" in hose


def test_tables_of_two_lines_bear_their_names(tmp_path, monkeypatch):
    import fairlead.analysis.margins.margins as of_lines

    made = of_lines.margins
    monkeypatch.setattr(of_lines, "margins", lambda result: [
        replace(one, line=name) for one in made(result) for name in ("upper", "lower")])  # fmt: skip
    printed = CliRunner().invoke(app, ["margins", str(written(tmp_path))]).stdout.splitlines()
    titles = [number for number, line in enumerate(printed) if line.strip() in ("upper", "lower")]
    tables = [number for number, line in enumerate(printed) if "station" in line and "peak N" in line]
    assert [number + 2 for number in titles] == tables


def test_a_node_scuffs_while_it_is_in_the_device(tmp_path):
    """Node 1 is in the bend all the time, at 0.5 m/s; node 2 leaves it after the first instant."""
    _, stations = of(written(tmp_path))
    assert stations["bend"].scuffed.value == pytest.approx(1.0)
    assert stations["bend"].scuffed.signal == "line.outer[1]"


def test_what_slides_on_belts_is_the_mean_of_what_lies_between_them(tmp_path):
    """Nodes 2 and 3 lie there all the time and slide at 0.1 and 0.3 m/s; node 1 comes at the end and does not."""
    _, stations = of(written(tmp_path))
    assert stations["belts"].slipped.value == pytest.approx((0.2 + 0.2) / 2 + (0.2 + 0.4 / 3) / 2)
    assert stations["belts"].scuffed.value == pytest.approx(0.6)


def test_what_was_not_recorded_is_named_and_the_rest_is_told(tmp_path):
    found, stations = of(written(tmp_path, leave_out=("line.hose_node", "line.outer[")))
    assert stations == {}
    assert found.whole.peak.value == 160
    assert found.whole.peak.place is None
    assert "line.hose_node[*].x for the station that an element is in" in found.missing
    assert "line.outer[*].slip for how far the line slides in bend" in found.missing
    assert not any("outer_belts" in text for text in found.missing)


def test_a_limit_that_is_kept_ends_with_zero_and_one_that_is_broken_with_five(tmp_path):
    kept = CliRunner().invoke(app, ["margins", str(written(tmp_path / "kept", LIMITS))])
    assert kept.exit_code == 0, kept.output
    tight = [{**LIMITS[0], "bound": -22.0, "text": "above -22 N"}]
    broken = CliRunner().invoke(app, ["margins", str(written(tmp_path / "broken", tight) / "run.json")])
    assert broken.exit_code == 5
    assert "limit broken: line.hose[2].tension = -25 N at t = 2 s, allowed: above -22 N" in broken.output


def test_what_a_run_saw_between_its_recorded_rows_counts(tmp_path):
    seen = [{**LIMITS[0], "nearest": ["line.hose[1].tension", -31.5, 0.7]}]
    answer = CliRunner().invoke(app, ["margins", str(written(tmp_path, seen))])
    assert answer.exit_code == 5
    assert "line.hose[1].tension = -31.5 N at t = 0.7 s" in answer.output


def test_a_killed_run_is_judged_as_far_as_it_came(tmp_path):
    tight = [{**LIMITS[0], "bound": -22.0, "text": "above -22 N"}]
    path = written(tmp_path, tight, finish=False)
    answer = CliRunner().invoke(app, ["margins", str(path), "--json"])
    assert answer.exit_code == 5
    told = json.loads(answer.stdout)
    assert told["status"] == "killed"
    assert told["lines"][0]["whole"]["peak"]["value"] == 160
    assert told["limits"][0]["broken"] is True


def test_a_folder_without_results_is_a_usage_error(tmp_path):
    answer = CliRunner().invoke(app, ["margins", str(tmp_path)])
    assert answer.exit_code == 2
    assert "no run of fairlead" in answer.output


CAPSTAN = """
components:
  rope: {type: Cable, length: 4 m, element: 0.125 m, start: 1 m, tension: 100 N, mass: 0.5 kg/m, stiffness: 1 MN}
  route: {type: Route, stations: [{type: Bend, start: 2 m, angle: 90 deg, radius: 1 m, friction: 0.3}]}
  haul: {type: MotionSource, velocity: {ramp: {to: -0.2 m/s, over: 0.2 s}}}
  load: {type: ForceSource, force: 100 N}
connections:
  - [rope.path, route.path]
  - [haul.flange, rope.inboard]
  - [load.flange, rope.outboard]
run: {stop: 1 s}
record: {every: 10 ms, signals: ["rope.line[*].tension", "rope.node[*].x", "rope.outer[*].slip"]}
limits: {haul.force: {above: -120 N}}
"""


@pytest.mark.slow
def test_a_run_and_its_margins_agree_on_what_is_broken(scene, tmp_path):
    """The haul pulls with 100 N exp(0.3 pi/2) = 160 N, more than the 120 N allowed."""
    model = scene(CAPSTAN)
    run = CliRunner().invoke(app, ["run", str(model.netlist.path), "--out", str(tmp_path / "run"), "-q"])
    assert run.exit_code == 5
    answer = CliRunner().invoke(app, ["margins", str(tmp_path / "run")])
    assert answer.exit_code == 5
    assert "limit broken: haul.force" in answer.output
    found, stations = of(tmp_path / "run")
    assert stations["bend"].scuffed.value == pytest.approx(0.2 * 0.9, rel=0.02)  # the way of a node that stays in it
    assert found.whole.peak.value >= 100 * math.exp(0.3 * math.pi / 2) * 0.99


PULSED = """
components:
  rope: {type: Cable, length: 12 m, element: 0.2 m, start: 0 m, tension: 300 N, mass: 0.8 kg/m, stiffness: 500 kN,
         damping_ratio: 0.05, side_wall: 500 N/m}
  route: {type: Route, stations: [{type: Bend, start: 3 m, angle: 60 deg, radius: 2 m, friction: 0.2}]}
  d: {type: MotionSource, velocity: 0 m/s}
  load:
    type: ForceSource
    force: {constant: 300 N, pulses: {to: 400 N, every: 1 s, wide: 8 ms, count: 1, rise: 2 ms, start: 1.123 s}}
connections: [[rope.path, route.path], [d.flange, rope.inboard], [load.flange, rope.outboard]]
run: {stop: 2 s, accuracy: 1e-5}
"""


@pytest.mark.parametrize("every", ["0.5 s", "1 ms"])
def test_the_side_wall_bears_the_peak_that_the_same_row_tells_however_seldom_rows_are_recorded(scene, every):
    """A pulse of 8 ms between rows half a second apart: the load on the bend is T/R of its peak, not that of a row."""
    result = scene(PULSED, **{"record.every": every}).run(out=None)
    (line,) = margins(result)
    (bend,) = line.stations
    assert bend.peak.value > 600
    assert bend.side_wall.value == pytest.approx(bend.peak.value / 2.0, rel=1e-12)
    assert bend.side_wall.t == bend.peak.t


def test_rows_that_miss_what_a_layer_had_between_them_are_told(scene):
    """Sums of layers are known in rows only; a hand that swings twice a second is seen once in half a second."""
    text = """
    components:
      rope: {{type: ArrayModule, length: 4 m, element: 0.4 m, start: 0.2 m, tension: 500 N,
             hose: {{mass: 1 kg/m, stiffness: 8 kN}}, core: {{mass: 1.5 kg/m, stiffness: 800 kN}},
             bulkhead_friction: 0.5}}
      route: {{type: Route, stations: [{{type: Bend, start: 1 m, angle: 90 deg, radius: 1.2 m, friction: 0.2}}]}}
      drive: {{type: MotionSource, velocity: {{sine: {{amplitude: 0.3 m/s, frequency: 2 Hz}}}}}}
      load: {{type: ForceSource, force: 500 N}}
    connections: [[rope.path, route.path], [drive.flange, rope.inboard], [load.flange, rope.outboard]]
    run: {{stop: 1 s}}
    record: {{every: {every} s, signals: ["rope.hose[*].tension", "rope.core[*].tension", "rope.hose_node[*].x"]}}
    """
    coarse, fine = (scene(text.format(every=every)).run(out=None).margins().notes for every in (0.5, 1e-3))
    assert any("more often than every 0.5 s: tension of all layers, side_wall and scuffed" in note for note in coarse)
    assert not any("more often" in note for note in fine)
