"""Contacts that hold whose force limit follows something given in time, or a signal that switches.

These are facts of every kernel, laid over one System.

    given in time      a quantity in time that is not constant in some piece in force between start and stop
    follows            a signal, a prescribed motion or an own unknown of a law that reads it, and so on from law to law
    rows that read it  of f, at once or by way of signals; what follows it as a state is smooth
    limit              a guard that bounds the force of its own contact while that holds

How bodies move is not followed: what a limit owes to that, the error of a step sees. Constant pieces with jumps between
them are no variation: a step ends where a piece does.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.component.keys import OWN, PORT, key
from fairlead.component.piecewise import PiecewisePolynomial
from fairlead.component.values import Wave, polynomial
from fairlead.kernels.structure import Structure
from fairlead.system.arrays.blocks import Block
from fairlead.system.compiled.system import System

Booleans = NDArray[np.bool_]
OFTEN = 10
"""Turns of a limit, each of which may add a switch: what `stepping` makes wrong in that many is no longer a few weights
(docs/stepping.md)."""
Moves = Callable[[PiecewisePolynomial | Wave, float, float], bool]


def timed_limits(system: System, start: float, stop: float, *, turning: bool = False) -> list[str]:
    """Paths of the components whose limit varies in time between start and stop [s], in the order of the blocks.

    `turning`: only where what is given in time turns between up and down OFTEN.
    """
    if not any(block.kernel.structure.holds for block in system.blocks):
        return []
    moves = _turns if turning else _moves
    beating = [_beats(block, start, stop, moves) for block in system.blocks]
    if not any(beats.any() for beats in beating):
        return []
    return _that_follow(system, beating, np.zeros(len(system.memory["z"]), dtype=bool))


def switched_limits(system: System) -> list[str]:
    """Paths of the components whose limit follows a part that only tells signals and has zones, as a relay."""
    if not any(block.kernel.structure.holds for block in system.blocks):
        return []
    switches = np.zeros(len(system.memory["z"]), dtype=bool)
    for block in system.blocks:
        s = block.kernel.structure
        if len(s.zones) > 1 and not any(key(target).kind == PORT for target in s.targets):
            switches[block.sig_index] = True
    nothing = [np.zeros(block.count, dtype=bool) for block in system.blocks]
    return _that_follow(system, nothing, switches) if switches.any() else []


def timed_rows(system: System, start: float, stop: float) -> Booleans:
    """[n]: rows of f that read something given in time that varies between start and stop, at once or by signals."""
    beating = [_beats(block, start, stop, _moves) for block in system.blocks]
    found = np.zeros(len(system.numbering.unknowns) + 1, dtype=bool)
    if not any(beats.any() for beats in beating):
        return found[:-1]
    varies = _spread(system, beating, np.zeros(len(system.memory["z"]), dtype=bool), states=False)
    for block, beats in zip(system.blocks, beating, strict=True):
        s = block.kernel.structure
        for k in range(len(s.targets)):
            rows = block.flow_index.reshape(block.count, -1)[:, k]
            reached = _reached(block, beats, varies, _inputs(s, s.zones, len(s.outputs) + k))
            found[np.minimum(rows[reached], len(found) - 1)] = True
    return found[:-1]


def latches_on_means(system: System) -> list[str]:
    """Paths of parts that remember (a relay) and read, at once or by signals, what has no rate: forces and the like."""
    at_once = np.zeros(len(system.memory["z"]), dtype=bool)
    at_once[np.flatnonzero(~system.differential)] = True
    nothing = [np.zeros(block.count, dtype=bool) for block in system.blocks]
    varies = _spread(system, nothing, at_once, states=False)
    found: list[str] = []
    for block, beats in zip(system.blocks, nothing, strict=True):
        s = block.kernel.structure
        tells = not any(key(target).kind == PORT for target in s.targets)
        reached = _reached(block, beats, varies, _read_by_latches(s) if tells else set())
        found += [block.instances[i].path for i in np.flatnonzero(reached)]
    return found


def _that_follow(system: System, beating: list[Booleans], varies: Booleans) -> list[str]:
    """Components whose limit follows what beats in a law, or what lies at these places in z."""
    varies = _spread(system, beating, varies)
    found: list[str] = []
    for block, beats in zip(system.blocks, beating, strict=True):
        reached = _reached(block, beats, varies, _read_by_limits(block.kernel.structure))
        found += [block.instances[i].path for i in np.flatnonzero(reached)]
    return found


def _beats(block: Block, start: float, stop: float, moves: Moves) -> Booleans:
    """By instance: time moves something in its law."""
    s = block.kernel.structure
    if not s.time_tables:
        return np.full(block.count, "t" in s.inputs)
    return np.array([any(moves(one.values.path(p), start, stop) for p in s.time_tables) for one in block.instances])


def _moves(given: PiecewisePolynomial | Wave, start: float, stop: float) -> bool:
    """True if this quantity in time varies inside a piece in force between start and stop."""
    if any(turns > 0 for turns in _swings(given, start, stop)):
        return True
    return bool(_terms_between(polynomial(given), start, stop)[:, 1:].any())


def _turns(given: PiecewisePolynomial | Wave, start: float, stop: float) -> bool:
    """True if this quantity in time turns up and down OFTEN between start and stop; a curved piece is a turn."""
    if any(turns >= OFTEN for turns in _swings(given, start, stop)):
        return True
    slopes = _terms_between(polynomial(given), start, stop)[:, 1:]
    ways = np.sign(slopes[:, 0])[slopes[:, 0] != 0.0]
    return bool(np.count_nonzero(np.diff(ways)) + np.count_nonzero(slopes[:, 1:].any(axis=1)) >= OFTEN)


def _swings(given: PiecewisePolynomial | Wave, start: float, stop: float) -> Iterator[float]:
    """How often each sine of a quantity in time turns between start and stop, while its amplitude is not zero."""
    for part in given.parts if isinstance(given, Wave) else ():
        lasts = np.clip(part.polynomial.right, start, stop) - np.clip(part.polynomial.left, start, stop)
        yield float(abs(part.omega) * lasts[part.polynomial.terms.any(axis=1)].sum() / np.pi)


def _terms_between(given: PiecewisePolynomial, start: float, stop: float) -> NDArray[np.float64]:
    """Coefficients of the pieces in force between start and stop."""
    return given.terms[(given.right > start) & (given.left < stop)]


def _spread(system: System, beating: list[Booleans], varies: Booleans, *, states: bool = True) -> Booleans:
    """By place in z: whether it follows what is given in time, or what varies already; `states`: also by those."""
    while True:
        before = np.count_nonzero(varies)
        for block, beats in zip(system.blocks, beating, strict=True):
            for place, inputs in _places(block, states=states):
                made = place[_reached(block, beats, varies, inputs)]
                varies[made] = True
        varies[system.numbering.dump] = varies[system.numbering.zero] = False
        if np.count_nonzero(varies) == before:
            return varies


def _places(block: Block, *, states: bool = True) -> Iterator[tuple[NDArray[np.int64], set[int]]]:
    """By signal and own unknown of a class: where it lies in z, by instance; and the inputs it depends on."""
    s = block.kernel.structure
    for k in range(len(s.outputs)):
        yield block.sig_index.reshape(block.count, -1)[:, k], _inputs(s, s.zones, k)
    for k, target in enumerate(s.targets):
        if states and key(target).kind == OWN:
            zones = [zone for zone in s.zones if zone not in s.holds.get(key(target).name, ())]
            rows = block.flow_index.reshape(block.count, -1)[:, k]  # that of an unknown is its place in z
            yield rows, _inputs(s, zones, len(s.outputs) + k)


def _inputs(s: Structure, zones: Sequence[str], value: int) -> set[int]:
    """Inputs that a value depends on in some of these zones."""
    return {j for zone in zones for sum_ in _of(s, zone)["values"][value] for j, _ in sum_}


def _read_by_limits(s: Structure) -> set[int]:
    """Inputs that the limits of held forces depend on, but for the forces themselves."""
    forces = {s.inputs.index(f"own:{name}") for name in s.holds if f"own:{name}" in s.inputs}
    found: set[int] = set()
    for zone in {zone for zones in s.holds.values() for zone in zones}:
        for guard, members in zip(s.guards[zone], _of(s, zone)["guards"], strict=True):
            if guard["limits"]:
                found |= {j for member in members for sum_ in member["sums"] for j, _ in sum_}
    return found - forces


def _read_by_latches(s: Structure) -> set[int]:
    """Inputs that guards depend on which remember that they fired."""
    return {
        j for zone in s.zones for guard, members in zip(s.guards[zone], _of(s, zone)["guards"], strict=True)
        if guard["latches"] for member in members for sum_ in member["sums"] for j, _ in sum_
    }  # fmt: skip


def _of(s: Structure, zone: str) -> dict[str, Any]:
    """What a zone depends on when nothing is known of its pieces."""
    return s.reads[zone]["v" * len(s.place_tables)]


def _reached(block: Block, beats: Booleans, varies: Booleans, inputs: set[int]) -> Booleans:
    """By instance: one of these inputs follows what is given in time."""
    s, at = block.kernel.structure, block.in_index.reshape(block.count, -1)
    found = np.zeros(block.count, dtype=bool)
    for j in inputs:
        found |= beats if s.inputs[j] == "t" else varies[at[:, j]]
    return found
