"""What a curve says of speed, direction, load and temperature, under several treatments, against closed forms."""

import math
import pathlib

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

import fairlead
from fairlead.errors import ModelError

SLIDING = """
    parameters: {method: hold, speed: 0.3 m/s, curve: 0.5, normal: 10 N}
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 2 kg, velocity: "{speed}"}
      pad: {type: Contact, method: "{method}", normal_force: "{normal}", curve: CURVE}
    connections: [[ground.flange, pad.a], [pad.b, block.flange]]
    run: {stop: 1 s, accuracy: 1e-7}
"""
MASS, NORMAL, SPEED = 2.0, 10.0, 0.3

DRIVEN = """
    components:
      ground: {type: Ground}
      pad: {type: Contact, method: saturation, creep: 1e-9 m/s, normal_force: 10 N, curve: CURVE}
      drive: {type: MotionSource, velocity: {ramp: {from: 0.01 m/s, to: 0.5 m/s, over: 1 s}}}
    connections: [[ground.flange, pad.a], [pad.b, drive.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
    record: {every: 5 ms}
"""
POINTS = np.array([[0.0, 0.5], [0.05, 0.42], [0.2, 0.35], [0.4, 0.37]])
CREEPING = ("tanh", "arctan", "root", "saturation", "binding")
BRISTLES = ("reset_integrator", "dahl", "lugre", "elastoplastic")
EVERY = ("binding", "hold", "karnopp", *BRISTLES, "tanh", "root", "saturation")


def finely(method: str) -> dict[str, str]:
    """A creep so small that a sliding block does not feel it."""
    return {"pad.creep": "1e-7 m/s"} if method in CREEPING else {}


# Speed


def test_viscous_friction_stops_a_block_as_its_exponential_says(simulate):
    level, rate = 0.2, 4.0
    result = simulate(SLIDING.replace("CURVE", "{curve: viscous, coulomb: 0.2, rate: 4 s/m}"))
    time = MASS / (NORMAL * rate) * math.log(1 + rate * SPEED / level)
    distance = (SPEED + level / rate) * MASS / (NORMAL * rate) * (
        1 - math.exp(-NORMAL * rate * time / MASS)
    ) - level / rate * time
    (stopped,) = [event.t for event in result.events if event.zone_to == "held" and event.t > 0]
    assert stopped == pytest.approx(time, rel=1e-6)
    assert result["block.x"][-1] == pytest.approx(distance, rel=1e-6)


@pytest.mark.parametrize("kind", ["linear", "cubic"])
def test_a_table_from_a_file_is_followed_from_point_to_point(simulate, tmp_path: pathlib.Path, kind: str):
    np.savetxt(tmp_path / "measured.csv", POINTS, delimiter=",", header="slip [m/s], coefficient")
    curve = f"{{curve: table, points: {{file: measured.csv, kind: {kind}}}}}"
    result = simulate(DRIVEN.replace("CURVE", curve))
    v = np.minimum(result["pad.slip"], POINTS[-1, 0])
    table = PchipInterpolator(*POINTS.T)(v) if kind == "cubic" else np.interp(v, *POINTS.T)
    np.testing.assert_allclose(result["pad.friction"], NORMAL * table, rtol=1e-9)
    intervals = [event for event in result.events if event.t > 0 and event.zone_to.startswith("curve.points")]
    for event, border in zip(intervals, POINTS[1:, 0], strict=True):  # each interval is a zone, entered at its border
        assert result.at("pad.slip", event.t) == pytest.approx(border, abs=1e-6)


# Direction

NAP = "{curve: table, points: [[0, 0.6], [1, 0.6]], backward: [[0, 0.3], [1, 0.3]]}"


