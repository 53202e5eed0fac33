"""Forces of impacts that go through signals: a slide is rubbed by what the blow of a stop on a block presses.

    P = mass of the block * 2 m/s        slide: speed loses mu g P/m, where g is what the signals leave of the blow

What signals leave is the limit of a short stiff blow: nothing beyond a limiter, all beyond a dead zone. And what is
integrated of the force of a stop gets the impulse.
"""

from __future__ import annotations

from math import exp, sqrt

import pytest

ENGINES = pytest.mark.parametrize("engine", ["rodas", "ida"])
ACCURACIES = pytest.mark.parametrize("accuracy", [1e-3, 1e-6])
MASS, MU, SPEED, PUSH = 2.0, 0.3, 3.0, 10.0
NAMES = [
    {"slide": "slide", "block": "block", "stop": "stop", "pad": "pad", "s1": "s1", "s2": "s2", "s3": "s3"},
    {"slide": "a", "block": "z", "stop": "m", "pad": "b", "s1": "y", "s2": "x", "s3": "c"},
    {"slide": "z", "block": "c", "stop": "b", "pad": "y", "s1": "a", "s2": "m", "s3": "x"},
]  # that the order of names is none of the scene's

PRESSED = """
components:
  floor: {{type: Ground}}
  @slide: {{type: Mass, mass: {MASS} kg, position: 0 m, velocity: {SPEED} m/s}}
  @block: {{type: Mass, mass: {MASS} kg, position: 1 m, velocity: -2 m/s}}
  @stop: {{type: RigidStop}}
  @pad: {{type: Contact, curve: {curve}}}
{parts}
connections:
  - [floor.flange, @stop.a, @pad.a]
  - [@stop.b, @block.flange]
  - [@pad.b, @slide.flange]
{joined}
run: {{stop: {stop} s, engine: {engine}, accuracy: {accuracy}}}
"""


def pressed(parts="", joined="  - [@stop.force, @pad.normal]", curve=MU, stop=0.5001, names=NAMES[0], **given):
    """The scene with its names."""
    text = PRESSED.format(MASS=MASS, SPEED=SPEED, parts=parts, joined=joined, curve=curve, stop=stop, **given)
    for name, other in names.items():
        text = text.replace(f"@{name}", other)
    return text


ONE = "  - [@stop.force, @s1.{}]\n  - [@s1.signal, @pad.normal]"
TWO = "  - [@stop.force, @s1.s]\n  - [@s1.signal, @s2.value]\n  - [@s2.signal, @pad.normal]"
BLOW = MU * 2.0
SCENES = {
    "a limiter": ("  @s1: {type: Limiter, low: 0, high: 20}", ONE.format("value"), 0.0),
    "a wide limiter": ("  @s1: {type: Limiter, low: 0, high: 2e9}", ONE.format("value"), 0.0),
    "the lesser of two": ('  @s1: {type: SignalFunction, expression: "min(s, 20)"}', ONE.format("s"), 0.0),
    "a dead zone": ("  @s1: {type: DeadZone, band: 5}", ONE.format("value"), BLOW),
    "the greater of two": (
        "  @s1: {type: SignalSelect, pick: greatest}\n  @s2: {type: SignalSource, value: 1e-3}",
        "  - [@stop.force, @s1.a]\n  - [@s2.signal, @s1.b]\n  - [@s1.signal, @pad.normal]",
        BLOW + MU * 1e-3 * 0.5 / MASS,
    ),
    "a switch": (
        "  @s1: {type: SignalSwitch, level: 10}",
        "  - [@stop.force, @s1.a, @s1.control]\n  - [@s1.signal, @pad.normal]",
        BLOW,
    ),
    "the size of the opposite": (
        '  @s1: {type: SignalFunction, expression: "-s"}\n  @s2: {type: SignalSize}', TWO, BLOW,
    ),
    "a size that turns round": ('  @s1: {type: SignalFunction, expression: "abs(2 - s)"}', ONE.format("s"),
                                BLOW + MU * 2 * 0.5001 / MASS),
    "a relay": ("  @s1: {type: Relay, upper: 10, on: 20}", ONE.format("value"), 0.0),
    "a gate that lets it pass": (
        "  @s1: {type: LogicGate, gate: and, level: 10}\n  @s2: {type: SignalSwitch}",
        "  - [@stop.force, @s1.a, @s1.b, @s2.a]\n  - [@s1.signal, @s2.control]\n  - [@s2.signal, @pad.normal]",
        BLOW,
    ),
    "three in a row": (
        "  @s1: {type: DeadZone, band: 5}\n  @s2: {type: SignalSize}\n  @s3: {type: Limiter, low: -1, high: 1e6}",
        "  - [@stop.force, @s1.value]\n  - [@s1.signal, @s2.value]\n  - [@s2.signal, @s3.value]\n"
        "  - [@s3.signal, @pad.normal]",
        0.0,
    ),
}  # fmt: skip


