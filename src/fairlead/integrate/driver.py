"""The Python side of a run: calls the compiled loop slice by slice and hands over what it recorded."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

import fairlead.integrate.ordering as ordering
from fairlead.integrate.codes import MOST_PERTURBED
from fairlead.integrate.condensing import columns_of, lay_out
from fairlead.integrate.counters import COUNTS, Counters
from fairlead.integrate.machine_code import compiled_loop
from fairlead.integrate.memory import LAYOUT, Memory
from fairlead.integrate.neighbours import held_entries, known_rows, neighbours, what_is_held
from fairlead.integrate.parts import NEVER_LOOK, Scope
from fairlead.integrate.protocol import (
    CALLBACKS,
    Block,
    Instance,
    Integers,
    OnBlock,
    Outcome,
    Problem,
    Run,
    Status,
)
from fairlead.integrate.replan import replan
from fairlead.integrate.sentences import culprits_of, sentence_of
from fairlead.integrate.tableau import TABLEAUS, Tableau

SLICE = 0.05
"""Seconds between two returns to Python, aimed at."""
FIRST_ATTEMPTS = 16
BLOCK_NUMBERS, LEAST_ROWS, MOST_ROWS = 1 << 17, 64, 1 << 16
"""Recorded numbers a block may hold; rows it may hold at least, 5 are needed, and at most."""
EVENTS = 4096
"""Zone changes a block may hold, if four passes of a settlement are no more."""
LEAST_PASSES, PATTERN_NUMBERS = 100, 1 << 22
"""Passes that a settling may take in any case, and how many zones the patterns that it remembers may have together."""
NEVER = 1e308
SERVED = (Status.PAUSED, Status.BUFFER_FULL, Status.REPLAN, Status.NARROW, Status.WIDEN)
"""Returns to Python after which the loop goes on."""
REACTIONS = {"warn": 0, "hold": 1, "stop": 2}


def integrate(problem: Problem, run: Run, on_block: OnBlock | None = None) -> Outcome:
    """Integrate `problem` over `run`; hand each `Block` to `on_block`, or keep them in the outcome.

    The problem is not changed: it may be run again, and by several threads at once.
    Never raises for what happens in the run: the outcome says how it ended and keeps all that was
    computed, after Ctrl-C too. Raises ValueError for settings or arrays that do not fit together.
    """
    begun = time.perf_counter()
    tableau = TABLEAUS[run.method]
    own = problem.instance(run)
    check(own, run)
    scope = Scope(own, lambda some: prepare(some, run, tableau), engine=run.engine)
    advance = loop_of(own, run, scope.memory)
    blocks: list[Block] = []
    take = on_block if on_block is not None else blocks.append
    status, inside, worked, attempts, replanned_at = Status.PAUSED, 0.0, 0.0, FIRST_ATTEMPTS, -1
    try:
        while status in SERVED:
            entered, working = time.perf_counter(), time.process_time()
            status = Status(advance(scope.memory.address, attempts))
            spent = time.perf_counter() - entered
            inside, worked = inside + spent, worked + time.process_time() - working
            if status == Status.WIDEN and scope.memory.number["woken"]:
                scope.memory.number["rows"] -= 1  # the row after the switch; the whole settles there once more
            if status != Status.REPLAN:
                flush(scope, run, take)
            if status == Status.REPLAN:
                again = int(scope.memory.number["factorisations"]) <= replanned_at + 1
                found = not again and replan(scope.memory, scope.problem)
                if run.engine == "stepping" and scope.memory.number["midway"]:
                    scope.memory.number["replanned"] = 1
                elif not found:
                    status = Status.SINGULAR
                    flush(scope, run, take)
                replanned_at = int(scope.memory.number["factorisations"])
            elif status in (Status.NARROW, Status.WIDEN):
                entered, working = time.perf_counter(), time.process_time()
                scope.look() if status == Status.NARROW else scope.wake()
                inside, worked = inside + time.perf_counter() - entered, worked + time.process_time() - working
            elif status == Status.PAUSED:
                attempts = next_attempts(attempts, spent)
            over = run.max_wall is not None and time.perf_counter() - begun > run.max_wall
            if over and status in SERVED:
                status = Status.MAX_WALL
    except KeyboardInterrupt:
        status = Status.INTERRUPTED
        flush(scope, run, take)
    culprits = culprits_of(status, scope.memory, scope.problem)
    sentence = sentence_of(status, scope.memory, scope.problem, run, culprits)
    memory = scope.finish()
    return Outcome(
        status=status,
        sentence=sentence,
        t=float(memory.number["t"]),
        y=memory.array["y"].copy(),
        culprits=culprits,
        chattering=tuple(own.machine_names[z] for z in np.flatnonzero(memory.array["chatters"]).tolist()),
        counters=count(memory),
        begun=scope.whole.array["begun"].copy(),
        lost=memory.array["lost"].copy(),
        wall=time.perf_counter() - begun,
        loop_wall=inside,
        loop_cpu=worked,
        problem=own,
        blocks=tuple(blocks),
    )


def loop_of(problem: Instance, run: Run, memory: Memory) -> Callable[[int, int], int]:
    """The loop of the engine: advance(address of the struct, attempts) -> status."""
    if run.engine == "ida":
        from fairlead.integrate.sundials import SundialsLoop

        return SundialsLoop(problem, run, memory)
    return compiled_loop(run.engine)


def next_attempts(attempts: int, spent: float) -> int:
    """Trial steps for the next slice, so that it lasts about SLICE seconds; at most eight times as many."""
    factor = SLICE / max(spent, 1e-6)
    return max(1, int(attempts * min(max(factor, 0.1), 8.0)))


def check(problem: Instance, run: Run) -> None:
    """Refuse what does not fit together, with both numbers."""
    if not run.stop > run.start:
        raise ValueError(f"stop = {run.stop:g} s must be after start = {run.start:g} s.")
    for name in ("every", "first_step", "fixed_step", "max_step", "step_floor", "dwell"):
        value = getattr(run, name)
        if value is not None and not value > 0:
            raise ValueError(f"{name} = {value:g} s must be above zero.")
    if run.engine == "ida" and run.fixed_step is not None:
        raise ValueError("fixed_step is for rodas and stepping; ida chooses its own steps.")
    if not 0.5 <= run.theta <= 1.0:
        raise ValueError(f"theta = {run.theta:g} must be from 0.5 to 1.")
    n, ng = len(problem.initial), len(problem.guard_machine)
    by_unknown = ("differential", "quadrature", "absolute", "relative", "cap", "unknown_names")
    lengths = dict.fromkeys(by_unknown, n) | dict.fromkeys(("guard_tolerance", "guard_names"), ng)
    for name, length in {**lengths, "machine_names": len(problem.zones)}.items():
        if len(getattr(problem, name)) != length:
            raise ValueError(f"{name} has {len(getattr(problem, name))} entries; it must have {length}.")
    for name in ("rhs", "jacobian", "mass"):
        if not problem.callbacks.get(name):
            raise ValueError(f"The problem has no callback {name}.")
    unknown = set(problem.callbacks) - set(CALLBACKS)
    if unknown:
        raise ValueError(f"Unknown callbacks {sorted(unknown)}; there are {', '.join(CALLBACKS)}.")
    if problem.zones.dtype != np.int64 or not problem.zones.flags.c_contiguous:
        raise ValueError("zones must be a contiguous array of int64, because the callbacks write to it.")


def prepare(problem: Instance, run: Run, tableau: Tableau) -> Memory:
    """The memory of the run: everything the loop needs, at the start."""
    n, ng, nz = len(problem.initial), len(problem.guard_machine), len(problem.zones)
    n_outputs = problem.n_outputs if problem.callbacks.get("outputs") else n
    plan = ordering.plan(problem)
    most_perturbed = MOST_PERTURBED if run.engine == "stepping" and not plan.dense else 0
    rows = max(LEAST_ROWS, min(MOST_ROWS, BLOCK_NUMBERS // max(n_outputs, 1)))
    events = max(EVENTS, 4 * (nz + ng))
    s = tableau.stages
    sizes = {
        "n": n, "n_guards": ng, "n_zones": nz, "n_jacobian": len(problem.pattern.rows),
        "n_mass": len(problem.mass_pattern.rows), "n_matrix": plan.size, "stages": s,
        "row_capacity": rows, "event_capacity": events, **plan.lengths,
    }  # fmt: skip
    lengths = sizes | {
        "stages_n": s * n, "three_n": 3 * n, "stages_stages": s * s, "three_stages": 3 * s,
        "rows_outputs": rows * n_outputs, "n_plus_1": n + 1, "passes_zones": (passes_allowed(run, nz) + 1) * nz,
        "passes": passes_allowed(run, nz) + 1, "n_zones_plus_1": nz + 1,
        "n_neighbours": 0, "n_hold_mass": 0, "n_hold_slope": 0, "n_hold_share": 0,
        "n_own_slopes": 0, "n_own_masses": 0, "no_own": 0,
        "most_perturbed": most_perturbed, "perturbed_square": most_perturbed**2,
        "perturbed_core": most_perturbed * plan.lengths["n_core"],
        "n_core_plus_1": plan.lengths["n_core"] + 1, "n_meters_plus_1": plan.lengths["n_meters"] + 1,
        "n_lower": len(plan.arrays.get("lower_rows", ())), "n_upper": len(plan.arrays.get("upper_rows", ())),
    }  # fmt: skip
    memory = Memory(lengths, given_arrays(problem, tableau, plan))
    write_numbers(memory, {**sizes, "n_outputs": n_outputs, "dense": int(plan.dense), "most_perturbed": most_perturbed})
    write_numbers(memory, {**settings(run, tableau), "max_step": _longest_step(run, problem)})
    if run.engine == "stepping":
        write_numbers(memory, stepping_settings(run, problem))
        memory.array["controlled"][:] = controlled(problem)
        memory.array["position_of"][:] = position_of(problem)
        for name, values in {**held_entries(problem), **neighbours(problem)}.items():
            memory.point(name, values, np.int64)
            if f"n_{name}" in (LAYOUT.names or ()):
                memory.number[f"n_{name}"] = len(values)
        memory.number["n_free_guards"] = _free_guards(memory)
        for name, kept in known_rows(problem).items():
            memory.point(name, kept, kept.dtype)
        memory.number["n_own_slopes"] = len(memory.array["own_slopes"])
        memory.number["n_own_masses"] = len(memory.array["own_masses"])
        memory.number["n_known"] = len(memory.array["known"])
        for name, of_machine in what_is_held(problem).items():
            memory.array[name][:] = of_machine
    calls = {f"call_{name}": problem.callbacks.get(name, 0) for name in CALLBACKS}
    if not calls["call_guards"] or not calls["call_switch"]:
        calls["call_guards"] = calls["call_switch"] = 0
        memory.number["n_guards"] = 0
    calls["call_forces"] = calls["call_forces"] or calls["call_rhs"]
    calls["call_drift"] = calls["call_drift"] or calls["call_slip"]
    calls["call_slopes"] = calls["call_slopes"] or calls["call_jacobian"]
    write_numbers(memory, {**calls, "context": problem.context})
    memory.number["max_passes"] = passes_allowed(run, nz)
    memory.number["narrow_at"] = NEVER_LOOK
    memory.number["weighs_guards"] = int(memory.array["guard_inertia"].any())
    memory.array["watched"][:] = watched(problem)
    memory.number["n_watched"] = int(memory.array["watched"].sum())
    memory.number["takes_impulses"] = int((memory.array["takes_impulse"] == 2).any())
    memory.number["dissipated_at"], memory.number["supplied_at"] = getattr(problem, "ledger", (-1, -1))
    memory.number["n_algebraic"] = int(n - np.count_nonzero(problem.differential))
    memory.array["last_toggle"][:] = -NEVER
    memory.array["blocked_until"][:] = -NEVER
    return memory


def passes_allowed(run: Run, machines: int) -> int:
    """Passes of one settling: what was set, or enough to change every machine some times over."""
    if run.max_passes is not None:
        return run.max_passes
    return min(LEAST_PASSES + 4 * machines, max(LEAST_PASSES, PATTERN_NUMBERS // max(machines, 1)))


def given_arrays(problem: Instance, tableau: Tableau, plan: ordering.Plan) -> dict[str, np.ndarray]:
    """Arrays the loop takes as they are; `zones` stays the live memory of the problem, y is a copy."""
    nominal = np.minimum(problem.absolute + problem.relative * np.abs(problem.initial), problem.cap)
    return {
        "y": np.array(problem.initial, dtype=np.float64),
        "absolute": problem.absolute, "relative": problem.relative, "cap": problem.cap,
        "column_scale": nominal, "guard_tolerance": problem.guard_tolerance,
        "a": tableau.a.ravel(), "C": tableau.C.ravel(), "c": tableau.c, "d": tableau.d,
        "m": tableau.m, "e": tableau.e, "H": tableau.H.ravel(),
        "zones": problem.zones, "guard_machine": problem.guard_machine,
        "kink_guard": np.asarray(getattr(problem, "kink_guard", np.zeros(len(problem.guard_machine))), np.int64),
        "may_hold": _of_contacts(problem),
        "takes_impulse": np.asarray(getattr(problem, "takes_impulse", np.zeros(len(problem.initial))), np.int64),
        "guard_inertia": getattr(problem, "guard_inertia", np.zeros(len(problem.guard_machine))),
        "differential": np.asarray(problem.differential, np.int64),
        "quadrature": np.asarray(problem.quadrature, np.int64),
        "jacobian_starts": problem.pattern.starts, "jacobian_rows": problem.pattern.rows,
        "mass_starts": problem.mass_pattern.starts, "mass_rows": problem.mass_pattern.rows,
        "mass_columns": columns_of(problem.mass_pattern),
        **plan.arrays,
    }  # fmt: skip


def _of_contacts(problem: Problem) -> Integers:
    """1 for every guard of a machine that decides whether a row holds."""
    holder = np.asarray(getattr(problem, "holder", ()), dtype=np.int64)
    return np.isin(problem.guard_machine, holder[holder >= 0]).astype(np.int64)


def settings(run: Run, tableau: Tableau) -> dict[str, float]:
    """The settings of the run as the struct names them."""
    span = run.stop - run.start
    most = np.iinfo(np.int64).max
    return {
        "max_steps": most if run.max_steps is None else run.max_steps,
        "max_events": most if run.max_events is None else run.max_events,
        "adaptive": int(run.fixed_step is None),
        "on_grid": int(run.every is not None),
        "every": run.every or 0.0,
        "on_chatter": REACTIONS[run.on_chatter],
        "start": run.start, "t": run.start, "stop": run.stop,
        "first_step": run.first_step or 0.0,
        "h_next": run.fixed_step or 0.0,
        "step_floor": run.step_floor if run.step_floor is not None else 1e-18 * span,
        "progress_floor": run.step_floor if run.step_floor is not None else 1e-12 * span,
        "dwell": run.dwell if run.dwell is not None else 1e-6 * span,
        "gamma": tableau.gamma,
        "error_exponent": 1.0 / (tableau.error_order + 1),
        "t_next": NEVER, "t_release": NEVER, "t_last_switch": -NEVER,
    }  # fmt: skip


def stepping_settings(run: Run, problem: Instance) -> dict[str, float]:
    """What the stepping engine sets differently, or alone."""
    return {
        "least_theta": run.theta, "fixed_step": run.fixed_step or 0.0,
        "error_exponent": 1.0 / 3.0, "linear": int(getattr(problem, "linear", False)),
        "samples": int(getattr(problem, "samples", False)),
        "has_limits": int(np.any(getattr(problem, "limit_guard", 0))),
        "n_quadratures": int(np.count_nonzero(problem.quadrature)),
    }  # fmt: skip


def watched(problem: Instance) -> Integers:
    """1 for unknowns that may be right at both ends of a step and wrong in between: algebraic and stiff ones."""
    stiff = np.asarray(getattr(problem, "stiff", np.zeros(len(problem.initial))), dtype=bool) | np.isfinite(problem.cap)
    return ((~np.asarray(problem.differential, dtype=bool) | stiff) & ~problem.quadrature).astype(np.int64)


def _free_guards(memory: Memory) -> int:
    """How many guards are not of contacts that may hold."""
    machine = memory.array["guard_machine"]
    return int(np.count_nonzero(memory.array["hold_row"][machine[machine >= 0]] < 0))


def _longest_step(run: Run, problem: Instance) -> float:
    """What was set, and what the problem says; a fixed step is as it is."""
    return run.max_step if run.fixed_step is not None else min(run.max_step, getattr(problem, "longest_step", np.inf))


def controlled(problem: Problem) -> Integers:
    """1 for unknowns whose error sets the step: differential, and no speed that has a position."""
    chosen = np.asarray(problem.differential & ~problem.quadrature, np.int64)
    chosen[position_of(problem) >= 0] = 0
    return chosen


def position_of(problem: Problem) -> Integers:
    """By unknown: the position whose rate it is, or -1."""
    found = np.full(len(problem.initial), -1, dtype=np.int64)
    for x, v in lay_out(problem).positions.items():
        if v >= 0:
            found[v] = x
    return found


def write_numbers(memory: Memory, values: dict[str, float]) -> None:
    """Set single values of the struct by name."""
    for name, value in values.items():
        memory.number[name] = value


def flush(scope: Scope, run: Run, take: OnBlock) -> None:
    """Hand over what the buffers hold and empty them."""
    number, array = scope.memory.number, scope.memory.array
    rows, n_outputs = int(number["rows"]), int(number["n_outputs"])
    events = scope.events(int(number["events"]))
    number["rows"] = 0
    number["events"] = 0
    t = float(number["t"])
    take(
        Block(
            t=array["row_t"][:rows].copy(),
            values=array["row_values"][: rows * n_outputs].reshape(rows, n_outputs).copy(),
            side=array["row_side"][:rows].astype(np.int8),
            events=events,
            reached=t,
            fraction=min(1.0, max(0.0, (t - run.start) / (run.stop - run.start))),
        )
    )


def count(memory: Memory) -> Counters:
    """The counters as the loop left them."""
    return Counters(
        **{name: int(memory.number[name]) for name in COUNTS},
        switches_by_machine=memory.array["switches_by_machine"].copy(),
        rejections_by_unknown=memory.array["rejections_by_unknown"].copy(),
    )