@pytest.mark.slow
@pytest.mark.parametrize("method", EVERY)
def test_a_surface_with_a_nap_stops_a_block_later_the_other_way(simulate, method: str):
    for sign, mu in ((1, 0.6), (-1, 0.3)):
        given = {**finely(method), "speed": f"{sign * SPEED} m/s"}
        text = SLIDING.replace("CURVE", NAP)
        if method in BRISTLES:  # bent as sliding bends them; stiff, so that they give little
            given["pad.presliding"] = "2 um"
            text += f"    initial: {{pad.z: {sign * mu / 0.6 * 2} um}}\n"
        result = simulate(text, **{"method": method, **given})
        distance = sign * np.abs(result["block.x"]).max()
        assert distance == pytest.approx(sign * MASS * SPEED**2 / (2 * mu * NORMAL), abs=3e-6)


@pytest.mark.parametrize("method", ["binding", "hold", "karnopp", "reset_integrator", "lugre", "elastoplastic"])
def test_a_surface_with_a_nap_holds_less_the_other_way(simulate, method: str):
    pushed = "      push: {type: ForceSource, force: {ramp: {to: LOAD, over: 0.5 s}}}\n    connections: ["
    text = SLIDING.replace("CURVE", NAP).replace("    connections: [", pushed)
    text = text.replace("block.flange]]", "block.flange, push.flange]]")
    for sign, stiction in ((1, 6.0), (-1, 3.0)):
        for share, moves in ((0.97, False), (1.03, True)):
            result = simulate(text.replace("LOAD", f"{sign * share * stiction} N"), method=method, speed="0 m/s")
            assert (abs(result["block.x"][-1]) > 2e-3) == moves, (method, sign, share)


@pytest.mark.slow
def test_points_for_backward_slip_may_go_with_any_curve(simulate):
    curve = "{curve: stribeck, stiction: 0.6, coulomb: 0.6, velocity: 1 cm/s, backward: [[0, 0.3], [1, 0.3]]}"
    for sign, mu in ((1, 0.6), (-1, 0.3)):
        result = simulate(SLIDING.replace("CURVE", curve), speed=f"{sign * SPEED} m/s")
        assert result["block.x"][-1] == pytest.approx(sign * MASS * SPEED**2 / (2 * mu * NORMAL), rel=1e-6)


FALLING_NAP = (
    "{curve: tustin, stiction: 0.5, coulomb: 0.3, velocity: 2 mm/s, backward: [[0, 0.8], [2 mm/s, 0.6], [1, 0.6]]}"
)


@pytest.mark.parametrize("method", [*EVERY, "arctan", "maxwell_slip"])
def test_every_treatment_slides_and_breaks_away_by_the_curve_of_its_direction(simulate, method: str):
    """10 N on a body of 10 g under a force that grows by 12 N/s: gone at 5 N or 8 N, then 3 N or 6 N."""
    text = SLIDING.replace("CURVE", FALLING_NAP).replace("mass: 2 kg", "mass: 10 g")
    text = text.replace("    connections: [", "      push: {type: ForceSource, force: {ramp: {to: LOAD, over: 1 s}}}\n"
                        "    connections: [").replace("block.flange]]", "block.flange, push.flange]]")  # fmt: skip
    gradual = method in (*BRISTLES[1:], "maxwell_slip")  # their way before that grows with the time it takes
    for sign, stiction, sliding in ((1, 5.0, 3.0), (-1, 8.0, 6.0)):
        result = simulate(text.replace("LOAD", f"{sign * 12} N"), method=method, speed="0 m/s", **finely(method))
        assert sign * result["pad.friction"][-1] == pytest.approx(sliding, rel=1e-3)
        load = 12 * result.t[np.argmax(sign * result["block.x"] > 2e-4)]
        if gradual:
            assert 0.75 * stiction < load < stiction
        else:
            assert load == pytest.approx(stiction, rel=0.02)


SHAPES = {"tanh": math.tanh, "arctan": lambda q: 2 / math.pi * math.atan(q), "root": lambda q: q / math.hypot(1, q)}


