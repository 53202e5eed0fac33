"""The parts of a web line in models/single_parts against balances of material and momentum of their scenes."""

import pathlib
import re

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

import fairlead
from fairlead.errors import ModelError

SCENES = pathlib.Path(__file__).parents[2] / "models" / "single_parts"


def run(name, **settings):
    """A scene, with other values by their dotted names."""
    result = fairlead.load(SCENES / f"{name}.yaml", set={"run.accuracy": "1e-6", **settings}).run(out=None)
    assert result.ok
    assert result.run["energy"]["closure"] < 1e-4
    return result


def switched(result, where, to):
    """Time at which a zone was first entered [s]."""
    table = result.switches().to_pandas()
    return float(table["first"][(table["component"] == where) & (table["zone_to"] == to)].min())


def test_strains_of_two_spans_follow_the_balance_of_their_material():
    """S1' = v1 - v2 S1/L1 and S2' = v2 S1/L1 - v3 S2/L2 are linear; with rates a and b they are exponentials."""
    result = run("web_span")
    t, v1, v2, v3 = result.t[result.t < 6], 1.0, 1.001, 1.002
    a, b = v2 / 1, v3 / 2
    first = v1 / a * (1 + (a / v1 - 1) * np.exp(-a * t))
    c = (a - v1) / (b - a)  # of exp(-a t) in the second span, whose inflow is a first
    second = v1 / b + c * np.exp(-a * t) + (2 - v1 / b - c) * np.exp(-b * t)
    assert result["web_1.strain"][: t.size] == pytest.approx(1 / first - 1, abs=1e-8)
    assert result["web_2.tension"][: t.size] / 1e5 == pytest.approx(2 / second - 1, abs=1e-8)


def test_tensions_follow_the_equation_of_shelton_and_brandenburg():
    """L dT/dt = EA (v2 - v1) + v1 T0 - v2 T, exact to a share that is the strain, here 1e-3."""
    result = run("web_span")

    def rates(_, y):
        return 1e5 * 0.001 + 0 - 1.001 * y[0], (1e5 * 0.001 + 1.001 * y[0] - 1.002 * y[1]) / 2

    t = result.t[result.t < 6]
    found = solve_ivp(rates, (0, 6), [0, 0], rtol=1e-9, atol=1e-9, t_eval=t)
    assert result["web_1.tension"][: t.size] == pytest.approx(found.y[0], abs=0.3)
    assert result["web_2.tension"][: t.size] == pytest.approx(found.y[1], abs=0.6)
    assert result.at("web_2.tension", 5.9) > 170  # it has what came over the roller, beside its own 100 N


@pytest.mark.slow
def test_a_web_tears_where_its_strength_is_reached():
    result = run("web_span")
    start = 1 / (1 + result.at("web_1.strain", 6.0))

    def material(_, y):
        return [1 - (1.001 + 0.01 * (_ - 6) / 10) * y[0]]

    found = solve_ivp(material, (6, 16), [start], rtol=1e-10, atol=1e-12, dense_output=True)
    tears = brentq(lambda t: 1 / found.sol(t)[0] - 1 - 800 / 1e5, 6, 16)
    assert switched(result, "web_1", "torn") == pytest.approx(tears, abs=1e-5)
    assert result["web_1.tension"][-1] == 0
    whole = run("web_span", **{"web_1.effects.breaking": "off"})
    assert whole["web_1.tension"][-1] > 800


@pytest.mark.slow
def test_a_line_that_runs_backward_is_the_mirror_image_of_one_that_runs_forward():
    """The rollers turned round in order and way: the strain of the far span comes over the roller between."""
    forward = run("web_span", **{"run.stop": "6 s"})
    back = run("web_span", **{
        "run.stop": "6 s", "first.speed": "-10.02 rad/s", "second.speed": "-10.01 rad/s", "third.speed": "-10 rad/s",
        "web_1.length": "2 m", "web_2.length": "1 m"})  # fmt: skip
    assert back["web_2.tension"] == pytest.approx(forward["web_1.tension"], abs=1e-3)
    assert back["web_1.tension"] == pytest.approx(forward["web_2.tension"], abs=1e-3)


