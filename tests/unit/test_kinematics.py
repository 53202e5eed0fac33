"""Rigid links, gears and racks: what they tie is one degree of freedom, whose inertias count with the ratio squared."""

import math

import numpy as np
import pytest

from fairlead.errors import ModelError
from fairlead.flatten.kinematics import Ties

LINKED = """
    components:
      wall: {type: Ground}
      spring: {type: Spring, stiffness: 300 N/m}
      front: {type: Mass, mass: 2 kg, position: 10 mm}
      link: {type: RigidLink, length: 0.4 m}
      back: {type: Mass, mass: 1 kg}
    connections: [[wall.flange, spring.a], [spring.b, front.flange, link.a], [link.b, back.flange]]
    run: {stop: 1 s, accuracy: 1e-8}
"""

GEARED = """
    parameters: {ratio: -3}
    components:
      wall: {type: Ground}
      spring: {type: Spring, stiffness: 500 N/m}
      drive: {type: Rack, radius: 0.1 m}
      motor: {type: Inertia, moment: 0.02 kg*m^2, angle: 0.1 rad}
      gear: {type: Gear, ratio: "{ratio}"}
      wheel: {type: Inertia, moment: 0.05 kg*m^2}
    connections:
      - [wall.flange, spring.a]
      - [spring.b, drive.rack]
      - [drive.pinion, motor.shaft, gear.a]
      - [gear.b, wheel.shaft]
    run: {stop: 1 s, accuracy: 1e-8}
"""

LOOP = """
    parameters: {last: 6}
    components:
      one: {type: Gear, ratio: 2}
      two: {type: Gear, ratio: 3}
      three: {type: Gear, ratio: "{last}"}
      disc: {type: Inertia, moment: 1 kg*m^2}
    connections: [[disc.shaft, one.a, three.a], [one.b, two.a], [two.b, three.b]]
    run: {stop: 1 ms}
"""


def free_groups(model):
    return [group for group in model.flat.groups if group.free]


def test_linked_masses_swing_as_one(simulate):
    """w^2 = k/(m1 + m2)."""
    result = simulate(LINKED)
    frequency = math.sqrt(300 / 3)
    np.testing.assert_allclose(result["front.x"], 0.01 * np.cos(frequency * result.t), atol=1e-8)
    np.testing.assert_allclose(result["back.x"] - result["front.x"], 0.4, rtol=1e-14)


def test_what_is_linked_has_one_position_and_one_speed(scene):
    (group,) = free_groups(scene(LINKED))
    assert group.mass == 3.0
    assert [unknown.name for unknown in scene(LINKED).system.numbering.unknowns][:2] == ["front.x", "front.v"]


def test_a_start_given_behind_a_link_is_the_start_of_all(scene):
    text = LINKED.replace("position: 10 mm", "velocity: 1 m/s").replace("mass: 1 kg", "mass: 1 kg, position: 0.5 m")
    (group,) = free_groups(scene(text))
    assert group.start == pytest.approx((0.1, 1.0))  # the link is 0.4 m long


def test_a_geared_pair_swings_at_its_frequency(simulate):
    """k r^2 phi = -(J1 + i^2 J2) phi'' at the motor, a spring of stiffness k on a rack of radius r."""
    result = simulate(GEARED)
    frequency = math.sqrt(500 * 0.1**2 / (0.02 + 9 * 0.05))
    np.testing.assert_allclose(result["motor.angle"], 0.1 * np.cos(frequency * result.t), atol=1e-7)
    np.testing.assert_allclose(result["wheel.angle"], -3 * result["motor.angle"], rtol=1e-13)


@pytest.mark.parametrize("ratio", [-3.0, 0.5, 20.0])
def test_inertias_count_with_the_ratio_squared(scene, ratio):
    (group,) = free_groups(scene(GEARED, ratio=ratio))
    heavier = "motor" if ratio**2 * 0.05 < 0.02 else "wheel"
    assert group.name == heavier  # the motion that is counted is that of the body with the larger share
    assert group.mass == pytest.approx((0.02 + ratio**2 * 0.05) / (1.0 if heavier == "motor" else ratio**2))


