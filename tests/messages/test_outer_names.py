"""Messages speak of ports, entries and items by the names a user writes."""

import math

import pytest

import fairlead
from fairlead.errors import ModelError
from tests.mistakes.bases import PULLER

SERVO = """
components:
  motor: {type: PmDrive, constant: 0.5 N*m/A, most_current: 20 A, inertia: 0.01 kg*m^2}
  screw: {type: Rack, radius: 10 mm}
  block: {type: Mass, mass: 1 kg}
connections:
  - [motor.shaft, screw.rack]
  - [screw.pinion, block.flange]
run: {stop: 1 s}
"""
SPRING = """
parameters: {k: 1}
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  pad: {type: Contact, normal_force: 1 N, curve: 0.3}
  block: {type: Mass, mass: 1 kg}
connections: [[wall.flange, spring.a, pad.a], [spring.b, block.flange, pad.b]]
run: {stop: 0.1 s}
record: {plots: [{title: one, signals: [block.x]}]}
limits: {spring.tension: {below: 50 N}}
"""


def told(model):
    with pytest.raises(ModelError) as caught:
        model.check()
    return str(caught.value)


def test_a_port_of_a_composite_goes_by_its_outer_name(scene):
    said = told(scene(SERVO))
    assert "motor.shaft is a rotational port, screw.rack a translational one" in said
    assert "motor.rotor" not in said


def test_initial_and_limits_are_set_by_name(scene):
    limits = {"limits.spring.tension.below": "7 N", "limits.block.x.above": "-1"}
    model = scene(SPRING, **{"initial.block.x": "3 mm", **limits})
    assert model.netlist.initial["block.x"].plain() == "3 mm"
    assert model.netlist.limits["spring.tension"].plain() == {"below": "7 N"}
    assert model.netlist.limits["block.x"].plain() == {"above": -1}
    assert model.run(out=None)["block.x"][0] == pytest.approx(3e-3)


def test_a_misspelt_name_in_such_a_block_is_told_whole(scene):
    with pytest.raises(ModelError, match=r"initial\.blok\.x: no unknown has this name\. Did you mean block\.x\?"):
        scene(SPRING, **{"initial.blok.x": "1"})
    with pytest.raises(ModelError, match=r"limits\.spring\.tention: no signal"):
        scene(SPRING, **{"limits.spring.tention.below": "1 N"})


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("pad.metod", "Did you mean method?"),
        ("pad.normal_forc", "Did you mean normal_force?"),
        ("padd.normal_force", "Did you mean pad?"),
        ("rn.stop", "Did you mean run?"),
        ("kk", "Did you mean k?"),
    ],
)
def test_a_misspelt_path_offers_the_nearest(scene, name, says):
    with pytest.raises(ModelError) as caught:
        scene(SPRING, **{name: "1"}).check()
    assert says in str(caught.value)


@pytest.mark.slow
def test_an_item_that_there_is_not_is_told_with_those_that_there_are():
    with pytest.raises(ModelError) as caught:
        fairlead.load("single_bend", set={"route.stations.bent.radius": "1 m"}).check()
    assert "there is no item bent in a list of" in str(caught.value)
    assert "Items go by number, 0 to" in str(caught.value)


def test_what_is_varied_and_compared_is_looked_at_before_anything_runs(tmp_path):
    from fairlead.analysis.cost.compare import compare

    file = tmp_path / "scene.yaml"
    file.write_text(f"schema: 1\nname: scene{SPRING}", encoding="utf-8")

    def load(settings):
        return fairlead.load(file, set=settings)

    with pytest.raises(ModelError, match=r"--vary: pad\.method: there is no method foo") as caught:
        compare(load, {"pad.method": ["hold", "foo"]}, out=tmp_path / "one")
    assert caught.value.exit_code == 1
    with pytest.raises(ModelError, match=r"--signals: no recorded signal has the name blok\.x\. Did you mean block\.x"):
        compare(load, {"pad.method": ["hold", "tanh"]}, out=tmp_path / "two", signals="blok.x")
    assert not (tmp_path / "two").exists()


