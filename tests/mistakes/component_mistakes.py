"""Mistakes in a class of one's own. The place is a line with `# here`; lines with `# or here` are as good."""

from __future__ import annotations

from tests.mistakes.entry import ERROR, Mistake, Typed, words

Words = str | tuple[str, ...]

HEAD = """\
from fairlead.component import Component, Composite, Controller, Count, Choice, Expansion, Input, Law, Output, Parameter
from fairlead.component import Rotational, State, Table, Translational, Unknown, Zones, exp, guard, hold, sqrt, zone
from fairlead.components.friction.curve import Curve
from fairlead.components.mechanics.spring import Spring
"""

SCENE = """\
schema: 1
components:
  wall: {type: Ground}
  own: {type: Own, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg, velocity: 1 m/s}
connections:
  - [wall.flange, own.a]
  - [own.b, block.flange]
run: {stop: 1 s}
"""

PORTS = """
class Own(Component):  # or here
    \"\"\"A spring of one's own.\"\"\"

    a, b = Translational("one end"), Translational("the other end")
"""

STIFFNESS = '    stiffness = Parameter("N/m", "Tension per stretch.", above=0)\n'

LAW = """
    def law(p, a, b):
        pull = p.stiffness * (b.x - a.x)
        return Law(a=-pull, b=pull)
"""


def own(name: str, text: str, part: Words, cure: Words, netlist: str = SCENE, answer: str = ERROR,
        apart: bool = False) -> Mistake:  # fmt: skip
    """A class that `check` is to refuse with the line of the library that is at fault."""
    library = HEAD + text
    lines = [number for number, line in enumerate(library.splitlines(), start=1) if "here" in line.partition("#")[2]]
    make = Typed(("check", "mine.yaml", "--library", "own.py"), {"own.py": library, "mine.yaml": netlist}, apart)
    return Mistake(name, make, tuple(f"own.py:{line}" for line in lines), words(part), words(cure), answer)


def spring(name: str, law: str, part: Words, cure: Words, answer: str = ERROR) -> Mistake:
    """A spring of which only the law, or what stands beside it, is wrong."""
    return own(name, PORTS + STIFFNESS + law, part, cure, answer=answer)


TWO_ZONES = """
    zones = Zones("apart", "touching")

    @zone("apart")
    def apart(p, a, b):
        return (0, 0)

    @zone("touching"){comment}
    def touching(p, a, b):
        return (p.stiffness * (b.x - a.x), p.stiffness * (a.x - b.x))

    @guard("apart", to="touching", unit="N")
    def meets(p, a, b):
        return p.stiffness * (a.x - b.x)

    @guard("touching", to="apart", unit="N")
    def parts(p, a, b):
        return p.stiffness * (b.x - a.x)
"""


def zones(*changes: tuple[str, str]) -> str:
    """The zones of a bumper, with replacements."""
    text = TWO_ZONES.replace("{comment}", "")
    for old, new in changes:
        text = text.replace(old, new)
    return text


CURVE_SCENE = """\
schema: 1
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 1 kg, velocity: 1 m/s}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: own, level: 0.3}}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange]
run: {stop: 1 s}
"""

LINKS = """
class Own(Composite):  # or here
    \"\"\"Springs in series.\"\"\"

    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", "Of each.", above=0)

    def expand(p, scene):  # or here
"""

