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
    """absolute, relative and cap of every unknown, shape (n,) each."""

    absolute: Floats
    relative: Floats
    cap: Floats


def weights(flat: FlatModel, numbering: Numbering, accuracy: float) -> Weights:
    """Weights for an accuracy."""
    unknowns = numbering.unknowns
    absolute = np.array([accuracy * nominal(u) for u in unknowns])
    relative = np.array([0.0 if u.kind in ("position", "ledger") else accuracy for u in unknowns])
    cap = np.full(len(unknowns), np.inf)
    share = CREEP_SHARE * min(1.0, accuracy / ORDINARY) ** 0.5
    for instance in flat.instances:
        most = _most(instance, accuracy, share)
        if most == np.inf:
            continue
        for port in ("a", "b"):
            rate = numbering.rate.get(flat.place(PortRef(instance.path, port))[0])
            if rate is not None:
                cap[rate] = min(cap[rate], most)
    return Weights(absolute, relative, cap)


def _most(instance: Instance, accuracy: float, share: float) -> float:
    """The largest weight of the speeds at a contact, m/s; infinite where nothing but the accuracy says."""
    creep = instance.values.given.get("creep")
    if isinstance(creep, float):
        return share * creep
    if not hasattr(instance.type, "narrowest"):
        return np.inf
    width = CURVE_SHARE * (instance.values.curve.scale() or np.inf)
    return width if width < accuracy * NOMINAL["m/s"] else np.inf


def nominal(unknown: Unknown) -> float:
    """The size of an unknown that counts as 1."""
    return NOMINAL.get(unknown.unit, 1.0) if unknown.nominal is None else unknown.nominal


def guard_tolerances(units: Sequence[str], cap: Floats) -> Floats:
    """Per guard: the rounding of its unit, but at most a tenth of the smallest speed weight."""
    least = cap.min(initial=np.inf) * 0.1
    return np.array([min(GUARD_ROUNDING.get(unit, 1e-9), least) for unit in units])
