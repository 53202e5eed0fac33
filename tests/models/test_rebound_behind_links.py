"""What a link, or a stop that touched before, has kept to rounding did not meet: its coefficient has no part in it.

Each scene has a stop with a coefficient of its own behind links that keep their speeds as equations. The speed after
the blow is -e times that before it, by the closed form of the motion up to there; in other units of mass, length and
time it scales, although the rounding that is left in the links is another one there.
"""

import math

import pytest

SCALES = [(1, 1, 1), (1e3, 1, 1), (1, 1, 1e-3), (1e3, 1e3, 1e3), (1e-3, 1e-3, 1e-3)]
ENGINES = ("rodas", "ida")


def in_units(text, mass, length, time):
    """The text with its quantities, written <4 kg>, in other units."""
    force = mass * length / time**2
    sizes = {"kg": mass, "m": length, "s": time, "m/s": length / time, "rad/s": 1 / time, "N": force,
             "N*s/m": mass / time, "kg*m^2": mass * length**2, "N*m": force * length}  # fmt: skip
    while "<" in text:
        before, _, rest = text.partition("<")
        quantity, _, after = rest.partition(">")
        number, unit = quantity.split()
        text = f"{before}{float(number) * sizes[unit]:.17g} {unit}{after}"
    return text


LEVER = """
    components:
      one: {type: Mass, mass: <2 kg>, position: 0, velocity: <3 m/s>}
      two: {type: Mass, mass: <4 kg>, position: 0}
      lever: {type: Lever, ratio: 0.5}
      ground: {type: Ground}
      stop: {type: RigidStop, restitution: 0.5, length: <-0.3 m>}
      pad: {type: Contact, normal_force: <12 N>, curve: 0.5}
    connections:
      - [one.flange, lever.a, stop.a]
      - [two.flange, lever.b, pad.b]
      - [lever.pivot, ground.flange, stop.b, pad.a]
    run: {stop: <0.25 s>, accuracy: 1e-6}
"""
SENSORS = """
    components:
      one: {type: Mass, mass: <1.3 kg>, position: 0, velocity: <2.3 m/s>}
      link: {type: ForceSensor}
      two: {type: Mass, mass: <0.7 kg>}
      rack: {type: Rack, radius: <0.13 m>}
      coupling: {type: TorqueSensor}
      wheel: {type: Inertia, moment: <0.05 kg*m^2>}
      oil: {type: Damper, damping: <1.7 N*s/m>}
      ground: {type: Ground}
      stop: {type: RigidStop, restitution: 0.7, length: <-0.31 m>}
    connections:
      - [one.flange, link.a, stop.a]
      - [link.b, two.flange, rack.rack, oil.b]
      - [rack.pinion, coupling.a]
      - [coupling.b, wheel.shaft]
      - [ground.flange, oil.a, stop.b]
    run: {stop: <0.25 s>, accuracy: 1e-6}
"""
PAIR = """
    components:
      behind: {type: Mass, mass: <1.1 kg>, position: 0, velocity: 0}
      before: {type: Mass, mass: <0.6 kg>, position: <0.37 m>, velocity: 0}
      between: {type: RigidStop, length: <0.37 m>, restitution: 0.1}
      push: {type: ForceSource, force: <0.9 N>}
      wall: {type: FixedPoint, position: <0.66 m>}
      stop: {type: RigidStop, restitution: 0.5}
    connections:
      - [behind.flange, push.flange, between.a]
      - [before.flange, between.b, stop.a]
      - [wall.flange, stop.b]
    run: {stop: <1.3 s>, accuracy: 1e-6}
"""


def behind_a_lever():
    """Friction of 6 N on half the speed, 3 kg in all: 1 m/s^2 against the motion, on both ways."""
    met = 3 - math.sqrt(9 - 2 * 0.3)
    return "one.v", -0.5 * (3 - met) + (0.25 - met)


def behind_sensors():
    """A damper takes its part of the speed by the way: m v = m v0 - c x; then it decays."""
    mass, c = 2 + 0.05 / 0.13**2, 1.7
    met = -mass / c * math.log(1 - 0.31 * c / (mass * 2.3))
    return "two.v", -0.7 * (2.3 - 0.31 * c / mass) * math.exp(-c / mass * (0.25 - met))


def behind_a_stop_that_touches():
    """Pushed from rest; by Moreau's law the pair, which touched, is thrown back as one."""
    a = 0.9 / 1.7
    met = math.sqrt(2 * 0.29 / a)
    return "behind.v", -0.5 * a * met + a * (1.3 - met)


@pytest.mark.parametrize("scale", SCALES, ids=str)
@pytest.mark.parametrize(
    ("text", "expected"),
    [(LEVER, behind_a_lever()), (SENSORS, behind_sensors()), (PAIR, behind_a_stop_that_touches())],
    ids=["lever", "sensors", "pair"],
)
def test_a_stop_behind_links_throws_back_with_its_own_coefficient(simulate, text, expected, scale) -> None:
    signal, speed = expected
    result = simulate(in_units(text, *scale), **{"run.engine": "rodas"})
    assert result[signal][-1] * scale[2] / scale[1] == pytest.approx(speed, rel=1e-4)


@pytest.mark.parametrize("method", ["hold", "binding"])
@pytest.mark.parametrize("engine", ENGINES)
def test_whatever_treats_the_friction_beside_it(simulate, engine, method) -> None:
    signal, speed = behind_a_lever()
    text = in_units(LEVER, 10, 1, 1) + f"    friction: {{method: {method}}}\n"
    assert simulate(text, **{"run.engine": engine})[signal][-1] == pytest.approx(speed, abs=2e-3)
