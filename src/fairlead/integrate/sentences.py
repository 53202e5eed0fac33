"""What a run that ended says: what happened, whom to look at, likely causes, what to try."""

from __future__ import annotations

import numpy as np

from fairlead.integrate.codes import REPEATED, UNSOLVED
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.problem import Problem, Run, Status

MOST_NAMED = 6
"""Forces that are named of those that hold."""


def culprits_of(status: Status, memory: Memory, problem: Problem) -> tuple[str, ...]:
    """Unknowns or machines to look at first, by name."""
    number = memory.number
    if status in (Status.STEP_FLOOR, Status.NOT_FINITE, Status.INCONSISTENT, Status.GIVEN_APART):
        return (problem.unknown_names[int(number["worst"])],)
    if status == Status.SINGULAR and number["culprit"] >= 0:
        culprit = int(number["culprit"])
        return holding(memory, problem) if problem.quadrature[culprit] else (problem.unknown_names[culprit],)
    if status == Status.CHATTER:
        return (problem.machine_names[int(number["culprit"])],)
    if status == Status.REBOUND_RUBS:
        back, holder = memory.array["rebound"] > 0.0, np.asarray(problem.holder)
        return tuple(problem.machine_names[z] for z in np.unique(holder[back & (holder >= 0)]))
    if status == Status.NOT_SETTLED:
        return tuple(problem.machine_names[z] for z in still_switching(memory))
    return ()


def holding(memory: Memory, problem: Problem) -> tuple[str, ...]:
    """Forces that hold in the zones in force: where a sum, which nothing depends on, seems open, one of these is."""
    rows, values = memory.array["mass_rows"], memory.array["mass"]
    held = np.unique(rows[values != 0.0])
    held = held[(np.asarray(problem.takes_impulse)[held] > 0) & ~np.asarray(problem.differential)[held]]
    return tuple(problem.unknown_names[k] for k in held[:MOST_NAMED].tolist())


def still_switching(memory: Memory) -> list[int]:
    """Machines whose zone changed in the last half of the passes of the settlement that failed."""
    patterns = last_patterns(memory)
    return [int(z) for z in np.flatnonzero((patterns != patterns[0]).any(axis=0))]


