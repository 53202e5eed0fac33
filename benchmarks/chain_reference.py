"""Reference motion of the chain, by two engines that share only parameters, stored in `data/chain_<N>.npz`.

Up to 200 blocks the stored positions come from event-driven integration (DOP853, every switch located,
zones exact; `peer_scipy.event_driven`) at a tolerance where two of its runs agree far below what any benchmark
asks. The second engine is a set-valued time stepping without any events,

    (M + h th C + h^2 th^2 K) v1 = b - h lambda,     lambda_i in f_i Sgn(v1_i),     th = 1/2,

solved in each step by a primal-dual active set (Moreau 1988; Hintermueller, Ito, Kunisch, SIAM J. Optim.
13 (2002) 865). It converges to the same motion as h falls, which is the statement of accuracy that the
file carries along. Longer chains are stored from the second engine and judged by the first.

    python benchmarks/chain_reference.py --blocks 100
"""

import argparse
import json
from pathlib import Path

import numpy as np
from peer_cases import SCALE, Chain
from peer_scipy import event_driven
from peers import DATA, Peer, error, sample_times
from scipy.linalg import solveh_banded

LONG = 200  # blocks; above, events are left to the check
LONG_STEPS = (6.25e-5, 3.125e-5, 1.5625e-5, 7.8125e-6)  # of the long chain [s]; they divide 0.1 s
STEPS = (1e-3, 5e-4, 2.5e-4, 1.25e-4)  # of the second engine [s]; they divide 20 ms
WIDTHS = 10.0 ** np.arange(-3, -12, -1)  # [m/s]
PASSES = 40  # of the active set before it is given a better start