@pytest.mark.slow
def test_a_slack_web_has_no_tension_until_its_slack_is_taken_up(simulate):
    """From no tension the second roller lags by dv for 1 s: dv 1 s of slack, which a lead of dv takes up in 1 s."""
    text = (SCENES / "web_span.yaml").read_text(encoding="utf-8").split("name: web_span\n")[1]
    table = "{table: [[0 s, 9.9 rad/s], [1 s, 9.9 rad/s], [1.0001 s, 10.1 rad/s], [4 s, 10.1 rad/s]]}"
    changed = re.sub(r"second: \{.*\}\}", f"second: {{type: SpeedSource, speed: {table}}}", text)
    result = simulate(changed, **{"run.accuracy": "1e-6", "run.stop": "2.5 s", "web_1.strength": "1 MN"})
    taut = switched(result, "web_1", "taut")
    assert taut == pytest.approx(2, abs=1e-3)
    assert result.at("web_1.tension", 1.5) == 0
    strain = 1.01 / (1 + 0.01 * np.exp(-1.01 * (2.5 - taut))) - 1  # S' = 1 - 1.01 S
    assert result.at("web_1.strain", 2.5) == pytest.approx(strain, rel=1e-4)


def hollow(radius):
    """Moment of inertia of the roll of both scenes [kg m^2]."""
    return 0.2 + 800 * 0.5 * np.pi / 2 * (radius**4 - 0.05**4)


def test_a_roll_turns_as_the_radius_and_the_inertia_that_are_left():
    """J w' = F R without w dJ/dt, so w^2/2 is the integral of F R/J over the angle; web that goes keeps its speed."""
    result = run("unwinder")
    k = 0.002 / (2 * np.pi)
    radius = result["roll.radius"]
    speeds = np.gradient(0.3 - radius, result.t) / k
    for at in (400, 800, 1100):
        angle = (0.3 - radius[at]) / k
        half = quad(lambda x: 40 * (0.3 - k * x) / hollow(0.3 - k * x), 0, angle)[0]
        assert speeds[at] == pytest.approx(np.sqrt(2 * half), rel=1e-3)  # differences of rows
    assert result["roll.moment"] == pytest.approx(hollow(radius), rel=1e-9)
    assert result["roll.left"] == pytest.approx(np.pi * (radius**2 - 0.05**2) / 0.002, rel=1e-9)
    assert radius[-1] < 0.2


def test_the_time_that_a_roll_takes_is_that_of_its_equation():
    """Two first-order equations integrated by scipy."""
    result = run("unwinder")
    k = 0.002 / (2 * np.pi)
    found = solve_ivp(lambda _, y: (y[1], 40 * (0.3 - k * y[0]) / hollow(0.3 - k * y[0])), (0, 18), (0, 0), rtol=1e-10,
                      atol=1e-10, t_eval=result.t)  # fmt: skip
    assert result["roll.radius"] == pytest.approx(0.3 - k * found.y[0], abs=1e-7)


