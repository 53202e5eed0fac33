"""What laws and guards depend on, as their text says it: sums of inputs, zone by zone and piece by piece of a table."""

import functools

import pytest
import sympy
from fairlead.components.friction import coulomb  # noqa: F401 (a curve for the contact, known once imported)
from fairlead.components.friction.hold import Hold
from fairlead.components.line.core_element import Core
from fairlead.components.line.hose_element import Hose
from fairlead.components.line.lateral_load import LateralLoad, RoundLoad
from fairlead.components.line.looped import LoopedHose
from fairlead.components.line.meter import Meter
from fairlead.components.route.drum import Drum, StoredNode, WoundNode
from fairlead.components.route.tow import SeaDrag

from fairlead.component import Carries, Component, Law, Parameter, Table, Translational, Zones, zone
from fairlead.component.trace import TraceError, trace
from fairlead.describe.specimen import specimen
from fairlead.kernels.dependence import sums
from fairlead.kernels.in_floats import differs, varies
from fairlead.kernels.text import KernelText


@functools.cache
def structure(kind):
    """What is known of a class with its parameters at their defaults, and the first curve where it wants one."""
    return KernelText(trace(specimen(kind, open_parts=False))).write()[1]


def said(structure, sums_):
    """Sums in words: `port:b:x-port:a:x`, without what is the same for all."""
    words = set()
    for one in sums_:
        names = sorted(f"{c:+g} {structure.inputs[j]}" for j, c in one)
        words.add(" ".join(names).replace("port:", "").replace("+1 ", "+").replace("-1 ", "-"))
    return words


def of(kind, value, zone="", pieces=""):
    """What a value of a class depends on."""
    s = structure(kind)
    names = [*s.outputs, *s.targets, *s.ledger]
    return said(s, s.reads[zone or s.zones[0]][pieces]["values"][names.index(value)])


def guard_of(kind, name, zone, pieces=""):
    """What the members of a guard depend on, and which of them are straight."""
    s = structure(kind)
    slot = [guard["name"] for guard in s.guards[zone]].index(name)
    members = s.reads[zone][pieces]["guards"][slot]
    return [(said(s, member["sums"]), member["straight"]) for member in members]


STRETCH, RATE, SLIP = "+b:x -a:x", "+b:v -a:v", "+b:v -a:v"


@pytest.mark.parametrize(
    ("kind", "value", "zone", "pieces", "wanted"),
    [
        (Hose, "port:a", "", "", {STRETCH, RATE}),
        (Hose, "dissipated", "", "", {RATE}),
        (Core, "port:b", "taut", "", {STRETCH, RATE}),
        (Core, "port:b", "loose", "", set()),
        (Core, "tension", "closing", "", set()),
        (Hold, "friction", "held", "", {"+own:force"}),
        (Hold, "own:force", "held", "", {SLIP, "+b:A -a:A"}),
        (Hold, "friction", "off", "", set()),
        (Hold, "slip", "off", "", {SLIP}),
        (Hold, "port:a", "off", "", set()),
        (StoredNode, "port:rim", "stored", "", {"+rim:v -node:v"}),
        (StoredNode, "port:rim", "edge", "", {"+rim:v -node:v", "+node:x"}),
        (StoredNode, "port:node", "free", "", set()),
        (WoundNode, "port:node", "stored", "", {"+in:radius", "+drum:v", "+node:v"}),
        (Drum, "radius_now", "", "v", {"+shaft:x"}),
        (Drum, "radius_now", "", "c", set()),
        (Drum, "line_speed", "", "c", {"+shaft:v"}),
        (SeaDrag, "drag", "", "0", set()),
        (SeaDrag, "drag", "", "1", {"+in:speed", "+node:v"}),
        (SeaDrag, "drag", "", "v", {"+in:speed", "+node:v", "+node:x"}),
        (Meter, "own:worked", "", "", {"+in:slip", "+in:friction"}),
        (LateralLoad, "force", "", "0", {"+in:more"}),
        (LoopedHose, "port:a", "", "00", {STRETCH, RATE}),
        (LoopedHose, "port:a", "", "11", {STRETCH, RATE}),
        (LoopedHose, "port:a", "", "01", {STRETCH, RATE, "+carriage:x", "+carriage:v"}),
        (LoopedHose, "port:carriage", "", "11", set()),
    ],
)
def test_a_value_depends_on_what_its_law_reads_in_that_zone_and_piece(kind, value, zone, pieces, wanted):
    assert {frozenset(word.split()) for word in of(kind, value, zone, pieces)} == {
        frozenset(word.split()) for word in wanted
    }


