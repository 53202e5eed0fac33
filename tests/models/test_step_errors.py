"""The error of a step of `stepping` with a switch inside is the one that docs/stepping.md says, at every phase."""

import numpy as np
import pytest

from fairlead.integrate import Run, integrate

PHASES = np.linspace(0.04, 0.96, 24)
BEFORE = 8  # steps before the one with the switch
BLOCK = """
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 1 kg, position: 0 m, velocity: SPEED m/s}
      rub: {type: Contact, normal_force: 10 N, curve: 0.3, method: hold}
      pull: {type: ForceSource, force: FORCE}
    connections: [[ground.flange, rub.a], [rub.b, block.flange, pull.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
    effects: {energy: off}
    """
NODE = """
    components:
      ground: {type: Ground}
      rub: {type: Contact, normal_force: 10 N, curve: 0.3, method: hold}
      behind: {type: Damper, damping: 4 N*s/m}
      pull: {type: ForceSource, force: FORCE}
    connections: [[ground.flange, rub.a, behind.a], [rub.b, behind.b, pull.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
    effects: {energy: off}
    """
WALL = """
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 1 m/s}
      stop: {type: EndStop, stiffness: 1 N/m, upper: 0.5 m, lower: -9 m, damping: 0 s/m}
    connections: [[ground.flange, stop.a], [stop.b, block.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
    effects: {energy: off}
    """
RAMP, LEVEL, DUE = "{ramp: {to: 60 N, over: 10 s}}", 3.0, 0.5  # N/s: 6; the limit [N]; the switch [s]
RATE = 6.0


def ends(model, due, what, after=1):
    """By phase: h, and the unknown at the end of so many steps, counted from the one with the switch at `due`."""
    system = model.system
    (k,) = [k for k, name in enumerate(system.unknown_names) if name.endswith(what)]
    for s in PHASES:
        h = due / (BEFORE + s)
        outcome = integrate(system, Run(stop=(BEFORE + after) * h, fixed_step=h, engine="stepping"))
        assert outcome.ok
        yield s, h, outcome.y[k]


def test_a_contact_that_lets_go_is_late_in_speed_by_the_square_of_the_nearer_part(scene):
    model = scene(BLOCK.replace("FORCE", RAMP).replace("SPEED", "0"))
    errors = []
    for s, h, v in ends(model, DUE, "block.v", after=2):
        errors.append((v - RATE / 2 * (2 * h - s * h) ** 2) / (RATE * h**2))
        assert errors[-1] == pytest.approx(-0.5 * min(s, 1 - s) ** 2, abs=1e-9)
    assert np.mean(errors) == pytest.approx(-1 / 24, rel=0.05)


@pytest.mark.parametrize("s", PHASES.tolist())
def test_a_jump_of_friction_leaves_the_errors_of_a_law_without_one(s, scene):
    """Stiction 3 N above 2 N, let go in the step or in the next: the impulse of 1 N is right, and the way it makes."""
    h, errors, jump = DUE / (BEFORE + s), {}, LEVEL - 2.0
    for j, curve in ((0.0, "0.3"), (jump, "{curve: coulomb, stiction: 0.3, coulomb: 0.2}")):
        text = BLOCK.replace("FORCE", RAMP).replace("SPEED", "0").replace("curve: 0.3", f"curve: {curve}")
        system = scene(text).system
        outcome = integrate(system, Run(stop=(BEFORE + 2) * h, fixed_step=h, engine="stepping"))
        names, late = list(system.unknown_names), (2 - s) * h
        x, v = (outcome.y[names.index(f"block.{what}")] for what in "xv")
        errors[j] = (x - RATE / 6 * late**3 - j / 2 * late**2, v - RATE / 2 * late**2 - j * late)
    assert errors[jump][1] == pytest.approx(-0.5 * min(s, 1 - s) ** 2 * RATE * h**2, abs=1e-9)
    assert errors[jump] == pytest.approx(errors[0.0], abs=1e-12)


