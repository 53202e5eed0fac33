"""Relations of positions that are kept: cranks, cams and rods, against the same machine in one coordinate."""

import itertools
import math

import numpy as np
import pytest

from fairlead.component.registry import known_types
from fairlead.describe.page import describe
from fairlead.errors import ModelError, UsageError
from fairlead.system.compiled.named_parts import kept_positions
from tests.reference.crank import Follower, crank

WEIGHT = 1e-2  # of a position, in accuracies (system/numbering/tolerances.py)
RADIUS, ROD, MOMENT, MASS = 0.05, 0.2, 0.02, 1.5
FREE = """
    components:
      wheel: {type: Inertia, moment: 0.02 kg*m^2, angle: 0.3 rad, speed: 10 rad/s}
      crank: {type: Crank, radius: 50 mm, rod: 200 mm}
      piston: {type: Mass, mass: 1.5 kg}
    connections:
      - [wheel.shaft, crank.shaft]
      - [crank.slider, piston.flange]
    run: {stop: 13 s, accuracy: 1e-6}
    record: {signals: ["*"], every: 10 ms}
    """
RUBS = """
    components:
      wheel: {type: Inertia, moment: 0.02 kg*m^2, angle: ANGLE rad, speed: SPEED rad/s}
      drive: {type: TorqueSource, torque: TORQUE}
      crank: {type: Crank, radius: 50 mm, rod: 200 mm}
      piston: {type: Mass, mass: 1.5 kg}
      wall: {type: Ground}
      pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}}
    connections:
      - [wheel.shaft, crank.shaft, drive.shaft]
      - [crank.slider, piston.flange, pad.b]
      - [wall.flange, pad.a]
    run: {stop: STOP s, accuracy: 1e-7}
    record: {signals: ["*"], every: 5 ms}
    """


def rubs(angle, speed, torque="0 N*m", stop=2):
    said = {"ANGLE": angle, "SPEED": speed, "TORQUE": torque, "STOP": stop}
    text = RUBS
    for name, value in said.items():
        text = text.replace(name, str(value))
    return text


def keeps(result, machine, accuracy, revolutions):
    """The relation is kept below its weight, energy within ten accuracies, both dead centres are passed every time."""
    angle, speed = result["wheel.angle"], result["wheel.speed"]
    energy = machine.energy(angle, speed)
    assert abs(result["crank.gap"]).max() < WEIGHT * accuracy
    assert result.run["projected"]["steps"] >= result.run["steps"] - 1
    assert 0 < result.run["projected"]["most"] < 1
    assert abs(energy / energy[0] - 1).max() < 10 * accuracy
    assert result.run["energy"]["closure"] < 10 * accuracy
    assert angle[-1] - angle[0] > revolutions * 2 * math.pi


@pytest.mark.slow
def test_a_free_crank_turns_as_its_one_coordinate_says(simulate) -> None:
    result, machine = simulate(FREE), Follower(crank(RADIUS, ROD), MOMENT, MASS)
    expected = machine.at(result.t, 0.3, 10.0)
    keeps(result, machine, 1e-6, 20)
    assert abs(result["wheel.angle"] - expected[:, 0]).max() < 1e-5  # an angle of 126 rad
    x, first, second = machine.path(expected[:, 0])
    assert abs(result["piston.x"] - x).max() < 1e-6
    acceleration = second * expected[:, 1] ** 2 + first * [machine.rates(0, row, 0)[1] for row in expected]
    assert abs(result["crank.force"] - MASS * acceleration).max() < 1e-4  # of 15 N


@pytest.mark.slow
@pytest.mark.parametrize("accuracy", [1e-4, 1e-6])
def test_a_thousand_revolutions_of_a_crank(simulate, accuracy) -> None:
    result = simulate(FREE, **{"run.stop": "650 s", "run.accuracy": accuracy, "record.every": "50 ms"})
    keeps(result, Follower(crank(RADIUS, ROD), MOMENT, MASS), accuracy, 1000)


