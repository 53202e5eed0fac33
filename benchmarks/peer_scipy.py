"""scipy through the belt and the chain: smooth friction, or exact friction with events.

Methods: Radau, BDF, LSODA (smooth law, given Jacobian); all these, RK45 and DOP853 between exact switches.
The event-driven runs step scipy's solver classes themselves and judge all guards in one vector, where
`solve_ivp` would call as many event functions as there are contacts.
"""

import numpy as np
from peer_cases import Belt
from peers import JUST_ZERO, Case, Limit, Peer, sample_times, settled, weights
from scipy.integrate import BDF, DOP853, LSODA, RK45, Radau
from scipy.optimize import brentq
from scipy.sparse import issparse

SOLVERS = {"Radau": Radau, "BDF": BDF, "LSODA": LSODA, "RK45": RK45, "DOP853": DOP853}
IMPLICIT = ("Radau", "BDF", "LSODA")
INSIDE = (0.25, 0.5, 0.75)  # where the reference also looks for a double crossing inside a step
STALL = 1e-12  # [s]; a solver that no longer advances by this much between switches is stopped


def smooth(case: Case, method: str, rtol: float, width: float, limit: float = 120.0) -> Peer:
    """Friction as a smooth function of width `width` [m/s], solved by one of scipy's stiff methods."""

    def rhs(t: float, y: np.ndarray) -> np.ndarray:
        return case.smooth_rhs(t, y, width)

    def jacobian(t: float, y: np.ndarray) -> object:
        return case.smooth_jacobian(t, y, width)

    y, _ = case.initial()
    times = sample_times(case)
    states = np.empty((times.size, y.size))
    options = {"rtol": rtol, "atol": weights(y.size, rtol, width)}
    options |= jacobian_options(case, method, jacobian)
    bound, count, done = Limit(limit), _no_counts(), 0
    solver = SOLVERS[method](rhs, 0.0, y, case.stop, **options)
    while solver.status == "running":
        _step(solver, bound)
        count["steps"] += 1
        done = _sample(solver, times, states, done)
    return Peer(times, states, _counted(count, solver))


def event_driven(case: Case, method: str, rtol: float, limit: float = 120.0, careful: bool = False) -> Peer:
    """Exact stick and slip: zones fixed within a step, switches located on the interpolant, then a restart.

    `careful` also looks for guards that rise and fall inside a step.
    """
    y, zones = case.initial()
    t, done, next_step, stalled = 0.0, 0, None, 0
    times = sample_times(case)
    states = np.empty((times.size, y.size))
    atol = weights(y.size, rtol, np.inf)
    bound, count = Limit(limit), {**_no_counts(), "switches": 0}
    while t < case.stop:
        solver = _fixed_zones(case, method, t, y, zones, rtol, atol, next_step)
        began_at = t
        while solver.status == "running":
            _step(solver, bound)
            count["steps"] += 1
            found = first_switch(case, solver, zones, careful)
            done = _sample(solver, times, states, done, found)
            if found is not None:
                break
        count = _counted(count, solver)
        # A restart may be bold: the last step size, without scipy's trial evaluations.
        next_step = solver.step_size
        if found is None:
            break
        t = found
        y = solver.dense_output()(t)
        guard = case.guards(t, y, zones)
        y, zones = settled(case, t, y, zones, (guard >= 0.0) | (guard == guard.max()), count)
        stalled = stalled + 1 if t - began_at < STALL else 0
        if stalled > 10 * zones.size + 100:
            raise RuntimeError(f"switching without end at t = {t:.9f} s")
    return Peer(times, states, count)


def first_switch(case: Case, solver: object, zones: np.ndarray, careful: bool) -> float | None:
    """Earliest time in the last step, just past its root, at which a guard is above zero; or None.

    A guard that starts at zero does not count: a block that has just broken away still stands still.
    """
    spots = (*INSIDE, 1.0) if careful else (1.0,)
    dense = None
    before = solver.t_old
    for spot in spots:
        t = solver.t if spot == 1.0 else solver.t_old + spot * (solver.t - solver.t_old)
        if spot == 1.0:
            guard = case.guards(t, solver.y, zones)
        else:
            dense = dense or solver.dense_output()
            guard = case.guards(t, dense(t), zones)
        rising = guard > JUST_ZERO
        if rising.any():
            dense = dense or solver.dense_output()
            return _locate(case, dense, zones, rising, before, t)
        before = t
    return None


def _locate(case: Case, dense: object, zones: np.ndarray, rising: np.ndarray, low: float, high: float) -> float:
    """Right-hand end of the bracket around the first root of the largest of the `rising` guards."""

    def largest(t: float) -> float:
        return float(case.guards(t, dense(t), zones)[rising].max()) - 0.5 * JUST_ZERO

    if largest(low) >= 0.0:
        low += 1e-9 * (high - low)
        if largest(low) >= 0.0:
            return low
    root = brentq(largest, low, high, xtol=1e-15, rtol=8.9e-16)
    while largest(root) < 0.0:
        root = min(np.nextafter(root, np.inf) + 1e-15, high)
    return root


def jacobian_options(case: Case, method: str, jacobian: object) -> dict:
    """How each method takes its Jacobian: sparse or dense matrix, packed bands, or not at all."""
    if method not in IMPLICIT:
        return {}
    if method != "LSODA" or isinstance(case, Belt):
        return {"jac": jacobian}
    low, up = case.bands

    def packed(t: float, y: np.ndarray) -> np.ndarray:
        matrix = jacobian(t, y)
        dense = matrix.tocoo() if issparse(matrix) else None
        band = np.zeros((low + up + 1, y.size))
        band[up + dense.row - dense.col, dense.col] = dense.data
        return band

    return {"jac": packed, "lband": low, "uband": up}


def _fixed_zones(
    case: Case,
    method: str,
    t: float,
    y: np.ndarray,
    zones: np.ndarray,
    rtol: float,
    atol: np.ndarray,
    first: float | None,
) -> object:
    def rhs(now: float, state: np.ndarray) -> np.ndarray:
        return case.zone_rhs(now, state, zones)

    def jacobian(now: float, state: np.ndarray) -> object:
        return case.zone_jacobian(now, state, zones)

    options = jacobian_options(case, method, jacobian)
    if first is not None and method != "LSODA":
        options["first_step"] = min(first, case.stop - t)
    return SOLVERS[method](rhs, t, y, case.stop, rtol=rtol, atol=atol, **options)


def _step(solver: object, bound: Limit) -> None:
    message = solver.step()
    if solver.status == "failed":
        raise RuntimeError(f"stopped at t = {solver.t:.6g} s: {message}")
    bound.check(solver.t)


def _sample(solver: object, times: np.ndarray, states: np.ndarray, done: int, until: float | None = None) -> int:
    """Fill the samples that the last step has passed (up to a switch); returns how many are filled by now."""
    reach = int(np.searchsorted(times, solver.t if until is None else until, side="right"))
    if solver.status == "finished" and until is None:
        reach = times.size
    if reach > done:
        states[done:reach] = solver.dense_output()(times[done:reach]).T
    return max(reach, done)


def _no_counts() -> dict[str, int]:
    return {"steps": 0, "nfev": 0, "njev": 0, "nlu": 0}


def _counted(count: dict[str, int], solver: object) -> dict[str, int]:
    return {**count, **{key: count[key] + int(getattr(solver, key) or 0) for key in ("nfev", "njev", "nlu")}}
