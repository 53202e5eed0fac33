"""Nodes without inertia that hold on to more than one thing: the bodies behind them move as one."""

import numpy as np
import pytest

ENGINES = ("rodas", "ida")
METHODS = ("hold", "karnopp")


def train(method, engine, *, unit=1.0, order=1, nodes=2, inertia=None, force="2 N"):
    """Two bodies and nodes with dampers between them, in a row of contacts that can take 10 N, 9 N, and so on."""
    parts = [f"m1: {{type: Mass, mass: {2 * unit} kg}}", f"m2: {{type: Mass, mass: {3 * unit} kg}}",
             "floor: {type: Ground}", f"pull: {{type: ForceSource, force: {force}}}"]  # fmt: skip
    places = [["m1.flange", "pull.flange"], *([] for _ in range(nodes)), ["m2.flange"]]
    ground = ["floor.flange"]
    for k in range(nodes + 1):
        parts.append(f"c{k}: {{type: Contact, normal_force: {(10 - k) * unit} N, curve: 1.0}}")
        places[k].append(f"c{k}.b")
        places[k + 1].append(f"c{k}.a")
    for k in range(1, nodes + 1):
        parts.append(f"d{k}: {{type: Damper, damping: {0.5 * unit} N*s/m}}")
        places[k].append(f"d{k}.b")
        ground.append(f"d{k}.a")
        if inertia:
            parts.append(f"e{k}: {{type: Mass, mass: {inertia} kg}}")
            places[k].append(f"e{k}.flange")
    joins = [f"[{', '.join(place[::order])}]" for place in (*places, ground)][::order]
    return scene(parts[::order], joins, method, engine, 2)


def scene(parts, joins, method, engine, stop):
    lines = "\n".join(f"      {part}" for part in parts)
    return f"""
    components:
{lines}
    connections: [{", ".join(joins)}]
    friction: {{method: {method}}}
    run: {{stop: {stop} s, accuracy: 1e-6, engine: {engine}}}
    record: {{every: 20 ms, signals: ["*"]}}
    """