@pytest.mark.parametrize("offset", [0.0, 0.03])
def test_a_driven_crank_needs_the_force_of_its_closed_form(simulate, offset) -> None:
    result = simulate(f"""
    components:
      drive: {{type: MotionSource, velocity: 1 m/s, origin: 0 m}}
      rim: {{type: Rack, radius: 0.1 m}}
      crank: {{type: Crank, radius: 50 mm, rod: 200 mm, offset: {offset} m, centre: 1 m}}
      piston: {{type: Mass, mass: 1.5 kg}}
    connections: [[drive.flange, rim.rack], [rim.pinion, crank.shaft], [crank.slider, piston.flange]]
    run: {{stop: 2 s, accuracy: 1e-7}}
    record: {{signals: ["*"]}}
    """)
    x, first, second = crank(RADIUS, ROD, offset)(10 * result.t)
    assert abs(result["piston.x"] - 1 - x).max() < 1e-8
    assert abs(result["piston.v"] - 10 * first).max() < 1e-7
    assert result["crank.force"] == pytest.approx(MASS * 100 * second, abs=1e-5)
    assert result["drive.force"] == pytest.approx(MASS * 100 * second * first / 0.1, abs=1e-5)
    # the shaft gives the moment about it of the rod's force on the slider, which is thrust across and force along
    moment = x * result["crank.thrust"] - offset * result["crank.force"]
    assert moment == pytest.approx(MASS * 100 * second * first, abs=1e-5)


def test_a_guide_rubs_with_the_thrust_of_the_rod_that_leans(simulate) -> None:
    """Friction mu |thrust| is part of the force whose thrust it is, in a loop:  F (1 - mu |tan| sign(v F)) = m a."""
    result = simulate("""
    components:
      drive: {type: SpeedSource, speed: 10 rad/s}
      crank: {type: Crank, radius: 50 mm, rod: 200 mm}
      piston: {type: Mass, mass: 1.5 kg}
      wall: {type: Ground}
      size: {type: SignalSize}
      guide: {type: Contact, curve: 0.2}
    connections:
      - [drive.shaft, crank.shaft]
      - [crank.slider, piston.flange, guide.b]
      - [wall.flange, guide.a]
      - [crank.thrust, size.value]
      - [size.signal, guide.normal]
    run: {stop: 0.28 s, accuracy: 1e-6}
    record: {signals: ["*"]}
    """)
    moving = (result.t > 0.02) & (result.t < 0.28)
    _, first, second = crank(RADIUS, ROD, 0.0)(10 * result.t[moving])
    across = RADIUS * np.sin(10 * result.t[moving])
    inertial, leans = MASS * 100 * second, np.abs(across / np.sqrt(ROD**2 - across**2))
    force = inertial / (1 - 0.2 * leans * np.sign(first * inertial))
    assert result["crank.force"][moving] == pytest.approx(force, abs=2e-3)
    assert result["guide.friction"][moving] == pytest.approx(0.2 * leans * np.abs(force) * np.sign(first), abs=1e-3)


def test_a_crank_with_friction_at_its_slider_sticks_and_breaks_away(simulate) -> None:
    """The torque swings about nothing: the shaft comes to rest, sticks, and breaks away the other way."""
    torque = "{sine: {amplitude: 0.6 N*m, frequency: 0.8 Hz}}"
    result = simulate(rubs(1.2, 0, torque, 4))
    machine = Follower(crank(RADIUS, ROD), MOMENT, MASS, lambda t: 0.6 * math.sin(2 * math.pi * 0.8 * t),
                       stiction=5.0, coulomb=3.0)  # fmt: skip
    expected = machine.at(result.t, 1.2, 0.0)
    held = [event.t for event in result.events if event.component == "pad" and event.zone_to == "held"]
    assert len(held) >= 4
    assert abs(result["wheel.angle"] - expected[:, 0]).max() < 1e-5
    assert abs(result["wheel.speed"] - expected[:, 1]).max() < 1e-4


def test_friction_turns_round_in_the_dead_centres(simulate) -> None:
    """The slider stops for an instant and is not held: the crank takes it on, as often as its energy lasts."""
    result = simulate(rubs(0.3, 10, stop=5))
    machine = Follower(crank(RADIUS, ROD), MOMENT, MASS, stiction=5.0, coulomb=3.0)
    expected = machine.at(result.t, 0.3, 10.0)
    assert abs(result["wheel.angle"] - expected[:, 0]).max() < 1e-5
    assert result["wheel.speed"][-1] == pytest.approx(0.0, abs=1e-9)
    assert result.run["energy"]["closure"] < 1e-6


