"""A class that contradicts itself is refused when it is created, at its own file and line."""
# ruff: noqa: E501 - mistakes and messages read best on one line

import math
import pathlib
import re
from dataclasses import fields

import pytest
from pydantic import ValidationError

from fairlead.component import Zones, zone
from fairlead.component.answers import Answers, rows
from fairlead.component.base import Family
from fairlead.component.bundled import bundled
from fairlead.component.class_checks import DeclarationError
from fairlead.component.in_si import not_in_si, parameters_in_si
from fairlead.component.parameters import make
from fairlead.component.piecewise import linear_table
from fairlead.component.terms import LEDGER
from fairlead.errors import ModelError

LAW = "def law(p, a):\n    return (0,)"
PAIRED = (
    "zones = Zones('off', 'on', 'no', forward=['on'], backward=['no'])\n"
    "@zone('off', 'on', 'no')\ndef all(p, a):\n    return (0,)\n"
)
TWO = "zones = Zones('on', 'off')\n@zone('on', 'off')\ndef all(p, a):\n    return (0,)\n"
REFUSED = {
    "a law beside zones": (TWO + LAW, "there are zones, and `law` is for a class without zones"),
    "two laws of one zone": (TWO + "@zone('off')\ndef off(p, a):\n    return (0,)", "zone 'off' has two laws, all and off; to replace one of a base class, name it all"),
    "two zones of one name": ("zones = Zones('on', 'on')\n@zone('on')\ndef on(p, a):\n    return (0,)",
                              "there are two zones 'on'; each zone has a name of its own"),
    "zones said twice": (TWO + "more = Zones('on', 'off', 'gone')", "zones and more are Zones both, and a class has one"),
    "a guard without a return": (
        TWO + "@guard('on', to='off', unit='m')\ndef leaves(p, a):\n    a.x - 0.2", "'leaves' gives nothing; does it lack"),
    "a guard that returns nothing": (
        TWO + "@guard('on', to='off', unit='m')\ndef leaves(p, a):\n    if p is a:\n        return None\n    a.x", "gives nothing"),
    "a guard of pass": (TWO + "@guard('on', to='off', unit='m')\ndef leaves(p, a):\n    pass", "gives nothing"),
    "a guard in mm": (TWO + "@guard('on', to='off', unit='mm')\ndef leaves(p, a):\n    return a.x", "its unit is m"),
    "a guard in furlongs": (TWO + "@guard('on', to='off', unit='furlongs')\ndef leaves(p, a):\n    return a.x", "its unit is m"),
    "a state that starts below its least": (LAW + "\nz = State('m', start=-1.0, least=0.0)", "'z' starts at -1, below its least, 0"),
    "an output in kN": (LAW + "\npull = Output('kN')", "the output 'pull' is in kN, and laws reckon and runs record in SI"),
    "an output in %": (LAW + "\nshare = Output('%')", "the output 'share' is in %, and laws reckon and runs record in SI; declare it in 1"),
    "a state in mm": (LAW + "\nz = State('mm', start=3.0)", "the state 'z' is in mm, and laws reckon and runs record in SI; declare it in m"),
    "an input in rpm": (LAW + "\nasked = Input('rpm', default=1.0)", "the input 'asked' is in rpm, and laws reckon"),
    "an unknown in kN*m": (LAW + "\nt = Unknown('kN*m')", "the unknown 't' is in kN*m, and laws reckon"),
    "a table in mm with points": (
        LAW + "\ng = Table('mm', 'N', default=((0, 1), (5, 2)))", "the default of 'g' is read in SI; declare it in m, not mm"),
    "a ramp in kN": (LAW + "\nf = Waveform('kN', default={'ramp': {'to': 3, 'over': 1}})", "the default of 'f' is read in SI"),
    "a mirrored guard whose zones have no pair": (
        "zones = Zones('off', 'on')\n@zone('off', 'on')\ndef all(p, a):\n    return (0,)\n"
        "@guard('off', to='on', unit='m', mirrored='meets_no')\n"
        "def meets(p, a, direction):\n    return direction * a.x",
        "guard 'meets' is mirrored, and its zones are their own mirror images. Pair them: Zones(..., forward=",
    ),
    "a mirrored guard that does not ask for the direction": (
        PAIRED + "@guard('off', to='on', unit='m', mirrored='meets_no')\ndef meets(p, a):\n    return a.x",
        "guard 'meets' is mirrored, and does not ask for the direction: def meets(p, ..., direction), +1 as written",
    ),
    "a mirror by a name that is taken": (
        PAIRED + "@guard('off', to='on', unit='m', mirrored='a')\n"
        "def meets(p, a, direction):\n    return direction * a.x",
        "guard 'meets' makes its mirror 'a', a name the class has already",
    ),
    "a zone without a law": (
        "zones = Zones('on', 'off')\n@zone('on')\ndef on(p, a):\n    return (0,)",
        "zone 'off' has no law",
    ),
    "a law of an unknown zone": (
        "zones = Zones('on')\n@zone('on', 'of')\ndef on(p, a):\n    return (0,)",
        "a law is declared for 'of', which is not in zones",
    ),
    "a guard of an unknown zone": (
        "zones = Zones('on')\n@zone('on')\ndef on(p, a):\n    return (0,)\n"
        "@guard('on', to='off', unit='m')\ndef leaves(p, a):\n    return a.x",
        "guard 'leaves' names 'off', which is not in zones",
    ),
    "a guard that leads nowhere": (
        "zones = Zones('on')\n@zone('on')\ndef on(p, a):\n    return (0,)\n"
        "@guard('on', to='on', unit='m')\ndef stays(p, a):\n    return a.x",
        "guard 'stays' leads from 'on' to itself",
    ),
    "an argument nobody declared": (
        "def law(p, a, b):\n    return (0,)",
        "law asks for 'b'; known: ['a', 'direction', 'p', 't', 'zone']",
    ),
    "words for where nothing is left, of an output that does not tell": (
        f"left = Output('kg', 'Left.', gone=('is empty', 'Fill it.'))\n{LAW}",
        "'left' has `gone`, which an output of role used_up says",
    ),
    "a start of what a law gives": (
        f"said = Output('1', 'Said.', start=1.0)\n{LAW}",
        "'said' has a start; its law gives it from the start on, so only a Controller has one",
    ),
    "a start by a name that nothing has": (
        f"said = Output('1', 'Said.', start='begin')\n{LAW}",
        "'said' starts with 'begin': neither a number nor a parameter of the class",
    ),
    "no law at all": ("", "zone 'always' has no law"),
    "a parameter called law, and no law": ("law = Parameter('N')", "zone 'always' has no law"),
    "a direction that zones do not tell": (
        "zones = Zones('on')\n@zone('on')\ndef on(p, a, direction):\n    return (direction * a.v,)",
        "on asks for the direction of 'on', which the zones do not tell",
    ),
    "a direction without its mirror image": (
        "zones = Zones('up', 'down', forward=['up'])\n@zone('up', 'down')\ndef both(p, a):\n    return (0,)",
        "forward=['up'], backward=[] are not pairs of zones that mirror one another",
    ),
    "a discrete variable that nothing samples": (f"{LAW}\nheld = Discrete('N')", "no sampled law gives ['held']"),
    "a period that is no parameter": (
        f"{LAW}\nheld = Discrete('N')\n@sampled(every='period')\ndef sample(p, a):\n    return Law(held=0)",
        "'sample' is sampled every 'period', which is no parameter",
    ),
    "a unit that means nothing": (f"{LAW}\nstiffness = Parameter('N/mile^9')", "'stiffness': N/mile^9 is not a unit"),
    "a name that is taken": (f"{LAW}\nvariant = Parameter('N')", "a parameter cannot be called 'variant'"),
    "a start that is no parameter": (
        f"{LAW}\nheld = Discrete('N', start='first')",
        "'held' starts at 'first', which is no parameter",
    ),
    "a default that is no parameter": (f"{LAW}\npull = Input('N', default='force')", "'pull' is 'force' when nothing"),
    "an attribute with a letter missing": (
        f"{LAW}\ntransmit = True",
        "nobody asks for 'transmit'. Did you mean transmits?",
    ),
    "a method with letters exchanged": (f"{LAW}\ndef inerita(p):\n    return {{}}", "Did you mean inertia?"),
    "a method in capitals": (f"{LAW}\ndef Starts_At(p, x, t):\n    pass", "Did you mean starts_at?"),
    "a law with a letter too many": ("def laws(p, a):\n    return (0,)", "Did you mean law?"),
    "a word where yes or no is asked": (f"{LAW}\ntransmits = 'yes'", "transmits is 'yes'; it is True or False"),
    "a number where a method is asked": (f"{LAW}\ninertia = 3.0", "inertia is 3.0, and a method (p) is asked for"),
    "a value where a method is asked": (f"{LAW}\ninertia = property(lambda p: 3)", "and a method (p) is asked for"),
    "a method that takes more": (f"{LAW}\ndef inertia(p, a):\n    return {{}}", "is called with (p)"),
    "a method that takes less": (f"{LAW}\ndef starts_at(p):\n    pass", "takes (p), and is called with (p, x, t)"),
    "a method with a self that nobody passes": (
        f"{LAW}\ndef prescribes(self):\n    return {{}}",
        "is called with ()",
    ),
    "an input that there is not": (f"{LAW}\npasses = 'target'", "passes is 'target'; the inputs are []"),
    "one input where two are asked": (
        f"{LAW}\npull = Input('N')\nfollows = 'pull'",
        "follows is 'pull'; it names two inputs",
    ),
    "a parameter that there is not": (f"{LAW}\nkeeps = 'wanted'", "keeps is 'wanted'; the parameters are []"),
    "a budget of something else": (f"{LAW}\nbudget = {{'steps': 5}}", "whole numbers for max_steps and max_events"),
    "a ledger that reads what there is not": (
        f"{LAW}\ndef stored(p, a, b):\n    return 0",
        "stored asks for 'b'; known: ['a', 'direction', 'p', 't', 'zone']",
    ),
    "a choice that there is not": (f"{LAW}\nas_one = ('form', 'a', 'b')", "it names a choice and two of its options"),
    "options that a choice has not": (
        f"{LAW}\nform = Choice(('up', 'down'))\nas_one = ('form', 'up', 'left')",
        "as_one is ('form', 'up', 'left'); it names a choice and two of its options",
    ),
    "a level that is no parameter": (f"{LAW}\nlevel = 'coulomb'", "level is 'coulomb'; the parameters are []"),
    "a method with neighbours exchanged": (f"{LAW}\ndef strat(p):\n    return {{}}", "Did you mean start?"),
    "what only a composite is asked": (f"{LAW}\ndef expand(p, scene):\n    pass", "is asked of a Composite, and never"),
    "what only a controller is asked": (
        f"{LAW}\ndef sample(self, t):\n    pass", "'sample' is asked of a Controller, and never of a Component",
    ),
    "samples of what there is not": (f"{LAW}\nasked_with = {{'zz': 1}}", "asked_with gives 'zz'; the parameters"),
    "a parameter called p": (f"{LAW}\np = Parameter('N')", "a parameter cannot be called 'p'; in a law that is the"),
    "a parameter called t": (f"{LAW}\nt = Parameter('s')", "a parameter cannot be called 't'; in a law that is time"),
    "an input called zone": (f"{LAW}\nzone = Input('1')", "an input cannot be called 'zone'; in a law"),
    "a default of another kind": (f"{LAW}\nk = Parameter('N/m', default='5 kg')", "default of 'k' is '5 kg'; 5 kg is"),
    "a default that is no number": (f"{LAW}\nk = Parameter('N/m', default=[1])", "the default of 'k' is [1]; "),
    "a default that is yes": (f"{LAW}\nk = Parameter('N/m', default=True)", "the default of 'k' is True; "),
    "a default out of range": (f"{LAW}\nk = Parameter('N/m', default=0, above=0)", "that is outside of its own range"),
    "a range of nothing": (f"{LAW}\nk = Parameter('N/m', above=3, below=2)", "'k' is to be above 3 and below 2, which"),
    "a bound with a unit": (f"{LAW}\nk = Parameter('N/m', above='0 N/m')", "'k': above is '0 N/m'; a bound is a"),
    "a default that is no option": (f"{LAW}\nc = Choice(('on', 'off'), default='onn')", "the options are on, off"),
    "a default that is no count": (f"{LAW}\nn = Count(default=2.5)", "a count is a whole number from 1 to 1000000"),
    "a guard of a unit that means nothing": (
        "zones = Zones('on', 'off')\n@zone('on', 'off')\ndef on(p, a):\n    return (0,)\n"
        "@guard('on', to='off', unit='mtr')\ndef leaves(p, a):\n    return a.x",
        "guard 'leaves': mtr is not a known unit",
    ),
    "a unit that is a number": (f"{LAW}\nk = Parameter(3)", "'k' has the unit 3; a unit is a text such as"),
    "options that are no texts": (f"{LAW}\nc = Choice((1, 2), default=1)", "'c' has the options (1, 2); they are a"),
    "options that are one text": (f"{LAW}\nc = Choice('on', default='on')", "'c' has the options 'on'; they are a"),
    "a part of no family": (f"{LAW}\nk = Part(3, 'x')", "'k' is a part of 3, which is no family such as Curve"),
    "a block that is a list": (f"{LAW}\nk = Block([1], 'x')", "'k' is a block of [1]; it is a map of names to"),
    "an effect off that is a text": (f"{LAW}\ne = Effect('x', off='Bob')", "'e' off is 'Bob'; it is a class with"),
    "a waveform that is a word": (f"{LAW}\nw = Waveform('N', default='fast')", "the default of 'w' is 'fast'; "),
    "a table that is a number": (f"{LAW}\nw = Table('m', 'N', default=3)", "the default of 'w' is 3; a table is"),
    "a size below zero": (f"{LAW}\nz = State('m', nominal=-1.0)", "'z' has the size -1; a size is above zero"),
    "what moves by a number": (f"{LAW}\nm = Parameter('m')\nmoves_as = 'm'", "moves_as is 'm'; the quantities in time"),
    "a start that is a list": (f"{LAW}\nheld = State('N', start=[0])", "'held' starts at [0]; write a number"),
    "a unit inside a block": (LAW + "\nhose = Block({'mass': Parameter('kg per m')})", "kg per m"),
}  # fmt: skip


