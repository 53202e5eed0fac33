"""Effects of lines and contacts: off equals the limit of on (physics section 6, third column).

Those of drives are in test_drive_effects.py, of gears, motors, controllers and sensors beside their components. An
effect without a limit only watches (`meters`, `energy`, `ruck_force`): it must not change the motion at all.
"""

import math

import numpy as np
import pytest

ROPE = """
    components:
      rope: {type: Cable, length: 4 m, element: 0.25 m, start: 0 m, tension: 200 N, mass: 1 kg/m, stiffness: 20 kN,
             damping_ratio: 0.3, weight: 20 N/m}
      route:
        type: Route
        stations:
          - {type: Straight, length: 1 m, slope: 0.2 rad}
          - {type: Bend, angle: 60 deg, radius: 1 m, friction: 0.3}
          - {type: Guide, length: 1 m, friction: 0.3}
      haul: {type: MotionSource, velocity: {ramp: {to: -0.5 m/s, over: 0.1 s}}}
      weight: {type: ForceSource, force: {ramp: {from: 200 N, to: 150 N, over: 0.5 s}}}
    connections:
      - [rope.path, route.path]
      - [haul.flange, rope.inboard]
      - [weight.flange, rope.outboard]
    friction: {method: hold}
    run: {stop: 1 s, accuracy: 1e-6}
    record: {signals: [haul.force, "rope.line[*].tension", "rope.node[*].x"], every: 10 ms}
"""
ARRAY = """
    components:
      line: {type: ArrayModule, length: 2 m, element: 0.25 m, tension: 500 N, hose: {mass: 1.6 kg/m, stiffness: 8 kN},
             core: {mass: 4.2 kg/m, stiffness: 50 kN}, bulkhead_friction: 0.5}
      route: {type: Route, stations: [{type: Tube, start: -2 m, length: 8 m, friction: 0.01, squeezes: 2000 N/m}]}
      haul: {type: MotionSource, position: {sine: {amplitude: 5 mm, frequency: 2 Hz}}}
      tow: {type: ForceSource, force: 500 N}
    connections:
      - [line.path, route.path]
      - [haul.flange, line.inboard]
      - [tow.flange, line.outboard]
    friction: {method: hold}
    run: {stop: 1 s, accuracy: 1e-6}
    record: {signals: [haul.force, "line.hose_node[*].x", "line.core[*].tension"], every: 10 ms}
"""
BLOCK = """
    components:
      hand: {type: MotionSource, velocity: 0.1 m/s}
      spring: {type: Spring, stiffness: 200 N/m}
      block: {type: Mass, mass: 1 kg}
      pad: {type: Contact, normal_force: 10 N, curve: 0.4}
      floor: {type: Ground}
    connections:
      - [hand.flange, spring.a]
      - [spring.b, block.flange, pad.b]
      - [floor.flange, pad.a]
    friction: {method: hold}
    run: {stop: 2 s, accuracy: 1e-7}
    record: {signals: [block.x, block.v, pad.friction], every: 10 ms}
"""


def difference(one, other, name):
    """Largest difference of a signal between two runs on one grid, relative to its largest value."""
    times = np.arange(0.02, one.t[-1] - 0.005, 0.01)
    a, b = one.at(name, times), other.at(name, times)
    return np.abs(a - b).max() / np.abs(b).max()


FREE = {"route.stations.1.friction": 1e-12, "route.stations.2.friction": 1e-12}
ROPE_LIMITS = {
    "device_friction": (FREE, 1e-6),
    "gravity": ({"rope.weight": 1e-9}, 1e-6),
    "line_damping": ({"rope.damping_ratio": 1e-9}, 1e-5),
}


@pytest.mark.parametrize("effect", ROPE_LIMITS)
def test_a_rope_with_an_effect_off_is_the_limit_of_on(simulate, effect):
    limit, tolerance = ROPE_LIMITS[effect]
    besides = FREE if effect == "line_damping" else {}  # undamped stick-slip is sensitive to everything
    off = simulate(ROPE, **besides, **{f"effects.{effect}": "off"})
    assert difference(off, simulate(ROPE, **{**besides, **limit}), "haul.force") < tolerance
    assert difference(off, simulate(ROPE, **besides), "haul.force") > 10 * tolerance


