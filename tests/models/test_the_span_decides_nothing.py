"""How long a run would last decides nothing of what happens in it: stops that are met, impacts, friction that sticks.

An instant is short beside the motion of the scene, not beside a span that a user took long to be safe.
"""

import numpy as np
import pytest

import fairlead

DRIVEN = """
schema: 1
name: driven
components:
  drive: {type: ForceSource, force: {sine: {amplitude: 12 N, frequency: 2 Hz}}}
  one: {type: MassWithStops, mass: 0.5 kg, lower: -10 mm, upper: 10 mm, sliding: 3 N, breakaway: 4 N,
        viscous: 5 N*s/m, restitution: 0.4, position: 0, velocity: 0}
connections: [[drive.flange, one.flange]]
run: {stop: 1.03 s}
"""
HAMMER = """
schema: 1
name: hammer
components:
  wall: {type: Ground}
  hammer: {type: Mass, mass: 0.5 kg, position: -0.05 m, velocity: 0}
  nail: {type: Mass, mass: 0.2 kg, position: 0, velocity: 0}
  hit: {type: RigidStop, restitution: 0.3}
  wood: {type: Contact, normal_force: 200 N, curve: {curve: coulomb, stiction: 0.6, coulomb: 0.5}}
  drive: {type: ForceSource, force: {pulses: {to: 60 N, every: 0.2 s, wide: 50 ms, count: 20, rise: 1 ms, start: 0 s,
                                              from: -4 N}}}
  back: {type: FixedPoint, position: -0.08 m}
  behind: {type: RigidStop}
connections:
  - [wall.flange, wood.a]
  - [hammer.flange, hit.a, drive.flange, behind.b]
  - [back.flange, behind.a]
  - [nail.flange, hit.b, wood.b]
run: {stop: 1.03 s}
"""
BALL = """
schema: 1
name: ball
components:
  floor: {type: Ground}
  ball: {type: Mass, mass: 1 kg, position: 0.2 m, velocity: 0}
  weight: {type: ForceSource, force: -9.81 N}
  meets: {type: RigidStop, restitution: 0.5}
connections:
  - [floor.flange, meets.a]
  - [ball.flange, meets.b, weight.flange]
run: {stop: 1.03 s}
"""
STICKS = """
schema: 1
name: sticks
components:
  wall: {type: Ground}
  block: {type: Mass, mass: 1 kg, position: 0, velocity: 0}
  pull: {type: ForceSource, force: {sine: {amplitude: 8 N, frequency: 2 Hz}}}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, coulomb: 0.3, stiction: 0.5}}
connections:
  - [wall.flange, pad.a]
  - [block.flange, pad.b, pull.flange]
run: {stop: 1.03 s}
"""
ROWS = np.linspace(0.05, 1.0, 20)


@pytest.fixture
def load(tmp_path):
    def load(netlist: str) -> fairlead.Model:
        (tmp_path / "scene.yaml").write_text(netlist)
        return fairlead.load(tmp_path / "scene.yaml")

    return load


def path(model: fairlead.Model, signals: tuple[str, ...], stop: float, **settings) -> np.ndarray:
    run = model.start(stop=stop, **settings)
    rows = []
    for t in ROWS:
        run.advance(float(t))
        rows.append([run.get(name) for name in signals])
    return np.array(rows)


@pytest.mark.parametrize("accuracy", [1e-3, 1e-4, 1e-6])
@pytest.mark.parametrize(
    ("netlist", "signals"),
    [(DRIVEN, ("one.x", "one.v")), (HAMMER, ("hammer.x", "nail.x")), (BALL, ("ball.x", "ball.v")),
     (STICKS, ("block.x", "block.v"))],
    ids=["driven", "hammer", "ball", "sticks"],
)  # fmt: skip
def test_a_run_that_would_last_three_years_begins_as_one_of_a_second(load, netlist, signals, accuracy):
    short = path(load(netlist), signals, 1.03, engine="rodas", accuracy=accuracy)
    long = path(load(netlist), signals, 1e8, engine="rodas", accuracy=accuracy)
    assert np.abs(long - short).max() <= 1e-3 * accuracy


@pytest.mark.parametrize("accuracy", [1e-3, 1e-5])
def test_so_it_does_on_stepping(load, accuracy):
    short = path(load(STICKS), ("block.x", "block.v"), 1.03, engine="stepping", accuracy=accuracy)
    long = path(load(STICKS), ("block.x", "block.v"), 1e8, engine="stepping", accuracy=accuracy)
    assert np.abs(long - short).max() <= 1e-3 * accuracy


def test_and_on_ida(load):
    """Its runs are not stepped: compared is where both have a row."""
    settings = {"engine": "ida", "accuracy": 1e-5, "check": False, "out": None}
    short = load(DRIVEN).run(**settings)
    long = load(DRIVEN).run(stop=1e7, max_steps=short.run["steps"], **settings)
    times = ROWS[float(long.t[-1]) > ROWS]
    assert len(times) > 10
    assert [long.at("one.x", t) for t in times] == pytest.approx([short.at("one.x", t) for t in times], abs=1e-5)


def test_what_moves_to_and_fro_twice_a_second_is_not_said_to_chatter(load):
    """Of a run of four months a millionth is ten seconds."""
    result = load(STICKS).run(stop=1e7, max_events=60, check=False, out=None)
    assert result.run["switches"] >= 40
    assert not any("to and fro" in said for said in result.remarks)


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("accuracy", [1e-4, 1e-8])
def test_a_ball_that_bounces_ever_faster_until_it_lies_is_not_said_to_chatter(load, engine, accuracy):
    """The bounces have an end: sqrt(2 h/g) (1 + e)/(1 - e) after the release, 0.61 s."""
    result = load(BALL).run(engine=engine, accuracy=accuracy, stop=1.03, check=False, out=None)
    assert result.at("ball.x", 1.0) == pytest.approx(0.0, abs=1e-9)
    assert abs(result.at("ball.x", 0.59)) > 1e-6
    assert not any("to and fro" in said for said in result.remarks)
