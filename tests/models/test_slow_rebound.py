"""A rebound below ten error weights is none: a run tells a stop that gave nothing back, and the `nominal` to give."""

from __future__ import annotations

import pytest

from tests.conftest import Scene

ENGINES = pytest.mark.parametrize("engine", ["rodas", "ida"])

BALL = """
    parameters: {{speed: 50 um/s, restitution: 1}}
    components:
      wall: {{type: Ground}}
      ball: {{type: Mass, mass: 1 kg, position: 100 um, velocity: "{{-speed}}"}}
      stop: {{type: RigidStop, restitution: "{{restitution}}"}}
    connections: [[wall.flange, stop.a], [stop.b, ball.flange]]
    run: {{stop: {stop} s, engine: {engine}}}
"""
TWO = """
    components:
      one: {{type: Mass, mass: 1 kg, velocity: 40 um/s}}
      other: {{type: Mass, mass: 1 kg, position: 100 um}}
      stop: {{type: RigidStop, restitution: 0.8}}
    connections: [[one.flange, stop.a], [stop.b, other.flange]]
    run: {{stop: 10 s, engine: {engine}}}
"""
SHAFT = """
    components:
      rotor: {{type: Inertia, moment: 1 kg*m^2, speed: 500 urad/s}}
      gear: {{type: Gear, ratio: 2}}
      end: {{type: Rack, radius: 0.1 m}}
      plate: {{type: FixedPoint, position: 400 um}}
      stop: {{type: RigidStop, restitution: 1}}
    connections: [[rotor.shaft, gear.a], [gear.b, end.pinion], [end.rack, stop.a], [stop.b, plate.flange]]
    run: {{stop: 10 s, engine: {engine}}}
"""


def told(result) -> list[str]:
    """What the run remarks of stops."""
    return [said for said in result.run["remarks"] if "gave nothing back" in said]


@ENGINES
@pytest.mark.parametrize(
    ("text", "names"),
    [(BALL, ["ball.v: 5e-05 m/s"]), (TWO, ["one.v: 4e-05 m/s", "other.v: 4e-05 m/s"])],
    ids=["wall", "two balls"],
)
def test_a_stop_that_is_met_slowly_is_told_with_the_size_to_give(
    simulate: Scene, engine: str, text: str, names: list[str]
) -> None:
    (said,) = told(simulate(text.format(engine=engine, stop=10)))
    assert said.startswith("stop gave nothing back: stop was met at")
    assert all(name in said for name in names)
    sizes = said.rpartition("nominal: ")[2].rstrip(".")
    mended = simulate(text.format(engine=engine, stop=10) + f"    nominal: {sizes}\n")
    assert not told(mended)
    assert any(event.zone_to == "free" for event in mended.events) or mended.run["lost"] != {}
    if text is BALL:
        assert mended["ball.v"][-1] == pytest.approx(50e-6, rel=1e-6)
    else:
        assert [mended["one.v"][-1], mended["other.v"][-1]] == pytest.approx([4e-6, 36e-6], rel=1e-6)


@ENGINES
def test_one_behind_a_gear_is_told_with_the_unknown_that_moves(simulate: Scene, engine: str) -> None:
    (said,) = told(simulate(SHAFT.format(engine=engine)))
    assert "rotor.speed" in said
    assert "rad/s" in said


@ENGINES
@pytest.mark.parametrize(
    "values",
    [{"restitution": 0}, {"speed": "1 mm/s"}, {"speed": "5 um/s"}],
    ids=["gives nothing", "fast", "below its error"],
)
def test_other_meetings_are_not(simulate: Scene, engine: str, values: dict[str, object]) -> None:
    assert not told(simulate(BALL.format(engine=engine, stop=10), **values))


@ENGINES
def test_a_ball_that_comes_to_rest_is_not(simulate: Scene, engine: str) -> None:
    text = BALL.format(engine=engine, stop=3).replace("100 um", "0.1 m")
    text = text.replace("ball.flange]", "ball.flange, w.flange]")
    text = text.replace("      stop:", "      w: {type: ForceSource, force: -10 N}\n      stop:")
    result = simulate(text, speed="0 m/s", restitution=0.5)
    assert abs(result["ball.v"][-1]) < 1e-9
    assert len(result.events) > 10
    assert not told(result)
