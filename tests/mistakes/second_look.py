"""More than fifty mistakes, written from the list of functions and the pages, by another than the first.

They try what the first hundred and seventy leave out: a call of the right kind with an argument of the wrong one,
things that are asked for too early or of the wrong object, and what a newcomer typed in three scenes of his own.
"""

from __future__ import annotations

import io
from typing import Any

import numpy as np

import fairlead
from fairlead.component import Component, Law, Output, Parameter, Translational, Zones, guard, zone
from fairlead.testing import contract
from tests.mistakes.bases import PULLER
from tests.mistakes.command_mistakes import command
from tests.mistakes.entry import EITHER
from tests.mistakes.netlist_mistakes import scene
from tests.mistakes.python_mistakes import call, run, values


def stepped(*, inputs: Any = (), **settings: Any) -> Any:
    """A function that begins a run of the puller, which another steps."""
    return lambda desk: desk.puller.start(inputs, **settings)


def step(what: Any) -> Any:
    """A function that does `what` with a run of the puller that has begun."""
    return lambda desk: what(desk.puller.start())


class Missing(Component):
    """A spring that forgets to say one of its outputs."""

    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", "Tension per stretch.", above=0)
    tension = Output("N", "Tension.")

    def law(p: Any, a: Any, b: Any) -> Law:
        pull = p.stiffness * (b.x - a.x)
        return Law(a=-pull, b=pull, stored=pull * (b.x - a.x) / 2)


class Astray(Component):
    """A stop, one of whose guards leads to a zone that there is not."""

    a = Translational()
    stiffness = Parameter("N/m", "Force per way beyond.", above=0)
    zones = Zones("free", "touching")

    @zone("free")
    def off(p: Any) -> Law:
        return Law(a=0)

    @zone("touching")
    def on(p: Any, a: Any) -> Law:
        return Law(a=p.stiffness * a.x)

    @guard("free", to="touching", unit="m")
    def meets(p: Any, a: Any) -> Any:
        return a.x

    @guard("touching", to="free", unit="m")
    def parts(p: Any, a: Any) -> Any:
        return -a.y


LOADING = (
    call("a netlist is loaded from a file object", lambda desk: fairlead.load(io.StringIO(PULLER)), "load", "path",
         ("path", "name")),
    call("a folder is loaded", lambda desk: fairlead.load("."), (".", "load"), (), ("file", "netlist")),
    call("overrides as pairs", lambda desk: fairlead.load("puller.yaml", set=[("mu", 0.4)]), "set", "mu",
         ("dict", "map", '{"mu": 0.4}', "mapping")),
    call("an override that is a list of numbers", lambda desk: fairlead.load("puller.yaml", set={"mu": [0.3, 0.4]}),
         ("set", "--set"), "mu", ("number", "one")),
    call("an override with the unit of another", lambda desk: fairlead.load("puller.yaml",
         set={"spring.stiffness": "400 N"}), ("set", "--set"), ("spring.stiffness", "400 N"), "N/m"),
    call("a setting of the run by its short name", lambda desk: fairlead.load("puller.yaml", set={"stop": "5 s"}),
         ("set", "--set"), "stop", "run.stop"),
    call("a method of friction that there is not", lambda desk: fairlead.load("puller.yaml",
         set={"pad.method": "holds"}), ("set", "--set", "pad.method"), "holds", "hold"),
    call("an array as a value", lambda desk: fairlead.load("puller.yaml", set={"mu": np.array([0.3, 0.4])}),
         ("set", "--set"), "mu", ("number", "one")),
)  # fmt: skip