def last_patterns(memory: Memory) -> np.ndarray:
    """Zones [passes, nz] after each of the last passes of the settlement."""
    nz, passes = int(memory.number["n_machines"]), int(memory.number["passes"])
    history = memory.array["zones_history"].reshape(-1, nz)[:passes]
    return history[passes // 2 :]


def first_overrun(memory: Memory, problem: Problem) -> tuple[float, str] | None:
    """When the first step of a run in real time overran, and what with; None if none did."""
    number = memory.number
    if not number["overruns"]:
        return None
    at = int(number["overrun_at"])
    if number["overrun_how"] == REPEATED:
        what = "the step was taken again"
    elif number["overrun_how"] == UNSOLVED:
        what = f"its equations were not solved, least of all for {problem.unknown_names[at]}"
    else:
        what = f"{problem.machine_names[problem.guard_machine[at]]} was to change its zone once more"
    return float(number["t_overrun"]), what


AT_START = "Give a better initial value, or check that the equations have a solution in these zones."
LATER = (
    "They were looked for from those just before. Check that the equations have a solution in these zones, and that no "
    "law there jumps. If they have one, put something between that gives way, as a Mass or a Volume does, or let what "
    "changes at once take a short time."
)
"""What to do where no consistent values are found: at the start, and at a switch."""


def jam(problem: Problem) -> str:
    """What else may be the cause where friction reads the force of a rigid part (events/right_root.py)."""
    names = ", ".join(problem.unknown_names[row] for row in problem.pressing[:MOST_NAMED, 0].tolist())
    if not names:
        return ""
    return (
        f" What locks itself by friction that follows its own force ({names}) may jam there, as a screw does that lets "
        "down a load with much inertia: no motion of rigid parts exists then. Put a spring between it and the load."
    )


def shared(problem: Problem) -> str:
    """What else may be the cause where contacts are on circles with gears of three shafts."""
    names = ", ".join(problem.held_too_much[:MOST_NAMED])
    if not names:
        return ""
    return (
        f" If all of {names} hold, beside a gear of three shafts that move, how they share is not known: write method: "
        "binding for one of them, or put a spring between one of them and its body."
    )


def sentence_of(status: Status, memory: Memory, problem: Problem, run: Run, culprits: tuple[str, ...]) -> str:
    """One paragraph about the end of the run."""
    t, names = float(memory.number["t"]), ", ".join(culprits)
    when = f"t = {t:.6g} s"
    step = float(memory.number["h"])
    dwell, kept = float(memory.number["dwell"]), "the results so far are kept."
    cycling = cycle(memory, problem) if status == Status.NOT_SETTLED else ""
    texts = {
        Status.FINISHED: f"Reached {when}.",
        Status.STEP_FLOOR: (
            f"{when}: the step size fell to {step:.2g} s, its floor ({_floor(memory, run)}), because of the error of "
            f"{names}. A law may jump inside its zone, or a Jacobian be wrong; check the component of that unknown, or "
            "loosen its tolerance."
        ),
        Status.NOT_FINITE: (
            f"{when}: {names} is not a finite number, whatever the step. A law divides by zero, takes the "
            "root of a negative number or overflows just ahead; look at the components of that unknown."
        ),
        Status.NOT_SETTLED: (
            f"{when}: zones did not settle in {int(memory.number['passes'])} passes; still switching: "
            f"{cycling}. Two laws contradict each other there; add a mass, damping or hysteresis "
            f"between them.{jam(problem)}{shared(problem)}"
        ),
        Status.INCONSISTENT: (
            f"{when}: no consistent values found for the algebraic unknowns, least of all for {names}. "
            + (AT_START if t <= run.start else LATER)
            + jam(problem)
        ),
        Status.SINGULAR: (
            f"{when}: the equations do not determine {names or 'all unknowns'}. A node without mass or "
            "damping, a contact that closes a loop of held contacts, a gear all three shafts of which follow given "
            "motions, a loop of signals whose gain is 1, or a relation "
            "of positions that nothing can keep here, as that of a crank in its dead centre under a given slider, "
            "leaves an unknown open; add a mass or damping there, or another gain. Equations of index 2 or 3, where a "
            "relation of speeds or positions alone is to determine a force, must be given as one of accelerations "
            "(index 1)."
        ),
        Status.CHATTER: (
            f"{when}: {names} switches to and fro faster than its dwell of {dwell:.2g} s. Its zones "
            "have no consistent choice at this point; add hysteresis, or hold it (run.chatter: hold)."
        ),
        Status.GIVEN_APART: (
            f"{when}: motions that are given move apart what {names} and other parts without give hold together, and "
            "none of them can open. Put something that gives between them (a spring, a contact with friction), or let "
            "a force or a torque drive one of them."
        ),
        Status.REBOUND_RUBS: (
            f"{when}: {names} rebounds while friction takes part in the impact, and how much that gives back along "
            "the surface no law says. Give it no restitution, or take a stop that gives (EndStop)."
        ),
        Status.MAX_STEPS: f"{when}: the budget of {run.max_steps} steps is used up; {kept}",
        Status.MAX_EVENTS: f"{when}: the budget of {run.max_events} events is used up; {kept}",
        Status.MAX_WALL: f"{when}: the budget of {run.max_wall or 0:.4g} s is used up; {kept}",
        Status.INTERRUPTED: f"{when}: interrupted; {kept}",
    }
    return texts[status] + _without_inertia(status, memory, problem) + _held_twice(status, memory, problem)


def _held_twice(status: Status, memory: Memory, problem: Problem) -> str:
    """What to do where several parts hold one motion at once, of which one has a ratio that sharing does not know."""
    culprit = int(memory.number["culprit"])
    if status != Status.SINGULAR or culprit < 0 or not problem.quadrature[culprit]:
        return ""
    return (
        " The forces named all hold there, some of them the same motion, and nothing says how they share it: give one "
        "of them way (EndStop instead of RigidStop, method: binding for a contact), or put a Spring between."
    )


def _without_inertia(status: Status, memory: Memory, problem: Problem) -> str:
    """What to do where the speed of a node without inertia ends a run: no force tells it any more."""
    at = {Status.STEP_FLOOR: "worst", Status.SINGULAR: "culprit"}.get(status)
    if at is None or int(memory.number[at]) not in np.asarray(problem.balanced):
        return ""
    return (
        " That node has no inertia, and the force of what slides there tells its speed no more. Add a mass there, or a "
        "damper beside the spring, or take method: hold, binding or dahl for the contact."
    )


def _floor(memory: Memory, run: Run) -> str:
    """Where the least step comes from."""
    resolved = 4e-15 * abs(float(memory.number["t"]))
    if run.step_floor is None:
        return "what time resolves; run.step_floor is not set"
    return f"run.step_floor = {run.step_floor:.2g} s" if run.step_floor > resolved else "what time resolves"


def cycle(memory: Memory, problem: Problem) -> str:
    """The machines that cycle, each with the zones it goes through: pad (stuck <-> forward)."""
    patterns = last_patterns(memory)
    parts = []
    for z in still_switching(memory):
        names = problem.zone_names(z)
        visited = " <-> ".join(names[int(zone)] for zone in dict.fromkeys(patterns[:, z].tolist()))
        parts.append(f"{problem.machine_names[z]} ({visited})")
    return ", ".join(parts) or "guards that fire without changing a zone"