def declare(body, kind="Component"):
    """Create a class with this body."""
    names = {}
    exec("from fairlead.component import *", names)  # as the top of a user's file
    lines = "".join(f"    {line}\n" for line in ["a = Translational()", *body.splitlines()])
    exec(f"class Mine({kind}):\n{lines}", names)  # the text of this test
    return names["Mine"]


@pytest.mark.parametrize("name", REFUSED)
def test_a_contradiction_is_refused_when_the_class_is_created(name):
    body, says = REFUSED[name]
    with pytest.raises(DeclarationError) as caught:
        declare(body)
    assert says in str(caught.value)
    assert "Mine: " in str(caught.value)


def test_zones_may_take_the_place_of_a_law_of_a_base_class_and_not_the_other_way_round():
    plain = declare(LAW)
    zoned = type("Zoned", (plain,), {"zones": Zones("on"), "on": zone("on")(lambda p, a: (0,))})
    assert zoned.declaration.laws.keys() == {"on"}
    with pytest.raises(DeclarationError, match="`law` is for a class without zones"):
        type("Again", (zoned,), {"law": plain.law})
    with pytest.raises(DeclarationError, match="`law` is for a class without zones"):
        type("Mixed", (plain, declare(TWO)), {})
    with pytest.raises(DeclarationError, match="zone 'on' has two laws, on and also"):
        type("More", (zoned,), {"also": zone("on")(lambda p, a: (1,))})
    assert type("Same", (zoned,), {"on": zone("on")(lambda p, a: (1,))}).declaration.laws["on"](0, 0) == (1,)