RUNNING = (
    call("a time that is not a number", run(stop=float("nan")), "stop", "nan", ("number", "finite", "10 ms")),
    call("settings in a dict", lambda desk: desk.puller.run({"stop": 0.1}), ("out", "run"), "stop",
         ("folder", "stop=", "path", "run(stop=0.1)")),
    call("the grid of the record as an argument", run(every="10 ms"), ("every", "run"), "every", "record.every"),
    call("what to record as an argument", run(signals=["block.x"]), ("signals", "run"), "signals", "record.signals"),
    call("a parameter of the scene as a setting", run(mu=0.4), ("mu", "run"), "mu", "with_values"),
    call("a parameter of a part as a setting", run(**{"pad.normal_force": 30}), ("pad.normal_force", "run"),
         "pad.normal_force", "with_values"),
    call("an accuracy in metres", run(accuracy="1 mm"), "accuracy", "1 mm", ("number", "without a unit")),
    call("an accuracy above one", run(accuracy=5), "accuracy", "5", ("below", "less", "at most", "1")),
    call("a largest step of nothing", run(max_step=0), "max_step", "0", ("above 0", "> 0", "greater than 0",
         "more than 0")),
    call("an engine by its class", run(engine=dict), "engine", "dict", "rodas"),
    call("a method of integration that there is not", run(method="rk45"), "method", "rk45", "rodas5p"),
)  # fmt: skip

VALUES = (
    call("a value of the right name and the wrong part", values(**{"block.stiffness": 3}), "block",
         "stiffness", ("mass", "spring.stiffness", "spring")),
    call("a value that no Mass can have", values(**{"block.mass": -1}), "block.mass", "-1", ("above 0", "> 0",
         "greater than 0", "more than 0")),
    call("a number that is none", values(mu=float("nan")), "mu", "nan", ("number", "finite")),
    call("a whole model as new values", lambda desk: desk.puller.with_values(desk.puller), ("with_values", "values"),
         "Model", ("dict", "mapping", '{"mu": 0.4}', "map")),
)  # fmt: skip

READING = (
    call("a result is asked for a parameter", lambda desk: desk.result["pad.normal_force"], "pad.normal_force",
         "pad.normal_force", ("recorded", "signals", "pad.slip")),
    call("a pattern where one name is meant", lambda desk: desk.result["block.*"], "block.*", "block.*",
         ("match", "to_pandas", "block.x")),
    call("a time in words", lambda desk: desk.result.at("block.x", "half"), ("t", "at", "half"), "half",
         ("number", "10 ms", "0.5 s", "s")),
    call("a time in metres", lambda desk: desk.result.at("block.x", "0.1 m"), ("t", "at", "0.1 m"), "0.1 m",
         ("seconds", "s", "0.1 s")),
    call("extremes of a misspelt signal", lambda desk: desk.result.extremes("blok.x"), ("blok.x", "extremes"),
         "blok.x", "block.x"),
    call("a column that a table has not", lambda desk: desk.result.switches()["zone"], ("zone", "column"), "zone",
         "zone_from"),
    call("a row behind the last one", lambda desk: desk.result.switches()[99], ("99", "row", "rows"), "99", ("row",
         "rows")),
    call("a figure of a misspelt signal", lambda desk: desk.result.plot("blok.x"), "blok.x", "blok.x", "block.x"),
    call("a figure between one time", lambda desk: desk.result.plot("block.x", between=0.1), "between", "0.1",
         ("(0, 1)", "two", "pair", "from and to", "begin and end")),
    call("a workbook that is a text file", lambda desk: desk.result.to_excel("block.csv"), ("block.csv", "to_excel"),
         "csv", "xlsx"),
    call("the file of the series is opened", lambda desk: fairlead.Result.open("puller.yaml"), "puller.yaml",
         "puller.yaml", ("folder", "run.json", "run")),
)  # fmt: skip

GUESSED = (
    call("a signal as an attribute", lambda desk: desk.result.block.x, "Result", "block", 'result["block.x"]'),
    call("the last word of a signal as an attribute", lambda desk: desk.result.slip, "Result", "slip",
         'result["pad.slip"]'),
    call("the times by another name", lambda desk: desk.result.time, "Result", "time", "Did you mean t?"),
    call("a table by the name of another package", lambda desk: desk.result.to_dataframe(), "Result", "to_dataframe",
         "to_pandas()"),
    call("a misspelt method of a result", lambda desk: desk.result.swiches(), "Result", "swiches", "switches"),
    call("a model is simulated", lambda desk: desk.puller.simulate(), "Model", "simulate", "run()"),
    call("a parameter is set", lambda desk: desk.puller.set(mu=0.3), "Model", "set", "with_values(...)"),
)  # fmt: skip

