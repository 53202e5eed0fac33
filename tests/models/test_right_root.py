"""Gears and screws that lock themselves: where their equations have two answers, the one that a stiff part has.

Closed forms: J w' = torque - what the load and its inertia take, in the direction in which the driving side pushes.
"""

from __future__ import annotations

from math import cos, pi

import numpy as np
import pytest

ENGINES = ("rodas", "stepping", "ida")

GEAR = """
    components:
      {m}: {{type: TorqueSource, torque: {torque} N*m}}
      {j}: {{type: Inertia, moment: {inertia} kg*m^2, speed: {speed} rad/s}}
      {g}: {{type: LossyGear, ratio: {ratio!r}, efficiency: 0.45{more}}}
      {d}: {{type: Inertia, moment: {moved} kg*m^2}}
      {l}: {{type: TorqueSource, torque: {load} N*m}}
    connections: [[{m}.shaft, {j}.shaft, {g}.a], [{g}.b, {d}.shaft, {l}.shaft]]
    run: {{stop: {stop} s, accuracy: 1e-6}}
"""
NAMES = {"m": "m", "j": "j", "g": "g", "d": "d", "l": "l"}
"""Above J/(ratio^2 (1/0.45 - 2)) = 40.5 kg m^2 the load of a gear with ratio 1/30 is heavy."""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("torque", "load", "inertia", "moved", "ratio", "speed"),
    [
        (2.0, -10.0, 0.01, 100.0, 1 / 30, 100.0),  # lifts
        (2.0, -10.0, 0.01, 30.0, 1 / 30, 100.0),  # the load is light: one answer
        (2.0, 10.0, 0.01, 100.0, 1 / 30, 0.0),  # lets down, and must push the inertia of the load
        (2.0, 10.0, 0.01, 1e5, 1 / 30, 3.0),
        (40.0, -1.5, 0.01, 0.4, 3.0, 5.0),
        (40.0, 0.5, 0.01, 0.4, 3.0, 0.0),
        (40.0, 1.5, 0.01, 0.4, -3.0, 0.0),
        (2e6, -1e7, 1e4, 1e8, 1 / 30, 100.0),
        (2e-6, -1e-5, 1e-8, 1e-4, 1 / 30, 100.0),
    ],
)
def test_a_gear_that_locks_itself_moves_as_its_driving_side_says(
    simulate, engine, torque, load, inertia, moved, ratio, speed
):
    given = {"torque": torque, "load": load, "inertia": inertia, "moved": moved, "ratio": ratio, "speed": speed}
    more = f", round_off: {1e-5 * abs(torque)} N*m"
    result = simulate(GEAR.format(**given, **NAMES, more=more, stop=0.05), **{"run.engine": engine})
    right = speed + 0.05 * (torque + ratio * load / 0.45) / (inertia + ratio**2 * moved / 0.45)
    assert result["j.speed"][-1] == pytest.approx(right, rel=1e-3)


@pytest.mark.parametrize("engine", ENGINES)
def test_backward_it_moves_as_forward(simulate, engine):
    ends = []
    for way in (1, -1):
        given = {"torque": 2.0 * way, "load": -10.0 * way, "inertia": 0.01, "moved": 100.0, "ratio": 1 / 30}
        given["speed"] = 100.0 * way
        result = simulate(GEAR.format(**given, **NAMES, more="", stop=0.2), **{"run.engine": engine})
        ends.append(way * result["j.speed"][-1])
    assert ends[0] == pytest.approx(ends[1], rel=1e-9)
    assert ends[0] == pytest.approx(100 + 0.2 * (2 - 10 / 30 / 0.45) / (0.01 + 100 / 900 / 0.45), rel=1e-4)


def test_names_and_their_order_do_not_matter(simulate):
    given = {"torque": 2.0, "load": -10.0, "inertia": 0.01, "moved": 100.0, "ratio": 1 / 30, "speed": 100.0}
    given |= {"more": "", "stop": 0.2}
    ends = []
    for names in (NAMES, {"m": "z", "j": "y", "g": "a", "d": "x", "l": "b"}):
        ends.append(simulate(GEAR.format(**given, **names))[f"{names['j']}.speed"][-1])
    assert ends[0] == pytest.approx(ends[1], rel=1e-9)


