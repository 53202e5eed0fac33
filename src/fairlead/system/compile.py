"""Fourth stage: the flat model becomes index arrays, kernels and a plan for the Jacobian.

    system = compile(flat)        kernels -> numbering -> blocks -> program -> context

No symbolic work happens here: kernels are traced once per class (`kernels.py`) and come from a cache.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.component.instantiate import PortRef
from fairlead.component.piecewise import PiecewisePolynomial
from fairlead.errors import Fault, ModelError
from fairlead.flatten.flat_model import FlatModel
from fairlead.system import layout
from fairlead.system.blocks import Block, Tables, build_blocks
from fairlead.system.determinacy import undetermined
from fairlead.system.driver import callbacks
from fairlead.system.initial import starts
from fairlead.system.kernels import Kernel, kernel
from fairlead.system.program import Entries, Program, plan
from fairlead.system.ranks import signal_ranks
from fairlead.system.system import OutputSignal, Pattern, System
from fairlead.system.tolerances import guard_tolerances, weights
from fairlead.system.unknowns import LEDGER, Numbering, number

HOLD_TIME = 1e-3  # s; a held contact loses a slip left over from rounding with this time constant

Integers = NDArray[np.int64]


def compile(flat: FlatModel, accuracy: float = 1e-3) -> System:
    """Compile a flat model. Raises ModelError for laws that cannot be traced, loops of signals and open parts."""
    kernels = _kernels(flat)
    structures = {path: made.structure for path, made in kernels.items()}
    effect = flat.assembly.netlist.effects.get("energy")
    numbering = number(flat, structures, energy=effect is None or effect.plain() != "off")
    ranks = signal_ranks(flat, kernels)
    blocks, tables, machines = build_blocks(flat, kernels, numbering, ranks, HOLD_TIME)
    begin, faults = starts(flat, numbering)
    faults += undetermined(flat, numbering, blocks)
    if faults:
        raise ModelError(faults)
    memory: dict[str, NDArray[Any]] = {}
    _offsets(blocks, numbering, memory)
    program = _program(flat, blocks, numbering)
    mass_pattern = _mass(blocks, numbering, memory)
    guards = _guards(blocks, memory)
    _context(flat, blocks, numbering, tables, machines, program, memory)
    chosen = weights(flat, numbering, accuracy)
    unknowns = numbering.unknowns
    system = System(
        flat, numbering, blocks, callbacks().address, memory["context"].ctypes.data,
        begin, Pattern(program.starts, program.rows), mass_pattern, memory["zones"],
        np.array([u.differential for u in unknowns], dtype=bool), np.array([u.kind == "ledger" for u in unknowns], dtype=bool),
        chosen.absolute, chosen.relative, chosen.cap, guard_tolerances([g[1] for g in guards], chosen.cap),
        memory["guard_machines"], [path for path, _ in machines], [g[0] for g in guards], _machine_zones(blocks),
        _machine_owners(blocks, len(machines)), _signals(flat, blocks, numbering), memory,
    )  # fmt: skip
    _start_pieces(flat, blocks, memory["zones"])
    system.record(["*"])
    return system


def _kernels(flat: FlatModel) -> dict[str, Kernel]:
    found, faults = {}, {}
    for instance in flat.instances:
        try:
            found[instance.path] = kernel(instance.variant)
        except TypeError as error:  # TraceError, and what an author's law may raise when it is run
            faults.setdefault(instance.variant, Fault(instance.where, f"{instance.path}: {error}"))
    if faults:
        raise ModelError(faults.values())
    return found


def _offsets(blocks: list[Block], numbering: Numbering, memory: dict[str, NDArray[Any]]) -> None:
    """Fill the blocks' rows: addresses of their arrays, offsets into partials, guards and outputs."""
    rows = np.zeros((len(blocks), layout.BLOCK), dtype=np.int64)
    partials, guards, outputs = 1, 0, 0
    for row, block in zip(rows, blocks, strict=True):
        arrays = (block.parameters, block.in_index, block.in_coef, block.in_offset, block.machines, block.table_base,
                  block.sig_index, block.flow_index, block.flow_coef, block.ledger_index)  # fmt: skip
        row[: len(arrays)] = [array.ctypes.data for array in arrays]
        s = block.kernel.structure
        for place, pairs in (
            (layout.D_SIGNALS, s.d_signals),
            (layout.D_FLOWS, s.d_flows),
            (layout.D_LEDGER, s.d_ledger),
            (layout.D_MASS, s.mass),
        ):
            row[place] = partials
            partials += block.count * len(pairs)
        row[layout.GUARDS], row[layout.OUTPUTS] = guards, outputs
        guards += block.count * s.slots
        outputs += block.count * (len(s.outputs) + 3)
    memory["blocks"], memory["partials"], memory["outputs"] = rows, np.ones(partials), np.zeros(outputs)


