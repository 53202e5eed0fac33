"""The compiled model: everything an engine asks for, by the shape of `integrate.protocol.Problem`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.flatten.flat_model import FlatModel
from fairlead.patterns import matcher
from fairlead.system import layout
from fairlead.system.blocks import Block, Tables
from fairlead.system.plain_python import CalledController
from fairlead.system.shares import shares
from fairlead.system.shown import what_to_ask
from fairlead.system.unknowns import Numbering

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class Pattern(NamedTuple):
    """Where a sparse matrix has entries, by columns (CSC)."""

    starts: Integers
    rows: Integers


@dataclass(frozen=True)
class OutputSignal:
    """One recordable output."""

    name: str
    unit: str
    doc: str
    at: int  # position among all outputs, or -1 - position in z


@dataclass
class System:
    """A model as flat arrays and addresses of compiled callbacks. `memory` keeps the arrays alive."""

    flat: FlatModel
    numbering: Numbering
    blocks: list[Block]
    tables: Tables
    callbacks: dict[str, int]
    context: int
    initial: Floats
    pattern: Pattern
    timed: NDArray[np.bool_]  # rows of f that depend on time
    mass_pattern: Pattern
    zones: Integers
    differential: NDArray[np.bool_]
    quadrature: NDArray[np.bool_]
    stiff: NDArray[np.bool_]  # states inside components, as a bristle: some follow what drives them within a step
    absolute: Floats
    relative: Floats
    cap: Floats
    guard_tolerance: Floats
    guard_machine: Integers
    guard_inertia: Floats
    holder: Integers  # per row: the machine whose zone decides whether it holds, or -1
    limit_guard: Integers  # per guard: 1 if it bounds the force of its own contact while that holds
    kink_guard: Integers  # per guard: 1 if it leads to the next piece of a continuous table
    linear: bool  # f is linear in the unknowns as long as the zones are frozen
    machine_names: Sequence[str]
    guard_names: Sequence[str]
    machine_zones: list[Sequence[str]]
    machine_guards: list[Any]  # per machine: the block and the instance it belongs to
    signals: list[OutputSignal]
    memory: dict[str, NDArray[Any]] = field(repr=False)
    recorded: list[OutputSignal] = field(default_factory=list)
    controllers: list[CalledController] = field(default_factory=list, repr=False)
    narrowing: Any = field(default=None, repr=False)  # cuts out what moves, see narrowing.py; None for a part

    @property
    def n(self) -> int:
        """How many unknowns."""
        return len(self.initial)

    @property
    def unknown_names(self) -> list[str]:
        """Names of the unknowns, in order."""
        return [unknown.name for unknown in self.numbering.unknowns]

    @property
    def beyond_row(self) -> Integers:
        """Machines of contacts that may close a circle: a switch changes more than their own row."""
        machines = np.unique(self.memory["circle_pairs"][:, 5])
        return machines[machines >= 0]

    @property
    def n_outputs(self) -> int:
        """Recorded outputs, and the stored energy at the end."""
        return len(self.recorded) + 1

    def zone_names(self, machine: int) -> Sequence[str]:
        """Names of the zones of one machine."""
        return self.machine_zones[machine]

    def guard_name(self, guard: int, machine: int, before: int) -> str:
        """Name of the guard that fired, given the zone it left."""
        if guard < 0:
            return "time"
        first = int(self.memory["guard_machines"][guard])
        slot = int(self.memory["guard_place"][guard, 3])
        block, _ = self.machine_guards[first]
        s = block.kernel.structure
        zone = s.zones[before] if machine == first and len(s.zones) > 1 and before < len(s.zones) else None
        named = s.guards[zone] if zone else next((g for g in s.guards.values() if slot < len(g)), [])
        return named[slot]["name"] if slot < len(named) else ""

    @property
    def uneven(self) -> list[str]:
        """Contacts that hold between a node with inertia and one without, by name."""
        in_mass = np.zeros(self.n, dtype=bool)
        in_mass[self.mass_pattern.rows] = True
        return sorted({self.machine_names[m] for m in self.holder[(self.holder >= 0) & ~in_mass]})

    @property
    def longest_step(self) -> float:
        """An eighth of the shortest period [s] of what swings in time: while all rests, nothing else tells of it."""
        fastest = 0.0
        for block in self.blocks:
            names = block.kernel.structure.parameters
            for k, name in enumerate(names):
                wave, _, part = name.partition(":")
                if part == "omega":
                    swings = block.parameters[:, names.index(f"{wave}:amplitude")] != 0
                    fastest = max(fastest, np.abs(block.parameters[swings, k]).max(initial=0.0))
        return math.pi / (4 * fastest) if fastest else math.inf

    @property
    def samples(self) -> bool:
        """True if controllers take samples of signals."""
        return bool(len(self.memory["sampled"]))

    def record(self, patterns: Iterable[str]) -> list[OutputSignal]:
        """Choose what is recorded; always also the ledger and the creep of every contact, at the end."""
        wanted = [matcher(pattern) for pattern in patterns]
        chosen = [s for s in self.signals if any(fits(s.name) for fits in wanted)]
        names = {s.name for s in chosen}
        hidden = [s for s in self.signals if (s.name.endswith(".creep_rate") or s.at < 0) and s.name not in names]
        self.recorded = chosen + hidden
        self.memory["selected"] = np.array([s.at for s in self.recorded], dtype=np.int64)
        context = self.memory["context"]
        context[layout.N_SELECTED] = len(self.recorded)
        context[layout.SELECTED] = self.memory["selected"].ctypes.data
        counts, late = what_to_ask(self.blocks, shares(self.blocks)[0], self.memory["selected"])
        self.memory["counts"][layout.OUTPUT] = counts
        context[layout.RATES_SHOWN] = int(late)
        return chosen

    def __str__(self) -> str:
        unknowns = self.numbering.unknowns
        algebraic = sum(not u.differential for u in unknowns)
        lines = [
            f"{self.n} unknowns, {algebraic} of them algebraic; {len(self.pattern.rows)} entries in df/dy; "
            f"{len(self.zones)} machines with zones; {len(self.guard_tolerance)} guard slots; "
            f"{len(self.blocks)} kernels",
        ]
        lines += [f"  kernel {b.kernel.variant.label}: {b.count} instances" for b in self.blocks]
        lines += [f"  unknown {u.name} [{u.unit}] {'' if u.differential else 'algebraic'}".rstrip() for u in unknowns]
        return "\n".join(lines)
