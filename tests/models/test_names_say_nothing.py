"""What things are called decides nothing: contacts, and what a class of a library has for parameters and zones."""

import pathlib
import re

import fairlead.components
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.analysis.characteristic import characteristic
from fairlead.analysis.cost.meshes import meshes
from fairlead.analysis.effects.switches import switches
from fairlead.analysis.remarks.statics_record import record
from fairlead.analysis.statics.fastest import motors
from fairlead.analysis.statics.laid_route import laid_routes
from fairlead.analysis.statics.solution import statics
from fairlead.analysis.treatments.treatments import contacts, creep, creep_of, kinds_of_treatment
from fairlead.cli import app
from fairlead.component.answers import METHODS
from fairlead.integrate import Run, integrate

NAMES = {"numbers": "012345", "letters": "abcdef", "words": ("left", "right", "7up", "in0", "out", "pad")}


def pads(names):
    """Blocks in a chain on pads, drawn to and fro by a spring; stiction above sliding friction."""
    lines, joins = ["floor: {type: Ground}"], [["floor.flange"]]
    for k, name in enumerate(names):
        load = f"normal_force: {8 + k} N, curve: {{stiction: {0.5 + 0.02 * k}, coulomb: 0.4}}"
        lines.append(f"block{k}: {{type: Mass, mass: 1 kg}}")
        lines.append(f"pad_{name}: {{type: Contact, {load}}}")
        lines.append(f"link{k}: {{type: SpringDamper, stiffness: {900 + 60 * k} N/m, damping: 2 N*s/m}}")
        joins[0].append(f"pad_{name}.a")
        joins.append([f"block{k}.flange", f"pad_{name}.b", f"link{k}.a"] + ([f"link{k - 1}.b"] if k else []))
    lines.append("hand: {type: MotionSource, position: {sine: {amplitude: 60 mm, frequency: 0.7 Hz}}}")
    joins.append([f"link{len(names) - 1}.b", "hand.flange"])
    wiring = "".join(f"\n  - [{', '.join(ports)}]" for ports in joins)
    parts = "\n  ".join(lines)
    return (
        f"schema: 1\nname: pads\ncomponents:\n  {parts}\nconnections:{wiring}\nfriction: {{method: hold}}\n"
        "run: {stop: 3 s, accuracy: 1e-4}\n"
    )


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_contacts_by_other_names_take_the_same_steps_bit_for_bit(tmp_path, engine):
    told = []
    for names in NAMES.values():
        path = tmp_path / "pads.yaml"
        path.write_text(pads(names), encoding="utf-8")
        outcome = integrate(fairlead.load(path).system, Run(stop=3.0, engine=engine))
        assert outcome.ok, outcome.sentence
        counts = {key: value for key, value in vars(outcome.counters).items() if isinstance(value, int)}
        assert counts["switches"] > 20
        told.append((outcome.times.tobytes(), outcome.values.tobytes(), outcome.events.tobytes(), counts))
    assert told[0] == told[1] == told[2]


def test_machines_of_one_class_variant_are_of_one_kind_and_others_are_not(tmp_path):
    path = tmp_path / "pads.yaml"
    exact = "curve: {stiction: 0.52, coulomb: 0.4}"
    path.write_text(pads("abc").replace(exact, "curve: 0.4, method: lugre"), encoding="utf-8")
    system = fairlead.load(path).system
    kind = dict(zip(system.machine_names, system.machine_kind.tolist(), strict=True))
    assert kind["pad_a"] == kind["pad_c"]
    assert len({kind["pad_a"], kind["pad_b"], kind["hand"]}) == 3


