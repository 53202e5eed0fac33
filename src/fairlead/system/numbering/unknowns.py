"""Numbering: which unknown, signal or reaction lies where in z and w, and what every unknown is called."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from fairlead.brief import in_a_line
from fairlead.component.assembly import Instance, PortRef
from fairlead.component.declare import SUM, State
from fairlead.component.keys import PORT, key
from fairlead.component.values import number_given
from fairlead.flatten.flat_model import FlatModel, Group
from fairlead.kernels.structure import Structure
from fairlead.system.numbering.contact_cycles import REST, HeldPair, circles
from fairlead.system.numbering.parts_of_bodies import Part, parts_of_bodies

LEDGER = ("dissipated", "supplied")


@dataclass(frozen=True)
class Unknown:
    """One entry of y."""

    name: str
    unit: str
    differential: bool
    mass: float  # its diagonal entry of M, 0 when algebraic
    start: float
    kind: str  # position, rate, acceleration, potential, sum, state, multiplier, share, ledger
    nominal: float | None = None  # a size that matters, where its component says one


@dataclass
class Numbering:
    """Positions in z and w. `zero` always holds 0, `dump` takes what nobody reads."""

    __repr__ = in_a_line

    unknowns: list[Unknown] = field(default_factory=list)
    position: dict[int, int] = field(default_factory=dict)  # group -> unknown
    rate: dict[int, int] = field(default_factory=dict)
    balance: dict[int, int] = field(default_factory=dict)  # group -> row of its balance
    accelerated: dict[int, int] = field(default_factory=dict)  # group -> its acceleration, where that is an unknown
    parts: list[Part] = field(default_factory=list)  # of bodies whose ties say what they carry
    part_row: dict[int, int] = field(default_factory=dict)  # node -> row of the balance of its part
    common: dict[int, int] = field(default_factory=dict)  # group in parts -> its acceleration, an unknown
    own: dict[tuple[str, str], int] = field(default_factory=dict)
    circles: list[HeldPair] = field(default_factory=list)
    share: dict[int, int] = field(default_factory=dict)  # group in a circle -> unknown, see redundancy.py
    ledger: dict[str, int] = field(default_factory=dict)
    pairs: list[tuple[int, int]] = field(default_factory=list)
    signals: dict[PortRef, int] = field(default_factory=dict)  # output -> position among signals
    reactions: dict[int, int] = field(default_factory=dict)  # prescribed group -> position among reactions
    rated: dict[int, int] = field(default_factory=dict)  # group -> position of the rate of its balance
    geared: frozenset[int] = frozenset()  # groups without inertia whose speeds rows give that always hold
    open_first: frozenset[str] = frozenset()  # contacts that begin open, since all together would hold too much
    resting: int = 0  # numbers behind `dump` that stand for what rests, see subsystem.py

    @property
    def n(self) -> int:
        """How many unknowns."""
        return len(self.unknowns)

    @property
    def first_reaction(self) -> int:
        """Where the reactions begin in z."""
        return self.n + len(self.signals)

    @property
    def zero(self) -> int:
        """Where z holds 0."""
        return self.first_rate + len(self.rated)

    @property
    def first_rate(self) -> int:
        """Where the rates of balances begin in z, behind the reactions."""
        return self.first_reaction + len(self.reactions)

    @property
    def time(self) -> int:
        """Where z holds t."""
        return self.zero + 1

    @property
    def acceleration(self) -> int:
        """Where the accelerations begin in z."""
        return self.zero + 2

    @property
    def dump(self) -> int:
        """Where z takes what nobody reads; behind it lies only what rests."""
        return self.acceleration + self.n

    @property
    def w_dump(self) -> int:
        """Last position of w."""
        return self.n + len(self.reactions) + len(self.rated)

    def add(self, unknown: Unknown) -> int:
        """Append an unknown and say where it is."""
        self.unknowns.append(unknown)
        return self.n - 1


def number(flat: FlatModel, structures: Mapping[str, Structure], *, energy: bool, rated: Collection[int] = (),
           geared: Collection[int] = (), rates: Collection[PortRef] = ()) -> Numbering:  # fmt: skip
    """Number all unknowns of the model: groups, own unknowns of components, ledger.

    Nodes without inertia that are `rated` or `geared` have a speed, and `rates` are signals (algebraic_nodes.py).
    """
    made = Numbering(rated={k: place for place, k in enumerate(sorted(rated))}, geared=frozenset(geared))
    kept = groups_kept(flat, structures)
    damped = groups_with_rate_forces(flat, structures) | set(rated) | set(geared)
    for index, group in enumerate(flat.groups):
        if group.free:
            _number_group(made, index, group, rate_matters=index in damped)
            if index in kept:
                _number_acceleration(made, index, group)
        else:
            made.reactions[index] = len(made.reactions)
    for instance in flat.those(lambda kind: kind.declaration.states or kind.declaration.unknowns):
        _number_own(made, instance)
    _number_parts(made, flat)
    made.circles = circles(flat, structures)
    for index in sorted({index for pair in made.circles for index, _ in pair.ends if index != REST}):
        group = flat.groups[index]
        if group.free:
            unit = group.domain.through[1]
            made.share[index] = made.add(Unknown(f"{group.name}.share", unit, False, 0.0, 0.0, "share"))
    if energy:
        for line in LEDGER:
            made.ledger[line] = made.add(Unknown(f"energy.{line}", "J", True, 1.0, 0.0, "ledger"))
    for output in (*_connected_outputs(flat), *rates):
        made.signals[output] = len(made.signals)
    return made


def _number_group(made: Numbering, index: int, group: Group, *, rate_matters: bool) -> None:
    (x, x_unit), *rest = group.domain.across
    if not rest:  # one potential: pressure or voltage
        kind = "sum" if group.domain is SUM else "potential"
        row = made.add(Unknown(f"{group.name}.{x}", x_unit, group.mass > 0, group.mass, group.start[0], kind))
        made.position[index] = made.balance[index] = row
        return
    v, v_unit = rest[0]
    if group.mass == 0 and not rate_matters:  # springs alone: the balance gives the position itself
        row = made.add(Unknown(f"{group.name}.{x}", x_unit, False, 0.0, group.start[0], "position"))
        made.position[index] = made.balance[index] = row
        return
    made.position[index] = made.add(Unknown(f"{group.name}.{x}", x_unit, True, 1.0, group.start[0], "position"))
    made.rate[index] = made.add(
        Unknown(f"{group.name}.{v}", v_unit, group.mass > 0, group.mass, group.start[1], "rate")
    )
    made.balance[index] = made.rate[index]
    made.pairs.append((made.position[index], made.rate[index]))


def _number_acceleration(made: Numbering, index: int, group: Group) -> None:
    """A body whose position a relation reads:  m v' = m a,  0 = forces - m a."""
    unit = f"{group.domain.across[1][1]}^2"  # m/s^2
    name = f"{group.name}.{group.domain.acceleration}"
    made.accelerated[index] = made.balance[index] = made.add(Unknown(name, unit, False, 0.0, 0.0, "acceleration"))


