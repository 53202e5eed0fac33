"""The instances of every class variant laid out for their kernel: indices, coefficients, parameters."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.component.instantiate import Instance, PortRef
from fairlead.component.keys import INPUT, OWN, RATE, TIME, key, rate_of
from fairlead.component.piecewise import STRIDE, PiecewisePolynomial
from fairlead.component.values import input_given, parameter, polynomial
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels.kernel import Kernel
from fairlead.kernels.structure import Structure
from fairlead.system.numbering.unknowns import LEDGER, Numbering

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Memory = dict[str, NDArray[Any]]  # arrays that compiled code reads and writes, by the names of `layout.py`
MASSLESS = 1e12  # inverse mass of a node without mass: light beside everything else


@dataclass
class Tables:
    """All tables of the model in one vector; the same table is stored once."""

    rows: list[Floats] = field(default_factory=list)
    at: dict[int, int] = field(default_factory=dict)
    length: int = 0

    def place(self, table: PiecewisePolynomial) -> int:
        """Where a table starts."""
        if id(table) not in self.at:
            self.at[id(table)] = self.length
            self.rows.append(table.rows)
            self.length += table.rows.size
        return self.at[id(table)]

    def vector(self) -> Floats:
        """All rows, flat."""
        return np.concatenate([r.ravel() for r in self.rows]) if self.rows else np.zeros(STRIDE)


@dataclass
class Block:
    """Instances of one variant, in the order of their signal rank."""

    kernel: Kernel
    instances: list[Instance]
    ranks: list[int]
    parameters: Floats
    in_index: Integers
    in_coef: Floats
    in_offset: Floats
    machines: Integers
    table_base: Integers
    sig_index: Integers
    flow_index: Integers
    flow_coef: Floats
    ledger_index: Integers
    acts: bool = True
    """False in a part of a model where these instances only say when it ends: nothing but their guards is asked."""

    @property
    def count(self) -> int:
        """How many instances."""
        return len(self.instances)


def build_blocks(
    flat: FlatModel, kernels: dict[str, Kernel], numbering: Numbering, ranks: dict[str, int], tau: float
) -> tuple[list[Block], Tables, list[tuple[str, int]]]:
    """Blocks, tables, and the machines in the order of their positions in `zones`: (instance, number in it)."""
    grouped: dict[int, list[Instance]] = {}
    for instance in flat.instances:
        grouped.setdefault(kernels[instance.path].address, []).append(instance)
    tables = Tables()
    machines: list[tuple[str, int]] = []
    blocks = []
    for instances in grouped.values():
        instances.sort(key=lambda instance: ranks.get(instance.path, 0))
        kernel = kernels[instances[0].path]
        blocks.append(_block(flat, kernel, instances, numbering, ranks, tables, machines, tau))
    return blocks, tables, machines


def _block(flat: FlatModel, kernel: Kernel, instances: list[Instance], numbering: Numbering, ranks: dict[str, int],
           tables: Tables, machines: list[tuple[str, int]], tau: float) -> Block:  # fmt: skip
    s = kernel.structure
    inputs = [[place_of_input(flat, numbering, instance, one) for one in s.inputs] for instance in instances]
    flows = [[_target(flat, numbering, instance, target, tau) for target in s.targets] for instance in instances]
    slots = []
    for instance in instances:
        slots.append([len(machines) + k for k in range(s.machines)])
        machines += [(instance.path, k) for k in range(s.machines)]
    signals = [[_signal(numbering, PortRef(i.path, name)) for name in s.outputs] for i in instances]
    return Block(
        kernel, instances, [ranks.get(i.path, 0) for i in instances],
        _floats([[parameter_of(flat, i, s, name, tau) for name in s.parameters] for i in instances]),
        _integers([[z for z, _, _ in row] for row in inputs]), _floats([[c for _, c, _ in row] for row in inputs]),
        _floats([[o for _, _, o in row] for row in inputs]), _integers(slots),
        _integers([[tables.place(polynomial(i.values.path(name))) for name in s.tables] for i in instances]),
        _integers(signals),
        _integers([[w for w, _ in row] for row in flows]), _floats([[c for _, c in row] for row in flows]),
        np.array([numbering.ledger.get(line, numbering.w_dump) for line in LEDGER], dtype=np.int64),
    )  # fmt: skip


def _floats(rows: Iterable[Iterable[float]]) -> Floats:
    return np.array(list(rows), dtype=np.float64)


def _integers(rows: Iterable[Iterable[int]]) -> Integers:
    return np.array(list(rows), dtype=np.int64)


def _signal(numbering: Numbering, output: PortRef) -> int:
    place = numbering.signals.get(output)
    return numbering.dump if place is None else numbering.n + place


def place_of_input(flat: FlatModel, numbering: Numbering, instance: Instance, text: str) -> tuple[int, float, float]:
    """Where an input lies in z, its coefficient and its offset."""
    one = key(text)
    if one.kind == TIME:
        return numbering.time, 1.0, 0.0
    if one.kind == OWN:
        return numbering.own[instance.path, one.name], 1.0, 0.0
    if one.kind == INPUT and one.part == RATE:
        source = flat.sources.get(PortRef(instance.path, one.name))
        at = numbering.signals.get(PortRef(source.instance, rate_of(source.port))) if source else None
        return (numbering.zero, 0.0, 0.0) if at is None else (numbering.n + at, 1.0, 0.0)
    if one.kind == INPUT:
        return _signal_input(flat, numbering, instance, one.name)
    return _port_input(flat, numbering, PortRef(instance.path, one.name), one.part)


def _signal_input(flat: FlatModel, numbering: Numbering, instance: Instance, name: str) -> tuple[int, float, float]:
    source = flat.sources.get(PortRef(instance.path, name))
    if source is not None:
        return numbering.n + numbering.signals[source], 1.0, 0.0
    outer = flat.assembly.open_inputs.get(PortRef(instance.path, name))
    own = input_given(instance.values, instance.type.declaration.inputs[name].default)
    return numbering.zero, 0.0, outer if outer is not None else own if own is not None else 0.0


def _port_input(flat: FlatModel, numbering: Numbering, port: PortRef, variable: str) -> tuple[int, float, float]:
    """Position or potential (x), rate (v), acceleration (a), prescribed (A), as an unknown (U), reaction (R)."""
    return place_of_motion(flat, numbering, *flat.place(port), variable)


def place_of_motion(
    flat: FlatModel, numbering: Numbering, index: int, ratio: float, offset: float, variable: str
) -> tuple[int, float, float]:
    """Where in z the motion stands of what moves with ratio * group + offset: place, coefficient, offset."""
    group = flat.groups[index]
    rate = numbering.rate.get(index)
    if group.free and variable == "U":
        return numbering.accelerated[index], ratio, 0.0
    if group.free and (variable in "AR" or (variable != "x" and rate is None)):
        return numbering.zero, 0.0, 0.0
    if variable == "R":  # the group's, at a port that moves `ratio` times as far
        return numbering.first_reaction + numbering.reactions[index], 1 / ratio, 0.0
    if group.free:
        if variable == "x":
            return numbering.position[index], ratio, offset
        assert rate is not None
        return (rate if variable == "v" else numbering.acceleration + rate), ratio, 0.0
    assert group.prescribed is not None
    if group.prescribed.outputs is None:
        return numbering.zero, 0.0, ratio * group.start[0] + offset if variable == "x" else 0.0
    _, own_ratio, own_offset = flat.place(group.prescribed.by)
    output = group.prescribed.outputs["xva".index(variable.lower().replace("u", "a"))]
    signal = numbering.n + numbering.signals[PortRef(group.prescribed.by.instance, output)]
    scale = ratio / own_ratio
    return signal, scale, offset - scale * own_offset if variable == "x" else 0.0


def _target(
    flat: FlatModel, numbering: Numbering, instance: Instance, target: str, tau: float
) -> tuple[int, float]:
    """Row of w and coefficient of a flow, rate or balance. A balance is written  M v' = -sum of flows."""
    kind, name, _ = key(target)
    if kind == OWN:
        return numbering.own[instance.path, name], 1.0
    index, ratio, _ = flat.place(PortRef(instance.path, name))
    if kind == RATE:
        at = numbering.rated.get(index)
        return (numbering.w_dump, 0.0) if at is None else (numbering.n + len(numbering.reactions) + at, -ratio * tau)
    if flat.groups[index].free:
        return numbering.balance[index], -ratio
    return numbering.n + numbering.reactions[index], ratio


def parameter_of(flat: FlatModel, instance: Instance, s: Structure, name: str, tau: float) -> float:
    """What a kernel reads under a name: of the component, of the body at one of its ports, or `tau` [s] for @tau."""
    if name == "@tau":
        return tau
    if name in s.inverse_masses:
        index, ratio, _ = flat.place(PortRef(instance.path, s.inverse_masses[name]))
        group = flat.groups[index]
        if not group.free:
            return 0.0
        return ratio**2 / group.mass if group.mass > 0 else MASSLESS
    return parameter(instance.values, name)
