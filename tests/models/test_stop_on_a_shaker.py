"""A body on a stop whose other side moves as given: it leaves where that falls faster than the body does.

On rodas the body is put back to what moves as given after every step, since a given place is exact and its own is not.
Nodes without inertia on a stop are here too, on the ground and on a shaker: they meet it without an impact.
"""

from itertools import pairwise

import numpy as np
import pytest

import fairlead
from tests.reference.thrown import G, flights, hops


def shaken(amplitude, frequency, engine, accuracy, stop, unit=1.0):
    return f"""
    components:
      weight: {{type: ForceSource, force: {-G * unit} N}}
      body: {{type: Mass, mass: {unit} kg}}
      rest: {{type: RigidStop}}
      plate: {{type: MotionSource, velocity: {{sine: {{amplitude: {amplitude} m/s, frequency: {frequency} Hz}}}}}}
    connections: [[plate.flange, rest.a], [rest.b, body.flange, weight.flange]]
    initial: {{body.x: 0 m}}
    run: {{stop: {stop} s, engine: {engine}, accuracy: {accuracy}}}
    record: {{every: 1 ms, signals: ["*"]}}
    """


def shaker(amplitude, frequency):
    return f"{{type: MotionSource, velocity: {{sine: {{amplitude: {amplitude} m/s, frequency: {frequency} Hz}}}}}}"


def flown(told, least):
    """(leaves, lands) of flights longer than `least`, of (t, zone) of one stop."""
    return np.array([(t, later[0]) for (t, zone), later in pairwise(told) if zone == "free" and later[0] - t > least])


@pytest.mark.parametrize(
    ("amplitude", "frequency", "unit"),
    [(1.0, 2, 1.0), (0.6, 3, 1e3), pytest.param(0.35, 8, 1e-3, marks=pytest.mark.slow),
     pytest.param(0.3, 15, 1.0, marks=pytest.mark.slow)],
)  # fmt: skip
@pytest.mark.parametrize("accuracy", ["1e-3", pytest.param("1e-4", marks=pytest.mark.slow), "1e-6"])
def test_it_leaves_and_lands_when_it_should(simulate, amplitude, frequency, unit, accuracy):
    """Three flights, found by the roots of closed forms; with other masses too. It does not touch in between."""
    stop = 3.3 / frequency
    result = simulate(shaken(amplitude, frequency, "rodas", accuracy, stop, unit))
    told = [(event.t, event.zone_to) for event in result.events]
    exact = [flight for flight in flights(amplitude, frequency, stop) if flight[1] < stop]
    assert len(exact) == 3
    assert flown(told, 0.01 / frequency) == pytest.approx(np.array(exact), abs=20 * float(accuracy) / frequency)
    assert len(told) == 2 * len(exact) + 1


@pytest.mark.parametrize("seed", [*range(4), *(pytest.param(k, marks=pytest.mark.slow) for k in range(4, 24))])
def test_what_has_left_is_not_met_again_at_once(simulate, seed):
    """By the rounding of its place and of the shaker. It may leave at once where it lands on what falls."""
    chance = np.random.default_rng(seed)
    frequency, accuracy = chance.uniform(1, 6), 10 ** chance.uniform(-7, -3)
    amplitude, unit = chance.uniform(1.1, 2) * G / (2 * np.pi * frequency), 10 ** chance.uniform(-3, 3)
    told = simulate(shaken(amplitude, frequency, "rodas", accuracy, 4 / frequency, unit)).events
    flown = [later.t - event.t for event, later in pairwise(told) if event.zone_to == "free"]
    assert len(flown) >= 2
    assert min(flown) > 1e-3 / frequency


@pytest.mark.parametrize(("amplitude", "frequency", "accuracy"), [(1.0, 2, 1e-4), (0.35, 8, 1e-4), (0.35, 8, 1e-6)])
def test_ida_says_which_engine_to_take(simulate, amplitude, frequency, accuracy):
    """It goes on from its own past, so that it cannot put a body back; it does not meet it for ever either."""
    with pytest.raises(fairlead.RunError, match=r"Bodies at rest lie on what moves as given.*run\.engine: rodas"):
        simulate(shaken(amplitude, frequency, "ida", accuracy, 1.0 / frequency))


