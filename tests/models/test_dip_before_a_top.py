"""What is met in the middle of a step that is long because nothing bends the motion, and left again before its end.

A force that is a polynomial in time moves a body along one, which a method of high order follows in few steps. A guard
may then fall, rise above zero and fall again within a step, or rise, fall and rise.
"""

import numpy as np
import pytest

SPAN = 20.0


def motion(seed):
    """A cubic through zero that goes down, up and down again, when it turns, and a place above zero that it meets."""
    chance = np.random.default_rng(seed)
    dips = chance.uniform(0.5, 5.5)
    turns = np.array([dips, chance.uniform(3.2 * dips, 0.95 * SPAN)])  # from three times on it rises above zero
    way = np.poly1d(turns, r=True).integ() * -chance.uniform(0.01, 1.0)
    return way, turns, chance.uniform(0.02, 0.98) * way(turns[1])


def meets(way, place, begin, end):
    """The first time between two at which a polynomial is at a place."""
    roots = (way - place).roots
    real = np.sort(roots.real[abs(roots.imag) < 1e-9])
    return real[(real > begin) & (real < end)][0]


def driven(way):
    """A force in time for 1 kg: a second derivative, which is a line."""
    slope, start = np.poly1d(way.deriv(2)).c
    return f"{{constant: {float(start)!r} N, drift: {{rate: {float(slope)!r} N/s}}}}"


@pytest.mark.parametrize("accuracy", ["1e-3", "1e-4", "1e-6", "1e-7"])
@pytest.mark.parametrize("seed", [*range(8), *(pytest.param(k, marks=pytest.mark.slow) for k in range(8, 40))])
def test_a_stop_is_met_behind_a_dip(simulate, seed, accuracy):
    """A body is thrown back, turned by a force and driven against a stop; alone it would come back before the end."""
    way, turns, place = motion(seed)
    result = simulate(f"""
    components:
      body: {{type: Mass, mass: 1 kg, position: 0 m, velocity: {float(way.deriv()(0.0))!r} m/s}}
      push: {{type: ForceSource, force: {driven(way)}}}
      stop: {{type: RigidStop}}
      wall: {{type: FixedPoint, position: {float(place)!r} m}}
    connections: [[body.flange, push.flange, stop.a], [wall.flange, stop.b]]
    run: {{stop: {SPAN} s, accuracy: {accuracy}, engine: rodas}}
    """)
    first = result.events[0]
    assert first.zone_to == "touching"
    assert first.t == pytest.approx(meets(way, place, turns[0], turns[1]), abs=10 * float(accuracy))
    assert result.extremes("body.x").highest == pytest.approx(place, abs=1e-8 * (1 + abs(place)))


@pytest.mark.parametrize("accuracy", ["1e-4", "1e-6", "1e-8"])
@pytest.mark.parametrize("seed", [*range(8), *(pytest.param(k, marks=pytest.mark.slow) for k in range(8, 40))])
def test_a_block_whose_slip_returns_to_zero_sticks(simulate, seed, accuracy):
    """Its friction is the steady part of a force that swings below it and comes back: it rests in between."""
    chance = np.random.default_rng(seed)
    t1, apart, c = chance.uniform(0.2, 0.5), chance.uniform(1.2, 2.0), chance.uniform(0.3, 1.0)
    t2 = t1 + apart
    pulled = np.poly1d([t1, t2], r=True) * c  # beyond sliding friction: below zero between t1 and t2
    speed = pulled.integ()
    start = -speed(t2) - chance.uniform(0.01, 0.5) * (speed(t1) - speed(t2))  # it stops before t2
    friction = 2.0 * c * apart**2
    stop = t2 + chance.uniform(0.5, 1.5)
    _, first, last = pulled.c
    result = simulate(f"""
    components:
      body: {{type: Mass, mass: 1 kg, position: 0 m, velocity: {float(start)!r} m/s}}
      pull: {{type: ForceSource, force: {{constant: {float(friction + last)!r} N, drift: {{rate: {float(first)!r} N/s}},
              product: {{of: {{drift: {{rate: {float(c)!r} N/s}}}}, times: {{drift: {{rate: 1 1/s}}}}}}}}}}
      pad: {{type: Contact, normal_force: 1 N, curve: {float(friction)!r}}}
      ground: {{type: Ground}}
    connections: [[body.flange, pull.flange, pad.b], [ground.flange, pad.a]]
    run: {{stop: {float(stop)!r} s, accuracy: {accuracy}, engine: rodas}}
    """)
    assert start > 0
    told = [event.zone_to for event in result.events]
    assert told[-2:] == ["held", "forward"]
    assert result.at("body.v", stop) == pytest.approx(speed(stop) - speed(t2), abs=20 * float(accuracy))