MISTAKES = (
    own("a unit does not exist", PORTS + '    stiffness = Parameter("N/mtr", "Per stretch.")  # here\n' + LAW,
        part=("stiffness", "mtr"), cure="N/m"),
    own("a default lies outside of its own range",
        PORTS + STIFFNESS + '    rest = Parameter("m", "Free length.", default=-1.0, above=0)  # here\n' + LAW,
        part=("rest", "-1"), cure=("above 0", "> 0", "greater than 0")),
    own("the default of a choice is none of its options",
        PORTS + STIFFNESS + '    end = Choice(("free", "fixed"), "How it ends.", default="fixd")  # here\n' + LAW,
        part=("end", "fixd"), cure="fixed"),
    spring("a law reads a variable that its port has not", """
    def law(p, a, b):  # or here
        pull = p.stiffness * (b.position - a.x)  # here
        return Law(a=-pull, b=pull)
""", part="position", cure=("x", "b.x")),
    spring("a law reads a misspelt parameter", """
    def law(p, a, b):  # or here
        pull = p.stifness * (b.x - a.x)  # here
        return Law(a=-pull, b=pull)
""", part="stifness", cure="stiffness"),
    spring("a law asks for a port that there is not", """
    def law(p, a, c):  # here
        pull = p.stiffness * (c.x - a.x)
        return Law(a=-pull, b=pull)
""", part=("law", "c"), cure=("a, b", "b")),
    spring("a law branches on a value", """
    def law(p, a, b):  # or here
        s = b.x - a.x
        pull = p.stiffness * s if s > 0 else 0  # here
        return Law(a=-pull, b=pull)
""", part="Own", cure=("zone", "zones")),
    spring("a law takes its exponential from math", """
    def law(p, a, b):  # or here
        import math
        pull = p.stiffness * math.exp(b.x - a.x)  # here
        return Law(a=-pull, b=pull)
""", part="Own", cure=("fairlead.component", "exp of fairlead.component")),
    spring("a law forgets to return", """
    def law(p, a, b):  # here
        pull = p.stiffness * (b.x - a.x)
        Law(a=-pull, b=pull)
""", part="Own", cure=("return", "Law(", "return Law")),
    spring("a law tells of a port that there is not", """
    def law(p, a, b):  # or here
        pull = p.stiffness * (b.x - a.x)
        return Law(a=-pull, c=pull)  # here
""", part="c", cure=("a, b", "b")),
    spring("a law adds a force and a speed", """
    def law(p, a, b):  # or here
        pull = p.stiffness * (b.x - a.x) + (b.v - a.v)  # here
        return Law(a=-pull, b=pull)
""", part=("N", "m/s"), cure=("unit", "units", "dimension", "N*s/m")),
    spring("an output is declared and never told", """
    tension = Output("N", "Tension.")  # or here

    def law(p, a, b):  # here
        pull = p.stiffness * (b.x - a.x)
        return Law(a=-pull, b=pull)
""", part="tension", cure=("tension=", "Law(", "Law")),
    spring("a state has no rate", """
    warm = State("K", "Temperature.")  # or here

    def law(p, a, b, warm):  # here
        pull = p.stiffness * (b.x - a.x)
        return Law(a=-pull, b=pull)
""", part="warm", cure=("rate", "warm=", "Law(")),
    spring("an inertia is text", LAW + """
    def inertia(p):  # here
        return {"b": "heavy"}  # or here
""", part=("inertia", "heavy"), cure=("number", "mass", "kg")),
    spring("a tie has three members and not four", LAW + """
    def ties(p):  # here
        return [("a", "b", 1.0)]  # or here
""", part="ties", cure=("(a, b, ratio, offset)", "offset", "four")),
    spring("a start is a number and not a pair", LAW + """
    def start(p):  # here
        return {"b": 0.5}  # or here
""", part=("start", "0.5"), cure=("(position, speed)", "position", "pair")),
    spring("a guard leads to a zone that there is not", zones(
        ('@guard("apart", to="touching", unit="N")\n', '@guard("apart", to="touch", unit="N")  # here\n'),
        ("    def meets(p, a, b):\n", "    def meets(p, a, b):  # or here\n")), part=("meets", "touch"),
        cure="touching"),
    spring("a zone has no law", zones(('zones = Zones("apart", "touching")',
           'zones = Zones("apart", "touching", "torn")  # here')),
           part="torn", cure=('@zone("torn")', "zone(", "law", "zone")),
    own("a composite joins a child that it has not", LINKS + """\
        children = {"first": scene.make(Spring, stiffness=p.stiffness)}
        return Expansion(children, [("first.b", "second.a")], {"a": "first.a", "b": "first.b"})  # here
""", part="second", cure=("first", "first.a")),
    own("a curve has no coefficient", """
class Own(Curve):  # here
    \"\"\"A curve that forgot what it is for.\"\"\"

    level = Parameter("1", "Coefficient.", least=0)
""", part="Own", cure=("coefficient", "coefficient(p, v)"), netlist=CURVE_SCENE,
        apart=True),
)  # fmt: skip