GREASE = """
    from fairlead.component import Choice, Component, Law, Output, Parameter, Translational, tanh

    class Grease(Component):
        '''Drags like a sticky fluid.'''
        {a}, {b} = Translational("one side"), Translational("the other side")
        {speed} = Parameter("m/s", "Speed over which it yields.", default=1e-3, above=0)
        {more} = Parameter("1", "Of no use.", default=0.5)
        {force} = Output("N", "Drag.")

        def law(p, {a}, {b}):
            drag = 5 * tanh(({b}.v - {a}.v) / p.{speed})
            return Law({a}=-drag, {b}=drag, {force}=drag, dissipated=drag * ({b}.v - {a}.v))
"""
GREASED = """
    components:
      wall: {{type: Ground}}
      grease: {{type: Grease}}
      block: {{type: Mass, mass: 1 kg, velocity: 0.2 m/s}}
      spring: {{type: Spring, stiffness: 100 N/m}}
    connections: [[wall.flange, grease.{a}, spring.a], [grease.{b}, spring.b, block.flange]]
    run: {{stop: 2 s, accuracy: 1e-3}}
"""
PLAIN = {"a": "left", "b": "right", "speed": "pace", "more": "other", "force": "pull"}
LOADED = [
    {"a": "a", "b": "b", "speed": "creep", "more": "curve", "force": "friction"},
    {"a": "a", "b": "b", "speed": "band", "more": "normal_force", "force": "creep_rate"},
    {"a": "b", "b": "a", "speed": "stick_speed", "more": "clamp", "force": "stored"},
    {"a": "flange", "b": "node", "speed": "displacement", "more": "constant", "force": "law_"},
]
"""Names that contacts, motors and devices of the library have."""


@pytest.mark.parametrize("names", LOADED, ids=lambda names: names["speed"])
def test_a_class_with_the_words_of_a_contact_is_none(scene, library, names):
    told = []
    for each in (PLAIN, names):
        model = scene(GREASED.format(**each), (library(GREASE.format(**each)),))
        outcome = integrate(model.system, Run(stop=2.0, accuracy=1e-3))
        assert outcome.ok, outcome.sentence
        told.append((outcome.times.tobytes(), outcome.y.tobytes(), outcome.counters.steps))
        assert contacts(model) == []
        assert creep_of(model) is None
        assert motors(model.flat, {0: 1.0}) == []
    assert told[0] == told[1]


SWITCHING = """
    from fairlead.component import Component, Law, Parameter, Translational, Zones, guard, zone

    class Kinked(Component):
        '''A spring of two stiffnesses.'''
        a, b = Translational(), Translational()
        zones = Zones("{soft}", "{hard}")

        @zone("{soft}")
        def {soft}(p, a, b):
            return 0.0 * (b.x - a.x), 0.0

        @zone("{hard}")
        def {hard}(p, a, b):
            tension = 400.0 * (b.x - a.x)
            return Law(a=-tension, b=tension, stored=200.0 * (b.x - a.x) ** 2)

        @guard("{soft}", to="{hard}", unit="m")
        def {up}(p, a, b):
            return b.x - a.x

        @guard("{hard}", to="{soft}", unit="m")
        def {down}(p, a, b):
            return a.x - b.x
"""
BOUNCING = """
    components:
      wall: {type: Ground}
      kinked: {type: Kinked}
      back: {type: Spring, stiffness: 50 N/m}
      block: {type: Mass, mass: 1 kg, velocity: 0.2 m/s}
    connections: [[wall.flange, kinked.a, back.a], [kinked.b, back.b, block.flange]]
    run: {stop: 1 s}
"""


@pytest.mark.parametrize("start", range(0, len(METHODS), 4))
def test_zone_laws_and_guards_may_have_the_names_of_what_the_framework_asks_for(scene, library, start):
    told = []
    for words in (("soft", "hard", "up", "down"), [*METHODS, *METHODS][start : start + 4]):
        given = dict(zip(("soft", "hard", "up", "down"), words, strict=True))
        model = scene(BOUNCING, (library(SWITCHING.format(**given)),))
        outcome = integrate(model.system, Run(stop=1.0))
        assert outcome.ok, outcome.sentence
        assert outcome.counters.switches > 2
        told.append((outcome.times.tobytes(), outcome.y.tobytes(), outcome.counters.steps))
    assert told[0] == told[1]


