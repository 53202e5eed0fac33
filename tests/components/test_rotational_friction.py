"""Clutch, brake and bearing against the closed forms of two turning bodies and a friction torque.

With a constant torque T between inertias J1 and J2 at speeds w1 and w2, and 1/J = 1/J1 + 1/J2:

    lock time     J |w1 - w2|/T
    common speed  (J1 w1 + J2 w2)/(J1 + J2)
    heat          J (w1 - w2)^2/2,  whatever the torque did in time
"""

import textwrap

import numpy as np
import pytest
from fairlead.components.rotation.rubbing import METHODS

import fairlead
from fairlead.component.registry import known_types

ENGAGED = """
    parameters: {method: hold}
    components:
      engine: {type: Inertia, moment: 2 kg*m^2, speed: 100 rad/s}
      load: {type: Inertia, moment: 3 kg*m^2, speed: 10 rad/s}
      clutch: {type: Clutch, radius: 0.1 m, faces: 2, curve: 0.3, normal_force: 1 kN, method: "{method}"}
    connections: [[engine.shaft, clutch.a], [clutch.b, load.shaft]]
    run: {stop: 3 s, accuracy: 1e-6}
"""
INERTIA, SLIP, TORQUE = 1 / (1 / 2 + 1 / 3), 90.0, 2 * 0.1 * 0.3 * 1000
COMMON = (2 * 100 + 3 * 10) / 5


@pytest.fixture
def simulate(tmp_path):
    def run(text, **settings):
        path = tmp_path / "scene.yaml"
        path.write_text("schema: 1\nname: scene\n" + textwrap.dedent(text), encoding="utf-8")
        return fairlead.load(path, set=settings).run(out=tmp_path / "run", force=True, check=False)

    return run


def swing(method):
    """Relative speed [rad/s] with which the bodies may go on for ever, on springs that all stick: within the first's.

    Four springs of Maxwell slip have yields y = presliding i/4 and a quarter of the friction each. No damping is left.
    """
    if method != "maxwell_slip":
        return 0.0
    radius, yields = 0.1, 2e-5 * np.arange(1, 5) / 4
    stiffness = TORQUE * radius * np.sum(0.25 / yields)  # N*m/rad
    return yields[0] / radius * np.sqrt(stiffness / INERTIA)


@pytest.mark.parametrize("method", METHODS)
def test_a_clutch_locks_at_the_common_speed_with_the_heat_of_the_closed_form(simulate, method):
    result = simulate(ENGAGED, method=method)
    assert result.status == "finished", result.run["sentence"]
    # A regularised clutch comes to rest only asymptotically; bristles ring by their deflection, some 20 um at 0.1 m.
    for body, moment in (("engine", 2), ("load", 3)):
        rings = swing(method) * INERTIA / moment
        assert result[f"{body}.speed"][-1] == pytest.approx(COMMON, abs=1e-4 * COMMON + rings)
    assert (2 * result["engine.speed"][-1] + 3 * result["load.speed"][-1]) / 5 == pytest.approx(COMMON, rel=1e-4)
    assert result["energy.dissipated"][-1] == pytest.approx(INERTIA * SLIP**2 / 2, rel=1e-4)


def test_a_clutch_locks_when_the_closed_form_says(simulate):
    result = simulate(ENGAGED)
    (locked,) = [event.t for event in result.events if event.zone_to == "held"]
    assert locked == pytest.approx(INERTIA * SLIP / TORQUE, rel=1e-9)
    assert result["clutch.torque"][0] == pytest.approx(-TORQUE)  # b, the load, is dragged forward
    assert result["clutch.torque"][-1] == pytest.approx(0.0, abs=1e-6)


def test_a_clutch_pressed_by_a_signal_locks_when_its_impulse_is_spent(simulate):
    """Torque rises with the normal force within 1 s: T t^2/2 until then, so the lock is half a second later."""
    text = ENGAGED.replace(", normal_force: 1 kN", "").replace(
        "    connections: [",
        """      press: {type: ForceSource, force: {ramp: {to: 1 kN, over: 1 s}}}
      piston: {type: Mass, mass: 1e9 kg}
    connections: [[press.flange, piston.flange], [press.force, clutch.normal], """,
    )
    result = simulate(text)
    (locked,) = [event.t for event in result.events if event.zone_to == "held" and event.t > 0.1]
    assert locked == pytest.approx(INERTIA * SLIP / TORQUE + 0.5, rel=1e-6)


SOFT = "curve: {coulomb: 0.3, softening: 0.004 1/K, reference_temperature: 300 K}"
WARM = "normal_force: 1 kN, heat: {capacity: 100 J/K, share: 0.5, ambient: 300 K}"
FADING = ENGAGED.replace("curve: 0.3", SOFT).replace("normal_force: 1 kN", WARM)


def test_a_clutch_is_warmed_by_the_heat_of_the_closed_form_and_fades(simulate):
    """Whatever the torque did in time, the faces get half of J w^2/2; and T = T0 exp(-alpha rise) on the way."""
    fading = simulate(FADING)
    rise = 0.5 * INERTIA * SLIP**2 / 2 / 100
    assert fading["clutch.temperature"][-1] == pytest.approx(300 + rise, rel=1e-6)
    (locked,) = [event.t for event in fading.events if event.zone_to == "held"]
    # T t = J w without fade; with it the mean of the torque is lower, between the cold and the last one.
    assert 1 < locked / (INERTIA * SLIP / TORQUE) < np.exp(0.004 * rise)
    slipping = fading.t < locked
    faded = TORQUE * np.exp(-0.004 * (fading["clutch.temperature"] - 300))
    np.testing.assert_allclose(-fading["clutch.torque"][slipping], faded[slipping], rtol=1e-4)


@pytest.mark.parametrize("kind", ["Brake", "Bearing"])
def test_a_braked_shaft_stops_after_the_angle_of_the_closed_form(simulate, kind):
    scene = f"""
        components:
          wheel: {{type: Inertia, moment: 0.5 kg*m^2, speed: 20 rad/s}}
          brake: {{type: {kind}, radius: 0.2 m, curve: 0.4, normal_force: 100 N, method: hold}}
        connections: [[wheel.shaft, brake.shaft]]
        run: {{stop: 2 s, accuracy: 1e-6}}
    """
    result = simulate(scene)
    torque = 0.2 * 0.4 * 100
    assert result["wheel.angle"][-1] == pytest.approx(0.5 * 20**2 / (2 * torque), rel=1e-6)
    assert abs(result["wheel.speed"][-1]) < 1e-9


def test_a_shaft_takes_every_treatment_but_those_that_are_there_to_be_looked_at():
    shown = {"naive_sign", "naive_zone", "bristle"}
    members = set(known_types()["Contact"].members) - shown
    assert set(METHODS) <= members
    missing = {
        word
        for word in members - set(METHODS)
        if members and known_types()["Contact"].members[word].__module__.startswith("fairlead.")
    }
    assert not missing


def test_a_scene_wide_treatment_holds_for_shafts_too(simulate):
    result = simulate(ENGAGED.replace(', method: "{method}"', "") + "    friction: {method: karnopp}\n")
    assert {event.zone_to for event in result.events} >= {"stuck"}
