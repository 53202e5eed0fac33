"""What can be computed with and is hardly meant is remarked with its name and place; what is odd but usual is not."""

import pytest

DRILL = """
parameters: {{mu: {mu}}}
components:
  motor: {{type: TorqueSource, torque: {{step: {{to: 3 N*m, at: {at}}}}}}}
  one: {{type: Inertia, moment: {moment}}}
  two: {{type: Inertia, moment: 1 kg*m^2}}
  clutch: {{type: Clutch, radius: {radius}, normal_force: 100 N, curve: "{{mu}}"}}
  wall: {{type: Housing}}
  spring: {{type: TorsionSpring, stiffness: 100 N*m/rad}}
connections:
  - [motor.shaft, one.shaft, clutch.a]
  - [clutch.b, two.shaft, spring.a]
  - [spring.b, wall.shaft]
run: {{stop: 2 s}}
"""
RIGHT = {"mu": "0.35", "at": "0.1 s", "moment": "1 kg*m^2", "radius": "100 mm"}


def remarks(scene, **changed):
    return [str(fault) for fault in scene(DRILL.format(**{**RIGHT, **changed})).check()]


def test_a_usual_scene_has_no_remark(scene):
    assert remarks(scene) == []


@pytest.mark.parametrize(
    ("changed", "place", "says"),
    [
        ({"mu": "35"}, ":9:", "clutch.curve = 35 (parameter mu) is far outside of what it usually is, 0 to 2."),
        ({"mu": "35"}, ":9:", "Per cent are written 35 %, which is 0.35."),
        ({"radius": "100 m"}, ":9:", "clutch.radius = 100 m is far outside of what it usually is, 0.001 to 10 m."),
        ({"radius": "100"}, ":9:", "are 100 mm meant?"),
        ({"radius": "1e-5 m"}, ":9:", "clutch.radius = 1e-5 m is far outside"),
        ({"moment": "1e13 kg*m^2"}, ":7:", "one.moment = 1e13 kg*m^2 is far outside of what it usually is, up to"),
        ({"at": "10 s"}, ":6:", "motor.torque changes first at 10 s, and the run ends at run.stop = 2 s."),
    ],
)
def test_a_value_far_outside_is_remarked_with_its_name(scene, changed, place, says):
    said = remarks(scene, **changed)
    assert len(said) == 1
    assert says in said[0]
    assert place in said[0]


def test_slippery_and_sticky_are_both_usual(scene):
    assert remarks(scene, mu="0") == []
    assert remarks(scene, mu="1.2") == []


def test_a_period_longer_than_the_run_is_remarked(scene):
    text = """
    components:
      wanted: {type: SignalSource, value: 1}
      block: {type: Mass, mass: 1 kg}
      eye: {type: MotionSensor}
      control: {type: PiController, period: 10 s, gain: 1, integral_time: 1 s, low: -10, high: 10}
    connections: [[wanted.signal, control.reference], [eye.x, control.measured], [eye.flange, block.flange]]
    run: {stop: 2 s}
    """
    said = [str(fault) for fault in scene(text).check()]
    assert any("control.period = 10 s is longer than the run of 2 s" in one for one in said)


@pytest.mark.slow
def test_bundled_models_have_no_such_remark():
    import pathlib

    import fairlead
    from fairlead.analysis.remarks.unusual import unusual

    for file in sorted((pathlib.Path(__file__).parents[2] / "models").glob("*.yaml")):
        assert [str(one) for one in unusual(fairlead.load(file).assembly)] == []