DEVICES = """
    from fairlead.components.route.deployer import Deployer
    from fairlead.components.route.pulley import Pulley
    from fairlead.components.route.sea import Sea
    from fairlead.components.route.winch import Winch

    class Reel(Winch):
        word = "Reel"

    class Sheave(Pulley):
        word = "Sheave"

    class Tracks(Deployer):
        word = "Tracks"

    class Lake(Sea):
        word = "Lake"
"""
WORDS = {"Winch": "Reel", "Pulley": "Sheave", "Deployer": "Tracks", "Sea": "Lake"}
ROUTE = """
    components:
      rope: {type: Cable, length: 24 m, element: 0.125 m, start: -10 m, mass: 0.5 kg/m, stiffness: 1 MN}
      route:
        type: Route
        stations:
          - {type: Winch, start: 0 m, radius: 0.5 m, name: drum}
          - {type: Straight, length: 1 m}
          - {type: Pulley, angle: 90 deg, radius: 0.6 m, friction: 0.3, bearing: {friction: 0.1}, name: wheel}
          - {type: Deployer, length: 1.5 m, friction: 0.5, clamp: 2 kN/m, name: belts}
          - {type: Sea, start: 6 m, speed: 3 m/s, tail: 300 N, name: water}
      haul: {type: MotionSource, velocity: {ramp: {to: 0.3 m/s, over: 1 s}}}
      brake: {type: ForceSource, force: -200 N}
    connections:
      - [rope.path, route.path]
      - [haul.flange, route.belts.belt]
      - [brake.flange, route.drum.rim]
    run: {stop: 3 s}
"""


def test_a_device_that_builds_on_another_counts_as_that_under_any_word(scene, library):
    """A drum, a pulley, belts and a sea of a library: statics says of them what it says of ours."""
    text = ROUTE
    for word, other in WORDS.items():
        text = text.replace(f"type: {word},", f"type: {other},")
    models = [scene(ROUTE), scene(text, (library(DEVICES),))]
    routes = [laid_routes(model.flat)[0] for model in models]
    assert all(one.winch is not None and len(one.seas) == 1 for one in routes)
    states = [statics(model.flat)[0].moving for model in models]
    tensions = [[one.tension.tolist() for state in found for one in state.passages] for found in states]
    assert tensions[0] == tensions[1]
    drives = [[(one.force, one.capacity, one.lever) for state in found for one in state.drives] for found in states]
    assert drives[0] == drives[1]
    assert any(capacity for _, capacity, _ in drives[0])


def test_only_the_settings_of_contacts_are_changed_with_the_treatment(scene, library):
    """What another component calls `creep` is its own affair."""
    model = scene(GREASED.format(**LOADED[0]).replace("Grease}", "Grease, creep: 2 mm/s}"),
                  (library(GREASE.format(**LOADED[0])),))  # fmt: skip
    assert creep(model, 1e-5) == {"friction.creep": "1e-05"}


def copied(*files, **words):
    """Bundled classes as those of a library, each word of `words` replaced."""
    folder = pathlib.Path(next(iter(fairlead.components.__path__)))
    text = "\n".join((folder / file).read_text(encoding="utf-8") for file in files)
    modules = "|".join(file.removesuffix(".py").replace("/", r"\.") for file in files)
    text = re.sub(rf"^from fairlead\.components\.({modules}) import .*\n|^from __future__.*\n", "", text, flags=re.M)
    return re.sub(rf"\b({'|'.join(words)})\b", lambda found: words[found[0]], text)


