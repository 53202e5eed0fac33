"""Advice for shafts speaks of what turns: an Inertia, a TorsionSpring, a Housing."""

import pytest

from fairlead.errors import ModelError

BETWEEN = """
components:
  slow: {type: SpeedSource, speed: 3 rad/s}
  fast: {type: SpeedSource, speed: 5 rad/s}
  clutch: {type: Clutch, normal_force: 10 N, radius: 0.1 m, curve: 0.3}
connections: [[slow.shaft, clutch.a], [fast.shaft, clutch.b]]
run: {stop: 1 s}
"""
LOOSE = """
components:
  gear: {type: Gear, ratio: 2}
  shaft: {type: TorsionSpring, stiffness: 3 N*m/rad}
connections: [[gear.a, shaft.a], [gear.b, shaft.b]]
run: {stop: 1 s}
"""


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        (BETWEEN, "Put an Inertia and a TorsionSpring between, or write friction: {method: binding}."),
        (LOOSE, "Join one of them to a Housing or a source of motion, or add an Inertia."),
    ],
    ids=["between two speeds", "without any inertia"],
)
def test_the_advice_names_parts_that_turn(scene, text, advice):
    with pytest.raises(ModelError) as raised:
        _ = scene(text).system
    assert advice in str(raised.value)