@pytest.mark.slow
def test_without_layers_a_roll_is_a_wheel():
    result = run("unwinder", **{"roll.effects.layers": "off"})
    full = run("unwinder")
    assert result.run["unknowns"] < full.run["unknowns"]
    turned = 40 * 0.3 / hollow(0.3) * result.t**2 / 2
    left = np.pi * (0.3**2 - 0.05**2) / 0.002 - 0.3 * turned
    assert result["roll.left"] == pytest.approx(left, abs=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize(("taper", "shape"), [(0.4, "hyperbolic"), (1.0, "hyperbolic"), (0.4, "linear")])
def test_a_winder_has_the_tension_of_its_taper_less_what_its_roll_takes(taper, shape):
    """At v the roll slows down by v k w/R^2 while R grows: J of it and the drag are taken from the torque."""
    result = run("winder", **{"taper.taper": str(taper), "taper.shape": shape, "taper.full_radius": "250 mm"})
    late = result.t > 15
    radius, k = result["roll.radius"][late], 0.002 / (2 * np.pi)
    falls = 1 - 0.05 / radius if shape == "hyperbolic" else (radius - 0.05) / 0.2
    v = 2.0 * (1 + result["web.tension"][late] / 1e5)
    slows = v**2 * k / radius**3
    tension = 200 * (1 - taper * falls) + (hollow(radius) * slows - 1e-3 * v / radius) / radius
    assert result["web.tension"][late] == pytest.approx(tension, rel=2e-4)
    assert result["roll.wound"][-1] - result["roll.wound"][0] == pytest.approx(80, rel=2e-3)


@pytest.mark.slow
def test_a_web_slips_on_an_idler_at_the_ratio_of_euler_and_in_a_nip_with_its_force_beside():
    result = run("web_rollers")
    slips, later = switched(result, "idler.contact", "forward"), switched(result, "nip.contact", "forward")
    assert later > slips > 1
    one, two, three = (result.at(f"web_{k}.tension", slips - 1e-4) for k in (1, 2, 3))
    assert two / one == pytest.approx(np.exp(0.2 * 1.5), rel=1e-4)
    at = [result.at(f"web_{k}.tension", 2.9) for k in (1, 2, 3)]
    assert at[1] / at[0] == pytest.approx(np.exp(0.2 * 1.5), rel=1e-4)
    assert at[2] == pytest.approx(at[1] * np.exp(0.2 * 0.5) + 0.2 * 500, rel=1e-4)
    braked = result.at("idler.speed", 2.9) - result.at("idler.speed", 2.8)  # what the web leaves of the brake
    brakes = 8 / 2 * 1.85
    assert braked / 0.1 == pytest.approx((0.05 * (at[1] - at[0]) - brakes) / 0.01, rel=2e-2)
    assert three is not None


@pytest.mark.slow
def test_an_accumulator_has_the_tension_of_the_average_model():
    """Material comes in at v_in and goes out at v_out S/L(x); the carriage is a mass with its force and its damper."""
    result = run("web_accumulator")

    def rates(t, y):
        x, v, material = y
        length = 4 + 8 * x
        pull = 1e5 * (length / material - 1)
        comes = 0.1 * np.interp(t, [0, 1, 2, 4, 5], [20, 20, 0, 0, 20])
        return v, (1600 - 8 * pull - 300 * v) / 100, comes - 2.004 * material / length

    found = solve_ivp(rates, (0, 6), (1.5, 0, 16 / 1.002), "LSODA", rtol=1e-10, atol=1e-12, max_step=1e-2,
                      t_eval=result.t)  # fmt: skip
    x, _, material = found.y
    assert result["carriage.x"] == pytest.approx(x, abs=1e-6)
    assert result["store.tension"] == pytest.approx(1e5 * ((4 + 8 * x) / material - 1), abs=0.05)
    assert np.ptp(x) > 0.5


@pytest.mark.slow
def test_a_dancer_swings_on_the_stretch_of_both_sides_of_its_loop():
    """2 arm^2 (material stiffness)/length over the moment; the cylinder's torque is that of both tensions."""
    result = run("rotary_dancer")
    late = result.t > 0.15
    angle = result["dancer.angle"][late]
    mean, times = (angle.max() + angle.min()) / 2, result.t[late]
    ups = np.flatnonzero((angle[:-1] < mean) & (angle[1:] >= mean))
    crossings = [np.interp(mean, angle[k : k + 2], times[k : k + 2]) for k in ups]
    stiff = 2 * 0.4**2 * 1e5 * (1 + 200 / 1e5) / 1.0  # over the material, which is shorter than its way
    assert np.mean(np.diff(crossings)) == pytest.approx(2 * np.pi / np.sqrt(stiff / 2), rel=1e-3)
    assert mean == pytest.approx(10 / stiff, rel=1e-2)
    assert result["dancer.tension_in"] == pytest.approx(result["dancer.tension_out"], abs=1e-6)


def profile(result, at, n):
    """Tensions from the storage drum to the load [N]."""
    return np.array([result.at(f"winch.span[{i}].tension", at) for i in range(n)] + [result.at("tail.tension", at)])


@pytest.mark.slow
@pytest.mark.parametrize(("mu", "groove"), [(0.12, 60.0), (0.2, 180.0)])
def test_a_rope_slips_through_all_grooves_at_euler_s_ratio_of_all_their_wraps(mu, groove):
    """Below it the storage drum feels nothing; from the load, each groove that slips takes exp(mu' pi)."""
    result = run("traction_drums", **{"winch.mu": str(mu), "winch.groove": f"{groove} deg"})
    ratio = np.exp(np.pi * mu / np.sin(np.radians(groove / 2)))
    slips = [switched(result, f"winch.wrap[{i}]", "forward") for i in range(3)]
    assert slips[0] > slips[1] > slips[2]
    for i, at in enumerate(slips):  # the load that this groove and those towards the load hold beside 1 kN
        assert profile(result, at, 3)[-1] == pytest.approx(1000 * ratio ** (3 - i), rel=2e-3)
    tensions = profile(result, slips[0] + 0.5, 3)
    assert tensions[1:] / tensions[:-1] == pytest.approx(ratio, rel=1e-3)
    assert profile(result, slips[0] - 0.1, 3)[0] == pytest.approx(1000, abs=0.01)  # `slow`
    assert result.at("drum.left", slips[0]) == pytest.approx(result["drum.left"][0], rel=1e-10)


AREA = np.pi * 0.25**2 / 4  # of the compensator [m^2]


@pytest.mark.slow
def test_a_passive_compensator_has_the_force_of_its_gas_on_both_sides_of_its_sheave():
    """The gas follows from the travel alone; the oil's force is that of both sides and of 200 kg."""
    result = run("heave_compensator", **{"compensator.effects.active": "off"})
    travel, late = result["compensator.travel"], result.t > 10
    assert np.ptp(travel[late]) > 1.3
    level = 20e5 * (1.5 / (1.5 * (20 / 33.6) ** (1 / 1.2) + AREA * (travel - 1.5))) ** 1.2
    assert result["compensator.gas_pressure"] == pytest.approx(level, rel=1e-4)
    rises = np.gradient(np.gradient(travel, result.t), result.t)
    both = result["sheave.tension_in"] + result["sheave.tension_out"] + 200 * rises
    assert (result["compensator.cylinder.pressure"] - 1e5)[late] * AREA == pytest.approx(both[late], abs=20)
    assert result["tail.tension"][late] == pytest.approx((level[late] - 1e5) * AREA / 2, abs=300)  # of 80 kN


@pytest.mark.slow
def test_an_active_compensator_leaves_a_third_of_what_the_gas_leaves():
    """2 T = gas + 4 (wanted - T), so T - wanted = (gas/2 - wanted)/3, less what the necks and the masses take."""
    result = run("heave_compensator")
    late = result.t > 10
    assert np.abs(result["control.command"][late]).max() < 20e3
    gas = (result["compensator.gas_pressure"][late] - 1e5) * AREA
    assert result["tail.tension"][late] - 8e4 == pytest.approx((gas / 2 - 8e4) / 3, abs=100)
    assert np.ptp(gas) / 2 > 6e3
    weak = run("heave_compensator", **{"compensator.most": "1 kN"})
    assert np.ptp(weak["tail.tension"][late]) > 2 * np.ptp(result["tail.tension"][late])


@pytest.mark.slow
def test_a_bearing_of_a_moving_sheave_parts_the_tensions_of_its_sides():
    """While the loop grows, rope comes in from the side ahead, so the side behind has to pull harder."""
    result = run("heave_compensator", **{"sheave.rubbing": "400 N*m", "compensator.effects.active": "off"})
    t = np.linspace(10, 39, 581)
    speed = np.gradient(result.at("compensator.travel", t), t)
    swift = np.abs(speed) > 0.2
    parts = result.at("sheave.tension_in", t) - result.at("sheave.tension_out", t)
    assert np.ptp(np.sign(speed[swift])) == 2
    assert parts[swift] == pytest.approx(1000 * np.sign(speed[swift]), abs=30)  # and 4 kg m^2 at the sheave


def test_a_stopper_holds_up_to_its_capacity_and_lets_go_as_it_is_opened():
    """The pull passes 50 kN at 5/3 s; opened from 4 s on it holds 20 kN until 4.6 s."""
    result = run("stopper")
    assert switched(result, "stopper.contact", "forward") == pytest.approx(5 / 3, rel=1e-6)
    assert result.at("chain.v", 2.0) == pytest.approx(15 / 3**2 / 2, rel=1e-5)
    again = [e.t for e in result.events if e.component == "stopper.contact" and e.zone_to == "forward"]
    assert again[1] == pytest.approx(4.6, rel=1e-6)
    assert result.at("chain.v", 6.0) - result.at("chain.v", 5.5) == pytest.approx(5, rel=1e-5)


@pytest.mark.parametrize(
    ("name", "set_to", "says"),
    [
        ("unwinder", {"roll.radius": "40 mm"}, "radius 0.04 m is below core_radius = 0.05 m"),
        ("unwinder", {"roll.moment": "1e-3 kg*m^2"}, "is not above that of a core of solid web"),
        ("traction_drums", {"drum.width": "20 mm"}, "width 0.02 m is below diameter = 0.03 m"),
        ("heave_compensator", {"compensator.pressure": "15 bar"}, "is not above precharge = 2e+06 Pa"),
        ("winder", {"taper.shape": "linear"}, "shape is linear without full_radius"),
        ("winder", {"taper.full_radius": "40 mm"}, "full_radius 0.04 m is not above core_radius = 0.05 m"),
    ],
)
def test_rolls_that_cannot_be_are_refused(name, set_to, says):
    with pytest.raises(ModelError, match=re.escape(says)):
        fairlead.load(SCENES / f"{name}.yaml", set=set_to).check()


USED_UP = """
    components:
      roll: {type: Unwinder, radius: 60 mm, core_radius: 50 mm, width: 0.5 m, thickness: 1 mm, density: 800 kg/m^3,
             moment: 0.2 kg*m^2, speed: 20 rad/s}
      brake: {type: TorqueSource, torque: -6 N*m}
      web: {type: WebSpan, length: 1 m, stiffness: 100 kN, tension: 100 N}
      nip: {type: SpeedSource, speed: 20 rad/s}
      rim: {type: Rack, radius: 60 mm}
    connections:
      - [roll.shaft, brake.shaft]
      - [roll.rim, web.a]
      - [web.b, rim.rack]
      - [nip.shaft, rim.pinion]
      - [roll.left, web.left]
      - [roll.held, web.before]
    run: {stop: 4 s, accuracy: 1e-6}
    record: {every: 10 ms, signals: [web.tension, roll.left]}
"""


@pytest.mark.slow
def test_the_end_of_a_web_comes_off_when_its_roll_is_used_up(simulate):
    """pi (0.06^2 - 0.05^2)/1 mm = 3.456 m at 1.2 m/s, less the stretch of a thousandth."""
    result = simulate(USED_UP)
    assert switched(result, "web", "torn") == pytest.approx(np.pi * 1.1e-3 / 1e-3 / 1.2, rel=2e-3)
    assert result.at("web.tension", 2.8) > 90
    assert result["web.tension"][-1] == 0


DRUM = """
    components:
      drum: {type: StorageDrum, radius: 0.32 m, core_radius: 0.3 m, width: 1 m, diameter: 30 mm, mass: 3 kg/m,
             nested: no, moment: 60 kg*m^2}
      motor: {type: SpeedSource, speed: 5 rad/s}
      end: {type: Mass, mass: 1 kg, position: 0 m}
    connections: [[drum.shaft, motor.shaft], [drum.rim, end.flange]]
    run: {stop: 100 s, accuracy: 1e-6}
"""


def test_a_run_ends_where_no_rope_is_left_on_a_drum(scene):
    """The angle until then is (R - core) 2 pi width/diameter^2; the rope pi (R^2 - core^2) width/diameter^2."""
    result = scene(DRUM).run(out=None, check=False)
    assert not result.ok
    assert "drum is used up" in result.run["sentence"]
    assert result.t[-1] == pytest.approx(0.02 * 2 * np.pi / 0.03**2 / 5, rel=1e-6)
    assert result["drum.radius"][-1] == pytest.approx(0.3, rel=1e-6)
    assert result["drum.left"][-1] == pytest.approx(0.0, abs=1e-4)
    assert result["end.x"][-1] == pytest.approx(np.pi * (0.32**2 - 0.3**2) / 0.03**2, rel=1e-6)


@pytest.mark.parametrize("layers", ["on", "off"])
def test_a_run_ends_where_a_roll_is_used_up_whether_or_not_its_radius_follows(scene, layers):
    text = (SCENES / "unwinder.yaml").read_text(encoding="utf-8").split("name: unwinder\n")[1]
    text = text.replace("stop: 18 s", "stop: 200 s").replace("every: 10 ms, ", "") + f"effects: {{layers: {layers}}}\n"
    result = scene(text).run(out=None, check=False)
    assert not result.ok
    assert "roll is used up" in result.run["sentence"]
    assert result["roll.left"][-1] == pytest.approx(0.0, abs=1e-3)
    if layers == "on":
        assert result["roll.radius"][-1] == pytest.approx(0.05, rel=1e-4)


def test_what_is_left_of_a_roll_turns_on_until_its_radius_is_zero(scene):
    """A span that listens to `left` has let its end come off; the motor turns what is left of the roll on."""
    text = USED_UP.replace("run: {stop: 4 s, accuracy: 1e-6}", "run: {stop: 100 s, accuracy: 1e-5}")
    text = text.replace("signals: [web.tension,", "signals: [roll.radius,")
    result = scene(text.replace("torque: -6 N*m", "torque: 1 N*m")).run(out=None, check=False)
    assert "roll is used up" in result.run["sentence"]
    assert switched(result, "web", "gone") < result.t[-1]
    assert result["roll.radius"][-1] == pytest.approx(0.0, abs=1e-4)


WOUND = """
    components:
      roll: {type: Winder, radius: 50 mm, core_radius: 50 mm, width: 0.5 m, thickness: 1 mm, density: 800 kg/m^3,
             moment: 0.2 kg*m^2, speed: 1 rad/s}
      pull: {type: TorqueSource, torque: -0.1 N*m}
    connections: [[roll.shaft, pull.shaft]]
    run: {stop: 100 s, accuracy: 1e-6}
"""


def test_an_empty_core_may_go_back_by_a_turn(scene):
    """It comes to rest, and turns back past where it began."""
    result = scene(WOUND).run(out=None, check=False)
    assert "roll is used up" in result.run["sentence"]
    assert result["roll.radius"][-1] == pytest.approx(0.049, rel=1e-5)


SHEAVE = """
    components:
      drum: {type: SpeedSource, speed: 1 rad/s}
      rack: {type: Rack, radius: 0.1 m}
      sheave: {type: MovingSheave, length: 3 m, stiffness: 50 kN, tension: 100 N, radius: 0.1 m, moment: 0.05 kg*m^2,
               mu: 0.1, effects: {traction: on} MORE}
      place: {type: Mass, mass: 10 kg}
      pull: {type: ForceSource, force: 200 N}
      end: {type: Ground}
    connections:
      - [drum.shaft, rack.pinion]
      - [rack.rack, sheave.a]
      - [sheave.b, end.flange]
      - [sheave.place, place.flange, pull.flange]
    run: {stop: 2 s}
"""


def test_a_damped_rope_that_slips_on_a_moving_sheave_needs_its_mass_there(scene):
    with pytest.raises(fairlead.ModelError, match="Give rope_mass"):
        scene(SHEAVE.replace("MORE", ", damping: 500 N*s")).check()


def test_with_it_the_ratio_of_tensions_stays_within_eulers(simulate):
    """As the rope slips over the sheave, the ratio is that of Euler's formula but for its mass and what swings."""
    result = simulate(SHEAVE.replace("MORE", ", damping: 500 N*s, rope_mass: 0.2 kg"))
    taut = (result["sheave.tension_in"] > 10) & (result["sheave.tension_out"] > 10)
    ratio = np.abs(np.log(result["sheave.tension_in"][taut] / result["sheave.tension_out"][taut]))
    assert taut.any()
    assert ratio.max() < 0.1 * np.pi + 0.02
    assert result.run["energy"]["closure"] < 1e-3


HAULED_IN = """
    components:
      v: {type: MotionSource, velocity: {ramp: {to: -1 m/s, over: 0.1 s}}}
      tail: {type: RopeTail, length: 3 m, stiffness: 100 kN, tension: 100 N, damping: 500 N*s}
      m: {type: Mass, mass: 10 kg}
      pull: {type: ForceSource, force: 100 N}
    connections: [[v.flange, tail.a], [tail.b, m.flange, pull.flange]]
    run: {stop: 8 s}
    record: {every: 10 ms}
"""
TAKEN_IN = """
    components:
      v1: {type: MotionSource, velocity: {table: [[0 s, 1], [1 s, 1], [1.5 s, 0]]}}
      v2: {type: MotionSource, velocity: 1 m/s}
      acc: {type: WebAccumulator, length: 4 m, strands: 4, stiffness: 1 MN, tension: 200 N, damping: 500 N*s}
      car: {type: Mass, mass: 50 kg, position: 0, velocity: 0}
      pull: {type: ForceSource, force: 800 N}
      dmp: {type: Damper, damping: 500 N*s/m}
      g: {type: Ground}
      eps: {type: SignalSource, value: 2e-4}
    connections:
      - [v1.flange, acc.a]
      - [acc.b, v2.flange]
      - [acc.carriage, car.flange, pull.flange, dmp.b]
      - [dmp.a, g.flange]
      - [eps.signal, acc.before, acc.after]
    run: {stop: 8 s}
    record: {every: 10 ms}
"""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize(
    ("text", "name", "when"),
    [(HAULED_IN, "tail", 0.05 + 2.997), (TAKEN_IN, "acc", 1.25 + 3.996)],  # 0.1 % of 3 m and 4 m are left, at 1 m/s
    ids=["tail", "accumulator"],
)
def test_a_run_ends_where_no_free_length_is_left(scene, engine, text, name, when):
    """It went on with a negative length, or bounced at a rope without one, and nothing said so."""
    result = scene(text, **{"run.engine": engine}).run(out=None, check=False)
    assert f"{name} is used up" in result.run["sentence"]
    assert result.t[-1] == pytest.approx(when, abs=0.03)
    assert (result[f"{name}.free"][:-1] > 0).all()
