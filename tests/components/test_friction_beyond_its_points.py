"""Friction and drag given by points: what `beyond: line` says past the last one must not drive the slip either."""

import numpy as np
import pytest

from fairlead.errors import ModelError

SCENE = """
components:
  guide: {{type: Ground}}
  slide: {{type: Mass, mass: 1 kg, position: 0, velocity: {velocity}}}
  rubbing: {{{part}}}
connections: [[guide.flange, rubbing.a], [rubbing.b, slide.flange]]
run: {{stop: 0.2 s, accuracy: 1e-7}}
"""
SHAFT = """
components:
  house: {{type: Housing}}
  rotor: {{type: Inertia, moment: 1, speed: 3}}
  rubbing: {{{part}}}
connections: [[house.shaft, rubbing.a], [rubbing.b, rotor.shaft]]
run: {{stop: 0.2 s, accuracy: 1e-7}}
"""
GEAR = """
components:
  motor: {{type: Inertia, moment: 1, speed: 3}}
  gear: {{type: LossyGear, ratio: 1, {part}}}
  load: {{type: Inertia, moment: 1, speed: 3}}
connections: [[motor.shaft, gear.a], [gear.b, load.shaft]]
run: {{stop: 0.2 s, accuracy: 1e-7}}
"""
FALLS = "{x: [0, 0.5, 1], y: [5, 3, 1], beyond: line}"  # 1 - 4 (v - 1): zero at 1.25
CONTACT = "type: Contact, normal_force: 10 N, curve: "


@pytest.mark.parametrize(
    ("text", "part", "says"),
    [
        (SCENE, f"{CONTACT}{{curve: table, points: {FALLS}}}",
         r"rubbing\.curve\.points: beyond: line has the coefficient fall below zero from 1\.25 m/s on"),
        (SCENE, f"{CONTACT}{{curve: table, points: {FALLS[:-1]}, kind: cubic}}}}", r"below zero from 1\.\d+ m/s on"),
        (SCENE, f"{CONTACT}{{curve: coulomb, coulomb: 5, backward: {FALLS}}}",
         r"rubbing\.curve\.backward: beyond: line has the coefficient fall below zero from 1\.25 m/s on"),
        (SCENE, f"type: SlideFriction, points: {FALLS}", r"the force fall below zero from 1\.25 m/s on"),
        (SHAFT, f"type: ShaftFriction, points: {FALLS}", r"the torque fall below zero from 1\.25 rad/s on"),
        (GEAR, f"efficiency: 0.9, bearing_points: {FALLS}",
         r"gear\.bearing_points: beyond: line has the torque fall below zero from 1\.25 rad/s on"),
        (GEAR, "efficiency_points: {x: [0, 1], y: [0.9, 0.7], beyond: line}", r"beyond: line leads to 0 at 4\.5 rad/s"),
        (GEAR, "efficiency_points: {x: [0, 1], y: [0.7, 0.9], beyond: line}", r"beyond: line leads to 1 at 1\.5 rad/s"),
        (GEAR, "efficiency_points: {x: [1, 2], y: [0.9, 0.7], beyond: line}", r"a share is 1\.1"),
        (SCENE, "type: Drag, points: [[-1, -2], [0, 0], [1, -2]]", r"at 1 m/s the drag is -2 N, which drives"),
        (SCENE, "type: Drag, points: [[0, 5], [1, 6]]", r"at -1 m/s the drag is 5 N, which drives the body on"),
        (SCENE, "type: Drag, points: {x: [-1, 0, 1, 2], y: [-1, 0, 2, 1], beyond: line}",
         r"at 4 m/s the drag is -1 N, which drives the body on"),
        (SCENE, "type: Drag, points: {x: [-2, -1, 0, 1], y: [-1, -2, 0, 1], beyond: line}",
         r"at -4 m/s the drag is 1 N, which drives the body on"),
    ],
)  # fmt: skip
def test_a_line_on_which_friction_would_drive_the_slip_is_refused_with_where_it_does(scene, text, part, says):
    with pytest.raises(ModelError, match=says):
        scene(text.format(velocity="3 m/s", part=part)).check()


@pytest.mark.parametrize(
    "part",
    [
        f"{CONTACT}{{curve: table, points: {{x: [0, 1], y: [0.2, 0.3], beyond: line}}}}",
        f"{CONTACT}{{coulomb: 9, backward: {{x: [0, 1], y: [0.2, 0.3], beyond: line}}}}",
        "type: SlideFriction, points: {x: [0, 1], y: [2, 3], beyond: line}",
    ],
)  # fmt: skip
def test_a_line_that_rises_is_followed_beyond_the_last_point(simulate, part):
    """dv/dt = -(2 + v) from 3 m/s on: v = 5 exp(-t) - 2; backward likewise."""
    way = -1 if "backward" in part else 1
    result = simulate(SCENE.format(velocity=f"{3 * way} m/s", part=part))
    np.testing.assert_allclose(way * result["slide.v"], 5 * np.exp(-np.asarray(result.t)) - 2, rtol=1e-5)


def test_drag_by_points_brakes_both_ways(simulate):
    """dv/dt = -2 v within and beyond the points."""
    part = "type: Drag, points: {x: [-1, 0, 1], y: [-2, 0, 2], beyond: line}"
    for way in (1, -1):
        result = simulate(SCENE.format(velocity=f"{3 * way} m/s", part=part))
        np.testing.assert_allclose(result["slide.v"], 3 * way * np.exp(-2 * np.asarray(result.t)), rtol=1e-5)
