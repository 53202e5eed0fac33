"""A class of a user's that answers wrongly is told with file, line, class, method, what it gave and what is allowed."""
# ruff: noqa: E501 - the tables of mistakes read best with one mistake a line

import re

import pytest

from fairlead.errors import ModelError

BOB = """
class Bob(Component):
    flange = Translational()
    mass = Parameter("kg", above=0)
    x, v, a = Output("m"), Output("m/s"), Output("m/s^2")

    def law(p, flange):
        return Law(flange=0, x=flange.x, v=flange.v, a=0)

    def {method}:
        {body}
"""
SCENE = """
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 10 N/m}
  bob: {type: Bob, mass: 1 kg}
connections: [[wall.flange, spring.a], [spring.b, bob.flange]]
run: {stop: 0.1 s}
"""
# (method, what it does, what the message says of it, what is allowed)
WRONG = [
    ("inertia(p)", "return 'heavy'", "Bob.inertia(p) gives 'heavy'.", "It gives a map from ports to finite numbers"),
    ("inertia(p)", "return p.mass", "Bob.inertia(p) gives 1.0.", "It gives a map from ports"),
    ("inertia(p)", "return None", "Bob.inertia(p) gives None.", "It gives a map from ports"),
    ("inertia(p)", "return {'flnge': p.mass}", "names the port 'flnge'; the ports are flange. Did you mean flange?",
     "It gives a map"),
    ("inertia(p)", "return {1: p.mass}", "names the port 1; the ports are flange.", "It gives a map"),
    ("inertia(p)", "return {'flange': '1 kg'}", "gives '1 kg' for flange, which is no amount of inertia.", "It gives a"),
    ("inertia(p)", "return {'flange': -p.mass}", "gives -1.0 for flange", "from 0 on"),
    ("inertia(p)", "return {'flange': float('nan')}", "gives nan for flange", "finite"),
    ("inertia(p)", "return {'flange': None}", "gives None for flange", "finite"),
    ("inertia(p)", "return {'flange': True}", "gives True for flange", "finite"),
    ("inertia(p)", "return {'flange': p.mas}", "Bob.inertia fails: AttributeError: Bob has no parameter 'mas'", ""),
    ("inertia(p)", "return {'flange': 1 / 0}", "Bob.inertia fails: ZeroDivisionError", "It gives a map"),
    ("start(p)", "return 0.1", "Bob.start(p) gives 0.1.", "(position, speed)"),
    ("start(p)", "return {'end': (0, 0)}", "names the port 'end'; the ports are flange.", "(position, speed)"),
    ("start(p)", "return {'flange': 0.5}", "gives 0.5 for flange; that is the pair (position, speed).", "(position, speed)"),
    ("start(p)", "return {'flange': (0, 0, 0)}", "gives (0, 0, 0) for flange; that is the pair (position, speed).", "(position, speed)"),
    ("start(p)", "return {'flange': ('1 m', None)}", "gives ('1 m', None) for flange; that is the pair", "(position, speed)"),
    ("ties(p)", "return ('flange', 'flange', 1, 0)", "gives 'flange', which is no tie.", "It gives ties (a, b, ratio"),
    ("ties(p)", "return (('flange', 'b', 1, 0),)", "names the port 'b'; the ports are flange.", "It gives ties"),
    ("ties(p)", "return (('flange', 'flange', 1, 0),)", "ties flange to itself.", "It gives ties"),
    ("ties(p)", "return None", "Bob.ties(p) gives None.", "It gives ties"),
    ("prescribes()", "return 'flange'", "Bob.prescribes() gives 'flange'.", "the names of their outputs"),
    ("prescribes()", "return {'flange': ('x', 'v')}", "gives ('x', 'v') for flange; that is 3 outputs or None.", "outputs"),
    ("prescribes()", "return {'flange': ('x', 'v', 'b')}", "names the output 'b'; the outputs are x, v, a.", "outputs"),
    ("check(p)", "yield 'mass is wrong'", "Bob.check(p) gives 'mass is wrong'.", "It yields three texts"),
    ("check(p)", "yield 'mas', 'is wrong', ''", "names the parameter 'mas'; there are mass. Did you mean mass?", "three"),
    ("check(p)", "return 'mass', 'is wrong', ''", "Bob.check(p) gives 'mass'.", "three texts"),
    ("check(p)", "return True", "Bob.check(p) gives True.", "three texts"),
    ("check(p)", "yield 'mass', p.mass > 3, ''", "gives ('mass', False, '').", "three texts"),
    ("prepare(given)", "given['mass'] = 2.0", "Bob.prepare(given) gives None.", "It gives a map of all parameters"),
    ("prepare(given)", "return {'mas': 2.0}", "names the parameter 'mas'", "It gives a map of all parameters"),
    ("prepare(given)", "return {}", "leaves out mass.", "It gives a map of all parameters"),
]


