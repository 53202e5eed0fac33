"""Mistakes in calls from Python. The place is the argument or the call that is wrong."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from fairlead.components.mechanics.spring import Spring

import fairlead
from fairlead.component import Component, Composite, Expansion, Law, Parameter, Translational
from fairlead.testing import contract
from tests.mistakes.bases import PULLER
from tests.mistakes.entry import ERROR, Called, Mistake, words

Words = str | tuple[str, ...]


def call(name: str, what: Callable[[Any], object], place: Words, part: Words, cure: Words, answer: str = ERROR,
         files: Mapping[str, str] | None = None) -> Mistake:  # fmt: skip
    """A call with the desk of the user."""
    return Mistake(name, Called(what, files or {}), words(place), words(part), words(cure), answer)


def run(**settings: Any) -> Callable[[Any], object]:
    """Run the puller in memory, for a moment."""
    return lambda desk: desk.puller.run(**{"out": None, "stop": 0.1, **settings})


def values(**given: Any) -> Callable[[Any], object]:
    """Give the puller other values."""
    return lambda desk: desk.puller.with_values(**given)


class Chain(Composite):
    """One spring, one of whose parameters is misspelt."""

    a, b = Translational(), Translational()

    def expand(p: Any, scene: Any) -> Expansion:
        return Expansion({"link": scene.make(Spring, stifness=3.0)}, [], {"a": "link.a", "b": "link.b"})


def made(child: str) -> Callable[[Any], object]:
    """Check a scene with a composite of one's own that makes its only child so."""

    def check(desk: Any) -> object:
        library = desk.folder / "own.py"
        library.write_text(COMPOSITE.replace("CHILD", child), encoding="utf-8")
        return fairlead.load("springs.yaml", libraries=["own.py"]).check()

    return check


COMPOSITE = '''\
from fairlead.component import Composite, Expansion, Translational
from fairlead.components.mechanics.spring import Spring


class Own(Composite):
    """One spring."""

    a, b = Translational(), Translational()

    def expand(p, scene):
        return Expansion({"link": CHILD}, [], {"a": "link.a", "b": "link.b"})
'''

SPRINGS = {
    "springs.yaml": """\
schema: 1
components:
  wall: {type: Ground}
  own: {type: Own}
  block: {type: Mass, mass: 1 kg, velocity: 1 m/s}
connections:
  - [wall.flange, own.a]
  - [own.b, block.flange]
run: {stop: 1 s}
"""
}


class Backward(Component):
    """A spring that pushes its ends apart when it is stretched, and calls what it stores positive."""

    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", "Tension per stretch.", above=0)

    def law(p, a, b):
        pull = p.stiffness * (b.x - a.x)
        return Law(a=pull, b=-pull, stored=pull * (b.x - a.x) / 2)


LOADING = (
    call("a bundled model is misspelt", lambda desk: fairlead.load("bellt"), "bellt", "bellt", "belt"),
    call("a file has another ending", lambda desk: fairlead.load("puller.yml"), "puller.yml", "puller.yml",
         "puller.yaml"),
    call("the text of a netlist is given for its path", lambda desk: fairlead.load(PULLER), "schema: 1",
         "characters", ("file", "path")),
    call("a scene parameter is misspelt", lambda desk: fairlead.load("puller.yaml", set={"mue": "0.4"}), ("set",
         "--set"), "mue", "mu"),
    call("values are given as they are typed", lambda desk: fairlead.load("puller.yaml", set="mu=0.4"), "set", "mu=0.4",
         ("dict", "mapping", '{"mu": "0.4"}', "map")),
    call("a library is not there", lambda desk: fairlead.load("puller.yaml", libraries=["nothing.py"]),
         ("libraries", "nothing.py"), "nothing.py", ("file", "folder", "no such file", "does not exist", "not found")),
    call("a library is given as a text, not in a list", lambda desk: fairlead.load("puller.yaml",
         libraries="nothing.py"),
         ("libraries", "nothing.py"), "nothing.py", ("list", '["nothing.py"]', "no such file", "does not exist",
         "not found")),
    call("a component type is misspelt", lambda desk: fairlead.describe_type("Sprng"), "Sprng", "Sprng", "Spring"),
    call("a stage is misspelt", lambda desk: desk.puller.describe("flat"), ("stage", "describe"), "flat", "flatten"),
    call("a graph is asked for as a picture", lambda desk: desk.puller.graph("png"), ("format", "graph"), "png", "svg"),
)  # fmt: skip

RUNNING = (
    call("a setting is misspelt", run(acuracy=1e-2), ("acuracy", "run"), "acuracy", "accuracy"),
    call("an engine does not exist", run(engine="foo"), "engine", "foo", "rodas"),
    call("an accuracy of zero", run(accuracy=0), "accuracy", "0", ("1e-12", "above 0", "> 0", "greater than 0",
         "more than 0")),
    call("a run ends after kilograms", run(stop="5 kg"), "stop", "5 kg", ("s", "10 ms")),
    call("a run ends before it begins", run(stop=-1.0), "stop", "-1", ("after", "start", "above 0", "> 0", "positive")),
    call("a run goes on until True", run(stop=True), "stop", "True", ("number", "s", "10 ms")),
    call("ten and a half steps", run(max_steps=10.5), "max_steps", "10.5", ("whole", "whole number", "integer")),
    call("results go to the number 3", run(out=3), "out", "3", ("folder", "path", "None", "directory")),
    call("progress is a number", run(progress=3), "progress", "3", ("function", "None", "callable", "call")),
    call("force is a word", run(force="no"), "force", "no", ("True", "False")),
    call("statics of a length", lambda desk: desk.haul.statics(speed="0.3 m"), "speed", "0.3 m", "m/s"),
)  # fmt: skip