def test_numbers_of_parameters_in_other_units_than_si_are_turned():
    kind = declare(
        LAW + "\ngap = Parameter('mm', default=5.0, least=1.0, most=1000.0, usual=(2.0, 20.0))"
        "\nrate = Parameter('N/mm', default=2.0, above=0)\nturn = Parameter('deg', default='90 deg', below=180)"
        "\nspeed = Parameter('rpm', default=60)\nshare = Parameter('%', default=50)\npull = Waveform('kN', default=3.0)"
        "\nhose = Block({'mass': Parameter('g/m', default=1600)}, '')\nshape = Table('mm', 'kN')"
    )
    has = kind.declaration.parameters
    gap, turn = has["gap"], has["turn"]
    assert (gap.unit, has["rate"].unit, turn.unit, has["speed"].unit) == ("m", "N/m", "rad", "rad/s")
    assert (gap.default, gap.least, gap.most, *gap.usual) == pytest.approx((0.005, 0.001, 1.0, 0.002, 0.02))
    assert (has["rate"].default, has["rate"].above) == (2000.0, 0)
    assert turn.below == pytest.approx(math.pi)
    assert (has["share"].unit, has["share"].default, has["pull"].unit, has["pull"].default) == ("1", 0.5, "N", 3000.0)
    assert (has["hose"].parameters["mass"].default, has["shape"].x, has["shape"].y) == (1.6, "m", "N")
    given = make(kind, shape=linear_table([0.0, 1.0], [0.0, 1.0])).given
    assert (given["gap"], given["rate"]) == (0.005, 2000.0)
    assert (given["turn"], given["speed"]) == pytest.approx((math.pi / 2, 2 * math.pi))
    assert given["pull"](0.0) == 3000.0


