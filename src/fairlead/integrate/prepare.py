"""What a run works with: plans and sizes, made once for a problem and shared; its settings; its memory at the start."""

from __future__ import annotations

import functools
import weakref
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

import fairlead.integrate.linear.ordering as ordering
from fairlead.integrate.codes import KNOWN_ZONES, LEVELS, MOST_PERTURBED, NEVER, QUARTIC
from fairlead.integrate.engines import engine_of
from fairlead.integrate.linear.condensing import columns_of, lay_out
from fairlead.integrate.memory.arena import BUFFERS, Memory
from fairlead.integrate.memory.layout import INDICES, VECTORS
from fairlead.integrate.problem import CALLBACKS, AnyPattern, Bytes, Instance, Integers, Problem, Run
from fairlead.integrate.rodas.tableau import TABLEAUS, Tableau
from fairlead.integrate.stepping.neighbours import held_bodies, held_entries, held_inertia, known_rows, neighbours

BLOCK_NUMBERS, LEAST_ROWS, MOST_ROWS = 1 << 17, 64, 1 << 16
"""Recorded numbers a block may hold; rows it may hold at least, 5 are needed, and at most."""
EVENTS = 4096
"""Zone changes a block may hold, if four passes of a settlement are no more."""
LEAST_PASSES, PATTERN_NUMBERS = 100, 1 << 22
"""Passes that a settling may take in any case, and how many zones the patterns that it remembers may have together."""
NEVER_LOOK = np.iinfo(np.int64).max
"""The step at which to look for a part of the problem, where there is none."""
REACTIONS = {"warn": 0, "hold": 1, "stop": 2}
Place = Callable[[Bytes], Instance]
"""Puts a problem to work in a piece of memory."""


class Planned(NamedTuple):
    """What all runs of a problem with one engine share: nothing changes it."""

    lengths: dict[str, int]
    """Of arrays, by the names in memory/of_*.py."""
    given: dict[str, np.ndarray]
    numbers: dict[str, float]


_PLANS: weakref.WeakKeyDictionary[Problem, dict[bool, Planned]] = weakref.WeakKeyDictionary()


def planned(problem: Problem, contacts: bool) -> Planned:
    """The plan for a problem, which is kept as long as the problem is; one that is no key is planned every time."""
    try:
        kept = _PLANS.setdefault(problem, {})
    except TypeError:
        return new_plan(problem, contacts)
    if contacts not in kept:
        kept[contacts] = new_plan(problem, contacts)
    return kept[contacts]