def _program(flat: FlatModel, blocks: list[Block], numbering: Numbering) -> Program:
    """Gather all partial derivatives and plan the elimination of the signals."""
    n, m = numbering.n, len(numbering.signals) + len(numbering.reactions)
    entries, level = Entries(), np.zeros(m + n, dtype=np.int64)
    top = 1 + max((rank for block in blocks for rank in block.ranks), default=0)
    level[len(numbering.signals) : m], level[m:] = top, top + 1
    at = 1
    for block in blocks:
        s, count = block.kernel.structure, np.arange(block.count)
        for k, name in enumerate(s.outputs):
            given = block.sig_index[:, k] != numbering.dump
            level[block.sig_index[given, k] - n] = np.array(block.ranks)[given] if name else 0
        for pairs, kind in ((s.d_signals, "signal"), (s.d_flows, "flow"), (s.d_ledger, "ledger")):
            for e, (k, j) in enumerate(pairs):
                row, coef = _row(block, numbering, kind, k, m)
                used = row >= 0
                partial = at + count * len(pairs) + e
                entries.add(row[used], block.in_index[used, j], partial[used], (coef * block.in_coef[:, j])[used])
            at += block.count * len(pairs)
        at += block.count * len(s.mass)
    _fixed_entries(flat, numbering, entries, n, m)
    return plan(entries, n, m, level)


def _row(block: Block, numbering: Numbering, kind: str, k: int, m: int) -> tuple[Integers, NDArray[np.float64]]:
    """Rows of the plan that value k of every instance goes to (-1: nowhere), and its coefficient."""
    one = np.ones(block.count)
    if kind == "signal":
        z = block.sig_index[:, k]
        return np.where(z == numbering.dump, -1, z - numbering.n), one
    if kind == "ledger":
        lines = [line for line in LEDGER if line in block.kernel.structure.ledger]
        place = numbering.ledger.get(lines[k], -1)
        return np.full(block.count, place + m if place >= 0 else -1), one
    w = block.flow_index[:, k]
    row = np.where(w < numbering.n, w + m, w - numbering.n + len(numbering.signals))
    return np.where(w == numbering.w_dump, -1, row), block.flow_coef[:, k]


def _fixed_entries(flat: FlatModel, numbering: Numbering, entries: Entries, n: int, m: int) -> None:
    """Rows x' = v, and the inertia at prescribed nodes; their partial derivative is the constant 1."""
    pairs = np.array(numbering.pairs, dtype=np.int64).reshape(-1, 2)
    one = np.zeros(len(pairs), dtype=np.int64)
    entries.add(pairs[:, 0] + m, pairs[:, 1], one, np.ones(len(pairs)))
    for row, mass, a in _reaction_masses(flat, numbering):
        entries.add(np.array([len(numbering.signals) + row]), np.array([a]), np.zeros(1, np.int64), np.array([mass]))


def _reaction_masses(flat: FlatModel, numbering: Numbering) -> list[tuple[int, float, int]]:
    """(reaction, mass, where its acceleration lies in z) of every prescribed group."""
    found = []
    for index, row in numbering.reactions.items():
        group = flat.groups[index]
        assert group.prescribed is not None
        outputs, by = group.prescribed.outputs, group.prescribed.by
        a = numbering.n + numbering.signals[PortRef(by.instance, outputs[2])] if outputs else numbering.zero
        found.append((row, group.mass, a))
    return found


