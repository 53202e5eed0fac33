"""What is off is absent: of every effect that a bundled class declares, no unknown, zone, guard or term is left.

Leaves and composites are asked by the kernels of all that they are made of; what a line makes where it meets a route
is asked by the compiled scene. Every effect of the library must be in one of the two lists, so a new one is asked too.
"""

from functools import cache

import numpy as np
import pytest

import fairlead
from fairlead.analysis.effects.effect_row import Size
from fairlead.component.base import Composite
from fairlead.component.bundled import bundled
from fairlead.component.scene import Scene, is_head
from fairlead.component.values import variant_of
from fairlead.kernels.kernel import plain
from fairlead.testing.samples import sample

ON_A_ROUTE = {
    ("ArrayModule", "hose_core_slip"): ("single_bend", {"line.length": "4 m"}),
    ("ArrayModule", "tension_only_core"): ("single_bend", {"line.length": "4 m"}),
    ("ArrayModule", "line_damping"): ("single_bend", {"line.length": "4 m"}),
    ("ArrayModule", "device_friction"): ("single_bend", {"line.length": "4 m"}),
    ("ArrayModule", "centrifugal"): ("single_bend", {"line.length": "4 m"}),
    ("ArrayModule", "meters"): ("single_bend", {"line.length": "4 m"}),
    ("Cable", "line_damping"): ("friction_anchor", {"element": "4 m"}),
    ("Cable", "line_stretch"): ("friction_anchor", {"element": "4 m"}),
    ("Cable", "device_friction"): ("friction_anchor", {"element": "4 m"}),
    ("Cable", "gravity"): ("friction_anchor", {"element": "4 m"}),
    ("Cable", "centrifugal"): ("capstan", {"element": "0.5 m", "rope.length": "6 m"}),
    ("Cable", "planar_slip"): ("torsion", {"element": "0.5 m"}),
    ("Cable", "meters"): ("torsion", {"element": "0.5 m"}),
    ("PowerUnit", "supply_dynamics"): ("power_unit", {}),
}
SAME_LAW = {
    ("ArrayModule", "planar_slip"): "that of Cable, see there",
    ("ArrayModule", "gravity"): "that of Cable, see there",
}


@cache
def declared():
    """(class, effect) of every concrete class of the library."""
    kinds = [member for kind in bundled().values() for member in (kind.members.values() if is_head(kind) else [kind])]
    return sorted({(kind, name) for kind in kinds for name in kind.declaration.effects}, key=str)


def leaves(values, path=""):
    """(path, leaf) of all that an instance is made of, however deep."""
    if not issubclass(values.type, Composite):
        return [(path, values)]
    children = values.type.expand(values, Scene()).children
    return [leaf for name, child in children.items() for leaf in leaves(child, f"{path}.{name}")]


def content(kind, effect, word, optional):
    """What an instance with the effect on or off has: (path, class) -> its unknowns, zones, guards and terms."""
    found = {}
    for path, leaf in leaves(sample(kind, np.random.default_rng(0), {effect: word}, optional)):
        _, one = plain(variant_of(leaf))
        flows = {f"{to}({key})" for zone in one.flow_inputs.values() for to, keys in zone.items() for key in keys}
        guards = {f"{zone}/{guard['name']}" for zone, named in one.guards.items() for guard in named}
        found[path, leaf.type] = {*one.parameters, *one.inputs, *one.targets, *one.zones, *guards, *flows}
    return found


def terms(system):
    """How many parameters, guards and dependences of flows on inputs all instances have together."""
    made = [(block.count, block.kernel.structure) for block in system.blocks]
    flows = [sum(len(keys) for zone in one.flow_inputs.values() for keys in zone.values()) for _, one in made]
    return sum(n * (len(one.parameters) + one.slots + k) for (n, one), k in zip(made, flows, strict=True))


ASKED_ALONE = [pair for pair in declared() if (pair[0].__name__, pair[1]) not in {**ON_A_ROUTE, **SAME_LAW}]


def quick(kind):
    """Members of a family inherit its effects: one of each stands for the others."""
    return getattr(kind, "word", "hold") == "hold"


@pytest.mark.parametrize(
    ("kind", "effect"),
    [
        pytest.param(kind, effect, marks=[] if quick(kind) else pytest.mark.slow, id=f"{kind.__name__}-{effect}")
        for kind, effect in ASKED_ALONE
    ],
)
def test_an_effect_that_is_off_leaves_no_unknown_zone_guard_or_term(kind, effect):
    gone = []
    for optional in (True, False):
        on, off = (content(kind, effect, word, optional) for word in ("on", "off"))
        for place in on.keys() & off.keys():  # a limiting model has another class
            assert not off[place] - on[place], f"{place}: there only when {effect} is off"
        gone += [place for place in on if on[place] - off.get(place, set())]
    assert gone, f"nothing goes when {effect} is off"


@pytest.mark.parametrize(("kind", "effect"), list(ON_A_ROUTE), ids=[f"{k}-{e}" for k, e in ON_A_ROUTE])
def test_an_effect_of_a_line_that_is_off_is_not_in_the_compiled_scene(kind, effect):
    model, settings = ON_A_ROUTE[kind, effect]
    systems = {word: fairlead.load(model, set={**settings, f"effects.{effect}": word}).system for word in ("on", "off")}
    on, off = Size.of(systems["on"]), Size.of(systems["off"])
    if effect == "planar_slip":  # one zone for both slips, or one for each, so that only the equations are simpler
        assert off.unknowns <= on.unknowns
        assert off.entries < on.entries
        return
    for name in ("unknowns", "entries", "zones", "guards", "kernels"):
        assert getattr(off, name) <= getattr(on, name), name
    assert terms(systems["off"]) < terms(systems["on"]), "no term of the equations goes"


def test_the_energy_ledger_that_is_off_has_no_unknown():
    on, off = (fairlead.load("belt", set={"effects.energy": word}).system for word in ("on", "off"))
    assert {name for name in on.unknown_names if name.startswith("energy")}
    assert on.n - off.n == len([name for name in on.unknown_names if name.startswith("energy")])
    assert not [name for name in off.unknown_names if name.startswith("energy")]