def new_plan(problem: Problem, contacts: bool) -> Planned:
    """Pivots, patterns, sizes; where `contacts` are planned also who holds what, and who hands its load to whom."""
    n, ng, nz = len(problem.initial), len(problem.guard_machine), len(problem.zones)
    plan, light = ordering.plan(problem), of_light(problem)
    most_perturbed = MOST_PERTURBED if contacts and not plan.dense else 0
    numbers: dict[str, float] = {
        "n": n, "n_guards": ng, "n_machines": nz, "n_jacobian": len(problem.pattern.rows),
        "n_mass": len(problem.mass_pattern.rows), "n_matrix": plan.size, **plan.lengths,
        "dense": int(plan.dense), "most_perturbed": most_perturbed,
        **dict(zip(("dissipated_at", "supplied_at"), problem.ledger, strict=True)),
        "n_algebraic": int(n - np.count_nonzero(problem.differential)), "n_moves": len(problem.moves),
        "n_accelerated": int(np.count_nonzero(problem.moves[:, 2] >= 0)), "n_met_guards": len(problem.met_guard),
        "n_balanced": len(problem.balanced), "n_light": len(light),
        "n_swings": problem.n_swings, "n_pressing": len(problem.pressing), "n_least": int(np.sum(problem.least_guard)),
    }  # fmt: skip
    lengths = plan.lengths | {
        "n": n, "n_guards": ng, "n_machines": nz, "n_jacobian": len(problem.pattern.rows),
        "n_mass": len(problem.mass_pattern.rows), "n_matrix": plan.size,
        "n_moves": len(problem.moves), "n_balanced": len(problem.balanced), "n_light": len(light),
        "n_met_guards": len(problem.met_guard), "n_swings": problem.n_swings, "n_pressing": len(problem.pressing),
        "pressing_square": len(problem.pressing) ** 2,
        "three_n": 3 * n, "n_plus_1": n + 1, "n_machines_plus_1": nz + 1,
        "most_perturbed": most_perturbed, "perturbed_square": most_perturbed**2,
        "perturbed_reduced": most_perturbed * plan.lengths["n_reduced"],
        "n_reduced_plus_1": plan.lengths["n_reduced"] + 1,
        "n_quadrature_rows_plus_1": plan.lengths["n_quadrature_rows"] + 1,
        "n_lower": len(plan.arrays.get("lower_rows", ())), "n_upper": len(plan.arrays.get("upper_rows", ())),
    }  # fmt: skip
    given: dict[str, np.ndarray] = {
        "guard_machine": problem.guard_machine,
        "kink_guard": np.asarray(problem.kink_guard, np.int64),
        "blow_guard": np.asarray(problem.blow_guard, np.int64),
        "least_guard": np.asarray(problem.least_guard, np.int64),
        "latch_guard": np.asarray(problem.latch_guard, np.int64),
        "may_hold": _of_contacts(problem), "met_guard": np.asarray(problem.met_guard, np.int64),
        "limit_guard": np.asarray(problem.limit_guard, np.int64), "bounded_row": bounded_rows(problem),
        "takes_impulse": np.asarray(problem.takes_impulse, np.int64),
        "holder": np.asarray(problem.holder, np.int64), "circle": np.asarray(problem.circle, np.int64),
        "grows_with_slip": np.asarray(problem.grows_with_slip, np.int64),
        "is_speed": moved_at_once(problem), "struck": moved_at_once(problem) * (1 - integrals(problem)),
        "integral": integrals(problem),
        "differential": np.asarray(problem.differential, np.int64),
        "quadrature": np.asarray(problem.quadrature, np.int64),
        "unweighed": (problem.quadrature | problem.gauge).astype(np.int64),
        "jacobian_starts": problem.pattern.starts, "jacobian_rows": problem.pattern.rows,
        "mass_starts": problem.mass_pattern.starts, "mass_rows": problem.mass_pattern.rows,
        "mass_columns": columns_of(problem.mass_pattern),
        **{f"move_{name}": np.ascontiguousarray(problem.moves[:, k], np.int64) for k, name in enumerate(MOVES)},
        "balanced_position": np.ascontiguousarray(problem.balanced[:, 0], np.int64),
        "balanced_speed": np.ascontiguousarray(problem.balanced[:, 1], np.int64),
        "pressing_row": np.ascontiguousarray(problem.pressing[:, 0], np.int64),
        "pressing_sign": np.ascontiguousarray(problem.pressing[:, 1], np.int64),
        "light": light, "speed_of": speed_of(problem), "position_of": position_of(problem),
        "diagonal_slope": diagonal(problem.pattern, n), "diagonal_mass": diagonal(problem.mass_pattern, n),
        "of_balance": of_balance(problem),
        **plan.arrays,
    }  # fmt: skip
    numbers["n_integrals"] = int(given["integral"].sum())
    given["asked_stiff"] = asked_stiff(given)
    numbers["n_asked_stiff"] = len(given["asked_stiff"])
    numbers["takes_impulses"] = int((given["takes_impulse"] >= RIGID).any())
    numbers["has_circles"] = int((given["circle"] > 0).any())
    numbers["rigid_circles"] = int(((given["takes_impulse"] >= RIGID) & (given["circle"] > 0)).any())
    if contacts:
        given |= held_entries(problem) | held_bodies(problem) | neighbours(problem) | known_rows(problem)
        given |= {"controlled": controlled(problem)}
        holds = given["hold_row"][problem.guard_machine[problem.guard_machine >= 0]] >= 0
        numbers |= {f"n_{name}": len(given[name]) for name in OF_STEPPING}
        numbers |= {"n_free_guards": int(np.count_nonzero(~holds)), "n_known": KNOWN_ZONES * nz}
    by_zone = {name: len(given.get(name, ())) for name in ("own_slopes", "own_masses")} | {"machines": nz}
    lengths |= {f"{name}_by_zone": KNOWN_ZONES * length if contacts else 0 for name, length in by_zone.items()}
    return Planned(lengths, given, numbers)


def of_light(problem: Problem) -> Integers:
    """Entries of M in columns of speeds without inertia: of rows that hold them, which tell their slip."""
    told = problem.callbacks.get("drift") or problem.callbacks.get("slip")
    found = np.flatnonzero(~np.asarray(problem.differential, dtype=bool)[columns_of(problem.mass_pattern)])
    return found.astype(np.int64) if told else found[:0].astype(np.int64)


