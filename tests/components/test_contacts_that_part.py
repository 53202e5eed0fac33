"""Stops, teeth, play and strands that are torn apart: what touches pushes or pulls one way only."""

import numpy as np
import pytest

STIFF, DAMPING, DEEP = 1e6, 5.0, 1e-3  # at rest pressed in by DEEP, with STIFF DEEP; in SI, of a line or of a shaft
AT = 0.01  # where what touches begins, from the middle
LINE = {"body": "Mass", "mass": "mass", "place": "position", "rate": "velocity", "port": "flange", "still": "Ground",
        "source": "ForceSource", "load": "force", "told": "v"}  # fmt: skip
SHAFT = {"body": "Inertia", "mass": "moment", "place": "angle", "rate": "speed", "port": "shaft", "still": "Housing",
         "source": "TorqueSource", "load": "torque", "told": "speed"}  # fmt: skip
SHARED = f"stiffness: {STIFF}, damping: {DAMPING}"
PARTS = {  # kind: (its line, port that stands, port that moves, radius, what it carries)
    "EndStop": (f"{SHARED}, lower: {-AT}, upper: {AT}", "a", "b", LINE, "force"),
    "Play": (f"{SHARED}, play: {2 * AT}", "b", "a", LINE, "force"),
    "RotationalStop": (f"{SHARED}, lower: {-AT}, upper: {AT}", "a", "b", SHAFT, "torque"),
    "Backlash": (f"{SHARED}, play: {2 * AT}", "b", "a", SHAFT, "torque"),
    "Gearbox": (f"{SHARED}, play: {2 * AT}, ratio: 1, effects: {{backlash: on, gear_friction: off}}", "b", "a", SHAFT,
                "torque"),
    "ChainDrive": (f"{SHARED}, slack: {2 * AT}, teeth_a: 20, teeth_b: 20, pitch: {2 * np.pi / 20}", "b", "a", SHAFT,
                   None),
}  # fmt: skip


def torn(simulate, kind, way, speed, load, stop, engine):
    """A body of 1 kg (or kg m^2) pressed in by DEEP at `speed`, under a load in time; what is carried, its speed."""
    line, still, moves, words, carried = PARTS[kind]
    result = simulate(f"""
        components:
          still: {{type: {words["still"]}}}
          part: {{type: {kind}, {line}}}
          body: {{type: {words["body"]}, {words["mass"]}: 1, {words["place"]}: {way * (AT + DEEP)},
                 {words["rate"]}: {way * speed}}}
          load: {{type: {words["source"]}, {words["load"]}: {load}}}
        connections:
          - [still.{words["port"]}, part.{still}]
          - [part.{moves}, body.{words["port"]}, load.{words["port"]}]
        run: {{stop: {stop} s, engine: {engine}, accuracy: 1e-6}}
        record: {{signals: ["*"]}}
    """)
    assert result.ok
    force = result["part.upper"] - result["part.lower"] if carried is None else result[f"part.{carried}"]
    return result, way * force, way * result[f"body.{words['told']}"]


def switched(result, end):
    """Time at which the part first changed to a zone whose name ends so."""
    table = result.switches().to_pandas()
    return float(table["first"][table["zone_to"].str.endswith(end)].min())


ENGINES = [("rodas", 1), pytest.param("rodas", -1, marks=pytest.mark.slow), ("stepping", -1),
           pytest.param("ida", 1, marks=pytest.mark.slow)]  # fmt: skip


@pytest.mark.parametrize(("engine", "way"), ENGINES)
@pytest.mark.parametrize("kind", PARTS)
def test_what_goes_apart_faster_than_it_springs_back_carries_nothing(simulate, kind, engine, way):
    """Torn back at 1 m/s, above 1/damping = 0.2 m/s, it keeps its speed, and its spring's energy is lost."""
    speed = -5 / DAMPING
    result, force, v = torn(simulate, kind, way, speed, "0", 3 * DEEP, engine)
    assert np.abs(force).max() <= 1e-9 * STIFF * DEEP
    assert v == pytest.approx(speed, rel=1e-9)
    assert switched(result, ("gap", "free")) == pytest.approx(DEEP / -speed, rel=1e-6)
    assert result.run["energy"]["dissipated"] == pytest.approx(STIFF * DEEP**2 / 2, rel=1e-5)


@pytest.mark.parametrize(("engine", "way"), ENGINES)
@pytest.mark.parametrize("kind", PARTS)
def test_nothing_holds_on_to_what_is_torn_off(simulate, kind, engine, way):
    """A load turns round and tears: the force ends where the speed is 1/damping, and never changes its sign."""
    press = STIFF * DEEP
    loads = [way * press, way * press, -20 * way * press, -20 * way * press]
    load = f"{{table: {{t: [0, 0.01, 0.0101, 1], y: {loads}}}}}"
    result, force, v = torn(simulate, kind, way, 0, load, 0.011, engine)
    assert force.max() == pytest.approx(press, rel=1e-4)
    assert force.min() >= -1e-3 * press
    lets_go = switched(result, "opening")
    assert 0.01 < lets_go < 0.0102
    assert np.interp(lets_go, result.t, v) == pytest.approx(-1 / DAMPING, rel=1e-3)
    assert np.abs(force[result.t > lets_go + 1e-9]).max() == 0
    assert result.run["energy"]["closure"] < 1e-5


@pytest.mark.parametrize("kind", ["EndStop", "Backlash"])
def test_what_is_let_go_slowly_springs_back_as_before(simulate, kind):
    """Its orbit is  c v - ln(1 + c v) + c^2 k d^2/2 = constant,  c the damping, and reaches no speed of -1/c."""
    result, _, v = torn(simulate, kind, 1, 2 / DAMPING, "0", 0.02, "rodas")
    orbit = 2 - np.log(3) + DAMPING**2 * STIFF * DEEP**2 / 2  # through DEEP with c v = 2
    back = -v[-1] * DAMPING
    assert -back - np.log(1 - back) == pytest.approx(orbit, rel=1e-3)
    assert not result.switches().to_pandas()["zone_to"].str.endswith("opening").any()


@pytest.mark.parametrize("engine", ["rodas", "stepping", pytest.param("ida", marks=pytest.mark.slow)])
def test_a_rope_whose_end_is_thrown_back_does_not_push(simulate, engine):
    """Its damping would push with 5 kN; the body keeps its speed until the rope is slack, and its energy is lost."""
    result = simulate(f"""
        components:
          winch: {{type: Ground}}
          rope: {{type: RopeTail, length: 1 m, stiffness: 100 kN, damping: 10 kN*s, tension: 10 N}}
          body: {{type: Mass, mass: 1 kg, position: 0, velocity: -0.5 m/s}}
        connections: [[winch.flange, rope.a], [rope.b, body.flange]]
        run: {{stop: 1 ms, engine: {engine}, accuracy: 1e-6}}
        record: {{signals: ["*"]}}
    """)
    strain = 1e-4
    assert np.abs(result["rope.tension"]).max() == 0
    assert result["body.v"] == pytest.approx(-0.5, rel=1e-12)
    assert switched(result, "slack") == pytest.approx(strain / (1 + strain) / 0.5, rel=1e-5)
    assert result.run["energy"]["dissipated"] == pytest.approx(10 * strain / (1 + strain) / 2, rel=1e-3)
