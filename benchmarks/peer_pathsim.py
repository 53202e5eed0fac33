"""PathSim through the belt and the chain: one ODE block, exact friction, the guards as an event.

The equations are those of `peer_cases.py`; the event is the largest of all guards, because an event per contact
costs a call of Python per contact and step. At an event the zones switch and the block starts anew from its
state. Solvers: RKBS32, RKCK54 and RKDP87; the implicit ESDIRK43 takes a full Jacobian and ten times as long.

There is no output between steps, and a step that lands on a sample time is a shorter one: it is judged at every
twentieth sample of the belt and every fifth of the chains only.
"""

import numpy as np
from peer_cases import Belt
from peers import JUST_ZERO, Case, Limit, Peer, sample_times, settled

SOLVERS = ("RKBS32", "RKCK54", "RKDP87")
SHORTEST = 1e-12  # [s], of a step; at an event PathSim shrinks its step until the guard is within CLOSE
CLOSE = 1e-6
"""Guards count as reached within this (newtons over newtons, or metres a second): at 1e-9 PathSim no longer advances
on a hundred blocks, at 1e-5 it loses switches there."""


def pathsim(case: Case, method: str, tolerance: float, limit: float = 120.0) -> Peer:
    """One run. Raises RuntimeError where it goes wrong, TimeoutError at the limit of CPU time."""
    import pathsim.solvers
    from pathsim import Simulation
    from pathsim.blocks import ODE
    from pathsim.events import ZeroCrossingUp

    y, zones = case.initial()
    held, count = {"zones": zones}, {"nfev": 0, "switches": 0}
    times = sample_times(case)[:: 20 if isinstance(case, Belt) else 5]

    def rhs(y: np.ndarray, _u: np.ndarray, t: float) -> np.ndarray:
        count["nfev"] += 1
        bound.check(t)
        return case.zone_rhs(t, y, held["zones"])

    def jacobian(y: np.ndarray, _u: np.ndarray, t: float) -> np.ndarray:
        found = case.zone_jacobian(t, y, held["zones"])
        return found.toarray() if hasattr(found, "toarray") else found

    def largest(t: float) -> float:
        return float(case.guards(t, block.engine.state, held["zones"]).max())

    def switch(t: float) -> None:
        y = block.engine.state
        guard = case.guards(t, y, held["zones"])
        fired = (guard >= -CLOSE) & (guard >= guard.max() - CLOSE)
        block.engine.state, held["zones"] = settled(case, t, y, held["zones"], fired, count)

    bound = Limit(limit)
    block = ODE(rhs, y, jacobian)
    simulation = Simulation(
        [block], [], [ZeroCrossingUp(largest, switch, tolerance=CLOSE)], dt=1e-5, dt_min=SHORTEST, log=False,
        Solver=getattr(pathsim.solvers, method), tolerance_lte_rel=tolerance, tolerance_lte_abs=0.1 * tolerance,
    )  # fmt: skip
    states = np.empty((times.size, y.size))
    states[0] = y
    if largest(0.0) > JUST_ZERO:
        switch(0.0)
    for k in range(1, times.size):
        simulation.run(times[k] - simulation.time, reset=False, adaptive=True)
        states[k] = block.engine.state
    if not np.isfinite(states).all():
        raise RuntimeError("not a number")
    return Peer(times, states, count)