def diagonal(pattern: AnyPattern, n: int) -> Integers:
    """[n]: where the entry (k, k) of a matrix is, -1 for none."""
    found = np.full(n, -1, dtype=np.int64)
    on_it = np.flatnonzero(np.asarray(pattern.rows) == columns_of(pattern))
    found[np.asarray(pattern.rows)[on_it]] = on_it
    return found


def of_balance(problem: Problem) -> Integers:
    """[n]: 1 for unknowns without inertia that a balance gives at each instant, as the voltage of a node; 2 for sums.

    Not for forces of contacts, whose rows tell slip while they hold, nor for what moves without inertia in such rows,
    nor for how circles of contacts share their load, which nothing reads.
    """
    found = (1 - np.asarray(problem.differential, dtype=np.int64)) * (1 - np.asarray(problem.gauge, dtype=np.int64))
    found[np.asarray(problem.mass_pattern.rows)] = found[columns_of(problem.mass_pattern)] = 0
    found[diagonal(problem.pattern, len(found)) < 0] = 0
    return found * (1 + np.asarray(problem.summed, dtype=np.int64))


def asked_stiff(given: Mapping[str, np.ndarray]) -> Integers:
    """Unknowns that may be shown in balance: those of balances, and speeds with a slope and an inertia of their own."""
    own = (given["diagonal_slope"] >= 0) & (given["diagonal_mass"] >= 0)
    return np.flatnonzero((given["of_balance"] > 0) | ((given["position_of"] >= 0) & own)).astype(np.int64)


def _of_contacts(problem: Problem) -> Integers:
    """By guard: 1 for those of a machine that decides whether a row holds, 2 if that row takes any impulse."""
    holder = np.asarray(problem.holder, dtype=np.int64)
    takes = np.asarray(problem.takes_impulse, dtype=np.int64)
    held, rigid = np.isin(problem.guard_machine, holder[holder >= 0]), holder[(holder >= 0) & (takes == RIGID)]
    return held.astype(np.int64) + np.isin(problem.guard_machine, rigid)


def bounded_rows(problem: Problem) -> Integers:
    """By guard: the row whose force its machine holds, where it bounds that force; -1 for none, or more than one."""
    holder = np.asarray(problem.holder, dtype=np.int64)
    row = np.full(len(problem.zones) + 1, -1, dtype=np.int64)
    held = np.flatnonzero(holder >= 0)
    row[holder[held]] = held
    counts = np.bincount(holder[held], minlength=len(row))
    row[counts > 1] = -1
    return np.where(np.asarray(problem.limit_guard) == 1, row[problem.guard_machine], -1).astype(np.int64)


RIGID = 2
"""What a row takes that takes any impulse."""


MOVES = ("position", "speed", "acceleration")
"""What the columns of `problem.moves` are."""


def speed_of(problem: Problem) -> Integers:
    """By unknown: the speed of an acceleration that is an unknown, else itself."""
    found = np.arange(len(problem.initial), dtype=np.int64)
    _, speeds, accelerations = problem.moves[problem.moves[:, 2] >= 0].T
    found[accelerations] = speeds
    return found


OF_STEPPING = ("hold_mass", "hold_slope", "hold_share", "body_speed", "neighbours", "own_slopes", "own_masses")
"""Arrays of `stepping` whose lengths the loop is told."""