ROD = """
    parameters: {{count: 12}}
    components:
      rod: {{type: {kind}, {blocks}: "{{count}}", mass: 1 kg, axial_stiffness: 1 kN, friction: 2 N}}
      hand: {{type: MotionSource, velocity: 0.1 m/s}}
    connections: [[rod.end, hand.flange]]
    run: {{stop: 1 s}}
"""
HAWSER = copied("line/cable.py", Cable="Hawser", element="piece", graded="pieces", side_wall="bears",
                ruck_force="buckles", profile="begins").replace("laid = LaidLine", "laid = Laid") + """

class Laid(LaidLine):
    ruck_force = property(lambda self: self.values.buckles)
    side_wall = property(lambda self: self.values.bears)
    begins_sliding = property(lambda self: self.values.begins == "statics")
"""  # fmt: skip
LINE = """
    parameters: {{fine: 0.25 m, also: "{{fine}}"}}
    components:
      rope: {{type: {kind}, length: 12 m, {element}: "{{also}}", start: -6 m, tension: 150 N, mass: 0.5 kg/m,
             stiffness: 1 MN, compression: carried, {side_wall}: 100 N/m, {ruck_force}: 90 N, bend_radius: 0.1 m,
             {profile}: statics}}
      route:
        type: Route
        stations:
          - {{type: Winch, start: 0 m, radius: 0.5 m, name: drum}}
          - {{type: Bend, start: 1 m, angle: 90 deg, radius: 0.6 m, friction: 0.3, name: bend}}
      haul: {{type: MotionSource, velocity: 0.3 m/s}}
      brake: {{type: ForceSource, force: -200 N}}
    connections:
      - [rope.path, route.path]
      - [haul.flange, rope.outboard]
      - [brake.flange, route.drum.rim]
    run: {{stop: 3 s}}
"""
OURS = {name: name for name in ("element", "side_wall", "ruck_force", "profile")}
THEIRS = {"element": "piece", "side_wall": "bears", "ruck_force": "buckles", "profile": "begins"}


def test_elements_are_found_where_a_class_declares_them(scene, library):
    """A scene parameter is set for what a component takes from it, whatever either is called."""
    rods = scene(ROD.format(kind="RodOnGuides", blocks="blocks")), scene(
        ROD.format(kind="Rod", blocks="pieces"),
        (library(copied("line/rod_on_guides.py", RodOnGuides="Rod", blocks="pieces")),),
    )  # fmt: skip
    assert [dict(meshes(rod, [2])[0].settings) for rod in rods] == [{"count": "24"}] * 2
    ropes = scene(LINE.format(kind="Cable", **OURS)), scene(LINE.format(kind="Hawser", **THEIRS), (library(HAWSER),))
    assert [dict(meshes(rope, [2])[0].settings) for rope in ropes] == [{"fine": "0.125"}] * 2
    doubled = scene(LINE.format(kind="Cable", **OURS).replace('"{also}"', '"{2*fine}"'))
    assert dict(meshes(doubled, [2])[0].settings) == {"rope.element": "0.25"}  # `fine` may mean something else
    unsaid = scene(ROD.format(kind="RodOnGuides", blocks="blocks").replace('blocks: "{count}", ', ""))
    assert dict(meshes(unsaid, [2])[0].settings) == {"rod.blocks": "200"}


def test_what_a_line_bears_is_told_by_the_line(scene, library):
    told = []
    for kind, words, files in (("Cable", OURS, ()), ("Hawser", THEIRS, (library(HAWSER),))):
        model = scene(LINE.format(kind=kind, **words), files)
        found = record(statics(model.flat)[0])
        assert found["limits"] == {"side_wall": 100.0, "ruck_force": 90.0}
        lengths = [one.values.length for one in model.flat.instances if "line[" in one.path]
        told.append((found["states"], found["remarks"], lengths))
    assert told[0] == told[1]
    assert any("more than rope bears" in remark for remark in told[0][1])
    assert len(set(told[0][2])) > 5  # elements of their own, for the tensions of statics


def test_only_physics_is_left_out_by_the_study_of_effects(scene, library):
    """Not where a line may be bent, nor what it starts with, nor how fine it is."""
    files = (library(HAWSER),)
    models = scene(LINE.format(kind="Cable", **OURS)), scene(LINE.format(kind="Hawser", **THEIRS), files)
    found = [{one.label for one in switches(model)} for model in models]
    renamed = {label.replace("buckles", "ruck_force").replace("begins", "profile") for label in found[1]}
    assert found[0] == renamed
    assert "rope.ruck_force absent" in found[0]
    assert not any(name in label for label in found[0] for name in ("side_wall", "bend_radius", "element"))