def test_a_capture_is_right_in_speed_and_short_or_far_by_half_its_parts(scene):
    a = LEVEL - 1.0  # m/s^2
    model = scene(BLOCK.replace("FORCE", "1 N").replace("SPEED", repr(a * DUE)))
    for _, _, v in ends(model, DUE, "block.v"):
        assert v == pytest.approx(0, abs=1e-12)
    for s, h, x in ends(model, DUE, "block.x"):
        assert x - a * DUE**2 / 2 == pytest.approx(a * h**2 / 2 * s * (1 - s), abs=1e-12)


def test_a_slip_that_turns_round_is_wrong_in_speed_by_order_one(scene):
    force = 9.0
    a, b = force + LEVEL, force - LEVEL
    model = scene(BLOCK.replace("FORCE", f"-{force} N").replace("SPEED", repr(a * DUE)))
    for s, h, v in ends(model, DUE, "block.v"):
        right = -b * (1 - s) * h
        assert v - right == pytest.approx((a - b) * s * h if s < b / a else b * (1 - s) * h, abs=1e-12)


def test_a_stop_that_gives_is_met_too_soon(scene):
    """The stop is so soft that it hardly turns the block within the step: r = k u = 1 N/s."""
    for s, h, v in ends(scene(WALL), DUE, "block.v"):
        wrong = (v - np.cos((1 - s) * h)) / (0.5 * h**2)
        assert wrong == pytest.approx(s**2, abs=0.3 * h)


def test_a_node_without_mass_that_is_let_go_is_behind_in_place(scene):
    model = scene(NODE.replace("FORCE", RAMP))
    for s, h, x in ends(model, DUE, ".x"):
        if s < 0.5:
            wrong = x - RATE / 8 * (1 - s) ** 2 * h**2
            assert wrong == pytest.approx(-RATE / 8 * s**2 * h**2, abs=1e-12)


def test_the_place_on_a_table_that_swings_is_of_order_three(scene):
    text = (
        BLOCK.replace("FORCE", "0 N")
        .replace("SPEED", "0.01")
        .replace(
            "ground: {type: Ground}",
            "ground: {type: MotionSource, velocity: {sine: {amplitude: 0.01 m/s, frequency: 0.5 Hz, phase: 90 deg}}}",
        )
    )
    model, found = scene(text), []
    (k,) = [k for k, name in enumerate(model.system.unknown_names) if name.endswith("block.x")]
    for n in (16, 32):
        outcome = integrate(model.system, Run(stop=0.8, fixed_step=0.8 / n, engine="stepping"))
        found.append(abs(outcome.y[k] - 0.01 / np.pi * np.sin(0.8 * np.pi)))
    assert found[0] > 7 * found[1]


@pytest.mark.parametrize("accuracy", ["1e-3", "1e-6"])
def test_where_machines_are_few_a_switch_is_logged_at_its_instant(accuracy, scene, tmp_path):
    model = scene(BLOCK.replace("FORCE", RAMP).replace("SPEED", "0"), **{"run.accuracy": accuracy})
    (let_go,) = model.run(out=tmp_path / "run", engine="stepping").events
    assert let_go.t == pytest.approx(DUE, abs=1e-9)


LIGHT = """
    components:
      heavy: {type: Mass, mass: 10 kg, position: 0 m, velocity: 0 m/s}
      light: {type: Mass, mass: 10 g, position: 0 m, velocity: 0 m/s}
      spring: {type: SpringDamper, stiffness: 1 kN/m, damping: 1 N*s/m}
      push: {type: ForceSource, force: {sine: {amplitude: 4 N, frequency: 2 Hz}}}
    connections: [[heavy.flange, spring.a], [spring.b, light.flange, push.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
    """


