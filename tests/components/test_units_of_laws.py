"""What a law adds up is of one unit, and what it gives of the unit declared; the line at fault is named."""

# ruff: noqa: E501 - the tables read best with one law a line

import re

import pytest

from fairlead.errors import ModelError
from fairlead.testing import ContractError, contract

SCENE = """
components:
  wall: {type: Ground}
  own: {type: Own, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg, velocity: 1 m/s}
connections: [[wall.flange, own.a], [own.b, block.flange]]
run: {stop: 0.1 s}
"""
OWN = '''
class Own(Component):
    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", above=0)
    damping = Parameter("N*s/m", default=1.0, least=0)
    curve = Table("m", "N", default=None)
    push = Waveform("N", default=None)
    {extra}

    def law(p, a, b{asks}):
        {lines}
'''
PULL = "pull = p.stiffness * (b.x - a.x)"


def told(scene, library, lines, extra="", asks=""):
    body = "\n        ".join(lines)
    path = library(OWN.format(lines=body, extra=extra, asks=asks))
    try:
        scene(SCENE, libraries=(path,)).check()
    except ModelError as error:
        return str(error)
    return ""


@pytest.mark.parametrize(
    ("lines", "line", "says"),
    [
        (("pull = p.stiffness * (b.v - a.v) + p.damping * (b.x - a.x)", "return -pull, pull"), 12, "are added; terms of a"),
        ((PULL, "more = b.v - a.v", "return Law(a=-pull - more, b=pull)"), 14, "[N] are added"),
        ((PULL, "pull = pull + p.damping", "return -pull, pull"), 13, "damping [N*s/m]"),
        (("s = b.x - a.x", "f = p.stiffness * exp(s)", "return -f, f"), 13, "exp takes a plain number"),
        (("f = p.damping * (b.x - a.x)", "return -f, f"), 11, "what a takes in is in N, and is given"),
        ((PULL, "return Law(a=-pull, b=pull, stored=pull)"), 11, "stored is in J, and is given"),
        ((PULL, "return Law(a=-pull, b=pull, dissipated=p.damping * (b.v - a.v))"), 11, "dissipated is in W"),
        (("s = sqrt((b.x - a.x)**2 + (b.v - a.v)**2)", "return -p.stiffness*s, p.stiffness*s"), 12, "[m^2/s^2]"),
    ],
)  # fmt: skip
def test_units_that_do_not_go_together_are_told_with_the_line(scene, library, lines, line, says):
    said = told(scene, library, lines)
    assert says in said
    assert re.search(rf"classes0\.py:{line}: Own\.law", said), said


@pytest.mark.parametrize(
    "lines",
    [
        (PULL, "return -pull, pull"),
        ("pull = p.stiffness * (b.x - a.x) + p.damping * (b.v - a.v)", "return -pull, pull"),
        ("s = b.x - a.x", "f = p.stiffness * s * (1 + (s / 1e-3)**2)", "return -f, f"),  # a length in a number
        ("f = 9.81 * p.damping * (b.v - a.v) / 9.81", "return -f, f"),
        ("v = sqrt((b.v - a.v)**2 + 1e-6)", "return -p.damping * v, p.damping * v"),
        ("s = b.x - a.x", "f = p.stiffness * s * tanh(s / 1e-3)", "return -f, f"),
        (PULL, "return Law(a=-pull, b=pull, stored=pull**2 / (2 * p.stiffness), dissipated=0)"),
    ],
)
def test_units_that_may_go_together_are_let_pass(scene, library, lines):
    assert told(scene, library, lines) == ""


def test_an_output_and_a_state_are_held_to_their_units(scene, library):
    output = 'pull = Output("m")'
    said = told(scene, library, (PULL, "return Law(a=-pull, b=pull, pull=pull)"), output)
    assert "pull is in m, and is given stiffness*(-a.x + b.x), which is in N" in said
    state = 'warm = State("K")'
    said = told(scene, library, (PULL, "return Law(a=-pull, b=pull, warm=warm)"), state, ", warm")
    assert "the rate of warm is in K/s, and is given warm, which is in K" in said


def test_a_state_without_rate_and_an_output_without_value_are_told_with_what_to_write(scene, library):
    said = told(scene, library, (PULL, "return Law(a=-pull, b=pull)"), 'warm = State("K")', ", warm")
    assert "the law leaves out the rate of the state warm: Law(..., warm=...) in K/s" in said
    said = told(scene, library, (PULL, "return Law(a=-pull, b=pull)"), 'pull = Output("N")')
    assert "no law gives the output 'pull'. Add it: Law(..., pull=...)" in said


def test_a_class_may_say_why_its_units_differ(scene, library):
    extra = 'exempt = {"units": "an old table in feet"}'
    assert told(scene, library, ("f = p.damping * (b.x - a.x)", "return -f, f"), extra) == ""


def declared(body):
    names = {}
    exec("from fairlead.component import *", names)  # as the top of a user's file
    exec(f"class Odd(Component):\n    a, b = Translational(), Translational()\n{body}", names)
    return names["Odd"]


SPRING = "    k = Parameter('N/m', above=0)\n    def law(p, a, b):\n        f = p.k * (b.x - a.x)\n        return "


@pytest.mark.parametrize(
    ("law", "says"),
    [
        ("Law(a=f, b=-f, stored=f * (b.x - a.x) / 2)", "With the opposite sign it would close"),
        ("Law(a=f, b=f, stored=f * (b.x - a.x) / 2)", "With the opposite sign of what a takes in it would close"),
        ("(-f, f)", "No law has a line of the ledger: add stored= [J], dissipated= or supplied= [W]"),
    ],
)
def test_what_the_ledger_can_tell_of_a_wrong_sign_it_tells(law, says):
    with pytest.raises(ContractError, match=re.escape(says)):
        contract(declared(SPRING + law))


def test_a_zone_that_the_search_did_not_reach_is_told_as_such():
    body = """
    zones = Zones("on", "far")
    on = zone("on")(lambda p, a, b: (0, 0))
    far = zone("far")(lambda p, a, b: (0, 0))
    leaves = guard("on", to="far", unit="m")(lambda p, a, b: b.x - a.x - 1e6)
    returns = guard("far", to="on", unit="m")(lambda p, a, b: 1e6 - b.x + a.x)
"""
    with pytest.raises(ContractError, match="has ended, which does not say that there is none"):
        contract(declared(body))


def test_contract_never_ends_in_a_raw_error():
    with pytest.raises(ContractError, match=r"Odd\.n fails: KeyError: 3"):
        contract(declared("    @derived\n    def n(p):\n        return {}[3]\n    def law(p, a, b):\n        return (p.n*a.x, -p.n*a.x)"))
