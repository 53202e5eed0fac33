"""Mistakes in components and connections: each is told with file, line and component, and what would be right."""
# ruff: noqa: E501 - the table of seeded mistakes reads best with one mistake a line

import os

import pytest

import fairlead
from fairlead.errors import ModelError

GOOD = """\
schema: 1
name: scene
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg, position: 10 mm}
  pad:
    type: Contact
    normal_force: 10 N
    curve: {curve: stribeck, stiction: 0.5, coulomb: 0.4, velocity: 20 mm/s}
  drive: {type: MotionSource, velocity: 0.1 m/s}
  push: {type: ForceSource, force: {ramp: {to: 3 N, over: 1 s}}}
  eye: {type: MotionSensor}
connections:
  - [wall.flange, spring.a]
  - [spring.b, block.flange, pad.b]
  - [drive.flange, pad.a]
  - [push.flange, block.flange]
  - [eye.flange, block.flange]
friction: {method: binding, creep: 0.1 mm/s}
run: {stop: 1 s}
record: {signals: [block.x, pad.*]}
limits: {spring.tension: {below: 50 N}}
"""
CURVE = "{curve: stribeck, stiction: 0.5, coulomb: 0.4, velocity: 20 mm/s}"
WAVE = "{ramp: {to: 3 N, over: 1 s}}"
LAST = "  - [eye.flange, block.flange]\n"


def check(tmp_path, text):
    """The whole message of a netlist with this text, with the folder's name taken out; "" when it is right."""
    (tmp_path / "scene.yaml").write_text(text)
    try:
        fairlead.load(tmp_path / "scene.yaml").check()
    except ModelError as error:
        return str(error).replace(f"{tmp_path}{os.sep}", "")
    return ""


def test_the_good_scene_is_good(tmp_path):
    assert check(tmp_path, GOOD) == ""