def _mass(blocks: list[Block], numbering: Numbering, memory: dict[str, NDArray[Any]]) -> Pattern:
    """The mass matrix: a diagonal, and rows of held contacts with the coefficients of their slip."""
    n = numbering.n
    row, column, partial, coef = [], [], [], []
    at = 1
    for block in blocks:
        s, count = block.kernel.structure, np.arange(block.count)
        at += block.count * (len(s.d_signals) + len(s.d_flows) + len(s.d_ledger))
        for e, (unknown, j) in enumerate(s.mass):
            own = block.flow_index[:, s.targets.index(f"own:{unknown}")]
            used = block.in_index[:, j] < n
            row.append(own[used])
            column.append(block.in_index[used, j])
            partial.append((at + count * len(s.mass) + e)[used])
            coef.append(block.in_coef[used, j])
        at += block.count * len(s.mass)
    diagonal = np.array([i for i, u in enumerate(numbering.unknowns) if u.differential], dtype=np.int64)
    rows, columns = (np.concatenate([*x, diagonal]) for x in (row, column))
    keys, place = np.unique(columns * n + rows, return_inverse=True)
    static = np.zeros(len(keys))
    static[place[len(place) - len(diagonal) :]] = [numbering.unknowns[i].mass for i in diagonal]
    held = np.concatenate([*partial, np.zeros(0, np.int64)])
    memory["mass_static"], memory["mass_coef"] = static, np.concatenate([*coef, np.zeros(0)])
    memory["mass_program"] = np.ascontiguousarray(np.stack([place[: len(held)], held], axis=1).astype(np.int64))
    return Pattern(np.searchsorted(keys // n, np.arange(n + 1)).astype(np.int64), (keys % n).astype(np.int64))


def _guards(blocks: list[Block], memory: dict[str, NDArray[Any]]) -> list[tuple[str, str]]:
    """Tables that lead from a fired guard to the new zone; returns name and unit of every slot."""
    place, machines, to, named = [], [], [], []
    for block in blocks:
        s = block.kernel.structure
        first = len(to)
        slots = [[s.guards[zone][k] if k < len(s.guards[zone]) else None for k in range(s.slots)] for zone in s.zones]
        to += [(g["to"], g["machine"], g["step"]) if g else (0, 0, 0) for zone in slots for g in zone]
        names = ["/".join(dict.fromkeys(zone[k]["name"] for zone in slots if zone[k])) for k in range(s.slots)]
        units = [{zone[k]["unit"] for zone in slots if zone[k]} for k in range(s.slots)]
        for i, instance in enumerate(block.instances):
            for k in range(s.slots):
                zoned = len(s.zones) > 1
                place.append((block.machines[i, 0] if zoned else -1, first, s.slots, k))
                machines.append(block.machines[i, 0])
                named.append((f"{instance.path} {names[k]}", min(units[k])))
    memory["guard_place"] = np.array(place, dtype=np.int64).reshape(-1, 4)
    memory["guard_to"] = np.array(to, dtype=np.int64).reshape(-1, 3)
    memory["guard_machines"] = np.array(machines, dtype=np.int64)
    return named


def _context(flat: FlatModel, blocks: list[Block], numbering: Numbering, tables: Tables, machines: list[Any],
             program: Program, memory: dict[str, NDArray[Any]]) -> None:  # fmt: skip
    """Sizes and addresses in one vector of int64, in the order of `layout.py`."""
    n, reactions = numbering.n, _reaction_masses(flat, numbering)
    inverse = np.zeros(n)
    for index in numbering.rate:
        if flat.groups[index].mass > 0:
            inverse[numbering.rate[index]] = 1 / flat.groups[index].mass
    holds, always = _holds(blocks)
    memory |= {
        "z": np.zeros(numbering.dump + 1), "w": np.zeros(numbering.w_dump + 1),
        "zones": np.zeros(len(machines), dtype=np.int64), "tables": tables.vector(),
        "kernels": np.array([b.kernel.address for b in blocks], dtype=np.int64),
        "counts": np.array([b.count for b in blocks], dtype=np.int64), "schedule": _schedule(blocks, numbering),
        "pairs": np.array(numbering.pairs, dtype=np.int64).reshape(-1, 2), "inverse_mass": inverse,
        "reaction_mass": np.array([mass for _, mass, _ in reactions]),
        "reaction_a": np.array([a for _, _, a in reactions], dtype=np.int64),
        "work": np.concatenate([[1.0], np.zeros(program.length - 1)]), "program": program.steps, "program_coef": program.coef,
        "holds": holds, "time_place": _time_places(blocks), "selected": np.zeros(0, dtype=np.int64),
        "stored": _stored(blocks), **_samplers(flat, blocks),
    }  # fmt: skip
    sizes = {
        "N": n, "N_SIGNALS": len(numbering.signals), "N_REACTIONS": len(reactions), "N_BLOCKS": len(blocks),
        "N_SCHEDULE": len(memory["schedule"]), "N_GUARDS": len(memory["guard_machines"]), "N_PAIRS": len(numbering.pairs),
        "N_PROGRAM": len(program.steps), "N_JACOBIAN": len(program.rows), "N_WORK": program.length,
        "N_MASS": len(memory["mass_static"]), "N_MASS_PROGRAM": len(memory["mass_program"]), "N_HOLDS": len(holds),
        "N_TIME": len(memory["time_place"]), "N_SELECTED": 0, "N_STORED": len(memory["stored"]), "T_AT": numbering.time,
        "ACCELERATION_AT": numbering.acceleration, "REACTION_AT": numbering.first_reaction, "ALWAYS_HELD": always,
        "JACOBIAN_AT": program.jacobian_at, "N_SAMPLED": len(memory["sampled"]),
    }  # fmt: skip
    addresses = {"OUTPUTS_ALL": "outputs"} | {
        name: name.lower() for name in (
            "Z", "W", "ZONES", "TABLES", "KERNELS", "BLOCKS", "COUNTS", "SCHEDULE", "PAIRS", "INVERSE_MASS", "REACTION_MASS",
            "REACTION_A", "PARTIALS", "WORK", "PROGRAM", "PROGRAM_COEF", "MASS_STATIC", "MASS_PROGRAM", "MASS_COEF", "HOLDS",
            "GUARD_PLACE", "GUARD_TO", "GUARD_MACHINES", "TIME_PLACE", "SELECTED", "STORED", "SAMPLED", "SAMPLE_PERIOD",
            "SAMPLE_COUNT", "SAMPLE_START",
        )
    }  # fmt: skip
    context = np.zeros(layout.CONTEXT, dtype=np.int64)
    for name, value in sizes.items():
        context[getattr(layout, name)] = value
    for name, key in addresses.items():
        context[getattr(layout, name)] = memory[key].ctypes.data
    memory["context"] = context


def _schedule(blocks: list[Block], numbering: Numbering) -> Integers:
    """Calls that compute signals: runs of equal rank inside every block that gives any, by rank."""
    calls = []
    for number_, block in enumerate(blocks):
        if not block.sig_index.size or (block.sig_index == numbering.dump).all():
            continue
        ranks = np.array(block.ranks)
        calls += [(r, number_, *np.searchsorted(ranks, [r, r + 1])) for r in np.unique(ranks)]
    return np.array([call[1:] for call in sorted(calls)], dtype=np.int64).reshape(-1, 3)


def _holds(blocks: list[Block]) -> tuple[Integers, int]:
    found, always = [], 0
    for block in blocks:
        s = block.kernel.structure
        for zones in s.holds.values():
            if len(s.zones) == 1:
                always += block.count
            else:
                found += [(place, s.zones.index(zone)) for place in block.machines[:, 0] for zone in zones]
    return np.array(found, dtype=np.int64).reshape(-1, 2), always


def _time_places(blocks: list[Block]) -> Integers:
    found = []
    for block in blocks:
        for path, k, column in _table_machines(block):
            if path in block.kernel.structure.time_tables:
                for i, instance in enumerate(block.instances):
                    pieces = len(_table(instance.values.path(path)).rows)
                    found.append((block.machines[i, k], block.table_base[i, column], pieces))
    return np.array(found, dtype=np.int64).reshape(-1, 3)


def _samplers(flat: FlatModel, blocks: list[Block]) -> dict[str, NDArray[Any]]:
    """Instances with sample times, in the order of the blocks."""
    sampled = [
        (b, i, block) for b, block in enumerate(blocks) if block.kernel.structure.period for i in range(block.count)
    ]
    periods = [float(getattr(block.instances[i].values, block.kernel.structure.period)) for _, i, block in sampled]
    return {
        "sampled": np.array([(b, i) for b, i, _ in sampled], dtype=np.int64).reshape(-1, 2),
        "sample_period": np.array(periods), "sample_count": np.zeros(len(sampled), dtype=np.int64),
        "sample_start": np.array([flat.assembly.netlist.run.start]),
    }  # fmt: skip


def _table_machines(block: Block) -> list[tuple[str, int, int]]:
    """(table, its machine within the instance, its column in table_base)."""
    s = block.kernel.structure
    first = s.machines - len(s.tables)
    return [(path, first + column, column) for column, path in enumerate(s.tables)]


def _table(value: Any) -> PiecewisePolynomial:
    return getattr(value, "polynomial", value)


def _stored(blocks: list[Block]) -> Integers:
    found = []
    for block, row in zip(blocks, _output_offsets(blocks), strict=True):
        width = len(block.kernel.structure.outputs) + 3
        found += [row + i * width + width - 3 for i in range(block.count)]
    return np.array(found, dtype=np.int64)


def _output_offsets(blocks: list[Block]) -> list[int]:
    sizes = [block.count * (len(block.kernel.structure.outputs) + 3) for block in blocks]
    return [0, *np.cumsum(sizes)[:-1].tolist()] if sizes else []


def _signals(flat: FlatModel, blocks: list[Block], numbering: Numbering) -> list[OutputSignal]:
    """Every output of every instance under its name, outer names of composites, and the ledger."""
    found = []
    for block, first in zip(blocks, _output_offsets(blocks), strict=True):
        s, has = block.kernel.structure, block.kernel.variant.type.declaration
        width = len(s.outputs) + 3
        for i, instance in enumerate(block.instances):
            for k, name in enumerate(s.outputs):
                declared = has.outputs[name]
                found.append(
                    OutputSignal(f"{instance.path}.{name}", declared.unit, declared.doc, first + i * width + k)
                )
    by_name = {signal.name: signal for signal in found}
    for outer, inner in flat.assembly.aliases.items():
        if str(inner) in by_name and outer != str(inner):
            signal = by_name[str(inner)]
            found.append(OutputSignal(outer, signal.unit, signal.doc, signal.at))
    order = {instance.path: number_ for number_, instance in enumerate(flat.instances)}
    found.sort(key=lambda signal: order.get(signal.name.rpartition(".")[0], -1))
    return found + [
        OutputSignal(f"energy.{line}", "J", f"Energy {line}.", -1 - at) for line, at in numbering.ledger.items()
    ]


def _machine_zones(blocks: list[Block]) -> list[Any]:
    names: dict[int, Any] = {}
    for block in blocks:
        s = block.kernel.structure
        for i, instance in enumerate(block.instances):
            if len(s.zones) > 1:
                names[int(block.machines[i, 0])] = s.zones
            for path, k, _ in _table_machines(block):
                pieces = len(_table(instance.values.path(path)).rows)
                names[int(block.machines[i, k])] = [f"{path} {p}" for p in range(pieces)]
    return [names[k] for k in range(len(names))]


def _machine_owners(blocks: list[Block], count: int) -> list[Any]:
    owners: list[Any] = [None] * count
    for block in blocks:
        for i in range(block.count):
            for place in block.machines[i] if block.machines.size else ():
                owners[int(place)] = (block, i)
    return owners


def _start_pieces(flat: FlatModel, blocks: list[Block], zones: Integers) -> None:
    """Inputs begin in the piece that holds at the start time; tables of unknowns settle at the start."""
    start = flat.assembly.netlist.run.start
    for block in blocks:
        for path, k, _ in _table_machines(block):
            if path in block.kernel.structure.time_tables:
                for i, instance in enumerate(block.instances):
                    zones[block.machines[i, k]] = _table(instance.values.path(path)).piece_at(start)
