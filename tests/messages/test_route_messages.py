"""A route that cannot be, or does not fit its line, is told with numbers before the run."""

import pytest

from fairlead.errors import ModelError

BEND = "{type: Bend, start: 3 m, angle: 90 deg, radius: 1 m, friction: 0.3}"


def scene_of(stations, line="length: 20 m, element: 0.25 m, start: 1 m"):
    return f"""
components:
  rope: {{type: Cable, mass: 1 kg/m, stiffness: 200 kN, {line}}}
  route:
    type: Route
    stations: [{(", " + chr(10) + "      ").join(stations)}]
  haul: {{type: MotionSource, velocity: -0.2 m/s}}
connections:
  - [rope.path, route.path]
  - [haul.flange, rope.inboard]
run: {{stop: 1 s}}
"""


def told(scene, stations, **line):
    with pytest.raises(ModelError) as caught:
        scene(scene_of(stations, **line)).check()
    return str(caught.value)


def test_devices_that_overlap(scene):
    text = told(scene, [BEND, "{type: Guide, start: 4 m, length: 1 m, friction: 0.3}"])
    assert ":9:" in text  # the line of the second device
    assert "guide begins at 4 m, before bend ends at 4.5708 m: they overlap by 0.571 m" in text
    assert "begin where it ends" in text


def test_degrees_written_as_a_bare_number(scene):
    text = told(scene, [BEND.replace("90 deg", "90")])
    assert "stations[0].angle: bend turns the line 14.3 times round; 6 are allowed" in text
    assert "A bare number is in rad; write 90 deg for degrees." in text


def test_elements_that_nobody_can_wait_for(scene):
    text = told(scene, [BEND], line="length: 20 m, element: 1 um, start: 1 m")
    assert "rope.element: elements of 1e-06 m make 2e+07 of them in 20 m; at most 20000" in text
    assert "Make them at least 0.001 m." in text


def test_contacts_missed_for_a_mistake_in_a_station_are_not_told_as_well(scene):
    """The signal of another component that no signal has is, though."""
    wrong = scene_of([BEND.replace("radius: 1 m", "radius: 1 kg")])
    with pytest.raises(ModelError) as caught:
        scene(wrong + "record: {signals: ['rope.outer[*].slip', haul.forc]}\n").check()
    text = str(caught.value)
    assert "stations[0].radius = 1 kg is a mass, not a length" in text
    assert "rope.outer" not in text
    assert "record: no signal has the name haul.forc. Did you mean haul.force?" in text
    assert len(caught.value.faults) == 2


def test_two_devices_of_one_name(scene):
    later = "{name: bend, type: Guide, start: 6 m, length: 1 m, friction: 0.3}"
    assert "2 devices are called bend" in told(scene, [BEND.replace("{", "{name: bend, "), later])


def test_devices_listed_out_of_order(scene):
    text = told(scene, [BEND, "{type: Guide, start: 1 m, length: 1 m, friction: 0.3}"])
    assert "guide stands after bend in the list, but lies inboard of it" in text


def test_a_slit_between_devices(scene):
    text = told(scene, [BEND, "{type: Guide, start: 4.6708 m, length: 1 m, friction: 0.3}"])
    assert "route.guide begins 0.1 m after bend ends, less than an element (0.25 m)" in text
    assert "Let it begin at 4.5708 m, or leave at least 0.25 m between them." in text


def test_elements_too_coarse_for_a_bend(scene):
    text = told(scene, [BEND], line="length: 20 m, element: 1 m, start: 1 m")
    assert "route.bend: an element of 1 m turns through 1 rad in a radius of 1 m" in text
    assert "Use elements of at most 0.25 m (0.25 rad): 7 on this device." in text


def test_a_device_shorter_than_its_elements(scene):
    text = told(scene, ["{type: Guide, start: 3 m, length: 0.3 m, friction: 0.3}"])
    assert "route.guide: it is 0.3 m long, shorter than 2 elements of 0.25 m" in text
    assert "0.075 m puts five nodes on it" in text


def test_a_bend_tighter_than_the_line_allows(scene):
    text = told(scene, [BEND], line="length: 20 m, element: 0.25 m, start: 1 m, bend_radius: 1.5 m")
    assert "route.bend: its radius of 1 m is tighter than rope allows, 1.5 m" in text