# (what stands in the good scene, what a hurried user writes instead, what the message must contain)
SEEDED = [
    # types and ports
    ("type: Spring", "type: Sprng", "scene.yaml:5:18: spring: there is no component type Sprng. Did you mean Spring?"),
    ("type: Spring", "type: spring", "scene.yaml:5:18: spring: there is no component type spring. Did you mean Spring?"),
    ("type: Spring", "type: Piston", "scene.yaml:5:18: spring: there is no component type Piston. There are AccelerationActuator, "),
    ("[spring.b,", "[spring.c,", "scene.yaml:16:6: spring.c: Spring has ports a, b; outputs tension, stretch. Did you mean spring.b?"),
    ("block.flange, pad.b]", "block.flnge, pad.b]", "scene.yaml:16:16: block.flnge: Mass has ports flange; outputs x, v. Did you mean block.flange?"),
    # parameters
    ("stiffness:", "stifness:", "scene.yaml:5:26: spring.stifness: Spring has no parameter stifness. Did you mean stiffness?\n    It has stiffness, free_length."),
    (", stiffness: 100 N/m", "", "scene.yaml:5:3: spring.stiffness is missing; Spring needs it.\n    Tension per stretch. Write a stiffness"),
    ("100 N/m", "-100 N/m", "scene.yaml:5:37: spring.stiffness = -100 N/m is out of range.\n    Allowed: above 0 N/m."),
    ("100 N/m", "100 kg", "scene.yaml:5:37: spring.stiffness = 100 kg is a mass, not a stiffness or force per length.\n    Write a stiff"),
    ("100 N/m", "100 N/mm2", "scene.yaml:5:37: spring.stiffness = 100 N/mm2: N/mm2 is not a unit.\n    Units are joined by * and / as"),
    ("100 N/m", "100 N/metre2", "spring.stiffness = 100 N/metre2: N/metre2 is not a unit"),
    ("100 N/m", "100 kn/m", "spring.stiffness = 100 kn/m: kn is not a known unit.\n    Did you mean kN, or knot?"),
    ("100 N/m", "100N/m", "spring.stiffness = 100N/m is not a quantity.\n    Put a space before the unit: 100 N/m."),
    ("100 N/m", "soft", "spring.stiffness = soft is not a quantity."),
    ("100 N/m", "[1, 2]", "spring.stiffness = a list of 2 is not a stiffness"),
    ("100 N/m", "true", "spring.stiffness = true is not a stiffness"),
    ("100 N/m", "", "spring.stiffness = nothing is not a stiffness"),
    ("mass: 1 kg", "mass: 0 kg", "scene.yaml:6:29: block.mass = 0 kg is out of range.\n    Allowed: above 0 kg."),
    # friction: words, curves, scene-wide settings
    ("curve: stribeck", "curve: stribek", "scene.yaml:10:20: pad.curve.curve: there is no curve stribek. Did you mean stribeck?\n    There are "),
    (CURVE, "stribek", "scene.yaml:10:12: pad.curve.curve: there is no curve stribek. Did you mean stribeck?"),
    (CURVE, "stribeck", "scene.yaml:10:12: pad.curve.stiction is missing; curve stribeck needs it.\n    Coefficient at rest. Write a plain"),
    (f"    curve: {CURVE}\n", "", "scene.yaml:7:3: pad.curve is missing; Contact (method: binding) needs it.\n    Coefficient of friction over slip speed. Write a number, or a map whose curve is one of coulomb"),
    ("stiction: 0.5", "stiction: 0.3", "scene.yaml:10:40: pad.curve.stiction: stiction 0.3 is below coulomb = 0.4.\n    The force to start sliding"),
    ("stiction: 0.5", "striction: 0.5", "scene.yaml:10:30: pad.curve.striction: curve stribeck has no parameter striction. Did you mean stiction?"),
    ("velocity: 20 mm/s", "velocity: 20 mm", "scene.yaml:10:69: pad.curve.velocity = 20 mm is a length, not a speed."),
    ("velocity: 20 mm/s", "velocity: 0 mm/s", "pad.curve.velocity = 0 mm/s is out of range.\n    Allowed: above 0 m/s."),
    (CURVE, "-0.2", "scene.yaml:10:12: pad.curve = -0.2 is out of range.\n    Allowed: at least 0."),
    (CURVE, "{curve: hump, stiction: 0.5, coulomb: 0.4, peak: 0.3, peak_velocity: 1 mm/s}", "pad.curve.peak: peak 0.3 is not above stiction 0.5 and coulomb 0.4."),
    (CURVE, "{curve: table, points: [[0.1, 0.3], [0.2, 0.2]]}", "scene.yaml:10:35: pad.curve.points: the first speed is 0.1 m/s.\n    Begin the table at 0 m/s."),
    (CURVE, "{curve: table, points: [[0, 0.3], [0.2, 0.2], [0.2, 0.1]]}", "pad.curve.points[2][0]: x must rise from point to point; 0.2 follows 0.2."),
    ("type: Contact", "type: Contact\n    method: holds", "scene.yaml:9:13: pad.method: there is no method holds. Did you mean hold?"),
    ("{method: binding,", "{method: bindng,", "scene.yaml:20:20: friction.method: there is no method bindng. Did you mean binding?"),
    ("creep:", "creap:", "scene.yaml:20:29: friction.creap: no friction method has such a setting. Did you mean creep?"),
    ("0.1 mm/s}", "0.1 kg}", "scene.yaml:20:36: friction.creep = 0.1 kg is a mass, not a speed."),
    ("0.1 mm/s}", "0.1 mm/s, form: litteral}", "scene.yaml:20:52: friction.form = litteral is not known. Did you mean literal?\n    Allowed: robust, literal."),
    ("friction:", "effects: {enrgy: off}\nfriction:", "scene.yaml:20:11: effects.enrgy: nothing in this scene has such an effect. Did you mean energy?"),
    ("friction:", "effects: {energy: maybe}\nfriction:", "scene.yaml:20:19: effects.energy = maybe is not a switch.\n    Write on or off."),
    ("0.1 mm/s}", "0.1 mm/s, plateau_width: 5, ramp_width: 4}", "pad.ramp_width: ramp_width 4 is not above plateau_width 5."),
    ("friction: {", "friction: {curve: {curve: tustn}, ", "scene.yaml:20:27: friction.curve.curve: there is no curve tustn. Did you mean tustin?"),
    # quantities in time
    ("velocity: 0.1 m/s", "velocity: 0.1 m/s, position: 3 m", "scene.yaml:11:3: drive: give either velocity or position."),
    (", velocity: 0.1 m/s", "", "scene.yaml:11:3: drive: give either velocity or position."),
    (WAVE, "{rampe: {to: 3 N, over: 1 s}}", "scene.yaml:12:37: push.force.rampe: there is no such waveform. Did you mean ramp?\n    There are constant, ramp,"),
    (WAVE, "{ramp: {to: 3 N, ovre: 1 s}}", "scene.yaml:12:53: push.force.ramp.ovre: there is no such setting. Did you mean over?"),
    (WAVE, "{ramp: {to: 3 N}}", "push.force.ramp: over is missing.\n    Needed: over, to."),
    (WAVE, "{ramp: {to: 3 kg, over: 1 s}}", "scene.yaml:12:48: push.force.ramp.to = 3 kg is a mass, not a force."),
    (WAVE, "{ramp: {to: 3 N, over: -1 s}}", "scene.yaml:12:59: push.force.ramp.over = -1 s is negative."),
    (WAVE, "{ramp: 3 N}", "scene.yaml:12:43: push.force.ramp = 3 N is not a map.\n    Write a map with from, over, start, to."),
    (WAVE, "{}", "push.force: nothing is given.\n    Give constant, ramp,"),
    (WAVE, "{table: {file: missing.csv}}", "scene.yaml:12:51: push.force.table.file: there is no file missing.csv in the folder of the netlist."),
    (WAVE, "{table: {file: ../outside.csv}}", "push.force.table.file = ../outside.csv lies outside the folder of the netlist."),
    (WAVE, "{table: [[0 s, 1 N], [0 s, 2 N]]}", "scene.yaml:12:58: push.force.table[1][0]: t must rise from point to point; 0 follows 0."),
    (WAVE, "{table: [[0 s, 1 N], [1 s, 2 m]]}", "scene.yaml:12:63: push.force.table[1][1] = 2 m is a length, not a force."),
    (WAVE, "{table: [[0 s, 1 N]]}", "push.force.table: a table has 2 to 100000 points, this one has 1."),
    (WAVE, "{table: 3}", "push.force.table: this is not a table.\n    Write a list of [t, y] pairs"),
    (WAVE, "{table: {t: [0, 1], y: [0, 1], kind: cubik}}", "push.force.table.kind = cubik is not known.\n    Allowed: linear, cubic."),
    # connections
    ("  - [push.flange, block.flange]\n", "", "scene.yaml:12:3: push is connected to nothing.\n    Connect push.flange, or remove push."),
    ("  - [wall.flange, spring.a]\n", "", "scene.yaml:5:3: spring.a is connected to nothing.\n    Connect it; a free end needs a Mass, a fixed one a Ground."),
    ("[wall.flange, spring.a]", "[wall.flange, spring.a, spring.a]", "spring.a is connected to itself"),
    ("[drive.flange, pad.a]", "[drive.flange, pad.a, block.flange]", "pad.a and pad.b are joined with each other, so pad has no effect.\n    Join them to different bodies."),
    ("[drive.flange, pad.a]", "[drive.flange, pad.a, wall.flange]", "scene.yaml:11:3: wall and drive both prescribe the motion of one body (wall.flange, drive.flange)."),
    (LAST, LAST + "  - [block.flange, eye.x]\n", "scene.yaml:20:6: block.flange is a translational port, eye.x a signal; they cannot be joined."),
    (LAST, LAST + "  - [eye.x, pad.normal]\n", "scene.yaml:20:6: eye.x is in m, pad.normal wants N."),
    (LAST, LAST + "  - [eye.x, eye.v]\n", "scene.yaml:20:6: eye.v and eye.x are outputs; a signal has one source."),
    (LAST, LAST + "  - [pad.bound_a, pad.bound_b]\n", "scene.yaml:20:6: pad.bound_a and pad.bound_b are inputs, and nothing gives the signal."),
    ("    normal_force: 10 N\n", "", "scene.yaml:7:3: pad.normal: nothing is connected to this input [N].\n    Connect an output to it, or give normal_force."),
    # signals
    ("block.x, pad", "blok.x, pad", "scene.yaml:22:20: record: no signal has the name blok.x. Did you mean block.x?"),
    ("pad.*", "pod.*", "scene.yaml:22:29: record: no signal has the name pod.*. Did you mean pad.*?"),
    ("[block.x, pad.*]", "[block.x], plots: [{signals: [block.z]}]", "scene.yaml:22:49: record: no signal has the name block.z.\n    block gives x, v."),
    ("[block.x, pad.*]", "[block.x], plots: [{signals: [block.x], kind: map, along: block.z}]", "scene.yaml:22:77: record: no signal has the name block.z."),
    ("spring.tension:", "spring.tenson:", "scene.yaml:23:10: limits.spring.tenson: no signal has this name. Did you mean spring.tension?"),
    ("below: 50 N", "below: 50 m", "scene.yaml:23:34: limits.spring.tension.below = 50 m is a length, not a force."),
    ("{below: 50 N}", "50 N", "scene.yaml:23:26: limits.spring.tension = 50 N has no bound: a limit is above or below"),
    ("{below: 50 N}", "-160 N", "Write it as {above: -160 N}, with above, below or both."),
    ("{below: 50 N}", "160 N", "Write it as {below: 160 N}, with above, below or both."),
    ("{below: 50 N}", "{}", "scene.yaml:23:26: limits.spring.tension = an empty map has no bound"),
    ("{spring.tension: {", "{spring.*: {", "scene.yaml:23:10: limits.spring.* means signals of several units"),
    ("below:", "belw:", "scene.yaml:23:27: limits.spring.tension.belw: a limit is above or below. Did you mean below?"),
    # where it begins
    ("friction:", "initial: {blok.x: 1 m}\nfriction:", "scene.yaml:20:11: initial.blok.x: no unknown has this name. Did you mean block.x?"),
    ("friction:", "initial: {block.x: 1 kg}\nfriction:", "scene.yaml:20:20: initial.block.x = 1 kg is a mass, not a length."),
    ("friction:", "initial: {block.angle: 1}\nfriction:", "scene.yaml:20:11: initial.block.angle: no unknown has this name.\n    block has block.x, block.v."),
    ("friction:", "initial: {wall.x: 1 m}\nfriction:", "scene.yaml:20:11: initial.wall.x: this motion is prescribed by wall.\n    Leave it out."),
    ("friction:", "initial: {drive.v: 1 m/s}\nfriction:", "initial.drive.v: this motion is prescribed by drive.\n    Set where drive begins instead."),
]  # fmt: skip