@pytest.mark.parametrize("accuracy", [1e-5, 1e-6])
def test_a_light_body_lags_behind_a_slow_load_by_no_more_than_two_weights(accuracy, scene, tmp_path):
    result = scene(LIGHT, **{"run.accuracy": repr(accuracy)}).run(out=tmp_path / "o", engine="stepping")
    rate, inertia = 4 * np.pi, np.diag([10, 0.01])
    # In steady motion, x = Im(amplitude e^(i rate t)); the heavy body drifts besides, and both swing as they start.
    bond = (1e3 + 1j * rate) * np.array([[1, -1], [-1, 1]])
    amplitude = np.linalg.solve(bond - rate**2 * inertia, [0, 4])[1]
    steady = result.t > 0.4
    t, v = result.t[steady], result["light.v"][steady]
    drift = 4 / rate / 10.01
    speed = np.imag(1j * rate * amplitude * np.exp(1j * rate * t)) + drift
    assert np.abs(v - speed).max() < 2 * accuracy * (0.1 + np.abs(speed).max())
    energy = result.run["energy"]
    missing = abs(energy["stored_change"] + energy["dissipated"] - energy["supplied"])
    assert missing < accuracy  # ten accuracies of 0.1 J


TOUCHED = """
    components:
      one: {type: Mass, mass: MASS kg, position: 0 m, velocity: 0 m/s}
      two: {type: Mass, mass: MASS kg, position: 0 m, velocity: 0 m/s}
      pad: {type: Contact, normal_force: LIMIT N, curve: 1}
      push: {type: ForceSource, force: {sine: {amplitude: PUSH N, frequency: 1 Hz}}}
    connections: [[one.flange, pad.a], [pad.b, two.flange, push.flange]]
    friction: {method: binding, creep: 1e-5 m/s}
    run: {stop: 1 s, accuracy: 1e-5}
    """


@pytest.mark.parametrize("accuracy", [1e-3, 1e-4, 1e-5, 1e-6])
@pytest.mark.parametrize(("mass", "limit"), [(1, 1), (0.1, 1), (1, 30)])
def test_a_creep_whose_load_comes_to_its_limit_and_no_further_is_not_shown_above_it(
    mass, limit, accuracy, scene, tmp_path
):
    # Each body takes half of the push; so the pad carries its limit at a quarter of the period, and never more.
    text = TOUCHED.replace("MASS", str(mass)).replace("LIMIT", str(limit)).replace("PUSH", str(2 * limit))
    result = scene(text, **{"run.accuracy": repr(accuracy)}).run(out=tmp_path / "o", engine="stepping", max_steps=50000)
    friction, load = result["pad.friction"], limit * np.sin(2 * np.pi * result.t)
    assert np.abs(friction).max() <= limit * (1 + 1e-5)
    assert np.abs(friction).max() > 0.99 * limit
    before = result.t < 0.24
    assert friction[before] == pytest.approx(load[before], abs=0.05 * limit)


SHAKEN = """
    components:
      table: {type: MotionSource, position: {sine: {amplitude: AMPLITUDE m, frequency: RATE Hz, phase: 90 deg}}}
      block: {type: Mass, mass: MASS kg, position: AMPLITUDE m, velocity: 0 m/s}
      pad: {type: Contact, normal_force: LOAD N, curve: 0.5}
    connections: [[table.flange, pad.a], [pad.b, block.flange]]
    friction: {method: lugre}
    run: {stop: 3 s, accuracy: 1e-5}
    """


@pytest.mark.parametrize("accuracy", [1e-5, 1e-6, 1e-7])
@pytest.mark.parametrize(("mass", "rate"), [(2, 2), (0.1, 5), (40, 1)])
def test_what_carries_a_body_by_bristles_gives_what_body_and_bristles_take(mass, rate, accuracy, scene, tmp_path):
    # The table takes 99/100 of the speed-up at which the block would slide; its bristles bend and creep, to and fro.
    amplitude = 0.99 * 5 / (2 * np.pi * rate) ** 2
    text = SHAKEN.replace("MASS", str(mass)).replace("LOAD", str(10 * mass)).replace("RATE", str(rate))
    text = text.replace("AMPLITUDE", repr(amplitude))
    result = scene(text, **{"run.accuracy": repr(accuracy)}).run(out=tmp_path / "o", engine="stepping")
    energy = result.run["energy"]
    missing = abs(energy["stored_change"] + energy["dissipated"] - energy["supplied"])
    assert missing < 0.1 * accuracy * max(energy["throughput"], 0.1)
