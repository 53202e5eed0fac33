"""One number, the accuracy, turned into weights and tolerances; and the checks that keep them in order.

The error weight of unknown i is  min(absolute_i + relative_i |y_i|, cap_i).  Positions get no relative
part: a stiff line far from the origin would lose its tension in it. The absolute part is the accuracy times a size
(`sizes.py`). The speeds of a binding contact are
capped at a tenth of its creep, or less: with a weight as large as the creep itself a run never ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fairlead.brief import in_a_line
from fairlead.flatten.flat_model import FlatModel
from fairlead.system.numbering.sizes import NOMINAL, Floats, nominal_sizes, of_contacts
from fairlead.system.numbering.unknowns import Numbering

# Weight of a speed at a binding contact, in creeps: the force of what is bound follows the slip, and is known to
# that share of stiction. At accuracies finer than the ordinary it is less, by the root of the accuracy.
CREEP_SHARE, ORDINARY = 0.1, 1e-3
# Weight of a speed at a contact that slides, at most, in speeds over which its curve changes: a step that does not see
# the curve rise towards rest lands on the wrong side of it, and the contact does not come to stick.
CURVE_SHARE = 0.3
# What a guard may exceed zero by at an accepted point: rounding of quantities of its unit, no more.
GUARD_ROUNDING = {"m/s": 1e-10, "rad/s": 1e-9, "m": 1e-10, "rad": 1e-9, "N": 1e-7, "N*m": 1e-7, "Pa": 1e-2,
                  "V": 1e-9, "A": 1e-9, "m^3/s": 1e-14, "m^3": 1e-15}  # fmt: skip


@dataclass(frozen=True)
class Weights:
    """absolute, relative and cap of every unknown, shape (n,) each; the tolerance of every guard, shape (ng,)."""

    absolute: Floats
    relative: Floats
    cap: Floats
    guard_tolerance: Floats


@dataclass(frozen=True, eq=False)
class Scales:
    """What there is to know of a System before the accuracy is: by unknown, shape (n,) each, and by guard."""

    __repr__ = in_a_line

    nominal: Floats
    """Sizes that count as 1."""
    follows: Floats
    """1 where the weight grows with the unknown, else 0."""
    creep: Floats
    """The smallest creep of the contacts at a speed; infinite where there is none."""
    width: Floats
    """Likewise the largest weight at which their curves are seen."""
    rounding: Floats
    """By guard: what its unit is known to."""

    def weights(self, accuracy: float) -> Weights:
        """Weights for an accuracy; a guard is known to its rounding, but to a tenth of the smallest speed weight."""
        share = CREEP_SHARE * min(1.0, accuracy / ORDINARY) ** 0.5
        cap = np.minimum(share * self.creep, np.where(self.width < accuracy * NOMINAL["m/s"], self.width, np.inf))
        tolerance = np.minimum(self.rounding, cap.min(initial=np.inf) * 0.1)
        return Weights(accuracy * self.nominal, accuracy * self.follows, cap, tolerance)


def scales(flat: FlatModel, numbering: Numbering, rounding: Floats) -> Scales:
    """The scales of a model; `rounding` is that of its guards."""
    contacts = of_contacts(flat, numbering)
    follows = np.array([0.0 if u.kind in ("position", "ledger") else 1.0 for u in numbering.unknowns])
    sizes = nominal_sizes(flat, numbering, contacts)
    return Scales(sizes, follows, contacts.creep, CURVE_SHARE * contacts.changes, rounding)


def roundings(units: Sequence[str]) -> Floats:
    """What guards of these units are known to."""
    return np.array([GUARD_ROUNDING.get(unit, 1e-9) for unit in units])