SCREW = """
    components:
      m: {{type: TorqueSource, torque: {torque} N*m}}
      j: {{type: Inertia, moment: 1e-5 kg*m^2, speed: {speed} rad/s}}
      g: {{type: LeadScrew, radius: 10 mm, lead: 5 mm, curve: 0.12, half_angle: 15 deg}}
      d: {{type: Mass, mass: {mass} kg}}
      l: {{type: ForceSource, force: -200 N}}
    connections: [[m.shaft, j.shaft, g.screw], [g.nut, d.flange, l.flange]]
    run: {{stop: 10 ms, accuracy: 1e-6}}
"""


def taken(radius, lead, mu):
    """Torque of a screw per axial force that it overcomes."""
    tangent = lead / (2 * pi * radius)
    return radius * (tangent + mu) / (1 - mu * tangent)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("torque", "mass", "speed"), [(1.0, 20, 100), (1.0, 60, 100), (1.0, 600, 100), (-1.0, 60, 0)])
def test_a_screw_lifts_a_heavy_load_and_pushes_it_down(simulate, engine, torque, mass, speed):
    result = simulate(SCREW.format(torque=torque, mass=mass, speed=speed), **{"run.engine": engine})
    per_force, lead = taken(0.01, 0.005, 0.12 / cos(pi / 12)), 0.005 / (2 * pi)
    pushed = (torque - 200 * per_force) / (1e-5 + mass * lead * per_force)  # also down, where both torques are negative
    assert result["j.speed"][-1] == pytest.approx(speed + 0.01 * pushed, rel=1e-3)


WORM = """
    components:
      m: {{type: TorqueSource, torque: 5 N*m}}
      j: {{type: Inertia, moment: 1e-3 kg*m^2, speed: 100 rad/s}}
      g: {{type: Worm, radius: 20 mm, lead: 12 mm, wheel_radius: 100 mm, curve: 0.14}}
      d: {{type: Inertia, moment: {moved} kg*m^2}}
      l: {{type: TorqueSource, torque: -50 N*m}}
    connections: [[m.shaft, j.shaft, g.worm], [g.wheel, d.shaft, l.shaft]]
    run: {{stop: 0.1 s, accuracy: 1e-6}}
"""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("moved", [0.1, 10, 1000])
def test_a_worm_lifts_a_heavy_load(simulate, engine, moved):
    result = simulate(WORM.format(moved=moved), **{"run.engine": engine})
    per_force, lead = taken(0.02, 0.012, 0.14), 0.012 / (2 * pi)
    lifted = (5 - 500 * per_force) / (1e-3 + moved / 0.1**2 * lead * per_force)
    assert result["j.speed"][-1] == pytest.approx(100 + 0.1 * lifted, rel=1e-3)


@pytest.mark.parametrize("engine", ENGINES)
def test_where_no_rigid_motion_exists_the_run_ends_and_says_that_it_may_jam(scene, tmp_path, engine):
    given = {"torque": 0.01, "load": 10.0, "inertia": 0.01, "moved": 100.0, "ratio": 1 / 30, "speed": 5.0}
    model = scene(GEAR.format(**given, **NAMES, more="", stop=0.2), **{"run.engine": engine})
    result = model.run(out=None, check=False)
    assert result.status == "failed"
    assert "may jam there" in result.run["sentence"]
    assert "g.teeth.carried" in result.run["sentence"]


@pytest.mark.parametrize("engine", ENGINES)
def test_a_rigid_gear_is_the_limit_of_one_with_a_stiff_spring(simulate, engine):
    given = {"torque": 2.0, "load": -10.0, "inertia": 0.01, "moved": 100.0, "ratio": 1 / 30, "speed": 100.0}
    text = GEAR.format(**given, **NAMES, more="", stop=0.2)
    rigid = simulate(text, **{"run.engine": engine})["j.speed"][-1]
    spring = "      k: {type: TorsionSpring, stiffness: 1e7 N*m/rad, damping: 1e4 N*m*s/rad}\n    connections:"
    sprung = text.replace("    connections:", spring)
    sprung = sprung.replace("[g.b, d.shaft, l.shaft]", "[g.b, k.a], [k.b, d.shaft, l.shaft]")
    sprung = sprung.replace("moment: 100.0 kg*m^2", "moment: 100.0 kg*m^2, speed: 3.3333333333333335 rad/s")
    assert rigid == pytest.approx(simulate(sprung)["j.speed"][-1], rel=1e-6)