@pytest.mark.slow
def test_a_line_presses_less_by_what_its_turn_needs_and_at_rest_not(simulate):
    """T - m v^2 grows by exp(mu angle), as T does without; so the two are the same in the limit of no speed."""
    text = ROPE.replace("20 N/m", "0 N/m").replace("{ramp: {from: 200 N, to: 150 N, over: 0.5 s}}", "200 N")
    times, found = np.linspace(1.8, 2.0, 21), {}  # the waves of the start have died away
    for speed in (4.0, 1e-4):
        run = {"haul.velocity.ramp.to": f"-{speed} m/s", "haul.velocity.ramp.over": "1 s", "run.stop": "2 s",
               "rope.length": "10 m", "rope.stiffness": "500 kN", "rope.damping_ratio": "5"}  # fmt: skip
        found[speed] = [
            simulate(text, **run, **{"effects.centrifugal": word}).at("rope.line[4].tension", times).mean()
            for word in ("on", "off")
        ]
    on, off = found[4.0]
    taken = 1.0 * 4.0**2  # N
    growth = math.exp(0.3 * math.pi / 3)
    assert off == pytest.approx(200 * growth, rel=2e-3)
    assert off - on == pytest.approx(taken * (growth - 1), rel=0.01)
    assert found[1e-4][0] == pytest.approx(found[1e-4][1], rel=1e-9)


def test_hose_and_core_that_cannot_part_are_one_body(simulate):
    """Bulkheads that grip everywhere, however they are pulled."""
    off = simulate(ARRAY, **{"effects.hose_core_slip": "off"})
    assert difference(off, simulate(ARRAY, **{"line.bulkhead_friction": 1e4}), "haul.force") < 1e-5
    assert difference(off, simulate(ARRAY, **{"line.bulkhead_friction": 1e-3}), "haul.force") > 1e-3


def test_a_core_in_tension_does_not_know_whether_it_can_push(simulate):
    off = simulate(ARRAY, **{"effects.tension_only_core": "off"})
    assert difference(off, simulate(ARRAY), "line.core[3].tension") < 1e-9


def test_bulkheads_at_every_node_are_smeared_ones(simulate):
    one, other = simulate(ARRAY), simulate(ARRAY, **{"line.bulkhead_pitch": "0.25 m"})
    assert difference(one, other, "haul.force") < 1e-9


@pytest.mark.parametrize("settings", [{"effects.meters": "on"}, {"effects.energy": "off"}, {"line.ruck_force": "1 kN"}])
def test_what_only_watches_changes_no_motion(simulate, settings):
    assert difference(simulate(ARRAY, **settings), simulate(ARRAY), "haul.force") < 1e-6


PUSHED = """
    components:
      line: {type: Cable, compression: carried, length: 1 m, element: 0.25 m, mass: 1 kg/m, stiffness: 8 kN,
             damping_ratio: 0.3, ruck_force: 50 N}
      route: {type: Route, stations: [{type: Straight, start: -1 m, length: 4 m}]}
      push: {type: MotionSource, position: {sine: {amplitude: 20 mm, frequency: 1 Hz}}}
      wall: {type: MotionSource, position: 1 m}
    connections:
      - [line.path, route.path]
      - [push.flange, line.inboard]
      - [wall.flange, line.outboard]
    run: {stop: 1 s, accuracy: 1e-6}
    record: {signals: [push.force], every: 10 ms}
"""


def test_a_ruck_as_stiff_as_the_hose_is_none(simulate):
    sound, limit = simulate(PUSHED), simulate(PUSHED, **{"line.ruck_stiffness": 1 - 1e-9})
    assert difference(limit, sound, "push.force") < 1e-6
    assert difference(simulate(PUSHED, **{"line.ruck_stiffness": 0.05}), sound, "push.force") > 0.1


RELAXING = """
    components:
      hose: {type: RelaxingHose, axial_stiffness: 8 kN, length: 1 m, damping: 0, branch_stiffness: 4 kN,
             relaxation: 0.2 s}
      wall: {type: Ground}
      pull: {type: MotionSource, position: {ramp: {from: 1 m, to: 1.1 m, over: 1 s}}}
    connections: [[wall.flange, hose.a], [pull.flange, hose.b]]
    run: {stop: 0.9 s, accuracy: 1e-7}
    record: {signals: [hose.tension], every: 10 ms}
"""


def test_a_hose_that_relaxes_follows_the_standard_linear_solid(simulate):
    """At a constant rate e' the branch carries k_1 e' tau (1 - exp(-t/tau)); without branch it is a spring."""
    result = simulate(RELAXING)
    closed = 8e3 * 0.1 * result.t + 4e3 * 0.1 * 0.2 * (1 - np.exp(-result.t / 0.2))
    np.testing.assert_allclose(result["hose.tension"], closed, rtol=1e-6, atol=1e-3)
    limit = simulate(RELAXING, **{"hose.branch_stiffness": 1e-9})
    np.testing.assert_allclose(limit["hose.tension"], 8e3 * 0.1 * limit.t, rtol=1e-6, atol=1e-6)


