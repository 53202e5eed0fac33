"""Mistakes in the text of a netlist, and in what it takes from other files. The place is the line that was damaged."""

from __future__ import annotations

from collections.abc import Mapping

from tests.mistakes.bases import BASES
from tests.mistakes.entry import EITHER, ERROR, WARNING, Mistake, Typed, damaged, first_difference, line_of, words

Words = str | tuple[str, ...]
Change = tuple[str, str]


def scene(name: str, base: str, *changes: Change, part: Words, cure: Words, at: Words = (), place: Words = (),
          answer: str = ERROR, files: Mapping[str, str] | None = None) -> Mistake:  # fmt: skip
    """A base with replacements, as mine.yaml; `at` are pieces of the lines to be named, else the first that differs."""
    text = damaged(BASES[base], *changes)
    lines = [line_of(text, piece) for piece in words(at)] or [first_difference(BASES[base], text)]
    places = words(place) or tuple(f"mine.yaml:{line}" for line in lines)
    make = Typed(("check", "mine.yaml"), {"mine.yaml": text, **(files or {})})
    return Mistake(name, make, places, words(part), words(cure), answer)


TABLE = ('velocity: {ramp: {to: "{speed}", over: 0.5 s}}', "velocity: {table: {file: hand.csv}}")

SLIPS_OF_THE_PEN = (
    scene("a component type is misspelt", "puller", ("type: Mass", "type: Mas"), part=("block", "Mas"), cure="Mass"),
    scene("a parameter is misspelt", "puller", ("stiffness:", "stifness:"), part=("spring", "stifness"),
          cure="stiffness"),
    scene("`type` is misspelt", "puller", ("type: Ground", "typ: Ground"), part=("floor", "typ"), cure="type"),
    scene("a block of the netlist is misspelt", "puller", ("connections:", "conections:"), part="conections",
          cure="connections"),
    scene("a port does not exist", "puller", ("spring.b, hand", "spring.c, hand"), part="spring.c", cure=("spring.b",
          "a, b")),
    scene("a recorded signal is misspelt", "puller", ("pad.slip", "pad.slp"), part="pad.slp", cure="pad.slip"),
    scene("a limit is put on a misspelt signal", "puller", ("{spring.tension: {", "{spring.tention: {"),
          part="spring.tention", cure="spring.tension"),
    scene("a start value is given to what is none", "puller", ("{block.x:", "{block.pos:"), part="block.pos",
          cure=("block.x", "position")),
    scene("an expression has a misspelt parameter", "puller", ('"{mu}"', '"{mue}"'), part=("pad", "mue"), cure="mu"),
    scene("a station's type is misspelt", "haul", ("type: Pulley", "type: Pully"), part=("route", "Pully"),
          cure="Pulley"),
    scene("the rim of a misspelt station is driven", "haul", ("route.winch.rim", "route.winsh.rim"),
          part="route.winsh.rim", cure="route.winch.rim"),
    scene("a figure has a misspelt signal", "haul", ('{title: Tension, signals: ["rope.line[*].tension"]',
          '{title: Tension, signals: ["rope.lines[*].tension"]'), part="rope.lines[*].tension",
          cure="rope.line[*].tension"),
    scene("an effect that no part of the scene knows", "servo", ("run: {stop: 2 s}",
          "run: {stop: 2 s}\neffects: {wnding: on}"), at="wnding", part="wnding", cure="winding"),
    scene("an effect is `yes`", "servo", ("run: {stop: 2 s}", "run: {stop: 2 s}\neffects: {winding: yes}"),
          at="winding: yes", part=("winding", "yes"), cure="on"),
    scene("a nominal size of a misspelt unknown", "puller", ("initial: {block.x: 0 mm}", "nominal: {blok.x: 1 mm}"),
          part="blok.x", cure="block.x"),
)  # fmt: skip