def set_valued(case: Chain, step: float, theta: float = 0.5) -> Peer:
    """The chain by time stepping with set-valued friction at end speeds; no zones are ever located."""
    n, limit = case.blocks, case.limit
    unit = np.zeros((2, n))  # second differences with free ends, upper band form
    unit[1], unit[1, [0, -1]], unit[0, 1:] = 2.0, 1.0, -1.0
    stiff, damp = case.spring * unit, case.damping_time * case.spring * unit
    stiff[1, -1] += case.pull_stiffness
    damp[1, -1] += case.pull_damping
    matrix = step * theta * damp + (step * theta) ** 2 * stiff
    matrix[1] += case.mass
    x, v, force, passes = np.zeros(n), np.zeros(n), np.zeros(n), 0
    times = sample_times(case)
    states, every = np.zeros((times.size, 2 * n)), round((times[1] - times[0]) / step)
    for i in range(round(case.stop / step)):
        position, speed = case.pull((i + theta) * step)
        free = -banded(stiff, x + step * theta * (1.0 - theta) * v) - (1.0 - theta) * banded(damp, v)
        free[-1] += case.pull_stiffness * position + case.pull_damping * speed
        after, force, used = contacts(matrix, case.mass * v + step * free, step * limit, force, v)
        x, v, passes = x + step * ((1.0 - theta) * v + theta * after), after, passes + used
        if (i + 1) % every == 0:
            states[(i + 1) // every, 0::2], states[(i + 1) // every, 1::2] = x, v
    return Peer(times, states, {"steps": i + 1, "solves": passes})


def contacts(matrix: np.ndarray, load: np.ndarray, limit: np.ndarray, impulse: np.ndarray, v: np.ndarray) -> tuple:
    """Speeds, friction impulses and solves of one step: matrix v + impulse = load, impulse in limit Sgn(v).

    The active set may cycle; a minimisation of the rounded-off energy then gives it a better start.
    Raises RuntimeError when it still does not settle.
    """
    gain = matrix[1]  # any positive number per contact; the diagonal makes both terms impulses
    held, sign = np.abs(impulse + gain * v) <= limit, np.sign(impulse + gain * v)
    for used in range(1, 20 * PASSES):
        if used % PASSES == 0:
            v = relax(matrix, load, limit, v)
            trial = load - banded(matrix, v) + gain * v
            held, sign = np.abs(trial) <= limit, np.sign(trial)
        v = solve_free(matrix, np.where(held, 0.0, load - sign * limit), held)
        impulse = np.where(held, load - banded(matrix, v), sign * limit)
        trial = impulse + gain * v
        now, direction = np.abs(trial) <= limit, np.sign(trial)
        if np.array_equal(now, held) and np.array_equal(direction[~now], sign[~now]):
            return v, impulse, used
        held, sign = now, direction
    raise RuntimeError("the active set of a step did not settle")


def relax(matrix: np.ndarray, load: np.ndarray, limit: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Minimise 1/2 v A v - load v + limit |v|, |v| rounded off below a width that shrinks from try to try."""
    for width in WIDTHS:
        for _ in range(PASSES):
            slope = banded(matrix, v) - load + limit * np.clip(v / width, -1.0, 1.0)
            steep = matrix.copy()
            steep[1] += np.where(np.abs(v) < width, limit / width, 0.0)
            way, share = solveh_banded(steep, -slope), 1.0
            if np.abs(way).max() < 1e-3 * width:
                break
            while share > 1e-6:
                trial = v + share * way
                if way @ (banded(matrix, trial) - load + limit * np.clip(trial / width, -1.0, 1.0)) <= 0.0:
                    break  # still falling, or at the bottom
                share *= 0.5
            v = v + share * way
    return v


def solve_free(matrix: np.ndarray, load: np.ndarray, held: np.ndarray) -> np.ndarray:
    """Solve the tridiagonal system for the blocks that are free; held blocks have no speed."""
    reduced = matrix.copy()
    reduced[1, held] = 1.0
    reduced[0, 1:][held[1:] | held[:-1]] = 0.0
    return solveh_banded(reduced, load)


def banded(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Product of a symmetric tridiagonal matrix in upper band form with a vector."""
    out = matrix[1] * vector
    out[:-1] += matrix[0, 1:] * vector[1:]
    out[1:] += matrix[0, 1:] * vector[:-1]
    return out


def compute(blocks: int, rtol: float) -> dict:
    """Positions to be stored and how accurate they are; long chains by stepping, others by events."""
    case = Chain(blocks)
    return compute_long(case, rtol) if blocks > LONG else compute_short(case, rtol)


def compute_short(case: Chain, rtol: float) -> dict:
    """Event-driven with DOP853 at two tolerances, judged by the second engine."""
    best = event_driven(case, "DOP853", rtol, limit=36_000.0, careful=True)
    coarser = event_driven(case, "DOP853", 30.0 * rtol, limit=36_000.0, careful=True)
    positions = best.y[:, 0::2]
    statement = {
        "engine": "events, DOP853",
        "rtol": rtol,
        "switches": best.counters["switches"],
        "switches_coarser": coarser.counters["switches"],
        "difference_to_coarser": error(case, coarser, positions),
        "difference_to_set_valued": {f"{h:g}": error(case, set_valued(case, h), positions) for h in STEPS},
    }
    return _found(case, best, statement)


def compute_long(case: Chain, rtol: float) -> dict:
    """Set-valued at the finest step (DOP853 would need 1e6 steps here), judged by events with LSODA."""
    runs = {h: set_valued(case, h) for h in LONG_STEPS}
    best = runs[LONG_STEPS[-1]]
    positions = best.y[:, 0::2]
    events = event_driven(case, "LSODA", rtol, limit=36_000.0)
    statement = {
        "engine": "set-valued stepping",
        "step": LONG_STEPS[-1],
        "difference_to_coarser": {f"{h:g}": error(case, runs[h], positions) for h in LONG_STEPS[:-1]},
        "difference_to_events": {"rtol": rtol, "error": error(case, events, positions)},
        "switches": events.counters["switches"],
    }
    return _found(case, best, statement)


def _found(case: Chain, best: Peer, statement: dict) -> dict:
    text = {"blocks": case.blocks, "scale_m": SCALE, **statement}
    return {"positions": best.y[:, 0::2], "speeds_at_end": best.y[-1, 1::2], "t": best.t, "statement": text}


def main() -> None:
    """Command line: compute and store one chain."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--blocks", type=int, default=100)
    parser.add_argument("--rtol", type=float, default=1e-11)
    a = parser.parse_args()
    found = compute(a.blocks, a.rtol)
    statement = json.dumps(found.pop("statement"))
    np.savez_compressed(Path(DATA / f"chain_{a.blocks}.npz"), statement=statement, **found)
    print(statement)


if __name__ == "__main__":
    main()
