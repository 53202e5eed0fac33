"""A start value on a body whose motion is given is that with which the motion begins, or a contradiction by name."""

from __future__ import annotations

import pytest

from fairlead.errors import ModelError

HAND = "hand: {type: MotionSource, velocity: 0.2 m/s}"
SCENES = {
    "speed": (HAND, "block: {type: Mass, mass: 1 kg, velocity: 1 m/s}", "[[hand.flange, block.flange]]",
              "block.flange.v starts at 1 m/s; hand.flange", "starts at 0.2 m/s"),
    "place": ("hand: {type: MotionSource, velocity: 0.2 m/s, origin: 1 m}",
              "block: {type: Mass, mass: 1 kg, position: 3 m}", "[[hand.flange, block.flange]]",
              "block.flange.x starts at 3 m; hand.flange", "starts at 1 m"),
    "still": (HAND, "block: {type: Mass, mass: 1 kg, velocity: 0}", "[[hand.flange, block.flange]]",
              "block.flange.v starts at 0 m/s; hand.flange", "starts at 0.2 m/s"),
    "sine": ("hand: {type: MotionSource, position: {sine: {amplitude: 1 m, frequency: 0.5 Hz}}}",
             "block: {type: Mass, mass: 1 kg, velocity: 1 m/s}", "[[hand.flange, block.flange]]",
             "block.flange.v starts at 1 m/s; hand.flange", "starts at 3.14159 m/s"),
    "gear": ("hand: {type: SpeedSource, speed: 2 rad/s}",
             "gear: {type: Gear, ratio: 3}\n      rotor: {type: Inertia, moment: 1 kg*m^2, speed: 2 rad/s}",
             "[[hand.shaft, gear.a], [gear.b, rotor.shaft]]", "rotor.shaft.speed starts at 2 rad/s; hand.shaft",
             "starts at 6 rad/s"),
    "rack": ("hand: {type: MotionSource, velocity: 1 m/s}",
             "rack: {type: Rack, radius: 0.1 m}\n      rotor: {type: Inertia, moment: 1 kg*m^2, speed: 5 rad/s}",
             "[[hand.flange, rack.rack], [rack.pinion, rotor.shaft]]",
             "rotor.shaft.speed starts at 5 rad/s; hand.flange", "starts at 10 rad/s"),
    "link": (HAND, "bar: {type: RigidLink, length: 2 m}\n      block: {type: Mass, mass: 1 kg, velocity: -0.2 m/s}",
             "[[hand.flange, bar.a], [bar.b, block.flange]]", "block.flange.v starts at -0.2 m/s; hand.flange",
             "starts at 0.2 m/s"),
    "signal": ("wish: {type: SignalSource, value: 2}\n      hand: {type: SpeedActuator, start: 2 rad/s}",
               "rotor: {type: Inertia, moment: 1 kg*m^2, speed: 1 rad/s}",
               "[[hand.shaft, rotor.shaft], [wish.signal, hand.wanted]]",
               "rotor.shaft.speed starts at 1 rad/s; hand.shaft", "starts at 2 rad/s"),
    "place by signal": ("wish: {type: SignalSource, value: 2}\n      hand: {type: PositionActuator}",
                        "block: {type: Mass, mass: 1 kg, position: 1 m}",
                        "[[hand.flange, block.flange], [wish.signal, hand.wanted]]",
                        "block.flange.x starts at 1 m; hand.flange", "starts at 0 m"),
}  # fmt: skip
TEXT = """
    components:
      {drive}
      {body}
    connections: {joins}
    run: {{stop: 0.1 s}}
"""


@pytest.mark.parametrize("name", SCENES)
def test_a_start_value_that_a_given_motion_overrides_is_a_contradiction(scene, name) -> None:
    """Both ends and both values are named, with place and way out; the order of the two says nothing."""
    drive, body, joins, said, moved = SCENES[name]
    for one, other in ((drive, body), (body, drive)):
        with pytest.raises(ModelError) as raised:
            scene(TEXT.format(drive=one, body=other, joins=joins)).check()
        assert said in str(raised.value)
        assert moved in str(raised.value)
        assert "Leave that start value out" in str(raised.value)
        assert len(raised.value.faults) == 1


@pytest.mark.parametrize(("drive", "body", "end"), [
    (HAND, "block: {type: Mass, mass: 1 kg, velocity: 0.2 m/s, position: 3 m}", 3.02),
    (HAND, "block: {type: Mass, mass: 1 kg, position: 3 m}", 3.02),
    (HAND, "block: {type: Mass, mass: 1 kg}", 0.02),
    ("hand: {type: MotionSource, velocity: {ramp: {to: 2 m/s, over: 1 s}}}",
     "block: {type: Mass, mass: 1 kg, velocity: 0}", 0.01),
])  # fmt: skip
def test_start_values_that_agree_are_taken(simulate, drive, body, end) -> None:
    """A motion given by its velocity alone begins where the body is."""
    result = simulate(TEXT.format(drive=drive, body=body, joins="[[hand.flange, block.flange]]"))
    assert result["hand.x"][-1] == pytest.approx(end, abs=1e-9)