def _number_parts(made: Numbering, flat: FlatModel) -> None:
    """Rows of parts are those of the ties that lead to them; that of the first is the acceleration of the body."""
    made.parts = parts_of_bodies(flat)
    for part in made.parts:
        group = flat.groups[part.group]
        if part.told_by is not None:
            row = made.own[part.told_by]
        elif group.free and part.group not in made.accelerated:
            unit = f"{group.domain.across[1][1]}^2"
            name = f"{group.name}.{group.domain.acceleration}"
            row = made.common[part.group] = made.add(Unknown(name, unit, False, 0.0, 0.0, "acceleration"))
        else:
            continue
        made.part_row |= dict.fromkeys(part.nodes, row)


@dataclass(frozen=True)
class PartRow:
    """The balance of a part: its row in w, where it counts too and how often, its mass, where its acceleration is."""

    row: int
    whole: int
    sign: float
    mass: float
    acceleration: int


def part_rows(flat: FlatModel, numbering: Numbering) -> list[PartRow]:
    """The balances of all parts that have one."""
    found = []
    given = {row: (a, mass / (flat.groups[k].mass or 1.0)) for (row, mass, a), k in
             zip(reaction_masses(flat, numbering), numbering.reactions, strict=False)}  # fmt: skip
    for part in numbering.parts:
        row = numbering.part_row.get(part.nodes[0])
        if row is None:
            continue
        if flat.groups[part.group].free:
            a = numbering.common.get(part.group, numbering.accelerated.get(part.group, -1))
            found.append(PartRow(row, numbering.balance[part.group], 1.0, part.mass, a))
        else:
            reaction = numbering.reactions[part.group]
            a, share = given[reaction]
            found.append(PartRow(row, numbering.n + reaction, -1.0, part.mass * share, a))
    return found


