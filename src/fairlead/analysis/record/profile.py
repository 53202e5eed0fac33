"""`fairlead run --profile`: where the wall time went, who caused switches and rejected steps, and one suggestion.

Counts come from the run and are exact. The time of a class of components is measured after the run: each of its
kernels is called again at the last point, and the time of a call is multiplied by how often the run made it.
"""

from __future__ import annotations

import ctypes
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from fairlead.kernels import layout
from fairlead.system.arrays.blocks import Block
from fairlead.system.compiled.system import Instance

MOST_NAMED = 8
CALLS, BATCHES = 10, 7  # per kernel and mode; the quickest batch counts, since others share the machine
MEASURABLE = 0.9  # of the stepping; what adds up to more was not measured but disturbed
OFTEN = 1 / 4  # of the steps (or attempts): what is more than this sets the cost of the run
KERNEL = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, *[ctypes.c_void_p] * 4)
EVALUATION = (layout.SIGNALS, layout.FLOWS, layout.LEDGER)
PARTIALS = (layout.PARTIALS_SIGNALS, layout.PARTIALS_FLOWS, layout.PARTIALS_LEDGER)


@dataclass(frozen=True)
class Times:
    """Seconds of a run: reading and compiling, inside the compiled loop, and all together."""

    compiling: float
    stepping: float
    wall: float

    @property
    def rest(self) -> float:
        """Loading the engine, writing results, Python."""
        return max(self.wall - self.compiling - self.stepping, 0.0)


def profile(system: Instance, counters: Any, times: Times) -> str:
    """The text of a profile; `counters` are those of the engine."""
    switches = Counter(_by_name(system.machine_names, counters.switches_by_machine))
    rejections = Counter(_by_name(system.unknown_names, counters.rejections_by_unknown))
    lines = [
        f"time: {times.wall:.3g} s, of it reading and compiling {_share(times.compiling, times.wall)}, "
        f"stepping {_share(times.stepping, times.wall)}, loading the engine and writing results "
        f"{_share(times.rest, times.wall)}",
        f"stepping: {counters.steps} steps, {counters.located} of them cut at a switch, {counters.rejected} rejected",
        *_laws(kernel_seconds(system, counters), times.stepping),
    ]
    if switches:
        shares = Counter(_by_class(system, switches))
        lines.append("zone switches by class:")
        lines += _rows((f"{_percent(n, switches.total())}", name) for name, n in shares.most_common(MOST_NAMED))
        lines.append("zone switches by component:")
        lines += _rows((str(n), name) for name, n in switches.most_common(MOST_NAMED))
    if rejections:
        lines.append("rejected steps by the unknown with the largest error:")
        lines += _rows((str(n), name) for name, n in rejections.most_common(MOST_NAMED))
    return "\n".join([*lines, f"suggestion: {suggestion(counters, times, switches, rejections)}"])


def _laws(seconds: Counter[str], stepping: float) -> list[str]:
    """Shares of the stepping by class; calls of some nanoseconds cannot be told from the cost of calling."""
    if seconds.total() > MEASURABLE * stepping:
        return ["laws: too short to be timed one by one"]
    rest = _percent(stepping - seconds.total(), stepping)
    return [
        "laws, share of the stepping (timed after the run, at its last point):",
        *_rows((_percent(s, stepping), name) for name, s in seconds.most_common(MOST_NAMED)),
        *_rows([(rest, "linear algebra, step control, recording")]),
    ]


def suggestion(counters: Any, times: Times, switches: Mapping[str, int], rejections: Mapping[str, int]) -> str:
    """One thing to try, for whatever took the largest part of the time."""
    if times.compiling > max(times.stepping, times.rest):
        return (
            "reading and compiling took longest, which a run does once however long it is; "
            "kernels compiled now come from the cache next time."
        )
    if times.rest > times.stepping:
        return (
            "the run itself is quick; loading the engine, and writing and drawing results cost more. "
            "Record fewer signals, or every some milliseconds (record: every)."
        )
    if counters.located > OFTEN * counters.steps:
        most, count = max(switches.items(), key=lambda item: item[1], default=("", 0))
        whose = f"{most} makes {count} of {counters.switches}. " if count > OFTEN * counters.switches else ""
        return (
            f"every switch ends a step, whatever the accuracy. {whose}Fewer elements in contact, "
            "or a larger creep with the binding method, make fewer switches."
        )
    if counters.rejected > OFTEN * (counters.steps + counters.rejected):
        worst = max(rejections, key=lambda name: rejections[name], default="some unknown")
        return f"many steps are rejected, most for {worst}; see what changes suddenly there without being a zone."
    return (
        "the smooth motion sets the step; an accuracy ten times looser takes about "
        "1.6 (order 5) to 2.2 (order 3) times fewer steps."
    )


def kernel_seconds(system: Instance, counters: Any) -> Counter[str]:
    """Seconds that the laws of each class took: time of one call times number of calls."""
    evaluations = counters.rhs + counters.jacobians + counters.guards
    calls = dict.fromkeys(EVALUATION, evaluations) | dict.fromkeys(PARTIALS, counters.jacobians)
    calls[layout.GUARD] = counters.guards
    found: Counter[str] = Counter()
    for number, block in enumerate(system.blocks):
        label = f"{block.kernel.variant.label} x {block.count}"
        found[label] += sum(count * _seconds(system, number, block, mode) for mode, count in calls.items())
    return found


def _seconds(system: Instance, number: int, block: Block, mode: int) -> float:
    """Seconds of one call of a kernel for all its instances, less those of a call for none."""
    memory = system.memory
    kernel = KERNEL(block.kernel.address)
    out = _scratch(system, mode)
    row = memory["blocks"][number].ctypes.data
    arrays = [memory[name].ctypes.data for name in ("z", "zones", "tables")]
    spent = []
    for stop in (0, block.count):
        batches = []
        for _ in range(BATCHES):
            begun = time.perf_counter()
            for _ in range(CALLS):
                kernel(mode, row, 0, stop, *arrays, out.ctypes.data)
            batches.append(time.perf_counter() - begun)
        spent.append(min(batches))
    return max(spent[1] - spent[0], 0.0) / CALLS


def _scratch(system: Instance, mode: int) -> np.ndarray:
    """Somewhere a kernel may write: as long as what it writes to in a run."""
    if mode == layout.GUARD:
        return np.zeros(len(system.guard_tolerance) + 1)
    name = {layout.SIGNALS: "z", layout.FLOWS: "w", layout.LEDGER: "w"}.get(mode, "partials")
    return system.memory[name].copy()


def _by_name(names: Any, counts: Any) -> dict[str, int]:
    """Counts of machines or unknowns by name; the tables of a component count with it."""
    found: Counter[str] = Counter()
    for k in np.flatnonzero(counts):
        found[names[k]] += int(counts[k])
    return found


def _by_class(system: Instance, switches: Mapping[str, int]) -> Counter[str]:
    labels = {instance.path: instance.variant.label for instance in system.flat.instances}
    found: Counter[str] = Counter()
    for name, count in switches.items():
        found[labels.get(name, name)] += count
    return found


def _rows(pairs: Any) -> list[str]:
    return [f"  {first:>8}  {second}" for first, second in pairs]


def _percent(part: float, whole: float) -> str:
    return f"{100 * max(part, 0.0) / whole:.0f} %" if whole > 0 else "-"


def _share(part: float, whole: float) -> str:
    return f"{part:.2g} s ({_percent(part, whole)})"