@pytest.mark.parametrize(("unit", "order"), [(1.0, 1), (1e3, -1), pytest.param(1e-3, -1, marks=pytest.mark.slow)])
@pytest.mark.parametrize("nodes", [1, pytest.param(2, marks=pytest.mark.slow), 3])
@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("method", METHODS)
def test_what_is_held_through_such_nodes_moves_as_one_body(simulate, method, engine, nodes, unit, order):
    """(m1 + m2) v' = F - n d v, though every contact touches a node whose acceleration nothing tells."""
    result = simulate(train(method, engine, unit=unit, order=order, nodes=nodes, force=f"{2 * unit} N"))
    drag = 0.5 * nodes
    exact = 2.0 / drag * (1.0 - np.exp(-drag * result.t / 5.0))
    for body in ("m1.v", "m2.v"):
        assert result[body] == pytest.approx(exact, abs=2e-6)
    assert result.run["counters"]["switches"] == 0
    assert np.abs(result["c0.slip"]).max() < 1e-9


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("method", [*METHODS, "binding"])
def test_what_lets_go_there_is_the_limit_of_a_little_inertia(simulate, method, engine):
    """A contact slides, and is caught again when the pull ends; the others hold on through their nodes."""
    pull = "{trapezoid: {to: 22 N, rise: 0.4 s, stay: 0.3 s, fall: 0.2 s}}"
    light = simulate(train(method, engine, force=pull))
    heavy = simulate(train("hold", "rodas", force=pull, inertia=1e-7))
    t = 0.02 * np.arange(1, 100)  # rows of the grid
    for name in ("m1.v", "m2.v", "c2.slip"):
        seen, wanted = (np.interp(t, one.t, one[name]) for one in (light, heavy))
        assert seen == pytest.approx(wanted, abs=2e-3 if method == "binding" else 2e-5)
    assert max(np.abs(light[f"c{k}.slip"]).max() for k in range(3)) > 0.1


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("method", [*METHODS, "binding"])
@pytest.mark.parametrize("preload", [pytest.param(0.0, marks=pytest.mark.slow), 100.0])
def test_a_lead_screw_lifts_through_a_rod_that_gives_way(simulate, method, engine, preload):
    """The nut has no inertia. Of the force F of the thread mu (P + F) rubs along it, and the load W + M a is left:

    F - mu (P + F) tan s = W + M a,   J w' = T - r (F tan s + mu (P + F)),   a = lead/(2 pi) w'
    """
    torque, moment, weight, mass, radius, lead, mu = 12.0, 2e-3, 1635.0, 200.0, 0.015, 0.012, 0.15
    parts = [f"drive: {{type: TorqueSource, torque: {{ramp: {{to: {torque} N*m, over: 0.2 s}}}}}}",
             f"rotor: {{type: Inertia, moment: {moment} kg*m^2}}",
             f"screw: {{type: LeadScrew, radius: {radius} m, lead: {lead} m, curve: {mu}, preload: {preload} N}}",
             "rod: {type: SpringDamper, stiffness: 5e6 N/m, damping: 1e5 N*s/m}",
             f"load: {{type: Mass, mass: {mass} kg}}",
             f"weight: {{type: ForceSource, force: -{weight} N}}"]  # fmt: skip
    joins = ["[drive.shaft, rotor.shaft, screw.screw]", "[screw.nut, rod.a]", "[rod.b, load.flange, weight.flange]"]
    result = simulate(scene(parts, joins, method, engine, 0.6))
    slope, way = lead / (2 * np.pi * radius), lead / (2 * np.pi)
    per_force = radius * (slope + mu) / (1 - mu * slope)
    at_rest = per_force * (weight + mu * preload * slope) + mu * preload * radius
    exact = (torque - at_rest) / (moment + per_force * mass * way)
    late = result.t > 0.4
    assert np.polyfit(result.t[late], result["rotor.speed"][late], 1)[0] == pytest.approx(exact, rel=1e-3)
    assert result["load.v"][late] == pytest.approx(way * result["rotor.speed"][late], abs=1e-4)
    assert abs(result.run["energy"]["closure"]) < 1e-4


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("method", METHODS)
def test_a_planetary_gear_holds_its_ring_without_inertia(simulate, method, engine):
    """The ring stands, so the carrier turns at a quarter of the sun, and of the drag the brake takes three quarters."""
    parts = ["engine: {type: SpeedSource, speed: 100 rad/s}", "gear: {type: Planetary, ratio: 3}",
             "load: {type: Inertia, moment: 0.5 kg*m^2}", "drag: {type: RotationalDamper, damping: 0.1 N*m*s/rad}",
             "frame: {type: Housing}",
             "brake: {type: Brake, radius: 0.1 m, faces: 2, normal_force: 3000 N, curve: 0.15}"]  # fmt: skip
    joins = ["[engine.shaft, gear.sun]", "[gear.ring, brake.shaft]", "[gear.carrier, load.shaft, drag.b]",
             "[frame.shaft, drag.a]"]  # fmt: skip
    result = simulate(scene(parts, joins, method, engine, 1))
    assert result["load.speed"][-1] == pytest.approx(25.0, abs=1e-6)
    assert abs(result["engine.torque"][-1]) == pytest.approx(0.1 * 25 / 4, abs=1e-5)
    assert abs(result["brake.torque"][-1]) == pytest.approx(0.1 * 25 * 3 / 4, abs=1e-5)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("method", METHODS)
def test_side_by_side_contacts_share_beside_what_they_hold(simulate, method, engine):
    """Two contacts that stand side by side between a body and such a node, and one from there to another body."""
    text = train(method, engine, nodes=1)
    text = text.replace("      c1:", "      beside: {type: Contact, normal_force: 10 N, curve: 1.0}\n      c1:")
    text = text.replace("c0.b", "c0.b, beside.b").replace("c0.a", "c0.a, beside.a")
    result = simulate(text)
    exact = 4.0 * (1.0 - np.exp(-0.1 * result.t))
    assert result["m2.v"] == pytest.approx(exact, abs=2e-6)
    assert result["c0.friction"] == pytest.approx(result["beside.friction"], abs=1e-6)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("damping", [0.0, 5.0])
def test_one_on_a_belt_that_starts_off_goes_along(simulate, method, engine, damping):
    """The belt draws a spring, or one with a damper, until that pulls as much as friction bears."""
    parts = ["belt: {type: MotionSource, velocity: {ramp: {to: 1 m/s, start: 0.1 s, over: 0.2 s}}}",
             "pad: {type: Contact, normal_force: 10 N, curve: 0.3}",
             f"spring: {{type: SpringDamper, stiffness: 100 N/m, damping: {damping} N*s/m}}",
             "ground: {type: Ground}"]  # fmt: skip
    joins = ["[belt.flange, pad.a]", "[pad.b, spring.a]", "[spring.b, ground.flange]"]
    result = simulate(scene(parts, joins, method, engine, 1))
    late = (-damping + np.sqrt(damping**2 + 2 * 100 * 3 / 5)) / 100  # 100 a t^2/2 + damping a t = 3 N, a = 5 m/s^2
    slips = next(event.t for event in result.events if event.component == "pad" and event.t > 0)
    assert slips == pytest.approx(0.1 + late, abs=1e-6)
    assert abs(result["pad.friction"][-1]) == pytest.approx(3.0, abs=1e-5)