@pytest.mark.parametrize(
    ("kind", "guard", "zone", "pieces", "wanted"),
    [
        (Core, "shortens", "taut", "", [({STRETCH}, False)]),
        (Core, "tightens", "loose", "", [({STRETCH}, False), ({STRETCH, RATE}, False)]),
        (Hold, "lifts", "held", "", [({"-in:normal"}, True)]),
        (Hold, "breaks_forward", "held", "", [({"+own:force", "+in:normal"}, False)]),
        (Hold, "lands_forward", "off", "", [({"+in:normal"}, False), ({SLIP}, False)]),
        (StoredNode, "nears", "stored", "", [({"+node:x"}, True)]),
        (RoundLoad, "curvature next", "inner", "0", [({"+flange:x"}, True)]),
        (Drum, "radius next", "always", "v", [({"+shaft:x"}, True)]),
    ],
)
def test_a_guard_depends_on_what_its_function_reads(kind, guard, zone, pieces, wanted):
    """A member that is a sum of inputs with numbers for coefficients, and a constant, is straight."""
    zone = zone if zone in structure(kind).zones else structure(kind).zones[0]
    found = guard_of(kind, guard, zone, pieces)
    assert [({frozenset(w.split()) for w in words}, straight) for words, straight in found] == [
        ({frozenset(w.split()) for w in words}, straight) for words, straight in wanted
    ]


class Written(Component):
    """The difference of two positions in words of its own."""

    a = Translational("one end")
    b = Translational("the other")
    k = Parameter("N/m", "Stiffness.", default=3.0)
    share = Table("m", "1", "Over place.")

    def law(p, a, b):
        """Each end with its own term, which SymPy does not put together by itself."""
        force = p.k * b.x - p.k * a.x
        return Law(a=-force, b=force * p.share(a.x))


def test_a_difference_that_is_written_out_is_one():
    assert of(Written, "port:a", "", "v") == {"+b:x -a:x"} or of(Written, "port:a", "", "v") == {"-a:x +b:x"}


def test_a_place_at_which_a_table_is_read_counts_beside_the_difference():
    """Where the table is not constant."""
    assert of(Written, "port:b", "", "v") == {"+a:x", "+b:x"}
    assert len(of(Written, "port:b", "", "1")) == 1
    assert not of(Written, "port:b", "", "0")


def test_a_difference_of_three_is_seen_and_one_of_two_among_them():
    import sympy

    from fairlead.component.trace import symbol

    keys = [f"port:{name}:v" for name in "abc"]
    a, b, c = (symbol(key) for key in keys)
    assert sums((a + c - 2 * b) ** 3, keys) == [[(0, -1.0), (1, 1.0)], [(0, -1.0), (2, 1.0)]]
    assert sums(sympy.exp(a - b) + c, keys) == [[(0, -1.0), (1, 1.0)], [(2, 1.0)]]
    assert sums(a * b, keys) == [[(0, 1.0)], [(1, 1.0)]]


def tied(law):
    """A class that says that its node is carried, with this law."""

    class Tied(Component):
        """Ties a node to a rim."""

        exempt = {"units": "laws of any form are tried"}
        node = Translational("the node")
        rim = Translational("what carries it")
        lock = Parameter("N*s/m", "Bond.", default=1e9)
        gear = Parameter("1", "Speed of the node over that of the rim.", default=2.0)
        carried = Carries("node", by="rim", zone="tied")
        zones = Zones("tied")

        @zone("tied")
        def tied(p, node, rim):
            """As given."""
            force = law(p, node, rim)
            return Law(node=force, rim=-force)

    return Tied


def test_the_ratio_of_speeds_is_that_of_the_law():
    assert structure(StoredNode).carries == [("", 1.0)]
    assert structure(WoundNode).carries == [("", 1.0), ("in:radius", 1.0)]
    geared = tied(lambda p, node, rim: p.lock * (3 * node.v - p.gear * rim.v))
    assert structure(geared).carries == [("", pytest.approx(1 / 3)), ("p:gear", 1.0)]


def test_a_law_that_ties_no_speeds_is_refused_where_it_says_that_it_carries():
    loose = tied(lambda p, node, rim: p.lock * (node.x - rim.x))
    with pytest.raises(
        TraceError, match=r"zone 'tied' is said to carry 'node' by 'rim', .* by 0; it must be"
    ):
        structure(loose)


def test_a_root_of_what_is_below_zero_where_it_is_tried_says_nothing():
    """An author's law is only asked behind its guard; numbers that it is tried with may lie before it."""
    a, b = sympy.symbols("a b")
    assert not varies(sympy.sqrt(a - b - 7), [a])
    assert not differs(sympy.sqrt(a - b - 7), sympy.sqrt(a - b - 8))