STEPPING = (
    call("a run of no such input", stepped(inputs=["hands"]), ("inputs", "hands"), "hands", ("interface", "hand")),
    call("an input that a run has not", step(lambda going: going.set("mu", 0.4)), ("set", "mu"), "mu", ("tunable",
         "inputs", "interface")),
    call("a signal that a run has not", step(lambda going: going.get("blok.x")), ("get", "blok.x"), "blok.x",
         "block.x"),
    call("a run goes on by kilograms", step(lambda going: going.advance("1 kg")), ("advance", "1 kg"), "1 kg", ("s",
         "10 ms", "5 s")),
    call("a state that is none", step(lambda going: going.restore({"t": 0})), ("restore", "state"), "dict", "save"),
    call("a tunable parameter that there is not", stepped(tunable=["pad.normal_forc"]), ("tunable", "pad"),
         "normal_forc", "normal_force"),
    call("modes about a contact that there is not", lambda desk: fairlead.modes(desk.puller, zones={"pda": "held"}),
         ("zones", "pda"), "pda", "pad"),
)  # fmt: skip

CLASSES = (
    call("a law forgets one of its outputs", lambda desk: contract(Missing), ("law", "Missing"), "tension",
         ("Law(", "tension=...", "give")),
    call("a guard asks a port for what it has not", lambda desk: contract(Astray), ("parts", "Astray"), "y",
         ("x", "x, v", "x and v")),
)  # fmt: skip

NETLISTS = (
    scene("a spring that is joined with itself", "puller", ("spring.a]", "spring.a, spring.b]"), part="spring",
          at=("spring.a, spring.b", "spring.b, hand"),
          cure=("remove", "leave", "other", "two", "once", "mean"), answer=EITHER),
    scene("a unit behind a unit", "puller", ("400 N/m", "400 N/m/m"), part=("stiffness", "N/m/m"), cure="N/m"),
    scene("a bend by its length", "haul", ("angle: 90 deg,", "length: 90 deg,"), part="length", cure="angle"),
    scene("a sample time of nothing", "servo", ("period: 10 ms", "period: 0 s"), part=("control", "period"),
          cure=("above 0", "> 0", "greater than 0", "more than 0")),
    scene("stiction below the sliding friction", "drill", ("stiction: 0.8", "stiction: 0.3"),
          part=("stiction", "0.3"), cure=("coulomb", "raise")),
    scene("a parameter without its braces", "puller", ('"{mu}"', "{curve: coulomb, coulomb: mu}"),
          part=("pad", "mu"), cure='"{mu}"'),
    scene("the end of a run without its braces", "puller", ("stop: 2 s", "stop: speed"), part=("run.stop", "speed"),
          cure='"{speed}"'),
    scene("a unit without a sign between its parts", "drill", ("moment: 5 kg*m^2", "moment: 5 kgm^2"),
          part=("table", "kgm"), cure="kg*m"),
    scene("the only end of a part by another name", "drill", ("flywheel.shaft, clutch", "flywheel.flange, clutch"),
          part="flywheel.flange", cure="flywheel.shaft"),
)  # fmt: skip

COMMANDS = (
    command("a run of two models", "run", "puller.yaml", "drill.yaml", place="drill.yaml", part="drill.yaml",
            cure=("one", "Usage", "each")),
    command("an override behind two dashes", "run", "puller.yaml", "--mu", "0.4", place="--mu", part="--mu",
            cure=("--set", "mu=0.4")),
    command("a setting of the run as an option", "run", "puller.yaml", "--max-step", "1e-3", place="--max-step",
            part="--max-step", cure=("run.max_step", "run.max_step=VALUE")),
    command("a quantity as two words", "effects", "puller.yaml", "--from", "3", "s", place=("s", "(s)"), part="s",
            cure=("quotes", "'3 s'")),
)  # fmt: skip

PYTHON = LOADING + RUNNING + VALUES + READING + GUESSED + STEPPING + CLASSES
