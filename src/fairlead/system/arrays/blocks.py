"""The instances of every class variant laid out for their kernel: indices, coefficients, parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from fairlead.brief import in_a_line
from fairlead.component.assembly import Instance, PortRef, asked_by_two
from fairlead.component.keys import INPUT, OWN, PORT, RATE, TAU, TIME, key, rate_of
from fairlead.component.piecewise import STRIDE, PiecewisePolynomial
from fairlead.component.values import input_given, parameter, polynomial
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels.kernel import Kernel
from fairlead.kernels.structure import Structure
from fairlead.system.numbering.unknowns import LEDGER, Numbering

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Memory = dict[str, NDArray[Any]]  # arrays that compiled code reads and writes, by the names of `layout.py`
T = TypeVar("T")
MASSLESS = 1e12  # inverse mass of a node without mass: light beside everything else


@dataclass
class Tables:
    """All tables of the model in one vector; the same table is stored once."""

    __repr__ = in_a_line

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

    __repr__ = in_a_line

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
    addresses = {id(one): one.address for one in {id(one): one for one in kernels.values()}.values()}
    for instance in flat.instances:
        grouped.setdefault(addresses[id(kernels[instance.path])], []).append(instance)
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
    ports = _Ports(flat, instances)
    in_index, in_coef, in_offset = _inputs(flat, numbering, ports, s.inputs)
    flow_index, flow_coef = _flows(flat, numbering, ports, s.targets, tau)
    slots = []
    for instance in instances:
        slots.append([len(machines) + k for k in range(s.machines)])
        machines += [(instance.path, k) for k in range(s.machines)]
    return Block(
        kernel, instances, [ranks.get(i.path, 0) for i in instances],
        _parameters(ports, s, tau), in_index, in_coef, in_offset, _integers(slots),
        _table_base(tables, instances, s.tables), _signals(numbering, instances, s.outputs), flow_index, flow_coef,
        np.array([numbering.ledger.get(line, numbering.w_dump) for line in LEDGER], dtype=np.int64),
    )  # fmt: skip


class _Ports:
    """Group, ratio and offset of the ports of some instances, looked up once: a law reads several motions of a port."""

    def __init__(self, flat: FlatModel, instances: list[Instance]) -> None:
        self.flat, self.instances = flat, instances
        self._known: dict[str, list[tuple[int, float, float]]] = {}

    def places(self, port: str) -> list[tuple[int, float, float]]:
        """Of a port, in the order of the instances."""
        if port not in self._known:
            places = self.flat.places
            self._known[port] = [places[instance.path, port] for instance in self.instances]
        return self._known[port]


def _inputs(
    flat: FlatModel, numbering: Numbering, ports: _Ports, inputs: Sequence[str]
) -> tuple[Integers, Floats, Floats]:
    """[instances, inputs]: where each lies in z, its coefficient and its offset."""
    shape = len(ports.instances), len(inputs)
    index, coef, offset = np.empty(shape, dtype=np.int64), np.empty(shape), np.empty(shape)
    for j, text in enumerate(inputs):
        one = key(text)
        if one.kind == PORT:
            found = _motions(flat, numbering, ports.places(one.name), one.part)
        elif one.kind == INPUT and one.part != RATE:
            found = _signal_inputs(flat, numbering, ports.instances, one.name)
        else:
            found = [place_of_input(flat, numbering, instance, text) for instance in ports.instances]
        index[:, j], coef[:, j], offset[:, j] = zip(*found, strict=True)
    return index, coef, offset


def _motions(
    flat: FlatModel, numbering: Numbering, places: Iterable[tuple[int, float, float]], part: str
) -> list[tuple[int, float, float]]:
    """As `place_of_motion` has them; what moves freely, as nearly all of a long line, is looked up here."""
    where = {"x": numbering.position, "v": numbering.rate}.get(part, {})
    groups, found = flat.groups, []
    for index, ratio, offset in places:
        at = where.get(index)
        if at is None or not groups[index].free:
            found.append(place_of_motion(flat, numbering, index, ratio, offset, part))
        else:
            found.append((at, ratio, offset if part == "x" else 0.0))
    return found


def _signal_inputs(
    flat: FlatModel, numbering: Numbering, instances: Iterable[Instance], name: str
) -> list[tuple[int, float, float]]:
    """As `_signal_input` has them; one that is joined is looked up here."""
    n, signals, found = numbering.n, numbering.signals, []
    sources = asked_by_two(flat.sources)
    for instance in instances:
        source = sources.get((instance.path, name))
        found.append(
            _signal_input(flat, numbering, instance, name) if source is None else (n + signals[source], 1.0, 0.0)
        )
    return found


def _flows(
    flat: FlatModel, numbering: Numbering, ports: _Ports, targets: Sequence[str], tau: float
) -> tuple[Integers, Floats]:
    """[instances, targets]: row of w and coefficient of each flow, rate or balance."""
    shape = len(ports.instances), len(targets)
    index, coef = np.empty(shape, dtype=np.int64), np.empty(shape)
    for j, target in enumerate(targets):
        kind, name, _ = key(target)
        if kind == OWN:
            found = [(numbering.own[instance.path, name], 1.0) for instance in ports.instances]
        else:
            places = ports.places(name)
            found = [_row_of_flow(flat, numbering, kind, group, ratio, tau) for group, ratio, _ in places]
            if kind != RATE and numbering.part_row:  # and from there to the balance of the body, see parts_of_bodies.py
                for i, instance in enumerate(ports.instances):
                    part = numbering.part_row.get(flat.node_of[PortRef(instance.path, name)])
                    found[i] = found[i] if part is None else (part, -places[i][1])
        index[:, j], coef[:, j] = zip(*found, strict=True)
    return index, coef


def _signals(numbering: Numbering, instances: list[Instance], outputs: Sequence[str]) -> Integers:
    """[instances, outputs]: where each goes in z."""
    n, dump, signals = numbering.n, numbering.dump, asked_by_two(numbering.signals)
    rows = [[signals.get((instance.path, name)) for name in outputs] for instance in instances]
    return _integers([[dump if place is None else n + place for place in row] for row in rows])


def _table_base(tables: Tables, instances: list[Instance], names: Sequence[str]) -> Integers:
    """[instances, tables]: where each starts."""
    return _integers(_of_values(instances, lambda i: [tables.place(polynomial(i.values.path(name))) for name in names]))


def _parameters(ports: _Ports, s: Structure, tau: float) -> Floats:
    """[instances, parameters] of a kernel."""
    own = [name for name in s.parameters if not of_motion(s, name)]
    found = np.empty((len(ports.instances), len(s.parameters)))
    of_own = [not of_motion(s, name) for name in s.parameters]
    found[:, of_own] = _of_values(ports.instances, lambda i: [parameter(i.values, name) for name in own])
    for j, name in enumerate(s.parameters):
        if name in s.inverse_masses:
            places = ports.places(s.inverse_masses[name])
            found[:, j] = [_inverse_mass(ports.flat, group, ratio) for group, ratio, _ in places]
        elif name == TAU:
            found[:, j] = tau
    return found


def _of_values(instances: Iterable[Instance], row: Callable[[Instance], list[T]]) -> list[list[T]]:
    """A row of each instance, which depends on its values only; made once for all that share them, as in a line."""
    known: dict[int, list[T]] = {}
    return [known.get(id(i.values)) or known.setdefault(id(i.values), row(i)) for i in instances]


def _integers(rows: Iterable[Iterable[int]]) -> Integers:
    return np.array(list(rows), dtype=np.int64)


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
    return place_of_motion(flat, numbering, *flat.place(PortRef(instance.path, one.name)), one.part)


def _signal_input(flat: FlatModel, numbering: Numbering, instance: Instance, name: str) -> tuple[int, float, float]:
    source = flat.sources.get(PortRef(instance.path, name))
    if source is not None:
        return numbering.n + numbering.signals[source], 1.0, 0.0
    outer = flat.assembly.open_inputs.get(PortRef(instance.path, name))
    own = input_given(instance.values, instance.type.declaration.inputs[name].default)
    return numbering.zero, 0.0, outer if outer is not None else own if own is not None else 0.0


def place_of_motion(
    flat: FlatModel, numbering: Numbering, index: int, ratio: float, offset: float, variable: str
) -> tuple[int, float, float]:
    """Where in z the motion stands of what moves with ratio * group + offset: place, coefficient, offset.

    Position or potential (x), rate (v), acceleration (a), prescribed (A), as an unknown (U), reaction (R).
    """
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


def _row_of_flow(
    flat: FlatModel, numbering: Numbering, kind: str, index: int, ratio: float, tau: float
) -> tuple[int, float]:
    """Row of w and coefficient of what goes into a group, or of its rate. A balance is  M v' = -sum of flows."""
    if kind == RATE:
        at = numbering.rated.get(index)
        return (numbering.w_dump, 0.0) if at is None else (numbering.n + len(numbering.reactions) + at, -ratio * tau)
    if flat.groups[index].free:
        return numbering.balance[index], -ratio
    return numbering.n + numbering.reactions[index], ratio


def of_motion(s: Structure, name: str) -> bool:
    """True for what a kernel reads under the name of a parameter and no component gives."""
    return name == TAU or name in s.inverse_masses


def parameter_of(flat: FlatModel, instance: Instance, s: Structure, name: str, tau: float) -> float:
    """What a kernel reads under a name: of the component, of the body at one of its ports, or `tau` [s] for @tau."""
    if name == TAU:
        return tau
    if name in s.inverse_masses:
        index, ratio, _ = flat.place(PortRef(instance.path, s.inverse_masses[name]))
        return _inverse_mass(flat, index, ratio)
    return parameter(instance.values, name)


def _inverse_mass(flat: FlatModel, index: int, ratio: float) -> float:
    """What a force at a port moves there: of a group, at a port that moves `ratio` times as far."""
    group = flat.groups[index]
    if not group.free:
        return 0.0
    return ratio**2 / group.mass if group.mass > 0 else MASSLESS
