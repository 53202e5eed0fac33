"""Bounces on a rigid stop die out in geometric order, whatever throws the body back and however long steps may be."""

import math

import pytest

SCENE = """
components:
  floor: {{type: Ground}}
  wall: {{type: FixedPoint, position: {place} m}}
  ball: {{type: Mass, mass: {mass} kg, position: {height} m}}
  stop: {{type: RigidStop, restitution: {restitution}}}
  rope: {rope}
connections: [[floor.flange, stop.a], [wall.flange, rope.a], [ball.flange, rope.b, stop.b]]
run: {{stop: {stop} s, max_events: 2000}}
"""
ROPES = {
    "spring": "{{type: Spring, stiffness: {stiffness} N/m, free_length: 0}}",
    "tether": "{{type: Tether, stiffness: {stiffness} N/m, length: 0}}",
}


def rest(mass, stiffness, load, height, restitution):
    """When the last flight ends [s], each half a swing about a place behind the stop, and the energy at first."""
    omega, behind = math.sqrt(stiffness / mass), load / stiffness
    t = math.acos(behind / (height + behind)) / omega
    v = omega * math.sqrt((height + behind) ** 2 - behind**2)
    while v > 1e-12:
        v *= restitution
        t += 2 * math.atan(v / (omega * behind)) / omega
    return t, stiffness * ((height + behind) ** 2 - behind**2) / 2


@pytest.mark.parametrize("stop", [0.8, 5.0])
@pytest.mark.parametrize("accuracy", [1e-3, 1e-4, 1e-5])
@pytest.mark.parametrize(
    ("rope", "stiffness", "load", "restitution"),
    [("spring", 171.0, 49.6, 0.6), ("spring", 20.0, 5.0, 0.8), ("spring", 5e4, 200.0, 0.3),
     ("tether", 171.0, 49.6, 0.6)],
)  # fmt: skip
def test_what_a_spring_throws_back_comes_to_rest(rope, stiffness, load, restitution, accuracy, stop, simulate):
    mass, height = 1.0, 0.01
    t, energy = rest(mass, stiffness, load, height, restitution)
    text = SCENE.format(place=-load / stiffness, mass=mass, height=height, restitution=restitution, stop=stop,
                        rope=ROPES[rope].format(stiffness=stiffness))  # fmt: skip
    result = simulate(text, **{"run.engine": "rodas", "run.accuracy": accuracy})
    met = [event.t for event in result.events if event.component == "stop"]
    lies = 2 * accuracy / (load / mass) / (1 - restitution)  # s: flights from ten weights of the speed on count as none
    assert max(met) == pytest.approx(t, abs=2 * lies + 10 * accuracy * t)
    assert len(met) < 200
    assert result["ball.x"][-1] == pytest.approx(0.0, abs=1e-9)
    assert result["ball.v"][-1] == pytest.approx(0.0, abs=1e-9)
    assert result["energy.dissipated"][-1] == pytest.approx(energy, rel=20 * accuracy)
