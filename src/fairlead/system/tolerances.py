"""One number, the accuracy, turned into weights and tolerances; and the checks that keep them in order.

The error weight of unknown i is  min(absolute_i + relative_i |y_i|, cap_i).  Positions get no relative
part: a stiff line far from the origin would lose its tension in it. The speeds of a binding contact are
capped at a tenth of its creep, or less: with a weight as large as the creep itself a run never ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.component.declare import TRANSLATIONAL
from fairlead.component.instantiate import Instance, PortRef
from fairlead.flatten.flat_model import FlatModel
from fairlead.system.unknowns import Numbering, Unknown

Floats = NDArray[np.float64]

# Sizes that matter in a scene of handling equipment, by unit; the accuracy is relative to these.
NOMINAL = {"m": 1e-2, "m/s": 0.1, "N": 10.0, "rad": 1e-2, "rad/s": 1.0, "N*m": 10.0, "Pa": 1e5, "V": 1.0, "A": 1.0,
           "m^3/s": 1e-5, "m^3": 1e-6}  # fmt: skip
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


def scales(flat: FlatModel, numbering: Numbering, units: Sequence[str]) -> Scales:
    """The scales of a model; `units` are those of its guards."""
    unknowns = numbering.unknowns
    creep, width = slow_speeds(flat, numbering)
    return Scales(
        np.array([nominal(u) for u in unknowns]),
        np.array([0.0 if u.kind in ("position", "ledger") else 1.0 for u in unknowns]),
        creep, width, np.array([GUARD_ROUNDING.get(unit, 1e-9) for unit in units]),
    )  # fmt: skip


def slow_speeds(flat: FlatModel, numbering: Numbering) -> tuple[Floats, Floats]:
    """By unknown the smallest creep and the largest weight at which curves are seen, see `Scales`; shape (n,) each."""
    creep, width = np.full(numbering.n, np.inf), np.full(numbering.n, np.inf)
    known: dict[int, tuple[float, float]] = {}
    for instance in flat.instances:
        key = id(instance.values)  # nodes of a line share theirs
        if key not in known:
            known[key] = _most(instance)
        for least, most in zip((creep, width), known[key], strict=True):
            if most == np.inf:
                continue
            for port in _slipping(instance):
                rate = numbering.rate.get(flat.place(PortRef(instance.path, port))[0])
                if rate is not None:
                    least[rate] = min(least[rate], most)
    return creep, width


def _slipping(instance: Instance) -> list[str]:
    """Ports of a contact between which it slips along a line."""
    return [name for name, port in instance.type.declaration.ports.items() if port.domain is TRANSLATIONAL]


def _most(instance: Instance) -> tuple[float, float]:
    """The creep of a contact, and the weight of a speed at which its curve is seen, m/s; infinite where it has none."""
    says = instance.type.answers
    if says.creeps:
        return instance.values.path(says.sticks_below), np.inf
    if says.changes_over is None:
        return np.inf, np.inf
    return np.inf, CURVE_SHARE * (says.changes_over(instance.values) or np.inf)


def nominal(unknown: Unknown) -> float:
    """The size of an unknown that counts as 1."""
    return NOMINAL.get(unknown.unit, 1.0) if unknown.nominal is None else unknown.nominal