def test_a_crank_at_rest_in_its_dead_centre_breaks_away(simulate) -> None:
    """There the slider is held twice: by the crank and by friction. The torque turns the shaft all the same."""
    result = simulate(rubs(0, 0, "{ramp: {to: 2 N*m, over: 1 s}}", 1))
    machine = Follower(crank(RADIUS, ROD), MOMENT, MASS, lambda t: 2 * t, stiction=5.0, coulomb=3.0)
    start = result.t >= 0.05
    expected = machine.at(result.t[start], result["wheel.angle"][start][0], result["wheel.speed"][start][0])
    assert abs(result["wheel.angle"][start] - expected[:, 0]).max() < 1e-5
    assert result["wheel.angle"][start][0] == pytest.approx(100 * 0.05**3 / 6, rel=0.01)  # friction has no lever yet


def test_a_driven_crank_rubs_through_its_dead_centres(simulate) -> None:
    result = simulate("""
    components:
      drive: {type: MotionSource, velocity: 1 m/s, origin: 0 m}
      rim: {type: Rack, radius: 0.1 m}
      crank: {type: Crank, radius: 50 mm, rod: 200 mm}
      piston: {type: Mass, mass: 1.5 kg}
      wall: {type: Ground}
      pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}}
    connections:
      - [drive.flange, rim.rack]
      - [rim.pinion, crank.shaft]
      - [crank.slider, piston.flange, pad.b]
      - [wall.flange, pad.a]
    run: {stop: 2 s, accuracy: 1e-7}
    record: {signals: ["*"], every: 5 ms}
    """)
    _, first, second = crank(RADIUS, ROD)(10 * result.t)
    slides = abs(first) > 1e-6
    force = MASS * 100 * second + 3 * np.sign(first)
    assert abs(result["crank.force"] - force)[slides].max() < 1e-4
    assert len([event for event in result.events if event.zone_to == "held"]) == 6


@pytest.mark.parametrize("seed", [0, 1, 3, *(pytest.param(k, marks=pytest.mark.slow) for k in range(4, 30))])
def test_cranks_at_random_stick_and_slip_as_their_one_coordinate_says(simulate, seed) -> None:
    """The error is that of the accuracy, but for what the machine itself makes of a start that is off by that much."""
    rng, accuracy = np.random.default_rng(seed), 1e-6
    radius, angle, speed = rng.uniform(0.01, 0.09), rng.uniform(-3, 3), rng.uniform(-20, 20) * rng.integers(2)
    rod, offset = radius * rng.uniform(1.2, 6), radius * rng.uniform(-0.15, 0.15)
    moment, mass, normal = 10 ** rng.uniform(-3, 0), 10 ** rng.uniform(-1, 1), 10 ** rng.uniform(-1, 1.5)
    stiction, torque, pace = rng.uniform(0.3, 0.8), 10 ** rng.uniform(-1, 1), rng.uniform(0.2, 3)
    coulomb = stiction * rng.uniform(0.1, 1)
    text = rubs(angle, speed, f"{{sine: {{amplitude: {torque} N*m, frequency: {pace} Hz}}}}", 2)
    text = text.replace("0.02 kg", f"{moment} kg").replace("50 mm", f"{radius} m").replace("1.5 kg", f"{mass} kg")
    text = text.replace("rod: 200 mm", f"rod: {rod} m, offset: {offset} m").replace("force: 10 N", f"force: {normal} N")
    text = text.replace("stiction: 0.5, coulomb: 0.3", f"stiction: {stiction}, coulomb: {coulomb}")
    result = simulate(text, **{"run.accuracy": accuracy, "record.every": "20 ms"})
    machine = Follower(crank(radius, rod, offset), moment, mass, lambda t: torque * math.sin(2 * math.pi * pace * t),
                       stiction=stiction * normal, coulomb=coulomb * normal)  # fmt: skip
    expected, beside = (machine.at(result.t, start, speed)[:, 0] for start in (angle, angle + accuracy))
    off = abs(result["wheel.angle"] - expected).max()
    assert off < 30 * (accuracy + abs(beside - expected).max())