@pytest.mark.parametrize(("right", "wrong", "says"), SEEDED, ids=[f"{wrong.strip()[:40]}" for _, wrong, _ in SEEDED])
def test_a_seeded_mistake_is_told(tmp_path, right, wrong, says):
    assert right in GOOD
    said = check(tmp_path, GOOD.replace(right, wrong, 1))
    assert says in said
    assert all(line.startswith(("scene.yaml:", "    ")) for line in said.splitlines())


@pytest.mark.parametrize("word", ["stifness: 100 N/m", "stiffness: 100 N/mn", "stiffness: -1"])
def test_one_mistake_is_told_once_and_without_echoes(tmp_path, word):
    said = check(tmp_path, GOOD.replace("stiffness: 100 N/m", word))
    assert len([line for line in said.splitlines() if not line.startswith("    ")]) == 1


def scene(*lines, friction="{}"):
    """A netlist of these components and connections, one a line; connections begin with a bracket."""
    components = "".join(f"  {line}\n" for line in lines if not line.startswith("["))
    connections = "".join(f"  - {line}\n" for line in lines if line.startswith("["))
    return f"schema: 1\nname: scene\ncomponents:\n{components}connections:\n{connections}friction: {friction}\nrun: {{stop: 1 s}}\n"


BLOCK, WALL = "block: {type: Mass, mass: 1 kg}", "wall: {type: Ground}"
PADS = ("one: {type: Contact, normal_force: 10 N, curve: 0.3}", "two: {type: Contact, normal_force: 10 N, curve: 0.3}")
STRUCTURAL = {
    "ports of two domains": (
        scene(BLOCK, "shaft: {type: Inertia, moment: 1 kg*m^2}", "[block.flange, shaft.shaft]"),
        "scene.yaml:7:6: block.flange is a translational port, shaft.shaft a rotational one; they cannot be joined.\n"
        "    Join block.flange with another translational port, or put a component with both kinds between them.",
    ),
    "a node between two contacts that hold": (
        scene(BLOCK, WALL, *PADS, "[wall.flange, one.a]", "[one.b, two.a]", "[two.b, block.flange]", friction="{method: hold}"),
        "scene.yaml:10:6: node {one.b, two.a} has no mass and no law determines its force while one and two hold.\n"
        "    Add a Mass there, join the two contacts into one, or write friction: {method: binding}.",
    ),
    "a node between a contact whose friction varies and a spring": (
        scene(BLOCK, WALL, "one: {type: Contact, normal_force: 10 N, curve: {curve: stribeck, stiction: 0.4, coulomb: 0.3, velocity: 10 mm/s}}",
              "two: {type: Spring, stiffness: 1 N/m}", "[wall.flange, one.a]", "[one.b, two.a]", "[two.b, block.flange]", friction="{method: hold}"),
        "node {one.b, two.a} has no mass and no damping, and the force of one varies with its slip, and where it falls the node would jump.\n"
        "    Add a Mass there, or damping beside the spring, or take a curve that is constant (coulomb) or grows in proportion (viscous).",
    ),
    "a force on a spring without mass": (
        scene(WALL, "two: {type: Spring, stiffness: 1 N/m}", "push: {type: ForceSource, force: 1 N}", "[wall.flange, two.a]", "[two.b, push.flange]"),
        "node {push.flange, two.b} has no mass and no damping, so its speed is not determined; push.flange would read it.",
    ),
    "a node between two slack lines": (
        scene(BLOCK, WALL, "one: {type: Tether, stiffness: 1 N/m}", "two: {type: Tether, stiffness: 1 N/m}", "[wall.flange, one.a]", "[one.b, two.a]", "[two.b, block.flange]"),
        "scene.yaml:10:6: node {one.b, two.a} has no mass and no law determines its force while one is slack and two is slack.",
    ),
    "springs on nothing": (
        scene("one: {type: Spring, stiffness: 1 N/m}", "two: {type: Spring, stiffness: 1 N/m}", "[one.a, two.a]", "[two.b, one.b]"),
        "scene.yaml:7:6: nodes {one.a, two.a} and {one.b, two.b} hang together without any mass, and on no fixed or driven point.",
    ),
    "a rigid loop of two lengths": (
        scene(BLOCK, "other: {type: Mass, mass: 1 kg}", "one: {type: RigidLink, length: 1 m}", "two: {type: RigidLink, length: 2 m}", "[block.flange, one.a, two.a]", "[other.flange, one.b, two.b]"),
        "scene.yaml:7:3: the rigid loop two - one contradicts itself: two has the length 2, the others leave 1.",
    ),
    "gears in a circle": (
        scene(*(f"{name}: {{type: Inertia, moment: 1 kg*m^2}}" for name in "abc"), *(f"g{n}: {{type: Gear, ratio: {n}}}" for n in (2, 3, 5)),
              "[a.shaft, g2.a, g5.a]", "[g2.b, b.shaft, g3.a]", "[g3.b, c.shaft, g5.b]"),
        "scene.yaml:9:3: the rigid loop g5 - g2 - g3 contradicts itself: g5 has the ratio 5, the others make it 6.",
    ),
    "tied bodies that start apart": (
        scene("block: {type: Mass, mass: 1 kg, position: 1 m}", "other: {type: Mass, mass: 1 kg, position: 5 m}", "one: {type: RigidLink, length: 1 m}", "[block.flange, one.a]", "[other.flange, one.b]"),
        "scene.yaml:5:3: other.flange.x starts at 5 m; block.flange, tied to it, starts so that it would be 2 m.",
    ),
    "a body at rest that starts with a speed": (
        scene("block: {type: Mass, mass: 1 kg, velocity: 1 m/s}", WALL, "[block.flange, wall.flange]"),
        "scene.yaml:4:3: block.flange starts with a speed of 1 on a body that wall keeps at rest.",
    ),
    "a contact between two prescribed motions": (
        scene(WALL, "belt: {type: MotionSource, velocity: 1 m/s}", PADS[0], "[wall.flange, one.a]", "[belt.flange, one.b]", friction="{method: hold}"),
        "scene.yaml:6:3: one lies between two prescribed motions (wall.flange and belt.flange); no law determines its force.\n"
        "    Put a Mass and a Spring between, or write friction: {method: binding}.",
    ),
    "a contact with both sides on one rigid body": (
        scene(BLOCK, "link: {type: RigidLink}", PADS[0], "[block.flange, one.a, link.a]", "[link.b, one.b]", friction="{method: hold}"),
        "scene.yaml:6:3: one has both sides on one rigid body (block); they can never slip.",
    ),
    "a gear of ratio zero": (
        scene("a: {type: Inertia, moment: 1 kg*m^2}", "b: {type: Inertia, moment: 1 kg*m^2}", "g: {type: Gear, ratio: 0}", "[a.shaft, g.a]", "[g.b, b.shaft]"),
        "scene.yaml:6:26: g.ratio: ratio is zero.\n    Hold a shaft with a prescribed motion instead.",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", STRUCTURAL)
def test_what_the_graph_cannot_mean_is_told(tmp_path, name):
    text, says = STRUCTURAL[name]
    assert says in check(tmp_path, text)


def test_mistakes_of_all_stages_are_told_at_once(tmp_path):
    text = scene("wall: {type: Grund}", "spring: {type: Spring, stifness: 10 N/m}", "block: {type: Mass, mass: 1 m}",
                 "other: {type: Mass, mass: 1 kg}", "tie: {type: RigidLink}", "pad: {type: Contact, normal_force: 10 N, curve: {curve: stribek}}",
                 "[wall.flange, spring.a]", "[spring.b, block.flange, pad.d]", "[tie.a, other.flang]") + "limits: {other.y: {above: 1 m}}\n"  # fmt: skip
    said = check(tmp_path, text)
    for mistake in (
        "4:16: wall: there is no component type Grund. Did you mean Ground?",
        "5:26: spring.stifness: Spring has no parameter stifness. Did you mean stiffness?",
        "6:29: block.mass = 1 m is a length, not a mass.",
        "8:3: tie.b is connected to nothing.",
        "9:59: pad.curve.curve: there is no curve stribek. Did you mean stribeck?",
        "12:30: pad.d: ",
        "13:13: other.flang: Mass has ports flange; outputs x, v. Did you mean other.flange?",
        "16:10: limits.other.y: no signal has this name.",
    ):
        assert f"scene.yaml:{mistake}" in said
    lines = [int(line.split(":")[1]) for line in said.splitlines() if not line.startswith("    ")]
    assert lines == sorted(lines)
    assert len(lines) == 8


MISREAD = """
components:
  floor: {type: Ground}
  block: {type: Mass, mass: -2 kg}
  pad: {type: Contact, normal_force: -10 N, curve: 0.3}
  spring: {type: Spring, stifness: 400 N/m}
  hand: {type: MotionSource, velocity: 1 kg}
  drum: {type: Inertia}
  gear: {type: RigidLink, length: 1 kg}
  rope: {type: Cable, length: 24 m, element: 0.15 m, mass: -0.8 kg/m, stiffness: 500 kN}
  route: {type: Route, stations: [{type: Winch, radius: -0.4 m}, {type: Bend, start: 2 m, angle: 90 deg, radius: 1 m}]}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, spring.a]
  - [spring.b, hand.flange]
  - [gear.a, block.flange]
  - [gear.b, drum.shaft]
  - [rope.path, route.path]
  - [rope.inbord, route.winch.rimm]
run: {stop: 2 s}
"""


def test_a_mistake_in_a_parameter_does_not_hide_those_of_the_wiring(scene):
    """What is joined is known although a number is not; and nothing is said of numbers that are not the user's."""
    with pytest.raises(ModelError) as caught:
        scene(MISREAD).check()
    said = [fault.what for fault in caught.value.faults]
    of_numbers = ("block.mass", "pad.normal_force", "spring.stifness", "hand.velocity", "drum.moment", "gear.length",
                  "rope.mass", "route.stations[0].radius", "route.stations[1].friction")  # fmt: skip
    of_wiring = ("rope.inbord: Cable has ports inboard", "route.winch.rimm: there is no component route.winch. Did you",
                 "drum.shaft is a rotational port, gear.b a translational one")  # fmt: skip
    for words in (*of_numbers, *of_wiring):
        assert [what for what in said if what.startswith(words)], words
    assert len(said) == len(of_numbers) + len(of_wiring)


def test_a_run_is_refused_with_all_that_check_would_say(scene, tmp_path):
    model = scene(MISREAD)
    with pytest.raises(ModelError) as caught:
        model.run(out=tmp_path / "run")
    with pytest.raises(ModelError) as checked:
        scene(MISREAD).check()
    assert [fault.what for fault in caught.value.faults] == [fault.what for fault in checked.value.faults]


def test_where_a_word_decides_what_ports_there_are_nobody_is_blamed_for_them(scene):
    """Whether a winch has a rim depends on its layers, which cannot be read."""
    text = MISREAD.replace("radius: -0.4 m", "radius: 0.4 m, layers: maybe").replace("rimm", "shaft")
    with pytest.raises(ModelError) as caught:
        scene(text).check()
    assert not [fault.what for fault in caught.value.faults if "route.winch" in fault.what]


def test_mistakes_of_the_netlist_and_of_the_components_are_told_together(tmp_path):
    said = check(tmp_path, GOOD.replace("stop: 1 s", "stpo: 1 s").replace("mass: 1 kg", "mass: 1 m").replace("[push.flange,", "[psh.flange,"))
    assert "run has no key stpo" in said
    assert "block.mass = 1 m is a length, not a mass." in said
    assert "psh.flange: there is no component psh" in said
    assert "connected to nothing" not in said


def test_a_table_in_a_file_is_told_with_its_place_and_its_neighbours(tmp_path):
    (tmp_path / "pull.csv").write_text("t,y\n0,1\n1,x\n")
    assert "push.force.table.file = pull.csv, row 3, column 2: x is not a number." in check(tmp_path, GOOD.replace(WAVE, "{table: {file: pull.csv}}"))
    assert "there is no file pul.csv in the folder of the netlist. Did you mean pull.csv?" in check(tmp_path, GOOD.replace(WAVE, "{table: {file: pul.csv}}"))
    (tmp_path / "pull.csv").write_bytes(b"\xff\xfe\x00\x01" * 20)
    assert "push.force.table.file = pull.csv, row 1: the file is not a text in UTF-8" in check(tmp_path, GOOD.replace(WAVE, "{table: {file: pull.csv}}"))
    (tmp_path / "pull.csv").write_text("0,1\n1,inf\n")
    assert "push.force.table.file = pull.csv, row 2, column 2: inf is not a number." in check(tmp_path, GOOD.replace(WAVE, "{table: {file: pull.csv}}"))
    assert "push.force.table.file = " in check(tmp_path, GOOD.replace(WAVE, f"{{table: {{file: {'x' * 300}.csv}}}}"))


def test_a_table_outside_the_folder_is_not_read_through_a_link(tmp_path):
    (tmp_path / "out.csv").write_text("0,1\n1,2\n")
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "pull.csv").symlink_to(tmp_path / "out.csv")
    assert "lies outside the folder of the netlist" in check(tmp_path / "in", GOOD.replace(WAVE, "{table: {file: pull.csv}}"))


@pytest.mark.parametrize(
    ("part", "port", "ends"),
    [
        ("{type: Gear, ratio: 2}", "part.a", "a free shaft needs an Inertia, a fixed one a Housing"),
        ("{type: Leak, conductance: 1e-12}", "part.a", "a closed end needs a Volume, an open one a Tank"),
        ("{type: Resistor, resistance: 1}", "part.plus", "what has no voltage of its own needs an Earth"),
        ("{type: Spring, stiffness: 1}", "part.a", "a free end needs a Mass, a fixed one a Ground"),
    ],
)
def test_what_a_port_that_leads_nowhere_needs_is_told_in_its_domain(scene, part, port, ends):
    other = {"part.a": "part.b", "part.plus": "part.minus"}[port]
    end = {"Gear": "Housing", "Leak": "Tank", "Resistor": "Earth", "Spring": "Ground"}[part.split()[1].rstrip(",")]
    name = {"Housing": "shaft", "Tank": "port", "Earth": "terminal", "Ground": "flange"}[end]
    text = f"components:\n  part: {part}\n  end: {{type: {end}}}\nconnections: [[end.{name}, {other}]]\nrun: {{stop: 1 s}}\n"
    with pytest.raises(ModelError, match=f"{port} is connected to nothing") as caught:
        scene(text).check()
    assert f"Connect it; {ends}." in str(caught.value)


def test_overrides_are_named_as_the_place_of_their_mistake(tmp_path):
    (tmp_path / "scene.yaml").write_text(GOOD)
    with pytest.raises(ModelError, match=r"block\.mass = 3 m is a length, not a mass"):
        fairlead.load(tmp_path / "scene.yaml", set={"block.mass": "3 m"}).check()


@pytest.mark.parametrize(
    ("right", "wrong", "says"),
    [
        ("type: ArrayModule", "type: ArayModule", "scene.yaml:20:11: line: there is no component type ArayModule. Did you mean ArrayModule?"),
        ("mass: 1.6 kg/m", "mas: 1.6 kg/m", "line.hose.mas: hose of ArrayModule has no parameter mas. Did you mean mass?"),
        ("mass: 1.6 kg/m", "mass: 1.6 kg", "line.hose.mass = 1.6 kg is a mass, not a mass per length."),
        ("type: Bend", "type: Bent", "route.stations[0].type: there is no type Bent. Did you mean Bend?"),
        ("radius:", "radios:", "route.stations[0].radios: type Bend has no parameter radios. Did you mean radius?"),
        ("angle: 90 deg", "angle: 90 m", "route.stations[0].angle = 90 m is a length, not an angle."),
        ("line.inboard", "line.inbord", "line.inbord: ArrayModule has ports inboard, outboard, path. Did you mean line.inboard?"),
        ("line.path,", "line.pth,", "line.pth: ArrayModule has ports inboard, outboard, path. Did you mean line.path?"),
        ("line.path, route.path", "line.path, haul.flange", "a path can only be joined with a path."),
        ("  - [line.path, route.path]\n", "", "line.path is connected to nothing.\n    Join it with the path of a line or of a route."),
        ("line.outer[*].slip", "line.outr[*].slip", "record: no signal has the name line.outr[*].slip. Did you mean line.outer[*].slip?"),
        ("\nfriction: {", "\nfriction: {plateau_width: 9, ", "friction.ramp_width: ramp_width 4 is not above plateau_width 9."),
        ("\nfriction: {", "\nfriction: {viscous: 1 kg, ", "friction.viscous = 1 kg is a mass, not a damping coefficient."),
    ],
)  # fmt: skip
def test_a_mistake_in_a_line_on_a_route_is_told_without_its_inner_parts(tmp_path, right, wrong, says):
    text = fairlead.load("single_bend").netlist.path.read_text().replace("method: hold", "method: binding")
    assert right in text
    said = check(tmp_path, text.replace(right, wrong, 1))
    assert says in said
    assert "surface" not in said
    assert "_node" not in said
