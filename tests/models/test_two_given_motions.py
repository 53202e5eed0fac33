"""A body that meets given motions of different speeds at one instant: the fastest throws it, the others open."""

import pytest

ENGINES = pytest.mark.parametrize("engine", ["rodas", "ida"])
SPEEDS = pytest.mark.parametrize(
    "speeds", [(0.0, 0.5), (0.5, 0.0), (0.0, 0.3), (0.2, 0.9), (0.0, 1.5), (0.1, 0.3, 0.5)]
)


def lifters(speeds, side, restitution, engine):
    """A body that falls at 1 m/s on plates that rise, all at one height."""
    parts = "".join(
        f"  plate{k}: {{type: MotionSource, velocity: {side * v}}}\n"
        f"  stop{k}: {{type: RigidStop, restitution: {restitution}}}\n"
        for k, v in enumerate(speeds)
    )
    ends = ("a", "b") if side > 0 else ("b", "a")
    joints = "".join(f"  - [plate{k}.flange, stop{k}.{ends[0]}]\n" for k in range(len(speeds)))
    stops = ", ".join(f"stop{k}.{ends[1]}" for k in range(len(speeds)))
    return (
        f"components:\n  body: {{type: Mass, mass: 2 kg, position: {0.1 * side}, velocity: {-side}}}\n{parts}"
        f"connections:\n{joints}  - [body.flange, {stops}]\nrun: {{stop: 1 s, engine: {engine}}}\n"
    )


@ENGINES
@SPEEDS
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_the_fastest_plate_throws_the_body(speeds, side, restitution, engine, simulate):
    """All are met at once, as plates that rise from below the height of the body at the instant it comes."""
    met = 0.1 / 1.0  # s: the plates start so far down that all are at 0 then
    text = lifters(speeds, side, restitution, engine)
    for k, v in enumerate(speeds):
        plate = f"plate{k}: {{type: MotionSource,"
        text = text.replace(plate, f"{plate} origin: {-side * v * met},")
    result = simulate(text)
    thrown = max(speeds) + restitution * (1 + max(speeds))
    assert side * result.at("body.v", 0.2) == pytest.approx(thrown, rel=1e-6)


@ENGINES
@pytest.mark.parametrize("speeds", [(1.0, 2.0), (2.0, 1.0), (1.0, 1.2), (-0.5, 0.5)])
def test_of_two_freewheels_the_faster_motor_drives_the_shaft(speeds, engine, simulate):
    text = f"""
    components:
      one: {{type: SpeedSource, speed: {speeds[0]}}}
      other: {{type: SpeedSource, speed: {speeds[1]}}}
      first: {{type: OneWayClutch}}
      second: {{type: OneWayClutch}}
      shaft: {{type: Inertia, moment: 0.5 kg*m^2, speed: -1}}
    connections: [[one.shaft, first.a], [other.shaft, second.a], [first.b, second.b, shaft.shaft]]
    run: {{stop: 1 s, engine: {engine}}}
    """
    result = simulate(text)
    assert result["shaft.speed"][-1] == pytest.approx(max(speeds), rel=1e-6)
