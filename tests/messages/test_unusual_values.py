"""What can be computed with and is hardly meant is remarked with its name and place; what is odd but usual is not."""

import pytest

from fairlead.errors import ModelError, UsageError

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


SLIDER = """
components:
  wall: {{type: Ground}}
  spring: {{type: Spring, stiffness: {k}}}
  block: {{type: Mass, mass: {m}, position: {x}}}
  push: {{type: ForceSource, force: {f}}}
connections: [[wall.flange, spring.a], [spring.b, block.flange, push.flange]]
{more}
run: {{stop: 1 s}}
"""
SOUND = {"k": "100 N/m", "m": "1 kg", "x": "0 m", "f": "1 N", "more": ""}


@pytest.mark.parametrize(
    ("changed", "place", "says"),
    [
        ({"k": "1e308 N/m"}, ":6:37:", "spring.stiffness = 1e308 N/m is too large to compute with"),
        ({"k": "1e200"}, ":6:37:", "spring.stiffness = 1e+200 is too large to compute with"),
        ({"k": "1e149 kN/mm"}, ":6:37:", "spring.stiffness = 1e149 kN/mm is too large"),
        ({"k": "1e-200 N/m"}, ":6:37:", "spring.stiffness = 1e-200 N/m is too small to compute with"),
        ({"m": "1e308 kg"}, ":7:29:", "block.mass = 1e308 kg is too large"),
        ({"m": "1e-308 kg"}, ":7:29:", "block.mass = 1e-308 kg is too small"),
        ({"x": "-1e200 m"}, ":7:45:", "block.position = -1e200 m is too large"),
        ({"f": "1e308 N"}, ":8:36:", "push.force = 1e308 N is too large"),
        ({"f": "{ramp: {to: 1e308 N, over: 1 s}}"}, ":8:48:", "1e308 N is too large"),
        ({"more": "initial: {block.v: 1e308 m/s}"}, ":10:20:", "initial.block.v = 1e308 m/s is too large"),
        ({"more": "nominal: {block.v: 1e-308 m/s}"}, ":10:20:", "nominal.block.v = 1e-308 m/s is too small"),
        ({"more": "nominal: {block.v: 1e308 m/s}"}, ":10:20:", "nominal.block.v = 1e308 m/s is too large"),
    ],
)
def test_what_overflows_is_refused_with_its_place_and_not_by_equations(scene, changed, place, says):
    with pytest.raises(ModelError) as caught:
        scene(SLIDER.format(**{**SOUND, **changed})).run(out=None)
    (fault,) = caught.value.faults
    assert says in fault.what
    assert place in f"{fault.where}:"
    assert "Is the exponent meant?" in fault.way_out


def test_an_input_of_a_stepped_run_is_refused_likewise(scene):
    text = SLIDER.format(**SOUND).replace("ForceSource, force: 1 N}", "ForceActuator}\n  given: {type: SignalInput}")
    text = text.replace("connections: [", "connections: [[given.signal, push.force], ")
    run = scene(text).start(inputs=["given.value"])
    with pytest.raises(UsageError, match=r"set: given\.value = 1e\+200 is too large to compute with"):
        run.set("given.value", 1e200)


@pytest.mark.parametrize(("k", "range_"), [("1e50 N/m", "up to 1e+30 N/m"), ("1e-50 N/m", "1e-30 to 1e+30 N/m")])
def test_a_quantity_of_any_unit_may_be_far_outside(scene, k, range_):
    said = [str(one) for one in scene(SLIDER.format(**{**SOUND, "k": k})).check()]
    assert any(f"spring.stiffness = {k} is far outside of what it usually is, {range_}" in one for one in said)


@pytest.mark.slow
def test_bundled_models_have_no_such_remark():
    import pathlib

    import fairlead
    from fairlead.analysis.remarks.unusual import unusual

    for file in sorted((pathlib.Path(__file__).parents[2] / "models").glob("*.yaml")):
        assert [str(one) for one in unusual(fairlead.load(file).assembly)] == []