def engine(cylinders):
    """Pistons on one wheel, every other one by a gear: many are in their dead centres at one instant."""
    parts = ["wheel: {type: Inertia, moment: 0.02 kg*m^2, angle: 0.3 rad, speed: 30 rad/s}", "wall: {type: Ground}"]
    joins = []
    for i in range(cylinders):
        parts += [f"crank{i}: {{type: Crank, radius: 50 mm, rod: 200 mm}}", f"piston{i}: {{type: Mass, mass: 1.5 kg}}",
                  f"gear{i}: {{type: Gear, ratio: {(1, -2)[i % 2]}}}",
                  f"pad{i}: {{type: Contact, normal_force: {2 + i} N, curve: {{curve: coulomb, stiction: 0.5, coulomb: 0.3}}}}"]  # fmt: skip  # noqa: E501
        joins += [f"[gear{i}.b, crank{i}.shaft]", f"[crank{i}.slider, piston{i}.flange, pad{i}.b]"]
    joins.append(f"[wheel.shaft, {', '.join(f'gear{i}.a' for i in range(cylinders))}]")
    joins.append(f"[wall.flange, {', '.join(f'pad{i}.a' for i in range(cylinders))}]")
    lines = ["components:", *(f"  {p}" for p in parts), "connections:", *(f"  - {j}" for j in joins)]
    return "\n".join([*lines, "run: {stop: 3 s}", 'record: {signals: ["*"], every: 10 ms}']) + "\n"


@pytest.mark.parametrize("cylinders", [3, 6])
def test_pistons_that_pass_their_dead_centres_together(simulate, cylinders) -> None:
    """Many unknowns, and several contacts that turn round at one instant; at a hundredth of the error they go alike."""
    one, fine = (simulate(engine(cylinders), **{"run.accuracy": accuracy}) for accuracy in (1e-6, 1e-8))
    assert abs(one["wheel.angle"] - fine["wheel.angle"]).max() < 1e-5
    assert len(one.events) == len(fine.events) > 100
    assert one.run["energy"]["closure"] < 1e-6
    assert max(abs(one[f"crank{i}.gap"]).max() for i in range(cylinders)) < WEIGHT * 1e-6


CAM = '''
class Cam(Component):
    """A follower on a smooth cam with a dwell at neither end."""

    shaft, follower = Rotational(), Translational()
    lift = Parameter("m", above=0)
    push = Unknown("N")
    force, gap = Output("N"), Output("m")

    def law(p, shaft, follower, push):
        gap = follower.x - p.lift * (1 - cos(shaft.angle) + sin(2 * shaft.angle) / 4)
        return Law(push=hold_position(gap), force=push, gap=gap)
'''


def test_a_cam_of_a_user(simulate, library) -> None:
    result = simulate("""
    components:
      wheel: {type: Inertia, moment: 0.02 kg*m^2, angle: 0.3 rad, speed: 10 rad/s}
      cam: {type: Cam, lift: 20 mm}
      valve: {type: Mass, mass: 0.5 kg}
      spring: {type: Spring, stiffness: 2 kN/m}
      head: {type: Ground}
    connections: [[wheel.shaft, cam.shaft], [cam.follower, valve.flange, spring.b], [spring.a, head.flange]]
    run: {stop: 2 s, accuracy: 1e-6}
    record: {signals: ["*"], every: 10 ms}
    """, (library(CAM),))  # fmt: skip

    def path(a):
        x = 1 - np.cos(a) + np.sin(2 * a) / 4
        return 0.02 * x, 0.02 * (np.sin(a) + np.cos(2 * a) / 2), 0.02 * (np.cos(a) - np.sin(2 * a))

    expected = Follower(path, 0.02, 0.5, force=lambda x: -2000 * x).at(result.t, 0.3, 10.0)
    assert abs(result["wheel.angle"] - expected[:, 0]).max() < 1e-5
    assert abs(result["cam.gap"]).max() < 1e-8


