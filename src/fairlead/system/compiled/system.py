"""The compiled model: everything an engine asks for, by the shape of `integrate.problem.Problem`.

    System      compiled once: structure, plans, code; frozen, and shared by all runs and threads
    Instance    a System in one run: working memory of its own, weights, what is recorded

Shapes are those of `integrate/problem.py` and `integrate/facts.py`, which say what every one means to an engine:
[n] by unknown, or by row of f; [ng] by guard; [nz] by machine, which is a position in `zones`.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any, NoReturn, Protocol

import numpy as np
from numpy.typing import NDArray

from fairlead.component.piecewise import FAR
from fairlead.distinct import distinct
from fairlead.errors import NoCopyError
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels import layout
from fairlead.kernels.break_away import least_left
from fairlead.system.arrays.blocks import Block, Memory, Tables
from fairlead.system.arrays.plain_python import CalledController, Known, called_controllers
from fairlead.system.arrays.pressing import pressed
from fairlead.system.arrays.recording import OutputSignal, Recording, choose
from fairlead.system.arrays.timing import PlacedTable
from fairlead.system.arrays.working import Bytes, Working, addressed, discrete, offsets
from fairlead.system.assembly.program import Pattern
from fairlead.system.numbering.contact_cycles import numbers
from fairlead.system.numbering.tolerances import Scales, Weights
from fairlead.system.numbering.unknowns import Numbering

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]
EVERYTHING = ("*",)
LOOKED_AT = 400.0
"""Steps in which a test bench takes a curve of friction. A parabola over its range is 1/400^2 = 6e-6 of its height from
lines between their ends."""


class Asked(Protocol):
    """What a run says of itself, see `integrate.problem.Run`; None: as the netlist says."""

    @property
    def accuracy(self) -> float | None:
        """Relative accuracy."""

    @property
    def start(self) -> float:
        """Time of the start, s."""

    @property
    def record(self) -> Sequence[str] | None:
        """Names of what to record, with * and ?; None: everything."""


@dataclass(frozen=True, eq=False)
class System:
    """A model as flat arrays and addresses of compiled callbacks; nothing in it is changed by a run."""

    flat: FlatModel
    numbering: Numbering
    blocks: list[Block]
    tables: Tables
    callbacks: dict[str, int]
    initial: Floats  # [n]
    pattern: Pattern  # of df/dy
    timed: Booleans  # [n]: rows of f that depend on time
    mass_pattern: Pattern  # of M
    zones: Integers  # [nz] at the start, but for what is given in time
    differential: Booleans  # [n]
    quadrature: Booleans  # [n]
    stiff: Booleans  # [n]: states inside components, as a bristle: some follow what drives them within a step
    accuracy: float  # of a run that does not say
    start: float  # likewise, s
    scales: Scales | None  # None for a part, whose weights are those of the whole
    guard_machine: Integers  # [ng]
    guard_inertia: Floats  # [ng] at the start
    holder: Integers  # [n]: the machine whose zone decides whether a row holds, or -1
    takes_impulse: Integers  # [n]: 0 it never holds, 1 no impulse but rounding, 2 any, 3 any of a relation of positions
    pressing: Integers  # [k, 2]: rows whose force other laws read, with the sign of its answer to a push
    met_guard: Integers  # [k]: guards of places at which a stop is met
    limit_guard: Integers  # [ng]: 1 if it bounds the force of its own contact while that holds
    blow_guard: Integers  # [ng]: 1 if an impulse asks it with the speeds before
    latch_guard: Integers  # [ng]: 1 if a part that only tells signals remembers that it fired
    least_guard: Integers  # [ng]: 1 if it is the least of several values, and their having risen is remembered
    kink_guard: Integers  # [ng]: 1 if it leads to the next piece of a continuous table
    linear: bool  # f is linear in the unknowns as long as the zones are frozen
    machine_names: Sequence[str]  # [nz]
    machine_kind: Integers  # [nz]: equal for the same place in instances of one class variant
    on_given_motion: list[str]  # stops of which a side moves as given
    n_swings: int  # what sines are taken of that no error of a step knows
    guard_names: Sequence[str]  # [ng]
    machine_zones: list[Sequence[str]]  # [nz]: names of the zones of each
    machine_owners: list[tuple[Block, int]]  # [nz]: the block it belongs to, and the instance in that
    signals: list[OutputSignal]  # all that can be recorded
    memory: Memory = field(repr=False)  # arrays that code reads; those that a run changes as they are at first
    working: Working = field(repr=False)
    timed_tables: list[PlacedTable] = field(repr=False)  # what is given in time
    subsystem_of: Callable[[Any], Any] | None = field(default=None, repr=False)  # see subsystem.py; None for a part

    def __post_init__(self) -> None:
        """Its arrays are read by all runs, in all threads; those of an Instance are its own."""
        for value in vars(self).values():
            if type(self) is System and isinstance(value, np.ndarray):
                value.setflags(write=False)

    @property
    def n(self) -> int:
        """How many unknowns."""
        return len(self.initial)

    @property
    def n_guards(self) -> int:
        """How many guard slots."""
        return len(self.guard_machine)

    @property
    def room(self) -> int:
        """Bytes that a run changes."""
        return self.working.size

    @property
    def unknown_names(self) -> list[str]:
        """Names of the unknowns, in order."""
        return [unknown.name for unknown in self.numbering.unknowns]

    @property
    def beyond_row(self) -> Integers:
        """Machines of contacts that may close a circle: a switch changes more than their own row."""
        machines = distinct(self.memory["circle_pairs"][:, layout.CIRCLE_MACHINE])
        return machines[machines >= 0]

    @property
    def circle(self) -> Integers:
        """By row: the number of the circle it lies in, 0 for none (`contact_cycles.numbers`)."""
        numbering, made = self.numbering, np.zeros(self.numbering.n, dtype=np.int64)
        of_pairs, of_bodies = numbers(numbering.circles, numbering.share)
        for pair, number in zip(numbering.circles, of_pairs, strict=True):
            made[numbering.own[pair.path, pair.unknown]] = number
        for body, row in numbering.share.items():
            made[row] = of_bodies[body]
        return made

    @property
    def grows_with_slip(self) -> Integers:
        """By row: 1 or -1 for a contact of a circle, by the sign of the force that a spring in its place would have."""
        made = np.zeros(self.numbering.n, dtype=np.int64)
        for pair in self.numbering.circles:
            made[self.numbering.own[pair.path, pair.unknown]] = 1 if pair.sense > 0 else -1
        return made

    def zone_names(self, machine: int) -> Sequence[str]:
        """Names of the zones of one machine."""
        return self.machine_zones[machine]

    def guard_name(self, guard: int, machine: int, before: int) -> str:
        """Name of the guard that fired, given the zone it left."""
        if guard < 0:
            return "time"
        first = int(self.memory["guard_machines"][guard])
        slot = int(self.memory["guard_place"][guard, layout.GUARD_SLOT])
        block, _ = self.machine_owners[first]
        s = block.kernel.structure
        zone = s.zones[before] if machine == first and len(s.zones) > 1 and before < len(s.zones) else None
        named = s.guards[zone] if zone else next((g for g in s.guards.values() if slot < len(g)), [])
        return named[slot]["name"] if slot < len(named) else ""

    @property
    def bodies(self) -> NDArray[np.bool_]:
        """[n]: speeds of nodes that have a position too."""
        found = np.zeros(len(self.numbering.unknowns), dtype=bool)
        found[[v for _, v in self.numbering.pairs]] = True
        return found

    @property
    def gauge(self) -> NDArray[np.bool_]:
        """[n]: unknowns that only differ by what is said of one of them, which is chance: how circles share a load.

        Accelerations too: the error of what they move counts, not their own.
        """
        return np.array([unknown.kind in ("share", "acceleration") for unknown in self.numbering.unknowns], dtype=bool)

    @property
    def summed(self) -> NDArray[np.bool_]:
        """[n]: unknowns that add up what components tell them; nothing flows by them."""
        return np.array([unknown.kind == "sum" for unknown in self.numbering.unknowns], dtype=bool)

    @functools.cached_property
    def moves(self) -> Integers:
        """[k, 3]: position, speed, acceleration (-1: no unknown), where relations of positions are kept; else none.

        Nor are there any without a stop of which a side moves as given: what touches it is brought back to it.
        """
        accelerations = {self.numbering.rate[k]: a for k, a in self.numbering.accelerated.items()}
        pairs = self.numbering.pairs if accelerations or self.on_given_motion else []
        light = bool(self.on_given_motion)  # nodes without inertia may touch what moves as given
        rows = [(x, v, accelerations.get(v, -1)) for x, v in pairs if light or self.differential[v]]
        return np.array(rows, dtype=np.int64).reshape(-1, 3)

    @functools.cached_property
    def balanced(self) -> Integers:
        """[k, 2]: position and speed of nodes without inertia whose balances have their rates beside them."""
        rows = [(self.numbering.position[k], self.numbering.rate[k]) for k in self.numbering.rated]
        return np.array(rows, dtype=np.int64).reshape(-1, 2)

    @functools.cached_property
    def rebound(self) -> Floats:
        """Coefficient of restitution of every row that takes any impulse, 0 for others."""
        found = np.zeros(self.n)
        for block in self.blocks:
            s = block.kernel.structure
            for unknown, (place, number) in s.rebounds.items():
                rows = block.flow_index[:, s.targets.index(f"own:{unknown}")]
                found[rows] = number if place < 0 else block.parameters[:, place]
        return found

    @property
    def mean(self) -> Floats:
        """[5]: what is asked for of given motions, see layout.py; [0] where none is read."""
        return self.memory["mean"] if len(self.memory["given_places"]) else np.zeros(0)

    @property
    def held_too_much(self) -> list[str]:
        """Contacts that begin open, since all together would hold too much (determinacy.py)."""
        return sorted(self.numbering.open_first)

    @property
    def longest_step(self) -> float:
        """An eighth of the shortest period [s] of what swings in time: while all rests, nothing else tells of it.

        Where all motion is given, no error tells how long a step may be for curved laws to be seen to change: as a test
        bench takes a curve of friction, LOOKED_AT times a period, and in the longest piece of what is given.
        """
        fastest, parts, pieces = 0.0, 8.0, math.inf
        for block in self.blocks:
            for amplitude, omega in block.kernel.structure.sines:
                swings = block.parameters[:, amplitude] != 0
                fastest = max(fastest, np.abs(block.parameters[swings, omega]).max(initial=0.0))
        if self._all_given and not self.linear:
            lengths = [table.polynomial.right - table.polynomial.left for table in self.timed_tables]
            longest = max((float(one[one < FAR].max(initial=0.0)) for one in lengths), default=0.0)
            parts, pieces = LOOKED_AT, longest / LOOKED_AT or math.inf
        return min(2 * math.pi / (parts * fastest) if fastest else math.inf, pieces)

    @functools.cached_property
    def _all_given(self) -> bool:
        """True if no unknown answers to another: there are integrals of what is given, and what follows at once."""
        answers = np.zeros(self.n, dtype=bool)
        answers[self.pattern.rows] = True
        return not (answers & self.differential & ~self.quadrature).any()

    @property
    def ledger(self) -> tuple[int, int]:
        """The unknowns in which what is dissipated and what is supplied add up; -1 where there is no ledger."""
        ledger = self.numbering.ledger
        return ledger.get("dissipated", -1), ledger.get("supplied", -1)

    @functools.cached_property
    def falls(self) -> Integers:
        """By machine: 1 where friction falls with a jump as the contact lets go."""
        fell: dict[tuple[int, int], int] = {}
        found = np.zeros(len(self.zones), dtype=np.int64)
        for block in self.blocks:
            shares = block.kernel.structure.shares_left
            for instance, machines in zip(block.instances, block.machines, strict=True) if shares else ():
                key = id(shares), id(instance.values)
                if key not in fell:
                    fell[key] = int(least_left(shares, instance.values) < 1)
                found[machines[0]] = fell[key]
        return found

    @property
    def samples(self) -> bool:
        """True if controllers take samples of signals."""
        return bool(len(self.memory["sampled"]))

    def recording(self, patterns: Sequence[str]) -> Recording:
        """Choose what is recorded, by names with * and ?; the ledger and the creep of every contact are, too."""
        return self._recording(tuple(patterns))

    @functools.cached_property
    def _recording(self) -> Callable[[tuple[str, ...]], Recording]:
        pressing = frozenset(one.signal for one in pressed(self.flat))
        return functools.lru_cache(maxsize=8)(
            lambda names: choose(self.signals, names, self.blocks, self.numbering, self.memory, pressing)
        )

    def instance(self, run: Asked | None = None, piece: Bytes | None = None) -> Instance:
        """This System for one run, with memory of its own; in `piece`, `working.size` bytes of zeros, if given."""
        assert self.scales is not None, "a part has the weights of the whole"
        accuracy = self.accuracy if run is None or run.accuracy is None else run.accuracy
        names = EVERYTHING if run is None or run.record is None else run.record
        piece = self.working.new() if piece is None else piece
        made = begun(self, self.scales.weights(accuracy), self.recording(names), piece)
        start = self.start if run is None else run.start
        for table in self.timed_tables:
            made.zones[table.machine] = table.polynomial.piece_at(start)
        made.memory["sample_start"][0] = start
        return made

    def __reduce_ex__(self, protocol: object) -> NoReturn:
        """Code and addresses are of this process. Raises NoCopyError."""
        raise NoCopyError("a System holds compiled code and cannot be copied or pickled. Pickle its Model instead.")

    def __str__(self) -> str:
        unknowns = self.numbering.unknowns
        algebraic = sum(not u.differential for u in unknowns)
        lines = [
            f"{self.n} unknowns, {algebraic} of them algebraic; {len(self.pattern.rows)} entries in df/dy; "
            f"{len(self.zones)} machines with zones; {self.n_guards} guard slots; "
            f"{len(self.blocks)} kernels",
        ]
        lines += [f"  kernel {b.kernel.variant.label}: {b.count} instances" for b in self.blocks]
        lines += [f"  unknown {u.name} [{u.unit}] {'' if u.differential else 'algebraic'}".rstrip() for u in unknowns]
        return "\n".join(lines)


@dataclass(frozen=True, eq=False)
class Instance(System):
    """A System in one run. Its callbacks change what lies in `piece`, and its controllers, and nothing else."""

    of: System = field(kw_only=True, repr=False)
    piece: Bytes = field(kw_only=True, repr=False)
    context: int = field(kw_only=True)
    absolute: Floats = field(kw_only=True)
    relative: Floats = field(kw_only=True)
    cap: Floats = field(kw_only=True)
    guard_tolerance: Floats = field(kw_only=True)
    record: Recording = field(kw_only=True, repr=False)
    controllers: list[CalledController] = field(kw_only=True, repr=False)

    @property
    def recorded(self) -> list[OutputSignal]:
        """What is recorded, in order."""
        return self.record.recorded

    @property
    def n_outputs(self) -> int:
        """Recorded outputs, and the stored energy at the end."""
        return len(self.recorded) + 1

    def remembered(self) -> list[Known]:
        """Copies of what the controllers in plain Python know."""
        return [controller.known() for controller in self.controllers]

    def raise_if_failed(self) -> None:
        """Nothing: a controller that failed is told with the run."""

    def remind(self, known: list[Known]) -> None:
        """Let the controllers go on from there."""
        for controller, what in zip(self.controllers, known, strict=True):
            controller.know(what)

    @functools.cached_property
    def subsystem(self) -> Any:
        """Cuts out what moves, see subsystem.py; None for a part."""
        return None if self.subsystem_of is None else self.subsystem_of(self)


def begun(system: System, weights: Weights, record: Recording, piece: Bytes) -> Instance:
    """An Instance that works in `piece`, which is zero, as a run begins but for time."""
    own = system.working.arrays(piece)
    for name, values in system.working.begin.items():
        own[name][...] = values
    blocks = [_own_block(block, k, own) for k, block in enumerate(system.blocks)]
    memory = system.memory | own | addressed(system.memory, own, blocks)
    context = memory["context"]
    record.tell(context)
    controllers = called_controllers(blocks, system.numbering, memory)
    context[layout.SAMPLE_KERNELS] = memory["sample_kernels"].ctypes.data
    return Instance(
        **{f.name: getattr(system, f.name) for f in fields(System)}
        | {"blocks": blocks, "memory": memory, "zones": own["zones"], "guard_inertia": own["guard_inertia"]},
        of=system, piece=piece, context=context.ctypes.data, absolute=weights.absolute, relative=weights.relative,
        cap=weights.cap, guard_tolerance=weights.guard_tolerance, record=record, controllers=controllers,
    )  # fmt: skip


def _own_block(block: Block, k: int, own: Memory) -> Block:
    """A block with what a run changes of it."""
    if discrete(k) in own:
        block = replace(block, parameters=own[discrete(k)])
    return replace(block, in_offset=own[offsets(k)]) if offsets(k) in own else block
