"""Thirty mistakes more, half of them in netlists, written before the answers were looked at.

They are what one types who knows another tool: units as they are spoken, blocks of another format, calls of numpy.
"""

from __future__ import annotations

import datetime

import numpy as np

from tests.mistakes.netlist_mistakes import scene
from tests.mistakes.python_mistakes import call, run, values

NETLISTS = (
    scene("a speed in kilometres an hour, as it is spoken", "puller", ("speed: 50 mm/s", "speed: 50 kmh"),
          part=("speed", "kmh"), cure="km/h"),
    scene("a stiffness in kilograms for a millimetre", "puller", ("400 N/m", "0.04 kg/mm"),
          part=("stiffness", "kg/mm"), cure=("N/m", "N/mm")),
    scene("a moment of inertia in kilograms times centimetres", "drill", ("moment: 2 kg*m^2", "moment: 2 kg*cm"),
          part=("flywheel", "moment", "kg*cm"), cure=("kg*m^2", "kg m^2")),
    scene("a percentage in words", "puller", ("mu: 0.3", "mu: 30 per cent"), part=("mu", "per cent"),
          cure=("%", "0.3", "number")),
    scene("a thousands separator", "haul", ("tension: 300 N", "tension: 1'300 N"), part=("tension", "1'300"),
          cure=("1300", "number and a unit", "digits", "number")),
    scene("a list of masses", "puller", ("mass: 2 kg", "mass: [2 kg, 3 kg]"), part=("block", "mass"),
          cure=("one", "single", "2 kg", "a number")),
    scene("a mass is left empty", "puller", ("{type: Mass, mass: 2 kg}", "{type: Mass, mass: }"),
          part=("block", "mass"), cure=("2 kg", "kg", "number")),
    scene("a limit above and below that exclude each other", "puller", ("{below: 20 N}", "{below: 5 N, above: 10 N}"),
          part="spring.tension", cure=("below", "above")),
    scene("components as a list", "puller", ("floor: {type: Ground}", "- {name: floor, type: Ground}"),
          at=("- {name: floor", "components:", "block: {type"), part=(), cure=("NAME:", "name:", "indent", "map", "-",
          "{type")),
    scene("a connection as a map", "puller", ("[floor.flange, pad.a]", "{from: floor.flange, to: pad.a}"),
          part=(), cure=("[", "list")),
    scene("an end in brackets", "haul", ("[rope.path, route.path]", "[rope.path, route[0].path]"), part="route",
          cure=("route.path", "route.winch", "path")),
    scene("the stop of a run as a time of the clock", "puller", ("stop: 2 s", "stop: 0:02"), part=("stop", "0:02"),
          cure=("s", "2 s")),
    scene("a run of no method", "puller", ("accuracy: 1e-4", "method: radau, accuracy: 1e-4"), part="radau",
          cure="rodas5p"),
    scene("a limit of the controller in another unit than its output", "servo", ("low: -10", "low: -10 V"),
          part=("control", "low"), cure=("without a unit", "number", "1")),
    scene("a gear between two shafts of one name", "drill", ("[clutch.b, table.shaft, string.a]",
          "[clutch.b, table.shaft, table.shaft, string.a]"), part="table.shaft", cure=("once", "twice", "remove",
          "one", "two ports")),
)  # fmt: skip


PYTHON = (
    call("a sweep in a call of run", run(accuracy=[1e-3, 1e-4]), "accuracy", "accuracy", ("number", "one")),
    call("a time span of the standard library", run(stop=datetime.timedelta(seconds=1)), "stop", "0:00:01",
         ("number", "1 s", "5 s", "seconds")),
    call("a pair of times for the end", run(stop=(0, 1)), "stop", "stop", ("number", "start", "5 s")),
    call("a complex accuracy", run(accuracy=1e-3 + 0j), "accuracy", "accuracy", ("number",)),
    call("a setting of scipy", run(rtol=1e-6), ("rtol", "run"), "rtol", "accuracy"),
    call("a largest step by another name", run(dt=1e-3), ("dt", "run"), "dt", ("max_step", "record.every")),
    call("a value with two dots", values(**{"pad.normal_force": "1.2.3 N"}), "pad.normal_force", "1.2.3",
         ("number", "2 N", "N")),
    call("a part is taken out", values(pad=None), "pad", "pad", ("pad.", "component", "parameter")),
    call("a signal by a list of names", lambda desk: desk.result[["block.x", "pad.slip"]], ("[", "Result", "name"),
         "block.x", ("to_pandas", "one", "each", "signals")),
    call("a slice of a result", lambda desk: desk.result[0:10], ("[", "Result", "name"), "slice",
         ("name", '"block.x"', "signals")),
    call("a value at many times that lie outside", lambda desk: desk.result.at("block.x", np.array([0.1, 7.0])), "at",
         "7", ("0.2", "end", "stop")),
    call("extremes of nothing", lambda desk: desk.result.extremes(), "extremes", (), ("name", "signal", "block.x")),
    call("a table goes to a number", lambda desk: desk.result.to_csv(7), ("to_csv", "path"), "7", ("path", "file",
         ".csv")),
    call("margins of a signal without a limit", lambda desk: desk.result.margins("block.x"), ("margins", "block.x"),
         "block.x", ("limits", "spring.tension", "no argument")),
    call("statics of a friction as a word", lambda desk: desk.haul.statics(speed="slow"), "speed", "slow", ("mm/s",
         "m/s", "number")),
)  # fmt: skip
