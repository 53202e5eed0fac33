"""A guard told to be mirrored is two guards: as written, and between the paired zones in the other direction."""

import pytest
import sympy

from fairlead.component import Component, Law, Parameter, Translational, Zones, guard, zone
from fairlead.component.registry import known_types
from fairlead.component.trace import trace
from fairlead.component.values import variant_of
from fairlead.testing.samples import families, sample

PAIRS = {"forward": ["ahead"], "backward": ["astern"]}


class Stops(Component):
    """A play, and what follows from one declaration for each guard."""

    a = Translational()
    play = Parameter("m", default=0.1, least=0)
    zones = Zones("free", "ahead", "astern", **PAIRS)

    @zone("free", "ahead", "astern")
    def all(p, a):
        """Nothing acts."""
        return Law(a=0)

    @guard("free", "astern", to="ahead", unit="m", mirrored="meets_astern")
    def meets(p, a, direction):
        """Beyond the play."""
        return direction * a.x - p.play, direction * a.v

    @guard("ahead", to="free", unit="m", mirrored="parts_astern")
    def parts(p, a, direction):
        """Within it again."""
        return p.play - direction * a.x


class ByHand(Stops):
    """The same with mirrors written out."""

    zones = Zones("free", "ahead", "astern")

    @guard("free", "astern", to="ahead", unit="m")
    def meets(p, a):
        """Beyond the play."""
        return a.x - p.play, a.v

    @guard("free", "ahead", to="astern", unit="m")
    def meets_astern(p, a):
        """The other way."""
        return -a.x - p.play, -a.v

    @guard("ahead", to="free", unit="m")
    def parts(p, a):
        """Within it again."""
        return p.play - a.x

    @guard("astern", to="free", unit="m")
    def parts_astern(p, a):
        """The other way."""
        return p.play + a.x


def guards_of(kind, chosen=()):
    """(zone, guard, to, values) of all guards, as they are traced."""
    import numpy as np

    traced = trace(variant_of(sample(kind, np.random.default_rng(1), dict(chosen), False)))
    return {(zone, g.name, g.to, *g.values) for zone, said in traced.zones.items() for g in said.guards if not g.table}


def test_a_mirrored_guard_is_the_two_that_one_would_write_by_hand():
    assert guards_of(Stops) == guards_of(ByHand)
    assert list(Stops.declaration.guards) == ["meets", "meets_astern", "parts", "parts_astern"]


def test_a_class_that_replaces_a_guard_replaces_its_mirror():
    class Late(Stops):
        @guard("ahead", to="free", unit="m", mirrored="ends_astern")
        def parts(p, a, direction):
            """Later."""
            return p.play / 2 - direction * a.x

    assert list(Late.declaration.guards) == ["meets", "meets_astern", "parts", "ends_astern"]


@pytest.mark.slow
def test_friction_that_knows_both_directions_lets_go_by_mirrored_limits():
    """Of every treatment with one curve for both: what leads out of a zone backward is what leads out of it forward,
    with slip and force reversed. Reversed symbols are an independent way to write it."""
    asked = 0
    for member, chosen in families(known_types()["Contact"]):
        zones = member.declaration.zones
        if chosen.get("curve") != "coulomb" or set(chosen) - {"curve"} or not zones.forward:
            continue
        traced = guards_of(member, chosen.items())
        names = {s for _, _, _, *values in traced for value in values for s in value.free_symbols}
        odd = {s: -s for s in names if s.name.startswith(("port:", "own:"))}
        pairs = {name: mark.mirrored for name, mark in member.declaration.guards.items() if mark.direction}
        for at, name, to, *values in traced:
            if name in pairs:
                there = [sympy.expand(value.subs(odd, simultaneous=True)) for value in values]
                other = next(v for z, n, _, *v in traced if (z, n) == (zones.mirrored(at), pairs[name]))
                assert [sympy.expand(value) for value in other] == there, (member, at, name, to)
                asked += 1
    assert asked > 30
