"""Every treatment has exactly one zone to go to, from any zone, at any slip, load and normal force.

The guards of a zone are followed in their order until none has risen. Asked are: that this ends; that it stays there
when asked again; that the end agrees with the slip, whatever the zone was before; and that nothing presses in `off`.
"""

import functools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

from fairlead.component.parameters import make
from fairlead.component.registry import known_types
from fairlead.testing.world import Instant, World

MEMBERS = {w: m for w, m in known_types()["Contact"].members.items() if m.__module__.startswith("fairlead.")}
SETTLES = [word for word in MEMBERS if word != "naive_zone"]  # it has no zone for rest, which is what it shows
REMEMBER = ("bristle", "reset_integrator", "maxwell_slip")
CURVE = {"curve": "stribeck", "stiction": 0.5, "coulomb": 0.3, "velocity": 0.02}
NORMAL, LIFT, STILL = 10.0, 1e-6, 3e-9  # the last: what a slip may be wrong by before a treatment takes notice


@functools.cache
def world(word: str) -> World:
    """The contact between a heavy and a light body."""
    values = make(MEMBERS[word], curve=CURVE, normal_force=NORMAL, **getattr(MEMBERS[word], "asked_with", {}))
    return World(values, {"a": 5.0, "b": 1.0})


def instant(of: World, slip: float, load: float, normal: float, own: float) -> Instant:
    """The body b slips and is pulled; `own` is where the treatment's state or unknown happens to be."""
    keys = dict.fromkeys(of.structure.inputs, 0.0) | {"port:b:v": slip, "in:normal": normal}
    keys |= {key: own for key in keys if key.startswith("own:")}
    return Instant(keys, {"a": 0.0, "b": load}, tuple(0 for _ in range(of.structure.machines)))


slips = some.one_of(some.floats(-1, 1), some.floats(-1e-3, 1e-3), some.floats(-1e-7, 1e-7), some.just(0.0))
loads = some.one_of(some.floats(-8, 8), some.floats(-100, 100), some.sampled_from([0.0, 5.0, -5.0, 3.0, 4.5]))
normals = some.sampled_from([0.0, 1e-7, 1e-3, 1.0, NORMAL, 1e3])
owns = some.one_of(some.floats(-1e-4, 1e-4), some.floats(-1, 1), some.just(0.0))


@pytest.mark.parametrize("word", SETTLES)
@settings(max_examples=60, deadline=None)
@given(slip=slips, load=loads, normal=normals, own=owns, number=some.integers(0, 100))
def test_a_treatment_has_one_zone_to_go_to(word, slip, load, normal, own, number):
    of = world(word)
    start = of.structure.zones[number % len(of.structure.zones)]
    at = instant(of, slip, load, normal, own)
    end = of.settle(at, start)  # raises CircleError when it does not end
    zone = of.zone(end)
    assert not of.risen(of.solve(end))
    assert of.zone(of.settle(end, zone)) == zone
    if normal == 0.0:
        assert zone == "off"
    if normal >= 3 * LIFT:
        assert zone != "off"
    left = end.values["port:b:v"] - end.values["port:a:v"]  # a contact that holds has taken the slip away
    if zone in ("forward", "slide_forward"):
        assert left >= -STILL
    if zone in ("backward", "slide_backward"):
        assert left <= STILL


@pytest.mark.parametrize("word", [word for word in SETTLES if word not in REMEMBER])
@settings(max_examples=40, deadline=None)
@given(slip=some.one_of(some.floats(1e-2, 1), some.floats(-1, -1e-2)), load=loads, number=some.integers(0, 100))
def test_fast_slip_leaves_no_choice(word, slip, load, number):
    """Whatever the zone before, a fast slip ends in the same one; bristles are asked with theirs unbent.

    Not asked are treatments whose state is their memory: a reset integrator slides on, or bends first, and springs of
    Maxwell slip that slip go on until the slip turns round.
    """
    of = world(word)
    ends = {of.zone(of.settle(instant(of, slip, load, NORMAL, 0.0), start)) for start in of.structure.zones}
    assert len(ends) == 1, ends