@ENGINES
@ACCURACIES
@pytest.mark.parametrize("case", SCENES)
def test_a_signal_leaves_of_a_blow_what_it_leaves_of_any_large_force(simulate, engine, accuracy, case):
    """Beyond a limit nothing; in a dead zone, a switch or a size all."""
    parts, joined, lost = SCENES[case]
    result = simulate(pressed(parts, joined, engine=engine, accuracy=accuracy))
    assert result.at("slide.v", 0.5001) == pytest.approx(SPEED - lost, abs=2e-6)


@pytest.mark.parametrize("names", NAMES[1:], ids=["backwards", "mixed"])
@pytest.mark.parametrize("case", ["a limiter", "a dead zone", "a size that turns round", "three in a row"])
def test_names_do_not_decide_it(simulate, case, names):
    """The same numbers, whatever order parts are stored in."""
    parts, joined, lost = SCENES[case]
    result = simulate(pressed(parts, joined, names=names, engine="rodas", accuracy=1e-4))
    assert result.at(f"{names['slide']}.v", 0.5001) == pytest.approx(SPEED - lost, abs=2e-6)


@ENGINES
@ACCURACIES
def test_a_limiter_hears_again_what_follows_the_blow(simulate, engine, accuracy):
    """The block is pushed on with 10 N: after the blow, of which nothing passes, that presses."""
    parts = f"  @s1: {{type: Limiter, low: 0, high: 20}}\n  @s2: {{type: ForceSource, force: -{PUSH} N}}"
    joined = ONE.format("value") + "\n  - [@s2.flange, @block.flange]"
    result = simulate(pressed(parts, joined, stop=1, engine=engine, accuracy=accuracy))
    met = (sqrt(4 + 2 * PUSH / MASS) - 2) * MASS / PUSH
    assert result.at("slide.v", 1.0) == pytest.approx(SPEED - MU * PUSH * (1 - met) / MASS, rel=20 * accuracy)
    assert result.at("s1.signal", 1.0) == pytest.approx(PUSH, rel=1e-6)


@ENGINES
@ACCURACIES
def test_a_relay_is_tripped_by_a_blow(simulate, engine, accuracy):
    """It lets go again below a level of its own, to which the force after the blow does not fall."""
    parts = "  @s1: {type: Relay, upper: 10, lower: -1, on: 20}"
    result = simulate(pressed(parts, ONE.format("value"), stop=1, engine=engine, accuracy=accuracy))
    assert result.at("s1.signal", 1.0) == 20
    assert result.at("slide.v", 1.0) == pytest.approx(SPEED - MU * 20 * 0.5 / MASS, rel=20 * accuracy)