def test_a_loop_that_closes_is_no_mistake(scene):
    (group,) = free_groups(scene(LOOP))
    assert sorted(group.ratios) == pytest.approx([1.0, 2.0, 6.0])


def test_a_loop_that_contradicts_itself_is_named(scene):
    """2 times 3 is not 5; every link of the loop may be the wrong one, so all are named."""
    with pytest.raises(ModelError) as caught:
        scene(LOOP, last=5).check()
    (fault,) = caught.value.faults
    assert all(name in fault.what for name in ("one", "two", "three"))
    assert "ratio" in fault.what


def test_links_round_a_loop_must_agree_in_length(scene):
    text = """
        parameters: {length: 0.3 m}
        components:
          short: {type: RigidLink, length: 0.1 m}
          long: {type: RigidLink, length: 0.2 m}
          whole: {type: RigidLink, length: "{length}"}
          block: {type: Mass, mass: 1 kg}
        connections: [[block.flange, short.a, whole.a], [short.b, long.a], [long.b, whole.b]]
        run: {stop: 1 ms}
    """
    assert len(free_groups(scene(text))) == 1
    with pytest.raises(ModelError, match="contradicts itself"):
        scene(text, length="0.31 m").check()


def test_ties_say_the_same_in_any_order():
    """b = 2a + 1, c = 3b - 4, d = -c: whatever is tied first, each follows from each other."""
    written = [(0, 1, 2.0, 1.0), (1, 2, 3.0, -4.0), (2, 3, -1.0, 0.0)]
    for order in ([0, 1, 2], [2, 1, 0], [1, 2, 0], [0, 2, 1]):
        ties = Ties([0, 1, 2, 3], [1.0] * 4, [0.0] * 4)
        assert all(ties.tie(*written[k]) for k in order)
        motion = {}
        for node in range(4):
            _, ratio, offset = ties.root(node)
            motion[node] = (ratio, offset)
        (ra, oa), at = motion[0], 0.7  # of the root; a follows, and from it the others
        a = ra * at + oa
        expected = [a, 2 * a + 1, 3 * (2 * a + 1) - 4, -(3 * (2 * a + 1) - 4)]
        assert [r * at + o for r, o in motion.values()] == pytest.approx(expected)
        assert ties.tie(0, 3, -6.0, 1.0)  # d = -6a + 1 follows from the rest
        assert not ties.tie(0, 3, -6.0, 1.1)


@pytest.mark.parametrize("length", [28.39353789735268, 26.1, 22.2762, 31.7, 9.999])
def test_rounding_along_a_rigid_line_is_no_contradiction(scene, length):
    """Places of its ends are sums of hundreds of links, rounded as what they are apart."""
    text = f"""
    components:
      rope: {{type: Cable, length: {length} m, element: 0.1 m, start: 0 m, tension: 425 N, mass: 0.37 kg/m,
             stiffness: 410 kN, compression: carried, effects: {{line_stretch: off}}}}
      route: {{type: Route, stations: [{{type: Bend, start: 1 m, angle: 1 rad, radius: 0.3 m, friction: 0.2}}]}}
      pull: {{type: ForceSource, force: -425 N}}
      hold: {{type: ForceSource, force: 367 N}}
    connections: [[rope.path, route.path], [rope.inboard, pull.flange], [rope.outboard, hold.flange]]
    run: {{stop: 1 s}}
    """
    assert scene(text).system.n > 0


def test_start_values_that_differ_are_still_a_contradiction(scene):
    text = LINKED.replace("back: {type: Mass, mass: 1 kg}", "back: {type: Mass, mass: 1 kg, position: 0.41001 m}")
    with pytest.raises(ModelError, match="tied to it, starts so that it would be"):
        scene(text).system  # noqa: B018