STARTED = """
    components:
      m: {{type: TorqueSource, torque: 2 N*m}}
      j: {{type: Inertia, moment: 0.01 kg*m^2, speed: {speed} rad/s}}
      {gear}
      k: {{type: TorsionSpring, stiffness: 1e7 N*m/rad, damping: {damping} N*m*s/rad}}
      d: {{type: Inertia, moment: 100 kg*m^2, speed: {behind!r} rad/s}}
    connections: [[m.shaft, j.shaft, g.a], [g.b, k.a], [k.b, d.shaft]]
    run: {{stop: 1 us, accuracy: 1e-6}}
"""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("damping", [1e2, 1e4])
@pytest.mark.parametrize("speed", [100.0, -7.0])
@pytest.mark.parametrize(
    "gear", ["g: {type: LossyGear, ratio: 0.1, efficiency: 0.45}", "g: {type: LossyGear, ratio: 0.1, efficiency: 0.9}"]
)
def test_a_shaft_without_inertia_between_a_gear_and_a_damper_starts_as_fast_as_the_gear(
    simulate, engine, damping, speed, gear
):
    """It had no speed of its own, so the damper pulled with all of the motor's, and teeth rubbed by that force."""
    text = STARTED.format(speed=speed, behind=speed / 10, damping=damping, gear=gear)
    result = simulate(text, **{"run.engine": engine})
    assert result["j.speed"] == pytest.approx(speed, rel=1e-4)
    assert result["d.speed"] == pytest.approx(speed / 10, rel=1e-4)


def hoists(loads, torque, speed=100.0, moved=100.0, names="gdl", turned=False):
    """One shaft that drives a hoist per load: a gear that locks itself, a drum, and what pulls at it."""
    g, d, pull = names
    parts = [f"m: {{type: TorqueSource, torque: {torque!r} N*m}}"]
    parts += [f"j: {{type: Inertia, moment: 0.01 kg*m^2, speed: {speed!r} rad/s}}"]
    joined = [["m.shaft", "j.shaft", *(f"{g}{k}.a" for k in range(len(loads)))]]
    for k, load in enumerate(loads):
        parts += [f"{g}{k}: {{type: LossyGear, ratio: {1 / 30!r}, efficiency: 0.45}}"]
        parts += [f"{d}{k}: {{type: Inertia, moment: {moved} kg*m^2}}"]
        parts += [f"{pull}{k}: {{type: TorqueSource, torque: {load} N*m}}"]
        joined += [[f"{g}{k}.b", f"{d}{k}.shaft", f"{pull}{k}.shaft"]]
    lines = reversed(parts) if turned else parts
    text = "    components:\n" + "".join(f"      {line}\n" for line in lines)
    return text + f"    connections: {joined}\n    run: {{stop: 0.05 s, accuracy: 1e-6}}\n".replace("'", "")


def hoisted(loads, torque, speed=100.0, moved=100.0):
    """Speed after 0.05 s if the shaft pushes all of them: each takes 1/0.45 of what its load and inertia need."""
    taken = sum(-load / 30 / 0.45 for load in loads)
    return speed + 0.05 * (torque - taken) / (0.01 + len(loads) * moved / 900 / 0.45)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("loads", "torque"),
    [
        ([-10.0, -10.0], 3.0),
        ([-10.0, -12.0], 2.0),
        ([-10.0, -10.0, -10.0], 4.0),
        ([-6.0, -10.0, -14.0, -18.0], 6.0),
        ([-10.0] * 7, 9.0),
        ([-10.0 - k for k in range(8)], 10.0),
    ],
)
def test_several_hoists_on_one_shaft_lift_together(simulate, engine, loads, torque):
    """Each by itself may answer rightly where the others hold it back: all are asked together."""
    result = simulate(hoists(loads, torque), **{"run.engine": engine})
    assert result["j.speed"][-1] == pytest.approx(hoisted(loads, torque), rel=1e-4)