def test_a_drum_too_small_for_the_line(scene):
    drum = "{type: Winch, radius: 0.3 m, layers: on, width: 0.5 m, height: 0.1 m, line_diameter: 50 mm}"
    text = told(scene, [drum, BEND], line="length: 60 m, element: 0.25 m, start: -50 m")
    assert "route.winch: it takes 43.56 m of line (2 layers of 10 wraps), and 50 m lie on it at the start" in text


def test_a_route_without_devices(scene):
    assert "route.stations is empty" in told(scene, [])


def test_a_name_that_is_none(scene):
    text = told(scene, ["{name: Bend A, type: Bend, start: 3 m, angle: 90 deg, radius: 1 m, friction: 0.3}"])
    assert "write a name of small letters, digits and underscores" in text


def test_a_step_in_length_is_refused(scene):
    text = """
components:
  weight: {type: Mass, mass: 1 kg}
  winch: {type: MotionSource, position: {step: {to: 2 m, at: 1 s}}}
connections: [[weight.flange, winch.flange]]
run: {stop: 1 s}
"""
    with pytest.raises(ModelError, match="the position jumps by 2 m at t = 1 s, which takes an infinite force"):
        scene(text).check()


def test_a_rope_that_cannot_push_cannot_ruck(scene):
    text = told(scene, [BEND], line="length: 20 m, element: 0.25 m, start: 1 m, ruck_force: 100 N")
    assert "rope.ruck_force: a line that cannot push cannot ruck" in text


WINCH = """
parameters: {start: -12 m}
components:
  rope: {type: Cable, length: 24 m, element: 0.25 m, start: "{start}", tension: 300 N, mass: 1 kg/m, stiffness: 500 kN}
  route:
    type: Route
    stations:
      - {type: Winch, radius: 0.4 m}
      - {type: Bend, start: 2 m, angle: 90 deg, radius: 1 m, friction: 0.3}
      - {name: wheel, type: Pulley, start: 5 m, angle: 45 deg, radius: 0.8 m, friction: 0.5}
  drive: {type: MotionSource, velocity: {ramp: {to: -0.3 m/s, over: 1 s}}}
  load: {type: ForceSource, force: 300 N}
connections:
  - [rope.path, route.path]
  - [drive.flange, DRIVEN]
  - [load.flange, rope.outboard]
friction: {method: hold}
run: {stop: 5 s}
"""
ON_THE_WINCH = WINCH.replace("DRIVEN", "route.winch.rim")


@pytest.mark.parametrize(
    ("start", "says", "way_out"),
    [
        (
            "0.3 m",
            "rope begins 0.3 m outboard of route.winch, and nothing else holds it: it lies from 0.3 to 24.3 m, and "
            "what lies inboard of 0 m is on the drum",
            "Let it start below 0 m by what is to be paid out",
        ),
        ("0 m", "rope only reaches route.winch, and nothing else holds it", "or leave out the winch and drive"),
    ],
)
def test_a_line_that_its_winch_does_not_hold_is_refused_by_check_and_run(scene, tmp_path, start, says, way_out):
    check, run = (scene(ON_THE_WINCH, start=start) for _ in range(2))
    for refused in (check.check, lambda: run.run(tmp_path / "no")):
        with pytest.raises(ModelError) as caught:
            refused()
        (fault,) = caught.value.faults
        assert fault.what.startswith(says)
        assert way_out in fault.way_out


@pytest.mark.slow
def test_a_line_on_a_drum_of_given_speed_runs_with_exact_hold(scene, tmp_path):
    """Its inboard end is fastened to the drum, so that a friction of its own would be between two given motions."""
    model = scene(ON_THE_WINCH)
    assert model.check() == []
    result = model.run(out=tmp_path / "run", stop=1.0)
    assert result.status == "finished"
    assert not result.match("rope.outer[0].slip")


@pytest.mark.parametrize("between", ["shaft: {type: Gear, ratio: 2}", "shaft: {type: Gear, ratio: 0.5}"])
def test_so_it_does_when_the_speed_is_given_through_a_gear(scene, between):
    through = ON_THE_WINCH.replace("  drive:", f"  {between}\n  pinion: {{type: Rack, radius: 1 m}}\n  drive:")
    geared = "[drive.flange, pinion.rack]\n  - [pinion.pinion, shaft.a]\n  - [shaft.b, route.winch.shaft]"
    through = through.replace("[drive.flange, route.winch.rim]", geared)
    assert scene(through).check() == []