TABLES = {
    "falls at once": ("[[0 m/s, 1.4], [0.4 m/s, 1.4], [0.5 m/s, 0.2]]", 2.6),
    "is even from there on": ("[[0 m/s, 0.9], [0.1 m/s, 0.2], [2.0 m/s, 0.2], [9 m/s, 0.2]]", 2.6),
    "of many pieces": ("[[0 m/s, 1.4], [0.1 m/s, 1.3], [0.2 m/s, 1.2], [0.3 m/s, 1.1], [0.5 m/s, 0.2]]", 2.6),
}


@ENGINES
@ACCURACIES
@pytest.mark.parametrize("case", TABLES)
@pytest.mark.parametrize("sense", [1, -1], ids=["forward", "backward"])
def test_a_contact_pressed_by_a_blow_rubs_as_its_table_says_at_its_speed(simulate, engine, accuracy, case, sense):
    """It was off, and its table in no piece in particular."""
    points, after = TABLES[case]
    text = pressed(curve=f"{{curve: table, points: {points}}}", engine=engine, accuracy=accuracy)
    result = simulate(text.replace(f"velocity: {SPEED}", f"velocity: {sense * SPEED}"))
    assert result.at("slide.v", 0.5001) == pytest.approx(sense * after, abs=2e-6)


MET = """
components:
  floor: {{type: Ground}}
  block: {{type: Mass, mass: 2 kg, position: 1 m, velocity: -2 m/s}}
  stop: {{type: RigidStop, restitution: {restitution}}}
{parts}
connections:
  - [floor.flange, stop.a]
  - [stop.b, block.flange]
{joined}
run: {{stop: 0.6 s, engine: {engine}, accuracy: {accuracy}}}
"""
INTEGRATED = {
    "itself": ("  sum: {type: Integrator}", "  - [stop.force, sum.value]", 1.0),
    "twice": ("  sum: {type: Integrator, gain: 2}", "  - [stop.force, sum.value]", 2.0),
    "less what is due": ("  sum: {type: Integrator}\n  fn: {type: SignalFunction, expression: '3*s - 1'}",
                         "  - [stop.force, fn.s]\n  - [fn.signal, sum.value]", 3.0),
    "limited": ("  sum: {type: Integrator}\n  fn: {type: Limiter, low: 0, high: 20}",
                "  - [stop.force, fn.value]\n  - [fn.signal, sum.value]", 0.0),
}  # fmt: skip


@ENGINES
@ACCURACIES
@pytest.mark.parametrize("restitution", [0, 0.5, 1])
@pytest.mark.parametrize("case", INTEGRATED)
def test_the_integral_of_a_force_gets_its_impulse(simulate, engine, accuracy, restitution, case):
    """Of 2 kg at 2 m/s, and what is thrown back."""
    parts, joined, share = INTEGRATED[case]
    result = simulate(MET.format(
        restitution=restitution, parts=parts, joined=joined, engine=engine, accuracy=accuracy
    ))  # fmt: skip
    due = -0.6 if case == "less what is due" else 0.0
    assert result.at("sum.signal", 0.6) == pytest.approx(share * 4 * (1 + restitution) + due, abs=1e-5)
    assert result.at("block.v", 0.6) == pytest.approx(2 * restitution, abs=1e-6)


WORK = """
components:
  first: {{type: Mass, mass: 1 kg, position: 0 m, velocity: 2 m/s}}
  sensor: {{type: PowerSensor}}
  between: {{type: Mass, mass: {between} kg}}
  stop: {{type: RigidStop, restitution: {e}}}
  second: {{type: Mass, mass: 1 kg, position: 1 m, velocity: 0 m/s}}
  sum: {{type: Integrator}}
connections:
  - [first.flange, sensor.a]
  - [sensor.b, between.flange, stop.a]
  - [stop.b, second.flange]
  - [sensor.power, sum.value]
run: {{stop: 1 s, engine: {engine}, accuracy: {accuracy}}}
"""