def test_names_and_order_of_hoists_do_not_matter(simulate):
    loads = [-6.0, -10.0, -14.0, -18.0]
    ends = [simulate(hoists(loads, 6.0))["j.speed"][-1]]
    ends += [simulate(hoists(loads[::-1], 6.0, names="zba", turned=True))["j.speed"][-1]]
    assert ends[0] == pytest.approx(ends[1], rel=1e-9)


SERIES = """
    components:
      m: {{type: TorqueSource, torque: 2 N*m}}
      j: {{type: Inertia, moment: 0.01 kg*m^2, speed: 100 rad/s}}
      g: {{type: LossyGear, ratio: 0.2, efficiency: 0.45}}
      i: {{type: Inertia, moment: {between} kg*m^2}}
      h: {{type: LossyGear, ratio: 0.2, efficiency: 0.4}}
      d: {{type: Inertia, moment: {moved} kg*m^2}}
      l: {{type: TorqueSource, torque: -10 N*m}}
    connections: [[m.shaft, j.shaft, g.a], [g.b, i.shaft, h.a], [h.b, d.shaft, l.shaft]]
    run: {{stop: 0.05 s, accuracy: 1e-6}}
"""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("between", [0.02, 1.0, 10.0])
@pytest.mark.parametrize("moved", [10, 100, 1000])
def test_gears_in_series_lift_together(simulate, engine, between, moved):
    result = simulate(SERIES.format(between=between, moved=moved), **{"run.engine": engine})
    taken = (0.2**2 * 10 / 0.4) / 0.45
    inertia = 0.01 + 0.2**2 / 0.45 * (between + 0.2**2 * moved / 0.4)
    assert result["j.speed"][-1] == pytest.approx(100 + 0.05 * (2 - taken) / inertia, rel=1e-4)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("method", ["binding", "karnopp", "tanh"])
def test_hoists_that_creep_start_in_motion(simulate, engine, method):
    """The plateau of binding has no answer at full speed: each pass asks which zone is that of the speed."""
    loads = [-6.0, -10.0, -14.0, -18.0]
    result = simulate(hoists(loads, 6.0), **{"run.engine": engine, "friction.method": method})
    assert result["j.speed"][-1] == pytest.approx(hoisted(loads, 6.0), rel=1e-4)


CLUTCHED = """
    components:
      m: {{type: TorqueSource, torque: 1 N*m}}
      j: {{type: Inertia, moment: 1e-5 kg*m^2, speed: 100 rad/s}}
      c: {{type: Clutch, radius: 30 mm, normal_force: 800 N, curve: 0.3}}
      i: {{type: Inertia, moment: 1e-6 kg*m^2, speed: 100 rad/s}}
      g: {{type: LeadScrew, radius: 10 mm, lead: 5 mm, curve: 0.12, half_angle: 15 deg}}
      d: {{type: Mass, mass: {mass} kg}}
      l: {{type: ForceSource, force: -200 N}}
    connections: [[m.shaft, j.shaft, c.a], [c.b, i.shaft, g.screw], [g.nut, d.flange, l.flange]]
    run: {{stop: 10 ms, accuracy: 1e-6}}
"""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("method", ["hold", "binding", "karnopp", "tanh"])
@pytest.mark.parametrize("mass", [20, 600])
def test_a_screw_behind_a_clutch_starts_in_motion(simulate, engine, method, mass):
    result = simulate(CLUTCHED.format(mass=mass), **{"run.engine": engine, "friction.method": method})
    per_force, lead = taken(0.01, 0.005, 0.12 / cos(pi / 12)), 0.005 / (2 * pi)
    lifted = (1.0 - 200 * per_force) / (1.1e-5 + mass * lead * per_force)
    assert result["j.speed"][-1] == pytest.approx(100 + 0.01 * lifted, rel=1e-4)


LET_DOWN = """
    components:
      t1: {type: TorqueSource, torque: {sine: {amplitude: 12 N*m, frequency: 0.7 Hz}}}
      t2: {type: TorqueSource, torque: -200 N*m}
      j1: {type: Inertia, moment: 0.01 kg*m^2, speed: 0 rad/s}
      j2: {type: Inertia, moment: 30 kg*m^2}
      g: {type: LossyGear, ratio: 0.03333333333333333, efficiency: 0.45, efficiency_back: -0.2, bearing: 0.1 N*m}
      d: {type: ShaftFriction, sliding: 0.2 N*m}
      h: {type: Housing}
    connections: [[t1.shaft, j1.shaft, g.a], [g.b, j2.shaft, t2.shaft, d.b], [d.a, h.shaft]]
    run: {stop: 1.7 s, accuracy: 1e-7}
"""