@pytest.mark.parametrize("method", SHAPES)
def test_a_smooth_law_is_the_one_that_its_page_prints(simulate, method: str):
    """T = N ((1 + s)/2 mu_forward(u) + (1 - s)/2 mu_backward(u)) s with u = sqrt(v^2 + creep^2), s = shape(v/creep)."""
    speed, creep = 2e-3, 1e-3
    u, s = math.hypot(speed, creep), SHAPES[method](speed / creep)
    coefficient = (1 + s) / 2 * (0.3 + 0.2 * math.exp(-u / 2e-3)) + (1 - s) / 2 * np.interp(u, [0, 2e-3], [0.8, 0.6])
    text = DRIVEN.replace("CURVE", FALLING_NAP).replace("saturation, creep: 1e-9", f"{method}, creep: 1e-3")
    text = text.replace("{ramp: {from: 0.01 m/s, to: 0.5 m/s, over: 1 s}}", "2 mm/s")
    result = simulate(text)
    assert result["pad.friction"][-1] == pytest.approx(10 * coefficient * s, rel=1e-9)
    page = pathlib.Path(__file__).resolve().parents[2] / "docs" / "treatments" / f"{method}.md"
    law = page.read_text(encoding="utf-8").split("```text")[1].split("```")[0]
    assert "N mu(u)" in law
    assert "u = sqrt(v^2 + creep^2)" in law


def test_the_bristle_of_equal_sites_refuses_a_curve_for_backward_slip(scene):
    with pytest.raises(ModelError, match=r"pad\.curve: backward points are given, and the sites of method bristle"):
        scene(SLIDING.replace("CURVE", FALLING_NAP), method="bristle").check()


def test_points_that_make_no_sense_are_refused(scene):
    wrong = {"[[0.1, 0.3], [1, 0.3]]": "the first speed is 0.1 m/s", "[[0, -1], [1, 1]]": "a coefficient is negative"}
    for points, says in wrong.items():
        with pytest.raises(ModelError, match=says):
            scene(SLIDING.replace("CURVE", f"{{coulomb: 0.5, backward: {points}}}")).check()


# Load

LOADED = "{coulomb: 0.5, load_exponent: 0.8, load_reference: 100 N}"
REFERENCE, EXPONENT = 100.0, 0.8


@pytest.mark.parametrize("method", EVERY)
def test_friction_grows_as_a_power_of_the_load_under_every_treatment(simulate, method: str):
    friction = 0.5 * REFERENCE * (NORMAL / REFERENCE) ** EXPONENT
    text = SLIDING.replace("CURVE", LOADED) + ("    initial: {pad.z: 2 um}\n" if method in BRISTLES else "")
    given = {"pad.presliding": "2 um"} if method in BRISTLES else finely(method)
    result = simulate(text, method=method, **given)
    assert result["block.x"].max() == pytest.approx(MASS * SPEED**2 / (2 * friction), abs=3e-6)


def test_a_contact_cut_in_parts_rubs_as_the_whole(simulate):
    """Ten spots under a tenth of the load each, the reference that of one spot: the mesh of a line must not count."""
    text = SLIDING.replace("CURVE", LOADED)
    whole = simulate(text, normal="100 N", **{"pad.extent": "10"})
    friction = 10 * 0.5 * REFERENCE * (10 / REFERENCE) ** EXPONENT
    assert whole["block.x"][-1] == pytest.approx(MASS * SPEED**2 / (2 * friction), rel=1e-6)


def test_load_dependence_off_is_friction_in_proportion_to_the_load(simulate, scene):
    text = SLIDING.replace("CURVE", LOADED)
    off = simulate(text + "    effects: {load_dependence: off}\n")
    plain = simulate(SLIDING.replace("CURVE", "0.5"))
    np.testing.assert_array_equal(off["block.x"], plain["block.x"])
    # The limit: with an exponent of 1 the effect changes nothing while it is on.
    limit = simulate(text, **{"pad.curve.load_exponent": "1"})
    assert limit["block.x"][-1] == pytest.approx(plain["block.x"][-1], rel=1e-9)