def prepare(problem: Problem, plan: Planned, run: Run, tableau: Tableau, place: Place) -> tuple[Memory, Instance]:
    """The memory of a run at its start, and the problem at work in it."""
    nz, s = len(problem.zones), tableau.stages
    passes, falls = passes_allowed(run, nz), np.asarray(problem.falls, np.int64)
    lengths = dict.fromkeys((VECTORS | INDICES).values(), 0) | plan.lengths | {
        "stages": s, "stages_n": s * len(problem.initial), "stages_stages": s * s, "three_stages": 3 * s,
        "passes_zones": (passes + 1) * nz, "passes": passes + 1,
        "levels": LEVELS, "levels_n": LEVELS * len(problem.initial) if falls.any() else 0,
    }  # fmt: skip
    memory = Memory(lengths, plan.given | method(run.method), problem.room)
    own = place(memory.piece)
    check_instance(own)
    write_numbers(memory, plan.numbers | settings(run, tableau) | {"stages": s, "max_passes": passes})
    write_numbers(memory, {"max_step": _longest_step(run, own), "restrict_at": NEVER_LOOK, "swing_step": NEVER})
    point_at_instance(memory, own)
    engine = engine_of(run)
    write_numbers(memory, engine.numbers(run, own))
    if engine.plans_contacts:
        memory.array["held_inertia"][:] = held_inertia(own)
    write_numbers(memory, calls(own) | {"context": own.context})
    if not memory.number["call_guards"]:
        memory.number["n_guards"] = 0
    make_buffers(memory, own)
    memory.array["y"][:] = own.initial
    memory.array["monitored"][:] = monitored(own)
    memory.number["n_monitored"] = int(memory.array["monitored"].sum())
    memory.array["falls"][:] = falls
    memory.number["falling"] = int(falls.any() and len(set(plan.given["holder"].tolist())) > 2)  # -1 is one
    memory.array["last_toggle"][:] = -NEVER
    memory.array["blocked_until"][:] = -NEVER
    memory.spread()
    return memory, own


@functools.cache
def method(name: str) -> dict[str, np.ndarray]:
    """The numbers of a Rosenbrock method as the loop wants them."""
    tableau = TABLEAUS[name]
    return {"a": tableau.a.ravel(), "C": tableau.C.ravel(), "c": tableau.c, "d": tableau.d, "m": tableau.m,
            "e": tableau.e, "H": tableau.H.ravel()}  # fmt: skip


def check_instance(own: Instance) -> None:
    """Refuse weights that do not fit the problem, and zones that callbacks cannot write to."""
    n, ng = len(own.initial), len(own.guard_machine)
    check_lengths(own, {"absolute": n, "relative": n, "cap": n, "guard_tolerance": ng})
    if own.zones.dtype != np.int64 or not own.zones.flags.c_contiguous:
        raise ValueError("zones must be a contiguous array of int64, because the callbacks write to it.")


def check_lengths(problem: Problem, lengths: dict[str, int]) -> None:
    """Refuse arrays of other lengths, with both numbers."""
    for name, length in lengths.items():
        if len(getattr(problem, name)) != length:
            raise ValueError(f"{name} has {len(getattr(problem, name))} entries; it must have {length}.")


def point_at_instance(memory: Memory, own: Instance) -> None:
    """Tell the loop of the zones and weights of the run."""
    inertia, back = np.asarray(own.guard_inertia), np.asarray(own.rebound, np.float64)
    of_run = {
        "absolute": own.absolute, "relative": own.relative, "cap": own.cap,
        "column_scale": np.minimum(own.absolute + own.relative * np.abs(own.initial), own.cap),
        "guard_inertia": inertia, "rebound": back,
    }  # fmt: skip
    for name, values in of_run.items():
        memory.point(name, values, np.float64)
    memory.point("zones", own.zones, np.int64)
    memory.array["guard_tolerance"][:] = own.guard_tolerance  # a step sets those of limits: they belong to its state
    memory.number["first_sample"] = int(own.samples)
    memory.number["rebounds"] = int(back.any())
    memory.number["mean_at"] = own.mean.ctypes.data if len(own.mean) else 0
    memory.number["weighs_guards"] = int(inertia.any())