YAML = (
    scene("a decimal comma in a map of one line", "puller", ("mass: 2 kg", "mass: 2,5 kg"), part=("block", "5 kg"),
          cure=("2.5", "2.5 kg", "decimal point", "decimal comma")),
    scene("a decimal comma in a scene parameter", "haul", ("mu: 0.35", "mu: 0,35"), part=("mu", "35"),
          cure=("0.35", "decimal point", "decimal comma")),
    scene("a decimal comma in quotes", "puller", ("mass: 2 kg", 'mass: "2,5 kg"'), part=("block", "mass", "2,5 kg"),
          cure=("2.5", "2.5 kg", "decimal point", "decimal comma")),
    scene("a brace is not closed", "puller", ("mass: 2 kg}", "mass: 2 kg"), part="{", cure=("}", "closed", "close")),
    scene("a bracket is not closed", "puller", ("spring.tension], every", "spring.tension, every"), part="[",
          cure=("]", "closed", "close")),
    scene("a tab indents", "puller", ("  floor:", "\tfloor:"), part="tabs", cure=("spaces", "space")),
    scene("a component is indented by one space less", "puller", ("  spring: {", " spring: {"), part="spring",
          cure=("indent", "indented", "indentation", "spaces", "column")),
    scene("a colon is missing", "puller", ("floor: {type", "floor {type"), part="floor", cure=("colon",
          "floor: {type")),
    scene("a space is missing behind a colon", "puller", ("mass: 2 kg", "mass:2 kg"), part=("block", "mass:2 kg"),
          cure=("space", "mass: 2 kg")),
    scene("two components have one name", "puller", ("  spring: {", "  block: {"), part="block",
          cure=("twice", "already", "first", "rename", "another name")),
    scene("an expression is not in quotes", "puller", ('curve: "{mu}"', "curve: {mu}"), part=("pad", "mu"),
          cure=("quotes", '"{mu}"')),
    scene("a pattern that begins with an asterisk is not in quotes", "puller", ("[block.*,", "[*.x,"), part="*",
          cure=("quotes", "quote", '"*.x"')),
    scene("the signals are a word, no list", "servo", ("signals: [eye.x, control.command, motor.torque]",
          "signals: eye.x"), part="signals", cure=("list", "[eye.x]", "brackets")),
    scene("the version of the format is missing", "puller", ("schema: 1\n", ""), at="name: puller", part="schema",
          cure=("schema: 1", "format: 1")),
)  # fmt: skip

UNITS = (
    scene("a mass is in newtons", "puller", ("mass: 2 kg", "mass: 2 N"), part=("block", "mass", "2 N"), cure="kg"),
    scene("a unit does not exist", "puller", ("400 N/m", "400 N/mtr"), part=("spring", "stiffness", "N/mtr"),
          cure="N/m"),
    scene("a number and its unit are not apart", "puller", ("400 N/m", "400N/m"), part=("spring", "stiffness",
          "400N/m"), cure=("space", "400 N/m")),
    scene("a mass is text", "puller", ("mass: 2 kg", "mass: '2'"), part=("block", "mass", "2"),
          cure=("kg", "quotes")),
    scene("an angle is given without a unit, in degrees", "haul", ("angle: 90 deg", "angle: 90"), part=("angle", "90"),
          cure="deg", at=("angle: 90", "route:"), answer=EITHER),
    scene("a ramp lasts for metres", "puller", ("over: 0.5 s", "over: 0.5 m"), part=("hand", "over", "0.5 m"),
          cure=("s", "10 ms", "time")),
    scene("a torque is in joules", "drill", ("40 N*m}", "40 J}"), part=("engine", "torque", "40 J"), cure="N*m"),
    scene("a coefficient of friction gets a speed by an expression", "puller", ('"{mu}"', '"{mu*speed}"'),
          part=("pad", "m/s"), cure=("plain", "no unit", "number", "without a unit", "dimensionless")),
    scene("an expression is given a unit twice", "puller", ('"{speed}"', '"{speed} m/s"'), part=("hand", "speed"),
          cure=("already", "twice", "leave", "drop", "without", "has a unit")),
    scene("an expression uses a function that there is not", "puller", ('"{mu}"', '"{tan(mu)}"'), part=("pad", "tan"),
          cure=("sin", "cos")),
    scene("an expression divides by zero", "puller", ("400 N/m", '"{1/0} N/m"'), part=("spring", "stiffness", "1/0"),
          cure=("not zero", "other than zero", "is zero", "nonzero")),
    scene("parameters use each other in a circle", "puller", ("mu: 0.3, speed: 50 mm/s",
          'mu: "{speed}", speed: "{mu}"'), part=("mu", "speed"), cure=("circle", "each other", "itself", "number")),
    scene("a limit is a length where the signal is a force", "puller", ("below: 20 N", "below: 20 mm"),
          part=("spring.tension", "20 mm"), cure="N"),
)  # fmt: skip