NEW_VALUES = (
    call("a new value of a misspelt parameter", values(mue=0.4), ("mue", "with_values"), "mue", "mu"),
    call("a new value of a misspelt setting", values(**{"pad.normal_forc": 30}), ("pad.normal_forc", "pad"),
         "normal_forc", "normal_force"),
    call("a new force in millimetres", values(**{"pad.normal_force": "30 mm"}), "pad.normal_force", "30 mm", "N"),
    call("a new value with a decimal comma", values(mu="0,4"), "mu", "0,4", ("0.4", "decimal point", "decimal comma")),
    call("a list of new values, to sweep them", values(mu=[0.3, 0.4]), "mu", "[0.3, 0.4]", ("one", "each", "loop",
         "a number")),
    call("a new value by a name that there is not, in a dict", lambda desk: desk.puller.with_values({"mue": 0.4}),
         "mue", "mue", "mu"),
    call("a new value of nothing", values(mu=None), "mu", "None", ("number", "a number", "text")),
)  # fmt: skip

READING = (
    call("a signal is misspelt", lambda desk: desk.result["blok.x"], "blok.x", "blok.x", "block.x"),
    call("a signal that was not recorded", lambda desk: desk.result["hand.force"], "hand.force", "hand.force",
         ("record", "recorded", "record.signals")),
    call("a signal by its number", lambda desk: desk.result[0], ("0", "result"), "0", ("name", "signals")),
    call("a value behind the end of the run", lambda desk: desk.result.at("block.x", 10.0), ("10", "10 s"), "10",
         ("0.2 s", "0.2")),
    call("a value on a side that there is not", lambda desk: desk.result.at("block.x", 0.1, side="middle"), "side",
         "middle", ("left", "right", "both")),
    call("name and time in the wrong order", lambda desk: desk.result.at(0.1, "block.x"), ("name", "at"), "0.1",
         ("name", "signal", "block.x")),
    call("a table of a name that is misspelt", lambda desk: desk.result.to_pandas("blok.x"), ("names", "blok.x"),
         "blok.x", "block.x"),
    call("a folder without results", lambda desk: fairlead.Result.open("nothing"), "nothing", "nothing",
         ("run", "folder", "directory", "no such")),
)  # fmt: skip

CLASSES = (
    call("the parameter of a child is misspelt", lambda desk: contract(Chain),
         ("make", "scene.make", "Spring"), "stifness", "stiffness"),
    call("the parameter of a child is a length", made('scene.make(Spring, stiffness="100 m")'),
         ("own", "own.py", "springs.yaml:4"), ("stiffness", "100 m"), ("N/m", "number"), files=SPRINGS),
    call("a child is made of a name", made('scene.make("Spring", stiffness=3.0)'),
         ("make", "scene.make", "own.py", "springs.yaml:4"), "Spring", ("class", "type"), files=SPRINGS),
    call("a force has the wrong sign", lambda desk: contract(Backward), "Backward", "energy", ("sign", "signs")),
)  # fmt: skip

class Lopsided(Component):
    """A spring whose law forgets its second end."""

    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", "Tension per stretch.", above=0)

    def law(p, a, b):
        return p.stiffness * (a.x - b.x)


LATER = (
    call("a start value in newtons", lambda desk: fairlead.load("puller.yaml", set={"initial.block.x": "3 N"}),
         ("set", "--set", "initial.block.x"), ("block.x", "3 N"), ("m", "mm", "35 mm")),
    call("a signal of no line is asked for by element", lambda desk: desk.result.elements("block.x"), ("elements",
         "block.x"), "block.x", ("[*]", "families", "families()")),
    call("text goes into a folder that is not there", lambda desk: desk.result.to_csv("nowhere/block.csv"),
         "nowhere/block.csv", "nowhere", ("folder", "directory")),
    call("a figure ends before it begins", lambda desk: desk.result.plot("block.x", between=(0.2, 0.1)), "between",
         "0.2", ("before", "after", "first", "swap", "later", "earlier")),
    call("a figure of a format that there is not", lambda desk: desk.result.plot("block.x", file="block.xyz"),
         "block.xyz", "xyz", ("png", "svg", "pdf")),
    call("a scene without a line is asked for its statics", lambda desk: desk.puller.statics(), ("statics", "puller"),
         "line", ("route", "docs/routes.md")),
    call("a run is stepped back", lambda desk: desk.puller.start().advance(-1.0), "advance", "-1", ("0", "after",
         "later", "above 0", "positive")),
    call("switches of a part that there is not", lambda desk: desk.result.switches("pda"), ("switches", "pda"), "pda",
         "pad"),
    call("a coefficient of friction in newtons", values(mu="0.3 N"), ("mu", "pad"), ("pad", "0.3 N"), ("number",
         "without a unit", "plain")),
    call("a law forgets one of its ports", lambda desk: contract(Lopsided), ("law", "Lopsided"), ("1", "2", "a", "b"),
         ("ports", "(a, b)", "Law(a=..., b=...)")),
)  # fmt: skip

MISTAKES = LOADING + RUNNING + NEW_VALUES + READING + CLASSES + LATER
