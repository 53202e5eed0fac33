"""A controller whose integral grows while what follows has given all it has is told, at the end of the run.

The plant is a body on a damper of 1 N*s/m, so that its speed is the force: with a limit of 0.1 N and 1 m/s wanted the
error stays at 0.9 m/s and more, and the integral grows for good.
"""

import warnings

import numpy as np
import pytest

import fairlead
from fairlead.analysis.record.wind_up import Watched

SCENE = """
schema: 1
name: pushed
components:
  wanted: {type: SignalSource, value: WANTED}
  control: {type: PiController, gain: 0.5, integral_time: 0.2 s, period: 10 ms}
  gain: {type: SignalGain, gain: 1}
  limit: {type: Limiter, low: -0.1, high: 0.1}
  push: {type: ForceActuator}
  body: {type: Mass, mass: 0.05 kg}
  air: {type: Damper, damping: 1 N*s/m}
  wall: {type: Ground}
  eye: {type: MotionSensor}
connections:
  - [push.flange, body.flange, air.a, eye.flange]
  - [air.b, wall.flange]
  - [wanted.signal, control.reference]
  - [eye.v, control.measured]
  - [control.command, gain.value]
  - [gain.signal, limit.value]
  - [limit.signal, push.force]
run: {stop: 4 s}
record: {signals: [body.v], every: 50 ms}
"""

VALVE = """
schema: 1
name: valve
components:
  source: {type: PressureSource, pressure: 15 MPa}
  tank: {type: Tank}
  wanted: {type: SignalSource, value: 5}
  control: {type: Pid, gain: 1, integral_time: 0.2 s, period: 10 ms}
  valve: {type: ServoValve, rated_flow: 20 L/min}
  cylinder: {type: Cylinder, bore_diameter: 40 mm, stroke: 3 m}
  wall: {type: Ground}
  load: {type: Mass, mass: 50 kg}
  eye: {type: MotionSensor}
connections:
  - [source.port, valve.supply]
  - [tank.port, valve.tank]
  - [wanted.signal, control.reference]
  - [eye.v, control.measured]
  - [control.command, valve.command]
  - [valve.a, cylinder.a]
  - [valve.b, cylinder.b]
  - [wall.flange, cylinder.body]
  - [cylinder.rod, load.flange, eye.flange]
run: {stop: 0.5 s}
record: {signals: [load.v], every: 10 ms}
"""


def told(tmp_path, text, **settings):
    """The remarks of a run on controllers that wind up."""
    (tmp_path / "scene.yaml").write_text(text, encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = fairlead.load(tmp_path / "scene.yaml").run(out=None, **settings)
    assert result.match("*.integral") == []  # it is looked at, and not recorded
    return [one for one in result.remarks if "winds up" in one]


@pytest.mark.parametrize("sampling", ["on", "off"])
@pytest.mark.parametrize("wanted", ["1", "-1"])
def test_a_controller_without_limits_before_a_limiter_is_told(tmp_path, wanted, sampling):
    text = SCENE.replace("WANTED", wanted) + f"effects: {{sampling: {sampling}}}\n"
    (remark,) = told(tmp_path, text)
    assert remark.startswith("control winds up: its integral grows during ")
    assert int(remark.split(" %")[0].split()[-1]) >= 97
    assert "while limit already gives all it has" in remark
    assert "Give control the limits `low` and `high` that limit has" in remark


@pytest.mark.parametrize("wanted", ["1", "-1"])
def test_a_clip_in_an_expression_is_a_limiter(tmp_path, wanted):
    """Made of the smaller and of the larger of two signals; only one of both is at its limit for good."""
    clip = '{type: SignalFunction, expression: "max(-0.1, min(0.1, value))"}'
    text = SCENE.replace("WANTED", wanted).replace("{type: Limiter, low: -0.1, high: 0.1}", clip)
    (remark,) = told(tmp_path, text)
    assert remark.startswith("control winds up: its integral grows during ")
    assert "while limit.step" in remark
    assert "passes another signal, and the controller answers late" in remark


def test_a_controller_whose_command_is_chosen_both_ways_is_not_told(tmp_path):
    """The size of a command: whichever of both passes, a larger command gives a larger one."""
    size = '{type: SignalFunction, expression: "max(value, -value)"}'
    text = SCENE.replace("WANTED", "1").replace("{type: Limiter, low: -0.1, high: 0.1}", size)
    assert told(tmp_path, text.replace("stop: 4 s", "stop: 1 s")) == []


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_it_is_told_of_every_engine(tmp_path, engine):
    if engine == "ida":
        pytest.importorskip("sksundae")
    assert len(told(tmp_path, SCENE.replace("WANTED", "1"), engine=engine)) == 1


@pytest.mark.parametrize("wanted", ["0.09", "{step: {from: 1, to: 0.02, at: 1.6 s}}"])
def test_what_can_be_reached_and_what_is_short_is_not_told(tmp_path, wanted):
    """In the second the command has left the limit by half of the run."""
    text = SCENE.replace("WANTED", wanted).replace("integral_time: 0.2 s", "integral_time: 20 s")
    assert told(tmp_path, text) == []


def test_a_controller_with_the_limits_of_what_follows_is_not_told(tmp_path):
    text = SCENE.replace("WANTED", "1").replace("period: 10 ms", "period: 10 ms, low: -0.1, high: 0.1")
    assert told(tmp_path, text) == []


@pytest.mark.parametrize("dynamics", ["on", "off"])
def test_a_valve_that_is_fully_open_is_a_limiter(tmp_path, dynamics):
    (remark,) = told(tmp_path, VALVE + f"effects: {{valve_dynamics: {dynamics}}}\n")
    assert remark.startswith("control winds up")
    assert "while valve" in remark


def test_time_counts_while_both_are_so():
    """Zone 1 from 1 s to 3 s; the size grows until 2 s, stands until 4 s as between samples, and falls."""
    one = Watched("control", "limit", 0, 7, frozenset({1}), 0)
    events = np.array([(1.0, 7, 1), (2.5, 3, 1), (3.0, 7, 0)], dtype=[("t", "f8"), ("machine", "i8"), ("after", "i8")])
    size = np.array([0.0, 1.0, 2.0, 2.0, 2.0, 1.0])
    one.watch(np.arange(6.0), size, events)
    assert one.wound == 2.0
    assert one.zone == 0
    assert one.grows is False