@pytest.mark.parametrize(
    ("options", "written", "word"),
    [(("1", "2", "3"), 3, "3"), (("1", "2", "3"), 3.0, "3"), (("0.5", "1.0"), 1, "1.0"), (("true", "false"), True, "true")],
)
def test_an_option_that_is_a_number_may_be_written_as_one(options, written, word):
    kind = declare(f"{LAW}\nn = Choice({options!r})")
    assert make(kind, n=written).n == make(kind, n=word).n == word
    for other in (4, 0.25, None, "four"):
        with pytest.raises(ValidationError):
            make(kind, n=other)


def test_the_bundled_classes_declare_in_si():
    for kind in {*bundled().values(), *Family.everyone}:
        has = kind.declaration
        assert not list(not_in_si(has.parameters, has)), kind
        assert parameters_in_si(has.parameters) == has.parameters, kind


def test_a_composite_must_say_what_it_is_made_of():
    with pytest.raises(DeclarationError, match=r"a Composite needs an expand\(p\) method"):
        declare("", kind="Composite")


def test_what_does_not_contradict_itself_is_a_component():
    assert list(declare(LAW).declaration.ports) == ["a"]


def test_a_file_with_such_a_class_is_named_with_its_line(scene, library):
    path = library("\nclass Mine(Component):\n    a = Translational()\n")
    with pytest.raises(ModelError) as caught:
        scene("components: {}\nrun: {stop: 1 s}", libraries=(path,)).check()
    assert re.search(r"classes0\.py:3: Mine: zone 'always' has no law", str(caught.value))