RODS = '''
class Rod(Component):
    """Keeps the distance of two points of a plane, each of which has two ports."""

    x1, y1, x2, y2 = Translational(), Translational(), Translational(), Translational()
    length = Parameter("m", above=0)
    pull = Unknown("N")
    tension = Output("N")

    def law(p, x1, y1, x2, y2, pull):
        return Law(pull=hold_position(sqrt((x1.x - x2.x) ** 2 + (y1.x - y2.x) ** 2) - p.length), tension=-pull)
'''


def hung(n):
    """Balls of 1 kg on rods of 1 m, one on the other, all on one line at the start."""
    parts = ["top: {type: Ground}"]
    joins = ["[top.flange, rod1.x1, rod1.y1]"]
    for i in range(1, n + 1):
        parts += [f"{axis}{i}: {{type: Mass, mass: 1 kg, position: {i if axis == 'x' else 0} m}}" for axis in "xy"]
        parts += [f"rod{i}: {{type: Rod, length: 1 m}}", f"weight{i}: {{type: ForceSource, force: -9.81 N}}"]
        after = (f", rod{i + 1}.x1", f", rod{i + 1}.y1") if i < n else ("", "")
        joins += [f"[x{i}.flange, rod{i}.x2{after[0]}]", f"[y{i}.flange, rod{i}.y2, weight{i}.flange{after[1]}]"]
    lines = ["components:", *(f"  {p}" for p in parts), "connections:", *(f"  - {j}" for j in joins)]
    return "\n".join([*lines, "run: {stop: 5 s, accuracy: 1e-6}", 'record: {signals: ["*"], every: 50 ms}']) + "\n"


@pytest.mark.slow
def test_a_pendulum_of_two_coordinates_swings_as_one(simulate, library) -> None:
    from scipy.integrate import solve_ivp

    result = simulate(hung(1), (library(RODS),))
    angle = solve_ivp(lambda t, y: [y[1], -9.81 * math.cos(y[0])], (0, 5), [0, 0], method="DOP853", rtol=1e-12,
                      atol=1e-13, t_eval=result.t)  # fmt: skip
    assert abs(result["x1.x"] - np.cos(angle.y[0])).max() < 1e-5
    assert result["rod1.tension"] == pytest.approx(angle.y[1] ** 2 - 9.81 * np.sin(angle.y[0]), abs=1e-4)


def test_rods_in_a_chain_keep_their_lengths_and_their_energy(simulate, library) -> None:
    """Many unknowns go by the sparse factors."""
    result = simulate(hung(6), (library(RODS),), **{"run.stop": "2 s"})
    points = [(np.zeros(len(result.t)),) * 2] + [(result[f"x{i}.x"], result[f"y{i}.x"]) for i in range(1, 7)]
    lengths = [np.hypot(b[0] - a[0], b[1] - a[1]) for a, b in itertools.pairwise(points)]
    assert max(abs(length - 1).max() for length in lengths) < 1e-7
    assert result.run["energy"]["closure"] < 1e-5
    assert result.run["counters"]["replans"] == 0


def test_an_impact_goes_through_the_crank(simulate) -> None:
    """One coordinate: the shaft goes back at e times its speed, and (1 - e^2) of all energy is lost."""
    result = simulate("""
    components:
      wheel: {type: Inertia, moment: 0.02 kg*m^2, angle: 2 rad, speed: -5 rad/s}
      crank: {type: Crank, radius: 50 mm, rod: 200 mm}
      piston: {type: Mass, mass: 1.5 kg}
      stop: {type: RigidStop, length: -0.23 m, restitution: 0.7}
      wall: {type: Ground}
    connections: [[wheel.shaft, crank.shaft], [crank.slider, piston.flange, stop.a], [wall.flange, stop.b]]
    run: {stop: 1 s, accuracy: 1e-7}
    record: {signals: ["*"]}
    """)
    before = Follower(crank(RADIUS, ROD), MOMENT, MASS).energy(2.0, -5.0)
    assert result.run["lost"]["stop"] == pytest.approx((1 - 0.7**2) * before, rel=1e-6)
    k = np.flatnonzero(np.diff(np.sign(result["wheel.speed"])))[0]
    assert result["wheel.speed"][k + 1] == pytest.approx(-0.7 * result["wheel.speed"][k], rel=1e-6)