VALUES = (
    scene("a friction of 35 for 35 per cent", "haul", ("mu: 0.35", "mu: 35"), part=("mu", "35"), answer=WARNING,
          at=("mu: 35", 'friction: "{mu}"'), cure=("0.35", "usual", "usually", "1.5", "above 1", "35 %")),
    scene("a mass of zero", "puller", ("mass: 2 kg", "mass: 0 kg"), part=("block", "mass", "0"),
          cure=("> 0", "above 0", "positive", "greater than 0", "more than 0")),
    scene("elements longer than the line's devices", "haul", ("element: 0.25 m", "element: 25 m"), part=("rope",
          "element"), cure=("element", "0.25 m", "shorter"), at=("rope:", "route:", "type: Bend", "name: wheel")),
    scene("a controller's period is longer than the run", "servo", ("period: 10 ms", "period: 10 s"),
          part=("control", "period", "10 s"), cure=("ms", "shorter", "2 s"), answer=EITHER),
    scene("rows are recorded farther apart than the run is long", "puller", ("every: 10 ms", "every: 10 s"),
          part=("every", "10 s"), cure=("2 s", "shorter"), answer=EITHER),
    scene("the run ends before it begins", "servo", ("stop: 2 s", "stop: -2 s"), part=("stop", "-2 s"),
          cure=("after", "start", "positive", "above 0", "> 0")),
    scene("a line is stretched by more than half of its length", "haul", ("tension: 300 N", "tension: 300 kN"),
          part=("rope", "tension"), cure=("stiffness", "strain", "stretch"), answer=EITHER),
    scene("a clutch of a hundred metres", "drill", ("radius: 100 mm", "radius: 100 m"), part=("clutch", "radius",
          "100 m"), cure=("mm", "0.1 m", "usual", "usually"), answer=WARNING),
    scene("sliding friction is above stiction", "drill", ("stiction: 0.8", "stiction: 0.3"), part=("rock", "stiction",
          "0.3"), cure=("coulomb", "0.5"), answer=EITHER),
    scene("a command has its lowest above its highest", "servo", ("low: -10, high: 10", "low: 10, high: -10"),
          part=("control", "low", "high"), cure=("below", "less than", "above", "swap", "smaller")),
    scene("a step comes after the end of the run", "servo", ("at: 0.1 s", "at: 10 s"), part=("wanted", "10 s"),
          cure=("stop", "2 s", "run.stop"), answer=WARNING),
    scene("a motion is given by position and by speed", "puller", ("type: MotionSource, ",
          "type: MotionSource, position: 1 m, "),
          part=("hand", "position", "velocity"), cure=("either", "one of", "not both", "only one", "leave")),
)  # fmt: skip

WIRING = (
    scene("nothing presses on a contact", "puller", ("normal_force: 20 N, ", ""), part="pad",
          cure=("normal_force", "pad.normal")),
    scene("a contact's surface is not connected", "puller", ("  - [floor.flange, pad.a]\n", ""), part="pad.a",
          at="pad:", cure=("connect", "connected", "connections", "nothing")),
    scene("a spring has both ends at one place", "puller", ("[spring.b, hand", "[spring.b, spring.a, hand"),
          part="spring",
          cure=("different", "both", "same", "one node", "itself"), at=("[spring.b, spring.a", "[pad.b", "spring: {")),
    scene("a shaft is joined with a rack", "servo", ("screw.pinion]", "screw.rack]"), part=("motor.shaft",
          "screw.rack"), cure=("screw.pinion", "rotational", "Rack"), at=("[motor.shaft, screw", "[screw.rack, table")),
    scene("a flange is joined with an input", "servo", ("[eye.x, control.measured", "[eye.flange, control.measured"),
          part=("eye.flange", "control.measured"), cure=("eye.x", "output", "signal")),
    scene("two outputs feed one input", "servo", ("[wanted.signal, control", "[wanted.signal, eye.v, control"),
          part=("wanted.signal", "eye.v"), cure=("one output", "one", "only one", "Sum")),
    scene("a controller does not know what was measured", "servo", ("  - [eye.x, control.measured]\n", ""),
          at="control:", part=("control", "measured"), cure=("connect", "connected", "connections")),
    scene("an output is joined with an output", "servo", ("motor.command]", "motor.torque]"),
          part=("control.command", "motor.torque"), cure="motor.command", at=("motor.torque]", "control:", "motor:")),
    scene("a point is to move and to stand", "puller", ("[spring.b, hand.flange]",
          "[spring.b, hand.flange, floor.flange]"),
          part=("hand", "floor"), cure=("one", "both", "only one", "spring"), at=("[spring.b", "hand:", "floor:")),
    scene("a line has no route", "haul", ("  - [rope.path, route.path]\n", ""), part="path", at=("rope:", "route:"),
          cure=("connect", "rope.path", "route.path", "connected")),
    scene("two stations lie on each other", "haul", ("start: 4 m", "start: 2 m"), part="wheel", at="wheel",
          cure=("start", "overlap", "overlaps", "2.571 m", "2.57 m")),
)  # fmt: skip

