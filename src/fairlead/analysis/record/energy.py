"""Does the energy add up? The ledger of a run, integrated with it.

    closure = |stored change + dissipated - supplied| / throughput

Throughput E is what the model has dealt with: the largest of supplied, dissipated and stored energy at any time.

What a run may miss follows from its error weights. A body of inertia m whose speed v is known to its weight w has its
energy to  m v w + m w^2/2.  All together, with  R = sum of m w^2/2  (`resolved`), that is at most

    2 sqrt(R E) + R        since  sum m v w <= sqrt(sum m v^2 sum m w^2)

So a scene in which less than R passes has moved by less than its weights, and its closure says nothing; at E = 1e4 R
the weights explain 2 % and at 1e8 R nothing that counts. R is accuracy^2 times 5 mJ for 1 kg that goes along.

Supplied and dissipated energy are integrals, known to a share of their own error weights, accuracy times 1 J: as the
accuracy is a share, that is taken for it (`known_to`, 1e-8 J at 1e-4). What gives and takes less is not judged. Each
step of `ida` leaves them off by a share of their weights at which its iteration ends, so there the steps count.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.component.replies import is_bundled
from fairlead.system.compiled.system import Instance, System

MOST_NAMED = 3
LEFT_BY_IDA = 0.01
"""Share of its weight by which a step of `ida` leaves an integral off; 0.0035 was measured over 800 steps."""
NOTHING = 1e-20
"""Throughput [J] below which nothing has passed: the thermal motion of one particle is as much (Boltzmann's k T)."""


@dataclass
class Ledger:
    """Watches the stored energy and the two integrals [J] as a run records them."""

    first: NDArray[np.float64] | None = None  # dissipated, supplied, stored
    last: NDArray[np.float64] | None = None
    most: float = 0.0

    def watch(self, rows: NDArray[np.float64]) -> None:
        """Take recorded rows (k, 3): dissipated, supplied, stored."""
        if not len(rows):
            return
        if self.first is None:
            self.first = before_the_start(rows[0])
            self.most = abs(float(self.first[2]))
        self.last = rows[-1].copy()
        for sizes in (np.abs(rows - self.first), np.abs(rows[:, 2])):
            self.most = max(self.most, float(np.fmax.reduce(sizes, axis=None)))  # what is no number says nothing

    def summary(self) -> dict[str, float | None]:
        """For run.json; closure is None when nothing passed through."""
        if self.first is None or self.last is None:
            return {"closure": None}
        dissipated, supplied, stored = (float(x) for x in self.last - self.first)
        missing = abs(stored + dissipated - supplied)
        return {
            "closure": missing / self.most if self.most > NOTHING else None,
            "supplied": supplied, "dissipated": dissipated, "stored_change": stored, "throughput": self.most,
        }  # fmt: skip


def before_the_start(row: NDArray[np.float64]) -> NDArray[np.float64]:
    """What the first row (3,) was before an impact at the start of the run.

    Both integrals are zero there, so what the row has of them was lost, or given by what moves as prescribed, at once.
    """
    dissipated, supplied, stored = row
    return np.array([0.0, 0.0, stored + dissipated - supplied])


def resolved(system: Instance) -> float:
    """R above [J]: the energy of all bodies, each as fast as the weight of its speed."""
    weights = np.minimum(system.absolute, system.cap)
    groups, rates = system.flat.groups, system.numbering.rate
    return float(sum(0.5 * groups[index].mass * weights[v] ** 2 for index, v in rates.items()))


def known_to(system: Instance, accuracy: float, ida_steps: int = 0) -> float:
    """What the integrals of the ledger are known to [J], after so many steps of `ida`; zero without a ledger."""
    ledger = [k for k, unknown in enumerate(system.numbering.unknowns) if unknown.kind == "ledger"]
    return max(accuracy, LEFT_BY_IDA * ida_steps) * float(np.max(system.absolute[ledger], initial=0.0))


def explained(energy: Mapping[str, Any]) -> float:
    """The closure that the error weights of a run explain; zero where it was not recorded."""
    most, least = energy.get("throughput") or 0.0, energy.get("resolved") or 0.0
    own = energy.get("known_to") or 0.0
    return float(2.0 * (least / most) ** 0.5 + (least + own) / most) if most > 0.0 else 0.0


def open_by(energy: Mapping[str, Any] | None) -> float | None:
    """The closure of a run, but zero where its error weights explain it; None where it is not judged."""
    closure = (energy or {}).get("closure")
    return None if closure is None or energy is None else 0.0 if closure <= explained(energy) else float(closure)


def judged(summary: dict[str, float | None], undeclared: list[str], own: list[str]) -> dict[str, Any]:
    """The summary; without a closure, and with their names, where components declare no energy of what they do.

    `own` are classes that are none of fairlead's library, which are named beside it.
    """
    beside = {"own_classes": own} if own else {}
    return {**summary, **beside, "closure": None, "undeclared": undeclared} if undeclared else {**summary, **beside}


def own_classes(system: System) -> list[str]:
    """Names of classes in the model that are none of fairlead's library, parts of other components among them."""
    found: dict[str, None] = {}
    variants = [block.kernel.variant for block in system.blocks]
    while variants:
        variant = variants.pop()
        variants += [part for _, part in variant.parts]
        if not is_bundled(variant.type):
            found[variant.type.__name__] = None
    return sorted(found)


def suspects(energy: Mapping[str, Any] | None) -> str:
    """Which classes to check where the ledger does not close, and how; nothing where all are of the library."""
    names = (energy or {}).get("own_classes") or []
    if not names:
        return ""
    does = "does" if len(names) == 1 else "do"
    return (
        f"{_few(names)} {does} not come with fairlead: check whether the class keeps the contract "
        f"(from fairlead.testing import contract; contract({names[0]}); docs/components.md)."
    )


def _few(names: list[str]) -> str:
    return ", ".join(names[:MOST_NAMED]) + (f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else "")


def unjudged(energy: Mapping[str, Any] | None) -> str:
    """What to say of components that declare no energy; nothing where there are none."""
    names = (energy or {}).get("undeclared") or []
    if not names:
        return ""
    return (
        f"{_few(names)}: the class declares no energy of the forces it gives, so whether the energy adds up is not "
        "judged. Let its law say what becomes of it: "
        "Law(..., stored=... J) or Law(..., dissipated=... W, supplied=... W)."
    )
