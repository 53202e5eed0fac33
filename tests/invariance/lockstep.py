"""The first trial step at which a scene and its twin in another order differ by more than rounding.

`python -m tests.invariance --first-difference "network 7"` tells the step, what was decided there, and the values of
the unknowns and guards that a decision may hang on, in both. A path differs only where some decision is degenerate: two
quantities are equal in exact arithmetic, and the last digit says which is the larger. That is the place to look.
"""

from __future__ import annotations

import pathlib
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

import fairlead
from fairlead.engine import engine_settings
from fairlead.integrate.problem import Status
from fairlead.integrate.underway import Underway
from fairlead.running import patterns_of
from tests.invariance.plays import Play
from tests.invariance.reordering import permuted, shuffled

CHANGES, ORDER = ("instances", "netlist"), 1
"""What may stand in another order, and the seed of that order, which is that of trials.py."""
ROUNDING = 1e-9
"""Share of a step, or number of error weights, by which rounding may move it."""
AT_LIMIT, MOST_SHOWN = 1e-9, 15
"""Guards nearer to zero than this are shown, but no more than so many."""
GROWN = 10.0
"""What grows by this factor in one step is told."""
CAUSES = ("rejected_error", "rejected_nan", "rejected_inconsistent", "rejected_switch", "rejected_cycling",
          "rejected_diverged", "rejected_singular")  # fmt: skip
FACTS = (
    "phase", "passes", "stage", "one_by_one", "failed", "retried", "theta_raise", "theta_now",
    "algebraic_speeds", "support_accelerates", "time_dependent_limits", "expecting", "assumed", "invalidated",
    "allowed", "allowed_before", "block_steps", "n_switched", "t_cut", "localising", "h_wanted", "growth", "landing",
    "crossed", "cut_at", "stalls", "lookahead", "nearness", "linearised", "searched",
)  # fmt: skip
"""What is shown of a step beside its length and its error."""


class Try(NamedTuple):
    """The state after a trial step; numbers by their names, arrays by the names of their owners."""

    t: float
    h: float
    error: float
    worst: str
    said: tuple[str, ...]
    """Which counters rose: why the step was rejected, or accepted, and what settled."""
    zones: dict[str, str]
    y: dict[str, float]
    weight: dict[str, float]
    guards: dict[str, tuple[float, float]]
    facts: dict[str, float]


def tries(model: Any) -> Iterator[Try]:
    """Every trial step of a run of the model."""
    netlist, system = model.netlist, model.system
    run = engine_settings(netlist, netlist.run, system, patterns_of(netlist))
    going = Underway(system, run, lambda _: None)
    before = dict.fromkeys((*CAUSES, "steps", "settling_passes", "located", "time_events"), 0)
    while going.served:
        going.go_on(1)
        if going.status in (Status.PAUSED, Status.FINISHED) or not going.served:
            now, memory = {name: int(going.active.memory.number[name]) for name in before}, going.active.memory
            yield _seen(memory, going.active, tuple(name for name in before if now[name] > before[name]))
            before = now


def _seen(memory: Any, active: Any, said: tuple[str, ...]) -> Try:
    problem, number, array = active.problem, memory.number, memory.array
    names, machines = problem.unknown_names, problem.machine_names
    of_guard = {
        f"{name}@{machines[z] if z >= 0 else '-'}": (float(a), float(b))
        for name, z, a, b in zip(problem.guard_names, problem.guard_machine, array["g"], array["g_end"])
    }
    return Try(
        float(number["t"]), float(number["h"]), float(number["error"]),
        names[int(number["worst"])] if number["worst"] >= 0 else "", said,
        {name: problem.zone_names(z)[array["zones"][z]] for z, name in enumerate(machines)},
        dict(zip(names, array["y"].tolist())), dict(zip(names, array["weight"].tolist())), of_guard,
        {name: number[name].item() for name in FACTS},
    )  # fmt: skip


def twins(play: Play, change: str, folder: pathlib.Path) -> tuple[Any, Any]:
    """A scene, and the same with its instances or its netlist in another order."""
    file = folder / "scene.yaml"
    file.write_text(play.text, encoding="utf-8")
    one, other = fairlead.load(file), fairlead.load(file)
    if change == "netlist":
        twin = folder / "twin.yaml"
        twin.write_text(shuffled(play.text, ORDER), encoding="utf-8")
        other = fairlead.load(twin)
    else:
        other.flat = permuted(other.flat, ORDER)
    return one, other


def first_difference(one: Iterator[Try], other: Iterator[Try]) -> str:
    """What the first two trial steps differ in, and the values that may have decided; empty if none do."""
    last, grown, most = None, [], ROUNDING
    for k, (a, b) in enumerate(zip(one, other)):
        both = [name for name in a.y if name in b.y and not name.endswith(".share")]  # which share is free is chance
        apart = max((abs(a.y[name] - b.y[name]) / max(a.weight[name], 1e-300) for name in both), default=0.0)
        if apart > GROWN * most:
            grown.append(f"try {k}, t {a.t:.9g}: {apart:.2g} weights apart, {', '.join(a.said)}")
        most = max(most, apart)
        zones = any(a.zones[name] != b.zones[name] for name in a.zones.keys() & b.zones.keys())  # of equals, one stays
        if a.said != b.said or zones or abs(a.h - b.h) > 1e-6 * a.h or apart > 1e-3:
            return "\n".join([*grown, _told(k, a, b, last)])
        last = (a, b)
    return ""


def _told(k: int, a: Try, b: Try, last: tuple[Try, Try] | None) -> str:
    lines = []
    if last is not None:
        lines.append(f"try {k - 1}: t {last[0].t:.15g} | {last[1].t:.15g}  h {last[0].h:.9g} | {last[1].h:.9g}  "
                     f"error {last[0].error:.9g} | {last[1].error:.9g} {last[0].said}")  # fmt: skip
    lines.append(f"try {k}: t {a.t:.15g} | {b.t:.15g}  h {a.h:.9g} | {b.h:.9g}  error {a.error:.12g} | {b.error:.12g} "
                 f"({a.worst} | {b.worst})")  # fmt: skip
    lines.append(f"  {', '.join(a.said)} | {', '.join(b.said)}")
    for name in a.facts:
        if a.facts[name] != b.facts[name]:
            lines.append(f"  {name}: {a.facts[name]:.12g} | {b.facts[name]:.12g}")
    for name, zone in a.zones.items():
        if zone != b.zones.get(name, zone) or (last and zone != last[0].zones.get(name)):
            lines.append(f"  zone of {name}: {last[0].zones.get(name) if last else ''} -> {zone} | {b.zones.get(name)}")
    where = {name for name, zone in a.zones.items() if zone != b.zones.get(name, zone)}
    shown = 0
    for name, (now, end) in a.guards.items():
        of = b.guards.get(name, (np.nan, np.nan))
        at_limit = any(0.0 < abs(value) < AT_LIMIT for value in (now, end, *of))
        if (name.split("@")[1] in where or at_limit) and shown < MOST_SHOWN:
            shown += 1
            lines.append(f"  guard {name}: g {now:.9g} | {of[0]:.9g}  at the end {end:.9g} | {of[1]:.9g}")
    far = sorted(a.y, key=lambda name: -abs(a.y[name] - b.y.get(name, 0)) / max(a.weight[name], 1e-300))[:4]
    for name in far:
        lines.append(f"  {name}: {a.y[name]:.15g} | {b.y.get(name, np.nan):.15g}  weight {a.weight[name]:.3g}")
    return "\n".join(lines)