def told(scene, path, text=SCENE):
    """The faults of a scene with this library."""
    with pytest.raises(ModelError) as caught:
        scene(text, libraries=(path,)).check()
    return [str(fault) for fault in caught.value.faults]


@pytest.mark.parametrize(("method", "body", "says", "allows"), WRONG, ids=[f"{m} {b}"[:60] for m, b, *_ in WRONG])
def test_a_method_that_answers_wrongly_is_told_at_its_own_line(scene, library, method, body, says, allows):
    path = library(BOB.format(method=method, body=body))
    said = told(scene, path)
    assert len(said) == 1
    assert says in said[0]
    assert allows in said[0]
    assert re.search(r"classes0\.py:1[12]: ", said[0])


def test_a_class_that_answers_wrongly_is_told_once_and_beside_other_mistakes(scene, library):
    path = library(BOB.format(method="inertia(p)", body="return None"))
    text = SCENE.replace("10 N/m", "-10 N/m").replace("run:", "  ").replace("bob: {", "bub: {type: Bob, mass: 2}\n  bob: {")
    text = text.replace("{stop: 0.1 s}", "").replace("bob.flange]]", "bob.flange], [bub.flange, spring.b]]")
    said = told(scene, path, text)
    assert len([one for one in said if "gives None" in one]) == 1
    assert any("spring.stiffness = -10 N/m is out of range" in one for one in said)


LAWS = {
    "a text": ("return Law(a='far', b=0)", "law gives 'far', which is not a number"),
    "nothing": ("pass", "the law returns None; it returns what a, b take in, in a tuple or as Law(a=..., b=...)"),
    "a list": ("return [a.x, b.x]", "the law returns a list; it returns what a, b take in"),
    "a map": ("return {'a': 0, 'b': 0}", "the law returns a dict; it returns what a, b take in"),
    "too little": ("return a.x", "the law returns 1 flows for 2 ports ['a', 'b']"),
    "a port": ("return a, b", "law gives the port 'a', which is not a number; take one of its variables, such as a.x"),
    "what fails": ("return 1 / 0, 0", "law: ZeroDivisionError"),
    "a variable that a port has not": ("return a.y, 0", "the port 'a' has x, v, a"),
}


@pytest.mark.parametrize("name", LAWS)
def test_a_law_that_says_what_no_law_can_is_told_at_its_line(scene, library, name):
    body, says = LAWS[name]
    path = library(f"class Odd(Component):\n    a, b = Translational(), Translational()\n    def law(p, a, b):\n        {body}\n")
    text = SCENE.replace("type: Spring, stiffness: 10 N/m", "type: Odd").replace("type: Bob", "type: Mass")
    said = told(scene, path, text)
    assert len(said) == 1
    assert says in said[0]
    assert re.search(r"classes0\.py:[45]: ", said[0])


