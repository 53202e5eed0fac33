"""SUNDIALS CVODE (scikit-sundae) through the belt and the chain: exact friction, the guards as root functions.

Zones are fixed between two roots; at a root they switch and CVODE starts afresh, its first step a share of
the distance of the last two roots. A new object for each start, because the package keeps a list of all
roots and turns it into an array at every step. The Jacobian of the chain is a band that CVODE differences
itself: seven evaluations in numpy, where a given one would have to be filled in as a full matrix.
"""

import numpy as np
from peer_cases import Belt
from peers import JUST_ZERO, Case, Limit, Peer, sample_times, settled, weights

METHODS = ("BDF", "Adams")
ROOT = 2  # status of a step that ends at a root
SHORTEST = 1e-10  # [s], of a first step
MOST_STEPS = 1_000_000  # between two samples
FIRST = 0.01  # first step after a root, in distances of the last two; 0.001 to 1 differ by a fifth


def cvode(case: Case, method: str, rtol: float, limit: float = 120.0) -> Peer:
    """One run. Raises RuntimeError where CVODE gives up, TimeoutError at the limit of CPU time."""
    y, zones = case.initial()
    times = sample_times(case)
    states = np.empty((times.size, y.size))
    states[0] = y
    bound, count = Limit(limit), {"nfev": 0, "njev": 0, "switches": 0}
    y, zones = settled(case, 0.0, y, zones, case.guards(0.0, y, zones) > JUST_ZERO, count)
    solver, done, before, first = _start(case, method, rtol, 0.0, y, zones, 0.0), 1, 0.0, 0.0
    while done < times.size:
        made = solver.step(times[done], "normal")
        if not made.success:
            raise RuntimeError(f"stopped at t = {made.t:.6g} s: {made.message}")
        bound.check(made.t)
        if made.status != ROOT:
            states[done] = made.y
            done += 1
        if made.status == ROOT or done == times.size:
            count["nfev"], count["njev"] = count["nfev"] + made.nfev, count["njev"] + made.njev
        if made.status == ROOT:
            guard = case.guards(made.t, made.y, zones)
            y, zones = settled(case, made.t, made.y, zones, (guard >= 0.0) | (guard == guard.max()), count)
            first = max(FIRST * (made.t - before), SHORTEST)
            before = made.t
            solver = _start(case, method, rtol, made.t, y, zones, first)
    return Peer(times, states, count)


def _start(case: Case, method: str, rtol: float, t: float, y: np.ndarray, zones: np.ndarray, first: float) -> object:
    """A CVODE object started at t in these zones."""
    from sksundae.cvode import CVODE

    def rhs(now: float, state: np.ndarray, rate: np.ndarray) -> None:
        rate[:] = case.zone_rhs(now, state, zones)

    def guards(now: float, state: np.ndarray, found: np.ndarray) -> None:
        found[:] = case.guards(now, state, zones)

    guards.direction = [1] * zones.size
    options = {"method": method, "rtol": rtol, "atol": weights(y.size, rtol, np.inf), "max_num_steps": MOST_STEPS}
    if isinstance(case, Belt):
        options["jacfn"] = lambda now, state, rate, J: J.__setitem__(..., case.zone_jacobian(now, state, zones))
    else:
        options |= dict(zip(("lband", "uband"), case.bands, strict=True)) | {"linsolver": "band"}
    solver = CVODE(rhs, eventsfn=guards, num_events=zones.size, first_step=first, **options)
    solver.init_step(t, y)
    return solver
