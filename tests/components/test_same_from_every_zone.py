"""Parts without memory: at one instant the zones lead to the same law, wherever one begins.

A part that has two limits, as a drive with one of current and one of voltage, is easily given a zone that nothing leads
out of where the other limit is met. Then what it does depends on how it came there. Parts that rightly remember, or
whose zone says where a state is, are listed with the reason.
"""

from __future__ import annotations

import zlib
from dataclasses import replace

import numpy as np
import pytest

from fairlead.component.base import Composite
from fairlead.component.bundled import bundled
from fairlead.component.keys import OWN, PORT, key
from fairlead.component.registry import known_types
from fairlead.component.scene import is_head
from fairlead.kernels import layout
from fairlead.testing.samples import SampleError, sample
from fairlead.testing.settled import in_pieces
from fairlead.testing.world import CircleError, Instant, World

bundled()
INSTANCES, INSTANTS = 4, 25
CLOSE = 1e-6  # of the largest number a law says; zones may lie within AT_ZERO of each other

STATE = "its zone says where its state is: gas or oil that is left, a stop of the state, what is wound"
HOLDS = "what it holds depends on what it held"
REMEMBER = {
    "Accumulator": STATE, "CavitatingVolume": STATE, "Chamber": STATE, "Integrator": STATE, "SteadyRoll": STATE,
    "WoundWeb": STATE, "WebSpan": STATE, "RoundLoad": "which side is ahead, at no load",
    "Core": HOLDS, "DogClutch": HOLDS, "MovingTail": HOLDS, "OneWayClutch": HOLDS, "RigidStop": HOLDS,
    "RopeTail": HOLDS, "WebAccumulator": HOLDS, "WholeSpan": HOLDS, "RuckingHose": "a ruck stays until it is drawn out",
    "PlanarContact": "it lifts off at another normal force than it lands at",
    "DeadBand": "hysteresis", "Relay": "hysteresis", "SignalChirp": "it has been swept",
    "ThrottledCylinder": "a valve opens at twice the opening at which it closes",
    "ThrottledMotor": "a valve opens at twice the opening at which it closes",
    "ValveLands": "a valve opens at twice the opening at which it closes",
}  # fmt: skip
KINDS = [
    kind for kind in known_types().values()
    if not issubclass(kind, Composite) and not is_head(kind) and len(kind.declaration.zones) > 1
]  # fmt: skip


def instant(world: World, rng: np.random.Generator, *, alone: bool) -> Instant:
    """A random one, small or large."""
    at, size = world.draw(rng, alone=alone), 10 ** rng.uniform(-1, 2.5)
    grown = {one: value * size if key(one).kind in (PORT, OWN, "in") else value for one, value in at.values.items()}
    return in_pieces(world, replace(at, values=grown, loads={name: size * x for name, x in at.loads.items()}), rng)


def ends(world: World, at: Instant) -> dict[str, np.ndarray]:
    """By zone that some zone leads to: what the law says there."""
    found = {}
    for zone in world.structure.zones:
        try:
            end = world.settle(at, zone)
        except CircleError:
            continue
        found[world.zone(end)] = np.concatenate([world.ask(mode, end).real for mode in (layout.FLOWS, layout.OUTPUT)])
    return found


FORGET = [kind for kind in KINDS if kind.__name__ not in REMEMBER]


@pytest.mark.parametrize("kind", FORGET, ids=lambda kind: kind.__name__)
def test_what_a_part_does_does_not_depend_on_the_zone_it_comes_from(kind):
    rng = np.random.default_rng(zlib.crc32(kind.__name__.encode()))
    for k in range(INSTANCES):
        try:
            values = sample(kind, rng, {}, optional=k % 2 == 0)
        except SampleError:
            pytest.skip("no random parameters")
        ports = kind.declaration.ports
        world = World(values, {name: 10 ** rng.uniform(-1, 1) for name, one in ports.items() if one.domain.mechanical})
        for j in range(INSTANTS):
            at = instant(world, rng, alone=j % 2 == 1)
            laws = ends(world, at)
            first = next(iter(laws.values()), None)
            for zone, law in laws.items():
                size = max(np.nanmax(np.abs(first), initial=1e-12), np.nanmax(np.abs(law), initial=1e-12))
                assert np.nanmax(np.abs(law - first), initial=0.0) <= CLOSE * size, (zone, list(laws), world.where(at))


def test_those_that_remember_are_there():
    assert {kind.__name__ for kind in KINDS} >= set(REMEMBER)
