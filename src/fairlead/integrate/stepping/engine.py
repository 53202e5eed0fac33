"""The engine `stepping`, as Python knows it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from fairlead.integrate.codes import MIDDLE, MOST_IN_FRAME, NEVER, PARABOLA
from fairlead.integrate.engine import Engine
from fairlead.integrate.problem import Instance, Run


def stepping_numbers(run: Run, problem: Instance) -> Mapping[str, float]:
    """What `stepping` sets differently, or alone."""
    locates = run.fixed_step is None and run.theta == MIDDLE and len(problem.zones) <= run.most_located
    return {
        "least_theta": run.theta, "fixed_step": run.fixed_step or 0.0,
        "error_exponent": 1.0 / 3.0 if run.theta == MIDDLE else 1.0 / 2.0,
        "linear": int(problem.linear), "most_inside": PARABOLA,
        "samples": int(problem.samples), "t_kink": -NEVER,
        "most_solves": MOST_IN_FRAME if run.real_time else 0, "t_overrun": NEVER, "overrun_at": -1,
        "has_limits": int(np.any(problem.limit_guard)),
        "n_quadratures": int(np.count_nonzero(problem.quadrature)),
        "locates": int(locates), "always_locates": int(locates), "damps": int(not locates and np.any(problem.falls)),
    }  # fmt: skip


STEPPING = Engine(
    "stepping", "fairlead.integrate.stepping.trial", ("stepping",), stepping_numbers, plans_contacts=True,
    works_on_parts=True,
)  # fmt: skip