def groups_kept(flat: FlatModel, structures: Mapping[str, Structure]) -> set[int]:
    """Groups of the ports that relations of positions read."""
    keeping = ((path, s) for path, s in structures.items() if s.positions)
    return {flat.places[path, port][0] for path, s in keeping for ports in s.positions.values() for port in ports}


def _number_own(made: Numbering, instance: Instance) -> None:
    has = instance.type.declaration
    for name, state in has.states.items():
        start = number_given(instance.values, state.start)
        made.own[instance.path, name] = made.add(
            Unknown(f"{instance.path}.{name}", state.unit, True, 1.0, start, "state", nominal_given(instance, state))
        )
    for name, unknown in has.unknowns.items():
        made.own[instance.path, name] = made.add(
            Unknown(f"{instance.path}.{name}", unknown.unit, False, 0.0, 0.0, "multiplier", unknown.nominal)
        )


def nominal_given(instance: Instance, state: State) -> float | None:
    """The size of a state that matters, as its component says."""
    return None if state.nominal is None else number_given(instance.values, state.nominal)


def groups_with_rate_forces(flat: FlatModel, structures: Mapping[str, Structure]) -> set[int]:
    """Groups on which some law's flow depends on the rate: a node without mass keeps its rate then."""
    distinct = {id(s): s for s in structures.values()}  # instances of a class share theirs
    ports = {key: _ports_with_rate_forces(s) for key, s in distinct.items()}
    places = flat.places
    return {places[path, port][0] for path, s in structures.items() for port in ports[id(s)]}


def _ports_with_rate_forces(structure: Structure) -> set[str]:
    flows = [flow for uses in structure.flow_inputs.values() for flow in uses.items()]
    keys = {key(one) for target, read in flows if key(target).kind == PORT for one in read}
    return {one.name for one in keys if one.is_speed}


def reaction_masses(flat: FlatModel, numbering: Numbering) -> list[tuple[int, float, int]]:
    """(reaction, mass, where its acceleration lies in z) of every prescribed group; nothing for rates of balances."""
    found = []
    for index, row in numbering.reactions.items():
        prescribed, a, ratio = flat.groups[index].prescribed, numbering.zero, 1.0
        if prescribed is not None and prescribed.outputs is not None:
            a = numbering.n + numbering.signals[PortRef(prescribed.by.instance, prescribed.outputs[2])]
            _, ratio, _ = flat.place(prescribed.by)
        found.append((row, flat.groups[index].mass / ratio, a))  # the source tells its own acceleration
    return found + [(len(numbering.reactions) + k, 0.0, numbering.zero) for k in numbering.rated.values()]


def _connected_outputs(flat: FlatModel) -> list[PortRef]:
    """Outputs that feed an input or prescribe a motion, each once."""
    found = dict.fromkeys(flat.sources.values())
    for group in flat.groups:
        if group.prescribed is not None and group.prescribed.outputs is not None:
            found |= dict.fromkeys(PortRef(group.prescribed.by.instance, name) for name in group.prescribed.outputs)
    return list(found)
