"""The engines by name."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from fairlead.integrate.codes import MIDDLE, PARABOLA
from fairlead.integrate.engine import Advance, Engine
from fairlead.integrate.memory import Memory
from fairlead.integrate.protocol import Instance, Run


def stepping_numbers(run: Run, problem: Instance) -> Mapping[str, float]:
    """What `stepping` sets differently, or alone."""
    return {
        "least_theta": run.theta, "fixed_step": run.fixed_step or 0.0,
        "error_exponent": 1.0 / 3.0, "linear": int(problem.linear), "most_inside": PARABOLA,
        "samples": int(problem.samples),
        "has_limits": int(np.any(problem.limit_guard)),
        "n_quadratures": int(np.count_nonzero(problem.quadrature)),
        "locates": int(run.fixed_step is None and run.theta == MIDDLE and len(problem.zones) <= run.most_located),
    }  # fmt: skip


def sundials_loop(problem: Instance, run: Run, memory: Memory) -> Advance:
    """Steps by SUNDIALS IDA, the rest by the compiled loop of `rodas`."""
    from fairlead.integrate.sundials import SundialsLoop

    return SundialsLoop(problem, run, memory)


RODAS = Engine(
    "rodas", "fairlead.integrate.rosenbrock", ("rosenbrock.py",), works_on_parts=True, keeps_relations=True
)
STEPPING = Engine(
    "stepping", "fairlead.integrate.stepping_loop",
    ("jumps.py", "known_rows.py", "exchange.py", "active_set.py", "overload.py", "missed_impulse.py",
     "unseen_guards.py", "steady_steps.py", "third_order.py", "step_residual.py", "line_search.py", "theta_step.py",
     "located_step.py", "stepping_trial.py", "stepping_loop.py"),
    stepping_numbers, plans_contacts=True, works_on_parts=True,
)  # fmt: skip
IDA = Engine(
    "ida", RODAS.module, RODAS.sources, loop=sundials_loop, chooses_steps=True,
    not_saved="The engine ida keeps the past of a run in memory of SUNDIALS, which cannot be copied",
)  # fmt: skip
ENGINES = {engine.name: engine for engine in (RODAS, STEPPING, IDA)}


def engine_of(run: Run) -> Engine:
    """The engine of a run, which names one or brings its own. Raises ValueError for a name that there is not."""
    if isinstance(run.engine, Engine):
        return run.engine
    if run.engine not in ENGINES:
        raise ValueError(f"engine = {run.engine!r} must be one of {', '.join(ENGINES)}, or an Engine.")
    return ENGINES[run.engine]