# dependence -> (settings without it, its curve with the parameter in question, the parameter in the limit and as usual)
DEPENDENCES = {
    "speed": ({}, "{curve: stribeck, stiction: IT, coulomb: 0.4, velocity: 20 mm/s}", 0.4000000001, 0.6),
    "load": (
        {"effects.load_dependence": "off"},
        "{curve: coulomb, coulomb: 0.4, load_exponent: IT, load_reference: 20 N}", 1.0000000001, 0.8,
    ),
    "temperature": (
        {"effects.temperature_dependence": "off"},
        "{curve: coulomb, coulomb: 0.4, softening: IT 1/K, reference_temperature: 300 K}", 1e-12, 0.05,
    ),
}  # fmt: skip


@pytest.mark.parametrize("dependence", DEPENDENCES)
def test_friction_without_a_dependence_is_the_limit_of_a_weak_one(simulate, dependence):
    settings, curve, weak, usual = DEPENDENCES[dependence]
    off = simulate(BLOCK, **settings)
    on = {it: simulate(BLOCK.replace("curve: 0.4", f"curve: {curve.replace('IT', repr(it))}")) for it in (weak, usual)}
    assert difference(on[weak], off, "block.x") < 1e-7
    assert difference(on[usual], off, "block.x") > 1e-3
    if settings:  # switched off where the curve has it
        without = simulate(BLOCK.replace("curve: 0.4", f"curve: {curve.replace('IT', repr(usual))}"), **settings)
        assert difference(without, off, "block.x") < 1e-9


@pytest.mark.slow
def test_a_contact_without_viscous_friction_is_the_limit_of_a_little(simulate):
    off = simulate(BLOCK)
    assert difference(simulate(BLOCK, **{"pad.viscous": 1e-9}), off, "block.x") < 1e-7
    assert difference(simulate(BLOCK, **{"pad.viscous": 5}), off, "block.x") > 1e-3


@pytest.mark.parametrize("method", ["binding", "tanh"])
def test_a_contact_that_creeps_is_one_that_holds_in_the_limit_of_no_creep(simulate, method):
    """The block is late by its creep, so the difference falls in proportion."""
    exact = simulate(BLOCK)
    apart = [
        difference(simulate(BLOCK, **{"friction.method": method, "friction.creep": creep}), exact, "block.x")
        for creep in (1e-4, 1e-5)
    ]
    assert apart[1] < 0.2 * apart[0]
    assert apart[1] < 1e-3


WHEEL = ROPE.replace("type: Bend, angle: 60 deg", "type: Pulley, name: wheel, angle: 60 deg")


def test_a_wheel_too_heavy_to_turn_is_locked(simulate):
    locked = simulate(WHEEL, **{"route.stations.1.turns": "locked"})
    heavy = simulate(WHEEL, **{"route.stations.1.moment": "1e9 kg*m^2"})
    assert difference(heavy, locked, "haul.force") < 1e-5
    assert difference(simulate(WHEEL), locked, "haul.force") > 1e-2


DRUM = """
    components:
      rope: {type: Cable, length: 4 m, element: 0.25 m, start: -3 m, tension: 200 N, mass: 1 kg/m, stiffness: 20 kN,
             damping_ratio: 0.3}
      route:
        type: Route
        stations:
          - {type: Winch, radius: 0.5 m, moment: 5 kg*m^2, layers: "off", line_diameter: 1 um, width: 0.8 m}
          - {type: Straight, length: 6 m}
      drive: {type: TorqueSource, torque: {ramp: {from: -100 N*m, to: -90 N*m, over: 0.2 s}}}
      weight: {type: ForceSource, force: 200 N}
    connections:
      - [rope.path, route.path]
      - [drive.shaft, route.winch.shaft]
      - [weight.flange, rope.outboard]
    run: {stop: 0.6 s, accuracy: 1e-6}
    record: {signals: [route.winch.speed, "rope.line[*].tension"], every: 10 ms}
"""


def test_layers_of_a_line_without_thickness_leave_the_radius_as_it_is(simulate):
    thin = simulate(DRUM, **{"route.stations.0.layers": "on"})
    assert difference(thin, simulate(DRUM), "route.winch.speed") < 1e-4