PAIR = """
from fairlead.components.mechanics.spring import Spring
from fairlead.components.friction.contact import Contact
class Pair(Composite):
    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", above=0)
    def expand(p, scene):
        {body}
"""
MADE = "one, two = (scene.make(Spring, stiffness=p.stiffness) for _ in range(2)); "
ENDS = "{'a': 'one.a', 'b': 'two.b'}"
EXPANSIONS = {
    "nothing": (MADE + "return None", "Pair.expand(p, scene) gives nothing."),
    "a map": (MADE + "return {'one': one}", "Pair.expand(p, scene) gives dict."),
    "a class as a child": (f"return Expansion({{'one': Spring}}, [], {ENDS})", "gives the child 'one' as type; children"),
    "a port left out": (MADE + "return Expansion({'one': one}, [], {'a': 'one.a'})", "leaves out the port b."),
    "a child that there is not": (MADE + f"return Expansion({{'one': one}}, [], {ENDS})", "there is no child 'two'."),
    "a port that a child has not": (
        MADE + f"return Expansion({{'one': one, 'two': two}}, [('one.c', 'two.a')], {ENDS})",
        "joins one.c, and Spring has a, b, tension, stretch.",
    ),
    "a connection that is a text": (
        MADE + f"return Expansion({{'one': one, 'two': two}}, ['one.b'], {ENDS})", "gives the connection 'one.b'"),
    "a parameter misspelt": (
        "return scene.make(Spring, stifness=p.stiffness)",
        "Pair.expand: scene.make(Spring), stifness: Spring has no parameter stifness. Did you mean stiffness?",
    ),
    "a value out of range": (
        "return scene.make(Spring, stiffness=-1.0)",
        "Pair.expand: scene.make(Spring), stiffness = -1.0 is out of range.",
    ),
    "a value of another kind": ("return scene.make(Spring, stiffness='10 kg')", "stiffness = 10 kg is a mass, not a"),
    "a name for a class": ("return scene.make('Spring', stiffness=1)", "scene.make takes a class such as Spring"),
    "a method that there is not": ("return scene.make(Contact, method='gleu', curve=0.3)", "there is no method gleu."),
    "what is no parameter": ("return p.stifness", "Pair.expand fails: AttributeError: Pair has no parameter 'stifness'"),
}  # fmt: skip


@pytest.mark.parametrize("name", EXPANSIONS)
def test_a_composite_that_cannot_be_placed_is_told_at_its_line(scene, library, name):
    body, says = EXPANSIONS[name]
    path = library(PAIR.format(body=body))
    text = SCENE.replace("type: Spring", "type: Pair").replace("type: Bob", "type: Mass")
    said = told(scene, path, text)
    assert len(said) == 1
    assert says in said[0]
    assert re.search(r"scene0\.yaml:6:\d+: spring: .*classes0\.py:[89]: ", said[0])


def test_a_derived_number_that_is_none_is_told_at_its_line(scene, library):
    text = BOB.format(method="inertia(p)", body="return {'flange': p.twice}") + (
        "    @derived\n    def twice(p):\n        return 'two'\n"
    )
    said = told(scene, library(text))
    assert re.search(r"classes0\.py:1\d: Bob\.twice gives 'two'", said[0])


CURVE = """
from fairlead.components.friction.curve import Curve
class Odd(Curve):
    m = Parameter("1", default=0.3)
    def coefficient(p, v):
        {coefficient}
    def {more}
"""
PAD = """
components:
  wall: {type: Ground}
  bob: {type: Mass, mass: 1 kg}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: odd}}
connections: [[wall.flange, pad.a], [pad.b, bob.flange]]
run: {stop: 0.1 s}
"""
OTHER = "other(p):\n        return 1"
CURVES = {
    "a text": ("return 'x'", OTHER, "Odd.coefficient gives 'x'. It gives a number: friction over normal force."),
    "nothing": ("pass", OTHER, "Odd.coefficient gives None. It gives a number"),
    "a breakaway of text": ("return p.m", "breakaway(p):\n        return 'x'", "Odd.breakaway gives 'x'. It gives a number"),
    "a scale of text": ("return p.m", "scale(p):\n        return 'x'", "Odd.scale gives 'x'."),
    "a branch": ("return p.m if v > 1 else 0", OTHER, "a law must not branch on values"),
}


@pytest.mark.parametrize("name", CURVES)
def test_a_part_that_gives_what_no_part_gives_is_told_at_its_line(scene, library, tmp_path, name):
    from typer.testing import CliRunner

    from fairlead.cli import app

    coefficient, more, says = CURVES[name]
    path = library(CURVE.format(coefficient=coefficient, more=more))
    said = " ".join(told(scene, path, PAD)[0].split())
    assert says in said
    assert re.search(r"classes0\.py:[5-8]: ", said)
    (tmp_path / "pad.yaml").write_text(f"schema: 1\nname: pad{PAD}")
    drawn = CliRunner().invoke(app, ["friction", str(tmp_path / "pad.yaml"), "--library", path, "--out", str(tmp_path)])
    assert drawn.exit_code in (0, 1)  # a branch may be drawn