def let_down():
    """Speed at 1.45 s of the shaft that a motor turns down with a load that presses, then pushes: by quadrature.

    Both branches are single-valued (A = 0.28 and 0.011): the load is below the limit of the gear. With s = -w > 0
    and the torque T that b asks, at a:  0.01 s' = -t1 - c T - bearing.
    """
    from scipy.integrate import solve_ivp

    ratio, bearing, rubs = 1 / 30, 0.1, 0.2

    def rate(t, s):
        given = -12 * np.sin(2 * np.pi * 0.7 * t)  # torque downward at a
        load = 200 - rubs  # torque downward at b
        asked = []
        for c in (1 / 0.45, -0.2):  # b is pushed; b drives, and a must help
            down = (given - bearing + c * ratio * load) / (0.01 + c * ratio**2 * 30)
            carried = (ratio * down * 30 - load) * ratio  # what a gives b, downward
            if carried >= 0.0 if c > 0.0 else carried <= 0.0:
                asked.append(down)
        return [asked[0]] if s[0] > 0.0 or asked[0] > 0.0 else [0.0]

    found = solve_ivp(rate, (0.72, 1.45), [0.0], max_step=2e-4, rtol=1e-8, atol=1e-9)
    return found.y[0, -1]


@pytest.mark.parametrize("engine", ENGINES)
def test_a_load_that_is_let_down_and_then_drives_goes_through_no_load_at_the_teeth(simulate, engine):
    """The rounded corner of the loss had a slope of 1.2: between both branches it left no answer at all."""
    result = simulate(LET_DOWN, **{"run.engine": engine})
    assert result.status == "finished"
    assert -result.at("j1.speed", 1.45) == pytest.approx(let_down(), rel=1e-3)


COASTS = """
    components:
      j: {{type: Inertia, moment: 1e-3 kg*m^2, speed: 100 rad/s}}
      g: {{type: Worm, radius: 20 mm, lead: 12 mm, curve: {mu}, wheel_radius: 100 mm, round_off: 1e-6 N}}
      d: {{type: Inertia, moment: {moved} kg*m^2}}
      b: {{type: Brake, radius: 0.1 m, curve: 0.4, normal_force: {pressed} N}}
      h: {{type: Housing}}
      s: {{type: ShaftFriction, sliding: 0.02 N*m}}
    connections: [[j.shaft, g.worm, s.b], [s.a, h.shaft], [g.wheel, d.shaft, b.shaft]]
    run: {{stop: {stop} s, accuracy: 1e-6}}
"""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("mu", [0.14, 0.3])
@pytest.mark.parametrize(("moved", "pressed"), [(0.1, 10.0), (3.0, 1000.0), (100.0, 1e4)])
def test_what_locks_itself_and_is_braked_on_both_sides_comes_to_rest_and_stays(simulate, engine, mu, moved, pressed):
    """Three contacts hold one motion at the capture, and the flanks rub by a force that depends on what they share.

    With `binding`, `tanh` and `karnopp` a heavy wheel that creeps drives the worm, which jams: the run ends so.
    """
    per_force, lead, brake = taken(0.02, 0.012, mu), 0.012 / (2 * pi), 0.04 * pressed
    falls = (0.02 + per_force * brake / 0.1) / (1e-3 + per_force * lead * moved / 0.1**2)
    assert brake > falls * moved * lead / 0.1  # the worm pushes all the time
    at_rest = 100.0 / falls
    text = COASTS.format(mu=mu, moved=moved, pressed=pressed, stop=repr(1.5 * at_rest))
    result = simulate(text, **{"run.engine": engine})
    assert result.at("j.speed", 0.9 * at_rest) == pytest.approx(10.0, rel=1e-3)
    assert result["j.speed"][-1] == pytest.approx(0.0, abs=1e-3)
    turned = result["j.angle"]
    assert turned[-1] == pytest.approx(50.0 * at_rest, rel=2e-3)
