"""integrate(): a run from its start to its end, and what comes of it."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from fairlead.integrate.counters import COUNTS, Counters
from fairlead.integrate.engines import engine_of
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.prepare import check_lengths
from fairlead.integrate.problem import CALLBACKS, Block, End, OnBlock, Outcome, Problem, Run, Status
from fairlead.integrate.sentences import culprits_of, first_overrun, sentence_of
from fairlead.integrate.underway import Underway


def integrate(
    problem: Problem, run: Run, on_block: OnBlock | None = None, go_on: Callable[[Underway], None] = Underway.go_on
) -> Outcome:  # fmt: skip
    """Integrate `problem` over `run`; hand each `Block` to `on_block`, or keep them in the outcome.

    `on_block` may return an `End`: the run has failed then. `go_on` has a run that is under way do a slice: who keeps
    time (fairlead/pacing.py) says when.

    The problem is not changed: it may be run again, and by several threads at once.
    Never raises for what happens in the run: the outcome says how it ended and keeps all that was
    computed, after Ctrl-C too. Raises ValueError for settings or arrays that do not fit together, and what a plain
    Python function of a textbook problem raised.
    """
    begun = time.perf_counter()
    check(problem, run)
    blocks: list[Block] = []
    ends: list[End] = []

    def take(block: Block) -> None:
        if on_block is None:
            blocks.append(block)
        elif isinstance(said := on_block(block), End):
            ends.append(said)

    going = Underway(problem, run, take)
    stepping = time.perf_counter()  # loading an engine, or compiling it once for this machine, is in no budget
    try:
        while going.served and not ends:
            go_on(going)
            over = run.max_wall is not None and time.perf_counter() - stepping > run.max_wall
            if over and going.served:
                going.status = Status.MAX_WALL
    except KeyboardInterrupt:
        going.status = Status.INTERRUPTED
        going.flush()
    going.active.problem.raise_if_failed()
    active, status = going.active, going.status
    if ends:
        status, (t, sentence, culprits) = Status.ENDED, ends[0]
    else:
        t, culprits = float(active.memory.number["t"]), culprits_of(status, active.memory, active.problem)
        sentence = sentence_of(status, active.memory, active.problem, run, culprits)
    memory, own = active.finish(), active.whole_problem
    return Outcome(
        status=status,
        sentence=sentence,
        t=t,
        y=memory.array["y"].copy(),
        culprits=culprits,
        chattering=tuple(own.machine_names[z] for z in np.flatnonzero(memory.array["chatters"]).tolist()),
        counters=count(memory),
        begun=active.whole.array["begun"].copy(),
        most_moved=float(memory.number["most_moved"]),
        lost=memory.array["lost"].copy(),
        not_given_back=memory.array["not_given_back"].copy(),
        joined=memory.array["joined"].copy(),
        first_joined=memory.array["first_joined"].copy(),
        first_overrun=first_overrun(memory, own),
        wall=time.perf_counter() - begun,
        loop_wall=going.wall,
        loop_cpu=going.cpu,
        problem=own,
        blocks=tuple(blocks),
    )


def check(problem: Problem, run: Run) -> None:
    """Refuse what does not fit together, with both numbers."""
    if not run.stop > run.start:
        raise ValueError(f"stop = {run.stop:g} s must be after start = {run.start:g} s.")
    for name in ("every", "first_step", "fixed_step", "max_step", "step_floor", "dwell"):
        value = getattr(run, name)
        if value is not None and not value > 0:
            raise ValueError(f"{name} = {value:g} s must be above zero.")
    engine = engine_of(run)
    if engine.chooses_steps and run.fixed_step is not None:
        raise ValueError(f"fixed_step is for rodas and stepping; {engine.name} chooses its own steps.")
    if run.real_time and (run.fixed_step is None or engine.name != "stepping"):
        raise ValueError("real_time is for stepping with a fixed_step.")
    if (problem.moves[:, 2] >= 0).any() and not engine.keeps_relations:
        raise ValueError(f"{engine.name} does not keep relations of positions; rodas does.")
    if not 0.5 <= run.theta <= 1.0:
        raise ValueError(f"theta = {run.theta:g} must be from 0.5 to 1.")
    n, ng = len(problem.initial), len(problem.guard_machine)
    by_unknown = dict.fromkeys(("differential", "quadrature", "unknown_names"), n)
    check_lengths(problem, {**by_unknown, "guard_names": ng, "machine_names": len(problem.zones)})
    for name in ("rhs", "jacobian", "mass"):
        if not problem.callbacks.get(name):
            raise ValueError(f"The problem has no callback {name}.")
    unknown = set(problem.callbacks) - set(CALLBACKS)
    if unknown:
        raise ValueError(f"Unknown callbacks {sorted(unknown)}; there are {', '.join(CALLBACKS)}.")


def count(memory: Memory) -> Counters:
    """The counters as the loop left them."""
    return Counters(
        **{name: int(memory.number[name]) for name in COUNTS},
        switches_by_machine=memory.array["switches_by_machine"].copy(),
        rejections_by_unknown=memory.array["rejections_by_unknown"].copy(),
    )