def test_no_load_at_all_is_no_trouble_for_a_power_of_it(simulate):
    text = SLIDING.replace("CURVE", LOADED).replace(', normal_force: "{normal}"', "").replace(
        "    connections: [",
        """      press:
        type: ForceSource
        force: {trapezoid: {from: -1 N, to: 10 N, start: 0.1 s, rise: 0.1 s, stay: 0.1 s, fall: 0.1 s}}
      anvil: {type: Mass, mass: 1e9 kg}
    connections: [[press.flange, anvil.flange], [press.force, pad.normal], """,
    )
    for method in ("hold", "binding", "lugre"):
        result = simulate(text, method=method, speed="1 m/s")
        pressed = result.at("pad.friction", 0.25)
        assert pressed == pytest.approx(0.5 * REFERENCE * (10 / REFERENCE) ** EXPONENT, rel=1e-4)
        assert result.at("pad.friction", 0.5) == 0.0


def test_an_exponent_without_its_load_is_refused(scene):
    with pytest.raises(ModelError, match="load_exponent is given without load_reference"):
        scene(SLIDING.replace("CURVE", "{coulomb: 0.5, load_exponent: 0.8}")).check()


# Temperature

SOFT = "{coulomb: 0.5, softening: 0.01 1/K, reference_temperature: 300 K}"
ALPHA, COLD = 0.01, 300.0
RUBBED = """
    parameters: {capacity: 2 J/K, loss: 0 W/K, stop: 60 s}
    components:
      ground: {type: Ground}
      pad: {type: Contact, method: saturation, normal_force: 100 N, ambient: 300 K, curve: CURVE}
      drive: {type: MotionSource, velocity: 0.2 m/s}
      warm: {type: FrictionHeat, capacity: "{capacity}", loss: "{loss}", share: 0.5, ambient: 300 K}
    connections:
      - [ground.flange, pad.a]
      - [pad.b, drive.flange]
      - [pad.friction, warm.friction]
      - [pad.slip, warm.slip]
      - [warm.temperature, pad.temperature]
    run: {stop: "{stop}", accuracy: 1e-7}
""".replace("CURVE", SOFT)


def test_friction_follows_a_temperature_given_in_time(simulate):
    text = DRIVEN.replace("CURVE", SOFT).replace(
        "    connections: [",
        """      day: {type: TemperatureSource, profile: {ramp: {from: 300 K, to: 380 K, over: 1 s}}}
    connections: [[day.temperature, pad.temperature], """,
    )
    result = simulate(text)
    np.testing.assert_allclose(result["pad.friction"], 5.0 * np.exp(-ALPHA * 80.0 * result.t), rtol=1e-9)


def test_a_surface_that_friction_warms_softens_by_a_logarithm(simulate):
    """c dTheta/dt = share N mu exp(-alpha dTheta) v  gives  dTheta = ln(1 + alpha share N mu v t/c)/alpha."""
    result = simulate(RUBBED)
    warmer = np.log(1 + ALPHA * 0.5 * 100 * 0.5 * 0.2 * result.t / 2.0) / ALPHA
    np.testing.assert_allclose(result["warm.temperature"], COLD + warmer, rtol=1e-7)
    np.testing.assert_allclose(result["pad.friction"], 50 * np.exp(-ALPHA * warmer), rtol=1e-5)


def test_a_warm_surface_settles_where_it_loses_what_it_gets(simulate):
    result = simulate(RUBBED, loss="0.05 W/K", capacity="0.1 J/K")
    balance = brentq(lambda rise: 0.05 * rise - 0.5 * 50 * 0.2 * math.exp(-ALPHA * rise), 0, 1000)
    assert result["warm.temperature"][-1] == pytest.approx(COLD + balance, rel=1e-6)


