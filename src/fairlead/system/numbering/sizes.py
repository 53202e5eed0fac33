"""Sizes of the unknowns that count as 1: by unit, as contacts and states say, and as the netlist's `nominal` says.

    nominal: {block.x: 2 um, "*.v": 1 mm/s, "line.core_node[*].x": 1 mm}

The absolute error weight of an unknown is the accuracy times its size. A size of a port that turns with another one
(`rim.rack.v` of a wheel) is put down to the unknown behind it, by their ratio. Of two patterns that fit one unknown
that with more letters counts, wildcards not counted; of names of one pattern that move as one, the least size.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.component.assembly import Instance
from fairlead.component.declare import TRANSLATIONAL
from fairlead.errors import Fault, shown
from fairlead.flatten.flat_model import FlatModel
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.netlist.netlist import Value
from fairlead.patterns import picked
from fairlead.quantities import QuantityError, computable_size
from fairlead.system.numbering.named_unknowns import Named, named_unknowns, no_such
from fairlead.system.numbering.unknowns import Numbering, Unknown

Floats = NDArray[np.float64]

# Sizes that matter in a scene of handling equipment, by unit; the accuracy is relative to these.
NOMINAL = {"m": 1e-2, "m/s": 0.1, "N": 10.0, "rad": 1e-2, "rad/s": 1.0, "N*m": 10.0, "Pa": 1e5, "V": 1.0, "A": 1.0,
           "m^3/s": 1e-5, "m^3": 1e-6}  # fmt: skip


@dataclass(frozen=True, eq=False)
class OfContacts:
    """What contacts say of the unknowns they rub on, shape (n,) each; infinite where none says anything."""

    creep: Floats
    """The smallest creep at a speed."""
    changes: Floats
    """The smallest range of speeds over which a curve changes."""
    presliding: Floats
    """The smallest way that a contact gives before it slides, at a position."""


def of_contacts(flat: FlatModel, numbering: Numbering) -> OfContacts:
    """Each in the unit of its unknown, which may turn where the contact slides."""
    found = OfContacts(*(np.full(numbering.n, np.inf) for _ in range(3)))
    known: dict[int, tuple[float, float, float] | None] = {}
    for instance in flat.instances:
        key = id(instance.values)  # nodes of a line share theirs
        if key not in known:
            sizes_of = _own_sizes(instance)
            known[key] = None if min(sizes_of) == np.inf else sizes_of
        if (own := known[key]) is None:
            continue
        creep, changes, presliding = own
        for port in _slipping(instance):
            index, ratio, _ = flat.places[instance.path, port]
            at = ((found.creep, creep, numbering.rate), (found.changes, changes, numbering.rate),
                  (found.presliding, presliding, numbering.position))  # fmt: skip
            for sizes, size, where in at:
                if index in where and ratio:
                    sizes[where[index]] = min(sizes[where[index]], size / abs(ratio))
    return found


def _own_sizes(instance: Instance) -> tuple[float, float, float]:
    """Creep and range of speeds [m/s], way before it slides [m]; infinite where a contact has none."""
    says, values = instance.type.answers, instance.values
    creep = values.path(says.sticks_below) if says.creeps else np.inf
    changes = says.changes_over(values) if says.changes_over is not None and not says.creeps else None
    return creep, changes or np.inf, values.path(says.preslides) if says.preslides else np.inf


def _slipping(instance: Instance) -> list[str]:
    """Ports of a contact between which it slips along a line."""
    return [name for name, port in instance.type.declaration.ports.items() if port.domain is TRANSLATIONAL]


def nominal_sizes(flat: FlatModel, numbering: Numbering, contacts: OfContacts) -> Floats:
    """The size of every unknown, shape (n,): that of its unit or its own, what contacts say, what the netlist says."""
    own = np.array([_of_unknown(one) for one in numbering.unknowns])
    sizes = np.minimum(np.minimum(own, contacts.presliding), contacts.changes)
    for unknown, size in _given(flat, numbering)[0].items():
        sizes[unknown] = size
    return sizes


def nominal_faults(flat: FlatModel, numbering: Numbering) -> list[Fault]:
    """What is wrong with the block `nominal` of the netlist."""
    return _given(flat, numbering)[1]


def _of_unknown(unknown: Unknown) -> float:
    return NOMINAL.get(unknown.unit, 1.0) if unknown.nominal is None else unknown.nominal


def _given(flat: FlatModel, numbering: Numbering) -> tuple[dict[int, float], list[Fault]]:
    """Sizes that the netlist gives, and what is wrong with them."""
    given = flat.assembly.netlist.nominal
    names = named_unknowns(flat, numbering) if given else {}
    found: dict[int, tuple[int, str, float]] = {}
    faults: list[Fault] = []
    for pattern, value in given.items():
        if len(faults) > MOST_FAULTS:
            break
        chosen = picked(names, pattern)
        if not chosen:
            faults.append(no_such(flat, names, "nominal", pattern, value.named_at))
            continue
        sizes, fault = _read(pattern, value, {name: names[name] for name in chosen})
        faults += [fault] if fault is not None else []
        letters = sum(one not in "*?" for one in pattern)
        for unknown, size in sizes.items():
            before = found.get(unknown)
            if before is not None and before[0] == letters and not math.isclose(before[2], size, rel_tol=1e-9):
                both = f"nominal.{before[1]}, and both fit {numbering.unknowns[unknown].name}"
                what = f"nominal.{pattern} = {shown(value.plain())} contradicts {both}."
                faults.append(Fault(value.where, what, "Give the size of that one by its own name."))
            if before is None or letters > before[0]:
                found[unknown] = letters, pattern, size
    return {unknown: size for unknown, (_, _, size) in found.items()}, faults


def _read(pattern: str, value: Value, chosen: dict[str, Named]) -> tuple[dict[int, float], Fault | None]:
    """Sizes by unknown."""
    sizes: dict[int, float] = {}
    for at in chosen.values():
        try:
            size = computable_size(value.plain(), at.unit)
        except QuantityError as error:
            return {}, Fault(value.where, f"nominal.{pattern} = {error.what}.", error.allowed)
        if not size > 0:
            what = f"nominal.{pattern} = {shown(value.plain())} is no size."
            return {}, Fault(value.where, what, "Give what counts as 1 there, above zero.")
        if at.ratio:
            sizes[at.unknown] = min(sizes.get(at.unknown, math.inf), size / abs(at.ratio))
    return sizes, None