@pytest.mark.parametrize("accuracy", ["1e-3", "1e-6"])
def test_a_rope_to_a_heaving_winch_is_slack_when_a_body_flies(simulate, accuracy):
    """Seen from the winch it is the plate, 3 m higher. A rack turns a rotor, which is a mass of 1 kg more."""
    result = simulate(f"""
    components:
      weight: {{type: ForceSource, force: -9.81 N}}
      heavy: {{type: ForceSource, force: -9.81 N}}
      load: {{type: Mass, mass: 1 kg}}
      geared: {{type: Mass, mass: 1 kg}}
      rack: {{type: Rack, radius: 0.1 m}}
      rotor: {{type: Inertia, moment: 0.01 kg*m^2}}
      rope: {{type: RigidStop, length: -3 m}}
      other: {{type: RigidStop, length: -3 m}}
      winch: {shaker(1.0, 2)}
    connections: [[winch.flange, rope.a, other.a], [rope.b, load.flange, weight.flange],
                  [other.b, geared.flange, heavy.flange, rack.rack], [rack.pinion, rotor.shaft]]
    initial: {{load.x: -3 m, geared.x: -3 m}}
    run: {{stop: 1.65 s, engine: rodas, accuracy: {accuracy}}}
    """)
    told = [(event.t, event.zone_to) for event in result.events if event.component == "rope"]
    exact = np.array([flight for flight in flights(1.0, 2, 1.65) if flight[1] < 1.65])
    assert flown(told, 5e-3) == pytest.approx(exact, abs=20 * float(accuracy))
    told = [(event.t, event.zone_to) for event in result.events if event.component == "other"]
    exact = np.array([flight for flight in flights(1.0, 2, 1.65, G / 2) if flight[1] < 1.65])
    assert flown(told, 5e-3) == pytest.approx(exact, abs=20 * float(accuracy))


def springs(unit, accuracy, engine, lower):
    return f"""
    components:
      weight: {{type: ForceSource, force: {-G * unit} N}}
      body: {{type: Mass, mass: {unit} kg}}
      foot: {{type: SpringDamper, stiffness: {5000 * unit} N/m, damping: {20 * unit} N*s/m}}
      rest: {{type: RigidStop}}
      lower: {lower}
    connections: [[lower.flange, rest.a], [rest.b, foot.a], [foot.b, body.flange, weight.flange]]
    initial: {{body.x: 0.1 m, foot.a.x: 0.1 m}}
    run: {{stop: 0.8 s, engine: {engine}, accuracy: {accuracy}}}
    """


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("unit", [1.0, 1e-3, pytest.param(1e3, marks=pytest.mark.slow)])
@pytest.mark.parametrize("accuracy", ["1e-4", "1e-6"])
def test_a_foot_without_inertia_lands_and_leaves(simulate, engine, unit, accuracy):
    """What it takes is a force, not an impulse; so it does not open the stop again."""
    result = simulate(springs(unit, accuracy, engine, "{type: Ground}"))
    assert np.array([event.t for event in result.events]) == pytest.approx(hops(0.0), abs=50 * float(accuracy))


@pytest.mark.parametrize("unit", [1.0, 1e3])
@pytest.mark.parametrize("accuracy", ["1e-4", "1e-6"])
def test_a_foot_without_inertia_lands_on_a_shaker(simulate, unit, accuracy):
    """It is put back to the plate as a body is."""
    result = simulate(springs(unit, accuracy, "rodas", shaker(1.0, 2)))
    assert np.array([event.t for event in result.events]) == pytest.approx(hops(4 * np.pi), abs=50 * float(accuracy))


@pytest.mark.parametrize("engine", ["rodas", "ida"])
def test_a_body_behind_a_sensor_is_stopped_and_its_lost_rebound_told(simulate, engine):
    """The sensor passes the impulse on to the stop. Its node has no inertia, so nothing is thrown back."""
    with pytest.warns(fairlead.RunWarning, match="rest: its restitution gives nothing back, since nothing at .*rest.b"):
        result = simulate(f"""
        components:
          weight: {{type: ForceSource, force: -9.81 N}}
          body: {{type: Mass, mass: 1 kg}}
          sensor: {{type: ForceSensor}}
          rest: {{type: RigidStop, restitution: 0.5}}
          air: {{type: Damper, damping: 1e-6 N*s/m}}
          floor: {{type: Ground}}
        connections: [[floor.flange, rest.a, air.a], [rest.b, sensor.a, air.b], [sensor.b, body.flange, weight.flange]]
        initial: {{body.x: 0.1 m, sensor.a.x: 0.1 m}}
        run: {{stop: 0.4 s, engine: {engine}, accuracy: 1e-6}}
        """)
    assert [event.t for event in result.events] == pytest.approx([np.sqrt(0.2 / G)], abs=1e-5)
    assert result["body.v"][-1] == pytest.approx(0.0, abs=1e-9)
    assert result["sensor.tension"][-1] == pytest.approx(-G, abs=1e-6)