def make_buffers(memory: Memory, own: Instance) -> None:
    """Room for what is recorded."""
    n_outputs = own.n_outputs if own.callbacks.get("outputs") else len(own.initial)
    rows = max(LEAST_ROWS, min(MOST_ROWS, BLOCK_NUMBERS // max(n_outputs, 1)))
    events = max(EVENTS, 4 * (len(own.zones) + len(own.guard_machine)))
    write_numbers(memory, {"n_outputs": n_outputs, "row_capacity": rows, "event_capacity": events})
    lengths = {"row_capacity": rows, "rows_outputs": rows * n_outputs, "event_capacity": events}
    for name in BUFFERS:
        kind = np.float64 if name in VECTORS else np.int64
        memory.point(name, np.zeros(lengths[(VECTORS | INDICES)[name]], kind), kind)


def calls(problem: Problem) -> dict[str, float]:
    """Addresses of the callbacks as the struct names them; those that stand in for others where these are missing."""
    found = {f"call_{name}": problem.callbacks.get(name, 0) for name in CALLBACKS}
    if not found["call_guards"] or not found["call_switch"]:
        found["call_guards"] = found["call_switch"] = 0
    found["call_forces"] = found["call_forces"] or found["call_rhs"]
    found["call_drift"] = found["call_drift"] or found["call_slip"]
    found["call_slopes"] = found["call_slopes"] or found["call_jacobian"]
    return dict(found)


def passes_allowed(run: Run, machines: int) -> int:
    """Passes of one settling: what was set, or enough to change every machine some times over."""
    if run.max_passes is not None:
        return run.max_passes
    return min(LEAST_PASSES + 4 * machines, max(LEAST_PASSES, PATTERN_NUMBERS // max(machines, 1)))


def settings(run: Run, tableau: Tableau) -> dict[str, float]:
    """The settings of the run as the struct names them."""
    span = run.stop - run.start
    most = np.iinfo(np.int64).max
    return {
        "max_steps": most if run.max_steps is None else run.max_steps,
        "max_events": most if run.max_events is None else run.max_events,
        "adaptive": int(run.fixed_step is None),
        "on_grid": int(run.every is not None),
        "every": run.every or 0.0, "between": int(run.between),
        "t_row": -NEVER, "most_inside": QUARTIC,
        "on_chatter": REACTIONS[run.on_chatter],
        "start": run.start, "t": run.start, "stop": run.stop,
        "first_step": run.first_step or 0.0,
        "h_next": run.fixed_step or 0.0,
        "step_floor": run.step_floor if run.step_floor is not None else 1e-18 * span,
        "progress_floor": run.step_floor if run.step_floor is not None else 1e-12 * span,
        "dwell": run.longest_dwell, "dwell_given": int(run.dwell is not None),
        "step_floor_given": int(run.step_floor is not None),
        "gamma": tableau.gamma,
        "error_exponent": 1.0 / (tableau.error_order + 1),
        "t_next": NEVER, "t_release": NEVER, "t_last_switch": -NEVER,
    }  # fmt: skip


def monitored(problem: Instance) -> Integers:
    """1 for unknowns that may be right at both ends of a step and wrong in between: algebraic and stiff ones."""
    stiff = np.asarray(problem.stiff, dtype=bool) | np.isfinite(problem.cap)
    counts = ~(problem.quadrature | problem.gauge)
    return ((~np.asarray(problem.differential, dtype=bool) | stiff) & counts).astype(np.int64)


def _longest_step(run: Run, problem: Instance) -> float:
    """What was set, and what the problem says; a fixed step is as it is."""
    return run.max_step if run.fixed_step is not None else min(run.max_step, problem.longest_step)


def controlled(problem: Problem) -> Integers:
    """1 for unknowns whose error sets the step: differential, and no speed of a body that has a position."""
    chosen = np.asarray(problem.differential & ~problem.quadrature, np.int64)
    chosen[(position_of(problem) >= 0) & problem.bodies] = 0
    return chosen


def position_of(problem: Problem) -> Integers:
    """By unknown: the position whose rate it is, or -1."""
    found = np.full(len(problem.initial), -1, dtype=np.int64)
    for x, v in lay_out(problem).positions.items():
        if v >= 0:
            found[v] = x
    return found


def moved_at_once(problem: Problem) -> Integers:
    """1 for unknowns that a jump of load moves in a time in which positions stand still."""
    chosen = np.asarray(problem.differential & ~problem.quadrature, np.int64)
    chosen[[x for x, v in lay_out(problem).positions.items() if v >= 0]] = 0
    return chosen


def integrals(problem: Problem) -> Integers:
    """1 for states inside parts that no other row of M reads: of what is given as a rate, impulses change them."""
    n, pattern = len(problem.initial), problem.mass_pattern
    rows, columns = np.asarray(pattern.rows), columns_of(pattern)
    alone = (np.bincount(rows, minlength=n) == 1) & (np.bincount(columns, minlength=n) == 1)
    alone &= diagonal(pattern, n) >= 0
    states = np.asarray(problem.stiff, dtype=bool) & np.asarray(problem.differential, dtype=bool)
    return (states & alone & ~np.asarray(problem.quadrature, dtype=bool)).astype(np.int64)


def write_numbers(memory: Memory, values: Mapping[str, float]) -> None:
    """Set single values of the struct by name."""
    for name, value in values.items():
        memory.number[name] = value
