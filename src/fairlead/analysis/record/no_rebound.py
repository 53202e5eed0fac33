"""Stops with a restitution that gave nothing back, since they were met slowly: a sentence with the `nominal` to give.

A rebound below ten error weights is none, so that a ball comes to rest (`integrate/events/rebound.py`). A stop that
gave something back before is such a ball. One that never did, though its rebound was more than its error, is told.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from fairlead.analysis.record.chattering import MOST_NAMED
from fairlead.component.assembly import PortRef
from fairlead.system.compiled.system import System
from fairlead.system.numbering.tolerances import Floats


def remark(system: System, slips: Floats) -> str:
    """What to tell of the stops; `slips` are the speeds at which they met, by row, shape (n,). "" for nothing."""
    found = [(system.numbering.unknowns[k].name.rpartition(".")[0], float(slips[k]), k)
             for k in np.flatnonzero(slips > 0.0).tolist()]  # fmt: skip
    if not found:
        return ""
    path, slip, row = max(found, key=lambda one: one[1])
    names = list(dict.fromkeys([path, *(name for name, *_ in found)]))
    more = f" and {len(names) - MOST_NAMED} more" if names[MOST_NAMED:] else ""
    speeds = dict(_speeds(system, row))
    unit = next(iter(speeds.values()), "m/s")
    given = ", ".join(f"{name}: {slip:.1g} {unit}" for name in speeds)
    return (
        f"{', '.join(names[:MOST_NAMED])}{more} gave nothing back: {path} was met at {slip:.2g} {unit}, and a "
        "rebound below ten error weights is none, whatever the restitution. If it matters, tell the size of these "
        f"speeds: nominal: {{{given}}}."
    )


def _speeds(system: System, row: int) -> Iterator[tuple[str, str]]:
    """Name and unit of the speeds that a row is a sum of."""
    flat, numbering = system.flat, system.numbering
    path, _, unknown = numbering.unknowns[row].name.rpartition(".")
    for block in system.blocks:
        for instance in block.instances:
            if instance.path == path:
                for port in block.kernel.structure.pairs.get(unknown, ()):
                    rate = numbering.rate.get(flat.place(PortRef(path, port))[0])
                    if rate is not None:
                        yield numbering.unknowns[rate].name, numbering.unknowns[rate].unit
