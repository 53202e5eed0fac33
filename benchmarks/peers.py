"""What all peers share: how a run is returned, judged and bounded.

Every peer returns a `Peer`: times, states, counters. `error` measures it as all benchmarks do: the larger of the end
error and the rms error of the positions, over 0.1 m; against the closed form for the belt, against the stored
reference (`chain_reference.py`) for the chain. A run is bounded in CPU time, because the machine may be busy.
"""

import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
from peer_cases import SCALE, Belt, Chain

DATA = Path(__file__).parent / "data"
JUST_ZERO = 1e-12  # guards above this are passed; they are newtons over newtons, or metres a second

Case = Belt | Chain


class Unable(RuntimeError):
    """A peer cannot do a case, whatever its settings; the message says why."""


class Peer(NamedTuple):
    """One run: sample times (m,), states (m, n) and counters."""

    t: np.ndarray
    y: np.ndarray
    counters: dict[str, int]


class Limit:
    """The CPU time a run may take, from now on."""

    def __init__(self, seconds: float) -> None:
        self.seconds, self.began = seconds, time.process_time()

    def check(self, t: float) -> None:
        """Raise TimeoutError when the time is used up; t is how far the run has come [s]."""
        if time.process_time() - self.began > self.seconds:
            raise TimeoutError(f"did not finish in {self.seconds:g} s of CPU time, came to t = {t:.3g} s")


def sample_times(case: Case) -> np.ndarray:
    """Times at which runs are compared: 2000 intervals for the belt, 150 for a chain, 30 for a long one."""
    if isinstance(case, Belt):
        return np.linspace(0.0, case.stop, 2001)
    return np.linspace(0.0, case.stop, 151 if case.blocks <= 200 else 31)


def error(case: Case, peer: Peer, reference: np.ndarray) -> float:
    """Larger of end error (worst block) and rms error (all blocks and times) of the positions, over 0.1 m.

    The times of `peer` may be some of the sample times only.
    """
    rows = np.searchsorted(sample_times(case), peer.t - 1e-9)
    miss = peer.y[:, 0::2] - reference[rows]
    return float(max(np.abs(miss[-1]).max(), np.sqrt(np.mean(miss**2))) / SCALE)


def reference_positions(case: Case) -> np.ndarray:
    """Positions at the sample times (m, blocks): closed form, or the stored reference of the chain.

    Raises FileNotFoundError when the reference of this chain has not been computed (see chain_reference.py).
    """
    if isinstance(case, Belt):
        return belt_positions(case, sample_times(case))[:, None]
    with np.load(DATA / f"chain_{case.blocks}.npz") as stored:
        return stored["positions"].astype(float)


def belt_positions(belt: Belt, t: np.ndarray) -> np.ndarray:
    """Closed form: m x'' = F_k - k x between breakaway at x = F_s/k and the return to the belt's speed."""
    drop, w = belt.stiction - belt.coulomb, np.sqrt(belt.stiffness / belt.mass)
    slip = 2.0 * (np.pi - np.arctan(drop / (belt.speed * np.sqrt(belt.stiffness * belt.mass)))) / w
    period = slip + 2.0 * drop / (belt.stiffness * belt.speed)
    first = belt.stiction / (belt.stiffness * belt.speed)
    phase = np.mod(t - first, period)
    swing = drop * np.cos(w * phase) + belt.stiffness * belt.speed / w * np.sin(w * phase)
    stuck = belt.coulomb - drop + belt.stiffness * belt.speed * (phase - slip)
    later = np.where(phase < slip, belt.coulomb + swing, stuck) / belt.stiffness
    return np.where(t <= first, belt.speed * t, later)


def weights(size: int, rtol: float, width: float) -> np.ndarray:
    """Absolute tolerances: rtol times 0.1 m and 1 m/s; speeds at most a tenth of the smooth law's width."""
    out = np.full(size, rtol * SCALE)
    out[1::2] = min(rtol, 0.1 * width)
    return out


def settled(case: Case, t: float, y: np.ndarray, zones: np.ndarray, fired: np.ndarray, count: dict) -> tuple:
    """State and zones after the guards `fired`; one that is left positive would never cross zero again."""
    for _ in range(zones.size):
        if not fired.any():
            break
        y, zones = case.switch(t, y, zones, fired)
        count["switches"] += 1
        fired = case.guards(t, y, zones) > JUST_ZERO
    return y, zones