TIME_AND_TABLES = (
    scene("a ramp is misspelt", "puller", ("{ramp:", "{rampe:"), part=("hand", "rampe"), cure="ramp"),
    scene("a table has more times than values", "haul", ("force: 300 N",
          "force: {table: {t: [0 s, 1 s, 2 s], y: [0 N, 300 N]}}"),
          part=("load", "table"), cure=("as many", "same number", "same length", "equally", "3", "each")),
    scene("the times of a table go back", "haul", ("force: 300 N",
          "force: {table: {t: [0 s, 2 s, 1 s], y: [0 N, 300 N, 0 N]}}"),
          part=("load", "table"), cure=("increase", "grow", "ascending", "rise", "increasing", "order")),
    scene("a table lies in a file that is not there", "puller", TABLE, part=("hand", "hand.csv"),
          cure=("folder", "beside", "no file", "not found", "no such file")),
    scene("a table was written with decimal commas", "puller", TABLE, part="0;0",
          files={"hand.csv": "t;y\n0;0\n0,5;1,5\n"},
          place=("hand.csv:2", "hand.csv, row 2"), cure=("0.5,1.5", "decimal point", "decimal comma", "semicolon",
          "comma")),
)  # fmt: skip

LATER = (
    scene("a setting of the run is misspelt", "puller", ("accuracy: 1e-4", "acuracy: 1e-4"), part="acuracy",
          cure="accuracy"),
    scene("a limit does not say on which side", "puller", ("{below: 20 N}", "20 N"), part=("spring.tension", "20 N"),
          cure=("below", "above")),
    scene("a limit allows nothing", "puller", ("{below: 20 N}", "{below: 20 N, above: 30 N}"),
          part=("spring.tension", "20 N", "30 N"), cure=("swap", "higher", "lower", "between", "less than", "raise")),
    scene("two stations have one name", "haul", ("{type: Straight, length", "{name: wheel, type: Straight, length"),
          part="wheel", at=("name: wheel, type: Straight", "name: wheel, type: Pulley"),
          cure=("another name", "rename", "one name", "each", "own name", "twice")),
    scene("a ramp does not say where it ends", "puller", ('{ramp: {to: "{speed}", over', "{ramp: {over"),
          part=("hand", "ramp", "to"), cure=("to: 0.1 m/s", "give", "needs", "missing", "add")),
    scene("a stiffness is negative", "puller", ("400 N/m", "-400 N/m"), part=("spring", "stiffness", "-400 N/m"),
          cure=("above 0", "> 0", "positive", "greater than 0", "more than 0")),
    scene("the treatment of the whole scene is misspelt", "drill", ("{method: hold}", "{method: held}"),
          part=("method", "held"), cure="hold"),
    scene("an angle is in metres", "haul", ("angle: 90 deg", "angle: 90 m"), part=("angle", "90 m"), cure="deg"),
    scene("a comma is missing in a connection", "puller", ("block.flange, spring.a", "block.flange spring.a"),
          part="block.flange spring.a", cure=("comma", "block.flange, spring.a")),
    scene("a unit lacks its sign of multiplication", "drill", ("2 kg*m^2", "2 kgm^2"), part=("flywheel", "moment",
          "kgm^2"), cure="kg*m^2"),
)  # fmt: skip

MISTAKES = SLIPS_OF_THE_PEN + YAML + UNITS + VALUES + WIRING + TIME_AND_TABLES + LATER