def test_temperature_dependence_off_leaves_no_state_and_no_term(scene, simulate):
    off = RUBBED + "    effects: {temperature_dependence: off}\n"
    assert scene(off).system.n == scene(RUBBED).system.n - 1
    assert "warm.theta" not in scene(off).system.unknown_names
    result = simulate(off)
    np.testing.assert_array_equal(result["pad.friction"], 50.0)
    np.testing.assert_array_equal(result["warm.temperature"], COLD)
    # The limit of the effect: a body too large to get warm.
    limit = simulate(RUBBED, capacity="1e12 J/K", stop="1 s")
    np.testing.assert_allclose(limit["pad.friction"], 50.0, rtol=1e-9)


@pytest.mark.parametrize("kind", ["Hold", "Binding"])
def test_a_factor_that_is_not_given_is_no_term_of_the_law(kind):
    said = fairlead.describe_type(kind)
    assert "coefficient(slip)" in said
    assert "load_factor" not in said.partition("Curve\n")[0]


# Temperature and speed

SHIFTED = "{curve: stribeck, stiction: 0.5, coulomb: 0.3, velocity: 0.1 m/s, velocity_shift: 0.03 1/K}"
WARMED = f"""
    components:
      ground: {{type: Ground}}
      pad: {{type: Contact, method: METHOD, normal_force: 10 N, curve: {SHIFTED}}}
      block: {{type: Mass, mass: 2 kg, velocity: 0.15 m/s}}
      push: {{type: ForceSource, force: 4 N}}
      day: {{type: TemperatureSource, profile: {{ramp: {{from: 293.15 K, to: 373.15 K, over: 1 s}}}}}}
    connections:
      - [day.temperature, pad.temperature]
      - [ground.flange, pad.a]
      - [pad.b, block.flange, push.flange]
    run: {{stop: 1 s, accuracy: 1e-6}}
    record: {{every: 5 ms}}
"""


@pytest.mark.parametrize("method", ["hold", "karnopp", "tanh", "arctan", "root"])
def test_a_warm_contact_slides_as_a_cold_one_does_more_slowly(simulate, method):
    """T(v, Theta) = N mu(a_T v) with a_T = exp(-beta (Theta - Theta_ref)), at every instant of a slide."""
    result = simulate(WARMED.replace("METHOD", method))
    slip = result["pad.slip"]
    assert slip.min() > 0.05
    closed = 10.0 * (0.3 + 0.2 * np.exp(-((slip * np.exp(-0.03 * 80.0 * result.t) / 0.1) ** 2)))
    np.testing.assert_allclose(result["pad.friction"], closed, rtol=2e-3 if method == "arctan" else 1e-5)
    cold = 10.0 * (0.3 + 0.2 * np.exp(-((slip / 0.1) ** 2)))
    assert np.abs(closed / cold - 1).max() > 0.1


@pytest.mark.slow
def test_a_shift_that_vanishes_leaves_the_curve_and_off_leaves_no_term(simulate):
    text = WARMED.replace("METHOD", "hold")
    plain = simulate(text.replace(", velocity_shift: 0.03 1/K", ""))
    weak = simulate(text.replace("0.03 1/K", "1e-9 1/K"))
    off = simulate(text + "    effects: {temperature_dependence: off}\n")
    np.testing.assert_allclose(weak["block.x"], plain["block.x"], rtol=1e-7)
    np.testing.assert_allclose(off["block.x"], plain["block.x"], rtol=1e-12)
    assert simulate(text)["block.x"][-1] < 0.9 * plain["block.x"][-1]


@pytest.mark.parametrize("method", ["binding", "saturation", *BRISTLES, "bristle"])
def test_a_method_that_cannot_shift_its_curve_says_so(scene, method):
    with pytest.raises(ModelError, match="velocity_shift is given, and this contact has its curve at one temperature"):
        scene(WARMED.replace("METHOD", method)).check()