@pytest.mark.parametrize(("length", "mass", "accuracy"), [(1e-2, 1e-3, 1e-7), (20.0, 1e3, 1e-6)])
def test_a_small_and_a_heavy_machine_turn_alike(simulate, length, mass, accuracy) -> None:
    """Lengths and masses scaled, times as they are; angles have the same weights, positions by their size."""
    text = rubs(0.3, 10, stop=2).replace("0.02 kg", f"{0.02 * mass * length**2} kg")
    text = text.replace("50 mm", f"{50 * length} mm")
    text = text.replace("200 mm", f"{200 * length} mm").replace("1.5 kg", f"{1.5 * mass} kg")
    result = simulate(text.replace("10 N", f"{10 * mass * length} N"), **{"run.accuracy": accuracy})
    expected = Follower(crank(RADIUS, ROD), MOMENT, MASS, stiction=5.0, coulomb=3.0).at(result.t, 0.3, 10.0)
    assert abs(result["wheel.angle"] - expected[:, 0]).max() < 1e-4
    assert abs(result["crank.gap"]).max() < WEIGHT * accuracy


def test_names_and_order_say_nothing(simulate) -> None:
    lines = FREE.replace("wheel", "zz").replace("piston", "aa").splitlines()
    other = simulate("\n".join([*lines[:2], lines[4], lines[3], lines[2], *lines[5:]]), **{"run.stop": "2 s"})
    one = simulate(FREE, **{"run.stop": "2 s"})
    assert other["zz.angle"] == pytest.approx(one["wheel.angle"], abs=1e-8)


def test_rodas_alone_takes_relations_of_positions(scene) -> None:
    for engine in ("stepping", "ida"):
        with pytest.raises(UsageError, match=f"run.engine: {engine} does not bring positions back .* crank .* rodas"):
            scene(FREE, **{"run.engine": engine}).run(out=None)
    result = scene(FREE, **{"run.stop": "0.1 s"}).run(out=None)
    assert result.run["engine_reason"] == "auto: it keeps relations of positions"


@pytest.mark.parametrize(
    ("wheel", "piston", "became"),
    [
        ("angle: 1 rad, speed: 3 rad/s", "", (1.0, 3.0)),
        ("", "position: 0.2 m, velocity: -0.1 m/s", None),
        ("angle: 1 rad", "velocity: -0.1 m/s", None),
        ("", "", (0.0, 0.0)),
    ],
)
def test_what_nobody_gave_follows_at_the_start(scene, wheel, piston, became) -> None:
    text = FREE.replace("angle: 0.3 rad, speed: 10 rad/s", wheel).replace("mass: 1.5 kg", f"mass: 1.5 kg, {piston}")
    system = scene(text.replace(", }", "}")).system
    y = dict(zip(system.unknown_names, system.initial, strict=True))
    x, first, _ = crank(RADIUS, ROD)(y["wheel.angle"])
    assert y["piston.x"] == pytest.approx(x, abs=1e-12)
    assert y["piston.v"] == pytest.approx(first * y["wheel.speed"], abs=1e-12)
    assert became is None or (y["wheel.angle"], y["wheel.speed"]) == pytest.approx(became)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("mass: 1.5 kg", "mass: 1.5 kg, position: 0.2 m", "relation of positions, but they start 0.0472 off it"),
        ("mass: 1.5 kg", "mass: 1.5 kg, velocity: 1 m/s", "(wheel) at 10 rad/s and crank.slider (piston) at 1 m/s"),
        ("{type: Mass, mass: 1.5 kg}", "{type: Ground}", "crank.slider prescribed by piston"),
        ("{type: Mass, mass: 1.5 kg}", "{type: Spring, stiffness: 1 N/m}", "position of its slider, which has no mass"),
        ("rod: 200 mm", "rod: 40 mm", "rod 0.04 m is not above radius + |offset| = 0.05 m"),
    ],
)  # fmt: skip
def test_what_cannot_be_kept_is_told(scene, old, new, says) -> None:
    text = FREE.replace(old, new)
    if "Spring" in new:
        text = text.replace("piston.flange]", "piston.a]\n      - [piston.b, wall.flange]").replace(
            "    connections", "      wall: {type: Ground}\n    connections"
        )
    with pytest.raises(ModelError) as caught:
        scene(text).check()
    assert says in str(caught.value)