@ENGINES
@ACCURACIES
@pytest.mark.parametrize("e", [0, 0.5])
def test_the_integral_of_a_power_gets_the_work_of_an_impact(simulate, engine, accuracy, e):
    """What the first body has lost."""
    between = 0.25
    result = simulate(WORK.format(e=e, between=between, engine=engine, accuracy=accuracy))
    after = 2 - (1 + e) * 2 * 1 / (2 + between)
    assert result.at("first.v", 1.0) == pytest.approx(after, rel=1e-6)
    assert result.at("sum.signal", 1.0) == pytest.approx((2**2 - after**2) / 2, abs=1e-5)


DOG = """
components:
  left: {{type: Inertia, moment: 1 kg*m^2, angle: 0 rad, speed: 0 rad/s}}
  right: {{type: Inertia, moment: 1 kg*m^2, angle: 0 rad, speed: 0.5 rad/s}}
  dog: {{type: DogClutch, synchronised: 1 rad/s}}
  lever: {{type: SignalSource, value: {{step: {{to: 1, at: 0.5 s}}}}}}
  sum: {{type: Integrator}}
connections:
  - [left.shaft, dog.a]
  - [dog.b, right.shaft]
  - [lever.signal, dog.engage]
  - [dog.torque, sum.value]
run: {{stop: 1 s, engine: {engine}, accuracy: {accuracy}}}
"""


@ENGINES
@ACCURACIES
def test_the_integral_of_the_torque_of_a_dog_clutch_gets_the_blow_of_its_engaging(simulate, engine, accuracy):
    """Two equal rotors share what the one turned with."""
    result = simulate(DOG.format(engine=engine, accuracy=accuracy))
    assert result.at("sum.signal", 1.0) == pytest.approx(-0.25, abs=1e-5)


@ENGINES
@ACCURACIES
def test_what_is_integrated_of_two_stops_joins_them_to_no_one_impact(simulate, engine, accuracy):
    """Each gives back its own share, though both meet at one instant and their forces add up in one integral."""
    result = simulate(f"""
components:
  floor: {{type: Ground}}
  one: {{type: Mass, mass: 2 kg, position: 1 m, velocity: -2 m/s}}
  other: {{type: Mass, mass: 3 kg, position: 1 m, velocity: -2 m/s}}
  soft: {{type: RigidStop, restitution: 0}}
  hard: {{type: RigidStop, restitution: 0.5}}
  both: {{type: Sum}}
  sum: {{type: Integrator}}
connections:
  - [floor.flange, soft.a, hard.a]
  - [soft.b, one.flange]
  - [hard.b, other.flange]
  - [soft.force, both.a]
  - [hard.force, both.b]
  - [both.signal, sum.value]
run: {{stop: 0.6 s, engine: {engine}, accuracy: {accuracy}}}
""")
    assert result.at("one.v", 0.6) == pytest.approx(0, abs=1e-6)
    assert result.at("other.v", 0.6) == pytest.approx(1, rel=1e-6)
    assert result.at("sum.signal", 0.6) == pytest.approx(4 + 9, abs=1e-5)


CURVES = {
    "viscous": ("{curve: viscous, coulomb: 0.1, rate: 0.2 s/m}", 3.5 * exp(-0.4) - 0.5),
    "steeply viscous": ("{curve: viscous, coulomb: 0.1, rate: 2 s/m}", 3.05 * exp(-4) - 0.05),
    "stribeck": ("{curve: stribeck, stiction: 1.5, coulomb: 0.3, velocity: 2.5 m/s}", 1.3216582),
}
"""Curves, and the speed after an impulse of 2 m/s times the mass: dv/dp = -mu(v)."""


@ENGINES
@ACCURACIES
@pytest.mark.parametrize("case", CURVES)
def test_friction_over_speed_follows_the_speed_through_a_blow(simulate, engine, accuracy, case):
    """Stribeck's by integration of dv/dp with a tolerance of 1e-10; the others by hand."""
    curve, after = CURVES[case]
    result = simulate(pressed(curve=curve, engine=engine, accuracy=accuracy))
    assert result.at("slide.v", 0.5001) == pytest.approx(after, abs=2e-5)