def test_what_is_asked_has_a_default_and_can_be_inherited():
    plain = declare(LAW)
    assert plain.answers == Answers(law=plain.law)
    half = declare(f"{LAW}\ntransmits = True\nbudget = {{'max_steps': 7}}\ndef inertia(p):\n    return {{'a': 1.0}}")
    leaf = type("Leaf", (half,), {"transmits": False})
    assert (half.answers.transmits, leaf.answers.transmits) == (True, False)
    assert leaf.answers.budget == {"max_steps": 7}
    assert leaf.answers.inertia(None) == {"a": 1.0}


@pytest.mark.parametrize("name", ["inertia", "start", "keeps", "transmits"])
def test_a_parameter_may_have_the_name_of_what_is_asked(name):
    """It is a declaration, so nobody takes it for an answer."""
    kind = declare(f"{LAW}\n{name} = Parameter('N')")
    assert name in kind.declaration.parameters
    assert getattr(kind.answers, name) == getattr(Answers(), name)


@pytest.mark.parametrize("helper", ["slope", "shape", "reach", "pull", "_transmit", "_inerita", "SITES"])
def test_helpers_of_an_author_are_left_alone(helper):
    assert declare(f"{LAW}\ndef {helper}(p, x):\n    return x").answers.law is not None


@pytest.mark.parametrize(
    ("body", "what"),
    [
        ("def scales(p):\n    return 1.0", "Did you mean scale?"),
        ("def breakaway(p, v):\n    return 0", "breakaway takes (p, v), and is called with (p)"),
        ("words = 'mine'", "Did you mean word?"),
        ("word = 3", "word is 3, and a str in the class it builds on"),
    ],
)
def test_a_member_of_a_family_answers_as_its_head_asks(body, what):
    from fairlead.components.friction.curve import Curve

    names = {"Curve": Curve}
    lines = "".join(f"    {line}\n" for line in body.splitlines())
    with pytest.raises(DeclarationError, match=re.escape(what)):
        exec(f"class Mine(Curve):\n{lines}", names)  # the text of this test


def test_the_page_lists_all_that_a_class_may_be_asked():
    page = (pathlib.Path(__file__).parents[2] / "docs" / "components.md").read_text(encoding="utf-8")
    for name, what, meaning in rows():
        assert f"| `{name}` | {what} | {meaning} |" in page


def test_all_that_may_be_asked_of_the_bundled_classes_is_said_by_one_of_them():
    """What no class says, nobody needs to ask; the ledger may stand in a law as well, where they all have it."""
    from fairlead.components.friction.contact import Contact
    from fairlead.components.friction.curve import Curve
    from fairlead.components.route.station import Station

    from fairlead.component.registry import bundled

    kinds = [*bundled().values(), *Contact.members.values(), *Curve.members.values(), *Station.members.values()]
    silent = [one.name for one in fields(Answers) if all(getattr(k.answers, one.name) == one.default for k in kinds)]
    assert set(silent) == set(LEDGER)