@pytest.mark.parametrize(
    ("given", "told"),
    [({"initial.block.x": "3 N"}, "initial.block.x = 3 N is a force"), ({"start": "3 N"}, "initial.block.x = 3 N is a"),
     ({"limits.spring.tension.below": "3 m"}, "limits.spring.tension.below = 3 m is a length"),
     ({"nominal.block.x": "3 N"}, "nominal.block.x = 3 N is a force"),
     ({"record.signals[0]": "blok.x"}, "no signal has the name blok.x")],
)  # fmt: skip
def test_a_value_at_a_signal_is_told_by_load_as_by_check(given, told, tmp_path):
    text = PULLER.replace("initial: {block.x: 0 mm}", 'initial: {block.x: "{start}"}')
    (tmp_path / "puller.yaml").write_text(text.replace("{mu: 0.3", "{start: 0 mm, mu: 0.3"), encoding="utf-8")
    assert fairlead.load(tmp_path / "puller.yaml", set={"start": "2 mm"}).netlist.name == "puller"
    with pytest.raises(ModelError, match=told):
        fairlead.load(tmp_path / "puller.yaml", set=given)


def test_a_run_refuses_what_it_would_record_in_vain(scene):
    """As `check` does: after a long run the signal would be missing."""
    model = scene("""
        components:
          wall: {type: Ground}
          spring: {type: Spring, stiffness: 100 N/m}
          block: {type: Mass, mass: 1 kg, velocity: 1 m/s}
        connections: [[wall.flange, spring.a], [spring.b, block.flange]]
        run: {stop: 0.1 s}
        record: {signals: [block.x, block.vv, "q*"]}
    """)
    with pytest.raises(ModelError, match=r"no signal has the name block\.vv\. Did you mean block\.v\?") as caught:
        model.run(out=None)
    assert "no signal has the name q*" in str(caught.value)


APART = """
components:
  part: {{{part}}}
  shaft: {{type: Inertia, moment: 1 kg*m^2, speed: 3 rad/s}}
  other: {{type: {other}}}
connections:
  - [part.{first}, shaft.shaft]
  - [part.{second}, other.{end}]
run: {{stop: 1 us}}
"""
MASS = {"other": "Mass, mass: 1 kg, velocity: 2 m/s", "end": "flange"}
WHEEL = {"other": "Inertia, moment: 1 kg*m^2, speed: 2 rad/s", "end": "shaft"}
SCREW = "type: LeadScrew, radius: 10 mm, lead: 5 mm, curve: 0.1"
WORM = "type: Worm, radius: 20 mm, lead: 12.57 mm, curve: 0.12, wheel_radius: 100 mm"


@pytest.mark.parametrize(
    ("part", "first", "second", "other", "said", "belongs"),
    [
        (SCREW, "screw", "nut", MASS, "part.nut (other) at 2 m/s", f"{3 * 5e-3 / math.tau:g} m/s"),
        (WORM, "worm", "wheel", WHEEL, "part.wheel (other) at 2 rad/s", f"{3 * 12.57e-3 / math.tau / 0.1:g} rad/s"),
        ("type: TorqueSensor", "a", "b", WHEEL, "part.b (other) at 2 rad/s", ""),
    ],
)
def test_start_speeds_that_a_part_does_not_allow_are_told_at_its_own_ports(
    scene, part, first, second, other, said, belongs
):
    """In their own units: not those of the parts that it is made of, nor with the speed of the other end's unit."""
    with pytest.raises(ModelError) as caught:
        scene(APART.format(part=part, first=first, second=second, **other)).run(out=None)
    (fault,) = caught.value.faults
    assert fault.what.startswith("part keeps its ends at ")
    assert f"part.{first} (shaft) at 3 rad/s and {said}" in fault.what
    assert (f"{belongs} belongs to 3 rad/s" in fault.what) == bool(belongs)
    assert "part.pressed" not in fault.what