def test_relations_that_say_the_same_are_told(scene) -> None:
    text = FREE.replace("piston: {", "twin: {type: Crank, radius: 50 mm, rod: 200 mm}\n      piston: {")
    text = text.replace("crank.shaft]", "crank.shaft, twin.shaft]")
    text = text.replace("[crank.slider", "[twin.slider, crank.slider")
    with pytest.raises(ModelError, match="crank and twin keep relations of positions that are not independent"):
        scene(text).check()


def test_another_value_moves_the_start(scene) -> None:
    model = scene(FREE)
    assert kept_positions(model.system) == ["crank"]
    longer = model.with_values(**{"crank.rod": "300 mm"})
    assert not longer.rebuilt
    y = dict(zip(longer.system.unknown_names, longer.system.initial, strict=True))
    assert y["piston.x"] == pytest.approx(crank(RADIUS, 0.3)(0.3)[0], abs=1e-12)


KEPT = '''
class Mine(Component):
    """A part."""

    a, b = Translational(), Translational()
    arm = Parameter("m", default=0.2)
    shape = Table("m", "m", default=((0, 1), (1, 2)))
    signal = Input("m", default=1.0)
    own = State("m")
    f = Unknown("N")
    zones = Zones("near", "far")

    @zone("near")
    def one(p, a, b, f, t, signal, own):
        return Law(own=0, f=hold_position(GAP))

    @zone("far")
    def other(p, a, b, f, t, signal, own):
        return Law(own=0, TERMS)

    leaves = guard("near", to="far", unit="m")(lambda p, a, b: a.x - 9)
'''


@pytest.mark.parametrize(
    ("gap", "terms", "says"),
    [
        ("b.x - p.shape(a.x)", "f=hold_position(GAP)", "varies with the table 'shape'"),
        ("b.x - a.x - sin(t)", "f=hold_position(GAP)", "varies with time"),
        ("b.x - a.x - signal", "f=hold_position(GAP)", "varies with the signal 'signal'"),
        ("b.x - a.x - own", "f=hold_position(GAP)", "varies with 'own'"),
        ("b.v - p.arm*a.v", "f=hold_position(GAP)", "write hold(slip) for a sum of speeds"),
        ("p.arm", "f=hold_position(GAP)", "wants positions of ports"),
        ("b.x - a.x**2", "a=0, b=0, f=f", "What holds a relation of positions holds it always"),
        ("b.x - a.x**2", "f=hold_position(b.x - a.x)", "is not the same in zone 'far' as in 'near'"),
        ("b.x - a.x**2", "a=f, b=0, f=hold_position(GAP)", "which hold_position puts on its ports itself"),
        ("b.x - p.arm", "f=hold_position(GAP)", "the law leaves out ['a']"),
        ("abs(b.x) - a.x", "f=hold_position(GAP)", "is not smooth"),
    ],
)
def test_a_relation_that_cannot_be_kept_is_refused_at_its_law(scene, library, gap, terms, says) -> None:
    text = library(KEPT.replace("TERMS", terms).replace("GAP", gap))
    with pytest.raises(ModelError) as caught:
        scene("""
        components:
          m: {type: Mass, mass: 1 kg}
          n: {type: Mass, mass: 1 kg}
          mine: {type: Mine}
        connections: [[m.flange, mine.a], [n.flange, mine.b]]
        run: {stop: 1 s}
        """, (text,)).check()  # fmt: skip
    assert says in str(caught.value)
    assert "classes0.py:" in str(caught.value)


def test_its_page_says_what_is_kept() -> None:
    page = describe("Crank", known_types())
    assert "is kept at 0 by push" in page
    assert "slider.force = -push" in page