PAD = """
    components:
      floor: {{type: Ground}}
      block: {{type: Mass, mass: 1 kg, position: 1 m}}
      pad: {{type: Contact, normal_force: 10 N, curve: {curve}{method}}}
      hand: {{type: ForceSource, force: 3 N}}
    connections: [[floor.flange, pad.a], [pad.b, block.flange, hand.flange]]
    run: {{stop: 1 s}}
"""


def test_a_curve_says_what_its_level_is(scene, library):
    plain = "{curve: stribeck, stiction: 0.5, coulomb: 0.4, velocity: 20 mm/s}"
    other = "{curve: sloping, stiction: 0.5, kinetic: 0.4, velocity: 20 mm/s}"
    files = (library(copied("friction/stribeck.py", Stribeck="Sloping", Tustin="Steep", coulomb="kinetic")),)
    for curve in (plain, other):
        (flat,) = [one for one in switches(scene(PAD.format(curve=curve, method=""), files)) if one.kind == "curve"]
        assert dict(flat.settings) == {"pad.curve": "0.4"}
    shared = PAD.format(curve=0.3, method="").replace(", curve: 0.3", "") + f"    friction: {{curve: {plain}}}\n"
    (flat,) = [one for one in switches(scene(shared)) if one.kind == "curve"]
    assert dict(flat.settings) == {"friction.curve": "0.4"}


def test_a_contact_says_how_it_sticks(scene, library):
    kinds = kinds_of_treatment(scene(PAD.format(curve=0.3, method="")))
    assert (kinds.exact, kinds.creeping, kinds.never_sticking) == ("hold", "binding", "tanh")
    files = (library(copied("friction/bristles.py", "friction/dahl.py", Dahl="Bent", ratio="stiff", z="bend",
                            presliding="give")),)  # fmt: skip
    one = scene(PAD.format(curve=0.3, method=", method: dahl, presliding: 1 mm"))
    two = scene(PAD.format(curve=0.3, method=", method: bent, give: 1 mm"), files)
    found = [characteristic(contacts(model)[0].values, 10.0) for model in (one, two)]
    assert found[0].stiffness == found[1].stiffness == pytest.approx(3000.0)


@pytest.mark.slow
def test_a_water_says_how_it_flows_and_drags(scene, library):
    words = {"Sea": "Tide", "form": "shape", "speed": "stream", "margin": "apart", "tail": "end"}
    files = (library(copied("route/tow.py", "route/sea.py", **words)),)
    other = ROUTE.replace("Sea, start: 6 m, speed: 3 m/s, tail", "Tide, start: 6 m, stream: 3 m/s, end")
    states = [statics(model.flat)[0].moving for model in (scene(ROUTE), scene(other, files))]
    tensions = [[one.tension.tolist() for state in found for one in state.passages] for found in states]
    assert tensions[0] == tensions[1]
    (far,) = [one for one in switches(scene(other, files)) if "water" in one.name]
    assert dict(far.settings) == {"route.stations[4].shape": "rigid"}


@pytest.mark.slow
def test_a_contact_says_what_presses_it(library, tmp_path):
    """Drawn from what its family declares, whatever ports, input, zone and curve are called."""
    words = {"Contact": "Touch", "a": "floor", "b": "shoe", "normal": "press", "off": "apart", "curve": "grip_of"}
    own = copied("friction/contact.py", "friction/one_formula.py", "friction/regularised.py", **words)
    own = own.replace('word = "tanh"', 'word = "soft"').replace(".friction.grip_of", ".friction.curve")
    told = [
        CliRunner().invoke(app, ["friction", "0.4", "--method", method, "--out", str(tmp_path), *own_library]).output
        for method, own_library in (("tanh", []), ("soft", ["--library", library(own)]))
    ]
    assert told[0] == told[1].replace("soft", "tanh")
    assert "holding capacity  0.4 N" in told[0]
