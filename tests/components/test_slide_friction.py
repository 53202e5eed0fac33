"""Friction of a slide given as force over speed, against the closed forms of a body that it stops or holds."""

import pathlib

import numpy as np
import pytest

import fairlead
from fairlead.errors import ModelError

SCENES = pathlib.Path(__file__).parents[2] / "models" / "single_parts"
SCENE = """
components:
  guide: {{type: Ground}}
  slide: {{type: Mass, mass: 2 kg, position: 0, velocity: {velocity}}}
  rubbing: {{type: SlideFriction, {friction}}}
  push: {{type: ForceSource, force: {force}}}
connections: [[guide.flange, rubbing.a], [rubbing.b, slide.flange, push.flange]]
run: {{stop: {stop}, accuracy: 1e-6, engine: {engine}}}
record: {{signals: [slide.v, slide.x, rubbing.*]}}
"""
ENGINES = ("rodas", "ida", "stepping")


def scene_of(friction, velocity="10 m/s", force="0", stop="6 s", engine="auto"):
    return SCENE.format(friction=friction, velocity=velocity, force=force, stop=stop, engine=engine)


@pytest.mark.parametrize("friction", ["sliding: 4 N", "points: [[0, 4 N], [100 m/s, 4 N]]"])
@pytest.mark.parametrize("method", ["hold", "karnopp"])
def test_a_constant_force_stops_a_body(simulate, friction, method):
    """2 kg at 10 m/s against 4 N: 5 s at 2 m/s^2, and 25 m."""
    result = simulate(scene_of(f"{friction}, method: {method}"))
    assert result.at("slide.v", 2.0) == pytest.approx(6.0, rel=1e-4)
    assert result.at("rubbing.slip", 2.0) == pytest.approx(6.0, rel=1e-4)
    assert result.at("rubbing.force", 2.0) == pytest.approx(4.0, rel=1e-4)
    assert result["slide.x"][-1] == pytest.approx(25.0, rel=1e-4)
    assert result["slide.v"][-1] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("friction", ["sliding: 4 N, viscous: 0.5 N*s/m", "points: [[0, 4 N], [100 m/s, 54 N]]"])
@pytest.mark.parametrize("way", [1, -1])
def test_a_force_that_grows_with_speed_stops_a_body_when_its_closed_form_says(simulate, friction, way, engine):
    """2 dv/dt = -(4 + v/2): v = (10 + 8) exp(-t/4) - 8, at rest after 4 ln(1 + 10/8); backward the same."""
    result = simulate(scene_of(friction, velocity=f"{10 * way} m/s", stop="4 s", engine=engine))
    t = np.asarray(result.t)
    rests = 4 * np.log(1 + 10 / 8)
    speed = np.where(t < rests, 18 * np.exp(-t / 4) - 8, 0.0)
    assert np.abs(way * result["slide.v"] - speed).max() < 1e-4 * 10
    assert way * result["slide.x"][-1] == pytest.approx(18 * 4 * (1 - np.exp(-rests / 4)) - 8 * rests, rel=1e-4)
    assert result.run["energy"]["closure"] < 1e-5


@pytest.mark.parametrize(
    "friction", ["sliding: 3 N, breakaway: 5 N", "points: [[0, 5 N], [1e-6 m/s, 3 N], [9 m/s, 3 N]]"]
)
def test_a_body_at_rest_begins_at_the_breakaway_force(simulate, friction):
    """A force of 1 N/s reaches 5 N after 5 s; then 3 N rub."""
    ramp = "{ramp: {to: 10 N, over: 10 s}}"
    result = simulate(scene_of(friction, "0", ramp, "7 s"))
    assert np.abs(result["slide.v"][result.t < 4.99]).max() < 1e-6
    assert result.at("rubbing.force", 4.0) == pytest.approx(4.0, rel=1e-4)  # what holds is what is asked
    assert result["slide.v"][-1] == pytest.approx((2 * 2 + 2**2 / 2) / 2, rel=1e-3)  # int of (5 + t - 3)/2 over 2 s


def test_force_falls_over_the_speed_that_is_given(simulate):
    """3 + 2 exp(-(v/10)^2) + 0.5 v at v = 10 m/s, at the start."""
    text = scene_of("sliding: 3 N, breakaway: 5 N, speed: 10 m/s, viscous: 0.5 N*s/m", stop="0.01 s")
    assert simulate(text)["rubbing.force"][0] == pytest.approx(3 + 2 * np.exp(-1) + 5, rel=1e-6)


def test_two_bodies_that_rub_on_each_other_come_to_their_common_speed(simulate):
    """1 kg and 3 kg with 4 m/s and 0, 6 N between them: v = 1 m/s after 1/2 s, with 6 J lost."""
    result = simulate("""
    components:
      below: {type: Mass, mass: 3 kg, position: 0, velocity: 0}
      above: {type: Mass, mass: 1 kg, position: 0, velocity: 4 m/s}
      rubbing: {type: SlideFriction, sliding: 6 N}
    connections: [[below.flange, rubbing.a], [rubbing.b, above.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
    """)
    assert result.at("above.v", 0.25) == pytest.approx(4 - 6 * 0.25, rel=1e-5)
    for body in ("above", "below"):
        assert result.at(f"{body}.v", 0.501) == pytest.approx(1.0, rel=1e-5)
    assert result.run["energy"]["dissipated"] == pytest.approx(4**2 / 2 - 4 / 2, rel=1e-5)


@pytest.mark.parametrize("engine", ENGINES)
def test_the_slide_of_the_bundled_scene_begins_at_its_first_point_and_comes_to_rest(engine):
    """The push grows by 30 N/s and reaches 60 N after 2 s; what is left of it once it ends is lost on the way."""
    result = fairlead.load(SCENES / "slide_friction.yaml", set={"run.engine": engine}).run(out=None)
    assert result.ok
    assert np.abs(result["slide.x"][result.t < 1.99]).max() < 1e-6
    assert result.at("slide.v", 2.1) > 0
    assert result["slide.v"][-1] == pytest.approx(0.0, abs=1e-5)
    assert result.run["energy"]["closure"] < 1e-4


@pytest.mark.parametrize(
    ("friction", "says"),
    [
        ("viscous: 1", "rubbing: give either sliding or points"),
        ("sliding: 4 N, points: [[0, 4 N], [1 m/s, 3 N]]", "rubbing: give either sliding or points"),
        ("sliding: 4 N, breakaway: 3 N", "rubbing.breakaway: breakaway 3 N is below sliding = 4 N"),
        ("sliding: 4 N, speed: 1 m/s", "rubbing.speed: speed is given without breakaway"),
        ("points: [[0, 4 N], [1 m/s, 3 N]], breakaway: 5 N", "rubbing.points: points are given beside breakaway"),
        ("points: [[1 m/s, 4 N], [2 m/s, 3 N]]", "Begin the table at 0 m/s"),
        ("points: [[0, 4 N], [2 m/s, -3 N]]", "A negative force would drive the slip"),
        ("sliding: 4 N/m", "rubbing.sliding = 4 N/m is a stiffness or force per length, not a force"),
    ],
)
def test_what_contradicts_itself_is_refused(scene, friction, says):
    with pytest.raises(ModelError, match=says):
        scene(scene_of(friction)).check()
