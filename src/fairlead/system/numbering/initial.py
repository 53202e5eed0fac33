"""Where the unknowns begin: the values of the components, replaced by what the netlist's `initial` says.

    initial: {block.x: 20 mm, "line.core_node[*].v": -0.3 m/s, pad.force: 2 N}

What a name may be is told in `named_unknowns.py`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import Fault, shown
from fairlead.flatten.flat_model import FlatModel
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.patterns import picked
from fairlead.quantities import QuantityError, computable
from fairlead.system.numbering.named_unknowns import named_unknowns, no_such
from fairlead.system.numbering.unknowns import Numbering


def starts(flat: FlatModel, numbering: Numbering) -> tuple[NDArray[np.float64], set[int], list[Fault]]:
    """The unknowns at the start, shape (n,), those that `initial` names, and what is wrong with that block."""
    begin = np.array([unknown.start for unknown in numbering.unknowns])
    given = flat.assembly.netlist.initial
    if not given:
        return begin, set(), []
    names, faults = named_unknowns(flat, numbering), list[Fault]()
    said: dict[int, tuple[str, float]] = {}
    for pattern, value in given.items():
        if len(faults) > MOST_FAULTS:
            break
        chosen = picked(names, pattern)
        if not chosen:
            faults.append(no_such(flat, names, "initial", pattern, value.named_at))
            continue
        try:
            numbers = {name: computable(value.plain(), names[name].unit) for name in chosen}
        except QuantityError as error:
            faults.append(Fault(value.where, f"initial.{pattern} = {error.what}.", error.allowed))
            continue
        for name, number in numbers.items():
            at = names[name]
            start = (number - at.offset) / at.ratio
            other, before = said.get(at.unknown, (pattern, start))
            if not math.isclose(before, start, rel_tol=1e-9, abs_tol=1e-12):
                what = f"initial.{pattern} = {shown(value.plain())} contradicts initial.{other}: both move as one."
                faults.append(Fault(value.where, what, "Give one of them."))
            said[at.unknown] = pattern, start
    for unknown, (_, start) in said.items():
        begin[unknown] = start
    return begin, set(said), faults
