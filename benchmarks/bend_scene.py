"""The single bend test as plain numbers: parameters, geometry and the table that every engine must fill.

A hose with a core and bulkheads, 15 m long, is hauled inboard round one 90 degree bend at 0.3 m/s against
800 N. Only what is needed to state the problem and to read off its results is shared between engines;
each engine writes down the equations of motion for itself. Nothing here imports fairlead.

Sign: s grows outboard, hauling is towards negative s, tension is positive in stretch. Source: physics
sections 3, 4.0, 4.2 and 7a (parameter set "bend-test").
"""

from dataclasses import asdict, dataclass
from typing import NamedTuple

import numpy as np

INSTANTS = (1.0, 5.0, 8.0, 12.0, 20.0)  # times of the table [s]
STEADY = (5.0, 15.0)  # interval for mean and ripple of the inboard tension [s]
RUCK_FORCE = -160.0  # 2 % of EA_h [N]
RUCK_DWELL = 0.1  # [s]


@dataclass(frozen=True)
class BendScene:
    """All numbers of the test in SI units; `mu` is hose on guide, `creep` is v_c of both contacts.

    `by_place`: load of the guide from the core tension at the hose node's place, not from the core node of
    the same index. docs/physics.md 3.3 says index; the two part when hose and core do.
    """

    mu: float = 0.35
    creep: float = 1e-4
    elements: int = 60
    length: float = 15.0
    first: float = 1.5
    bend_start: float = 3.0
    radius: float = 1.0
    angle: float = np.pi / 2
    edge: float = 0.25
    hose_mass: float = 1.6
    core_mass: float = 4.2
    hose_stiffness: float = 8e3
    core_stiffness: float = 500e3
    damping_ratio: float = 0.05
    outboard: float = 800.0
    speed: float = -0.3
    ramp: float = 1.0
    bulkhead_stiction: float = 0.50
    bulkhead_coulomb: float = 0.40
    stribeck_speed: float = 0.02
    stop: float = 20.0
    by_place: bool = False

    @property
    def pitch(self) -> float:
        """Element length l [m]."""
        return self.length / self.elements

    @property
    def node_length(self) -> np.ndarray:
        """Length that belongs to each node [m], shape (n + 1,): half an element at the ends."""
        share = np.full(self.elements + 1, self.pitch)
        share[[0, -1]] *= 0.5
        return share

    @property
    def start(self) -> np.ndarray:
        """Route position of every node at t = 0 [m], shape (n + 1,), the same for hose and core."""
        return self.first + self.pitch * np.arange(self.elements + 1)

    @property
    def hose_share(self) -> float:
        """Part of the tension that the hose carries at the start [-]: EA_h/(EA_h + EA_c)."""
        return self.hose_stiffness / (self.hose_stiffness + self.core_stiffness)

    @property
    def capstan(self) -> float:
        """Inboard tension when the hose slides everywhere on the bend [N]."""
        return float(self.outboard * np.exp(self.mu * self.angle))

    def haul(self, t: float) -> tuple[float, float]:
        """Position [m] and speed [m/s] of the inboard end."""
        if t < self.ramp:
            return self.first + 0.5 * self.speed * t * t / self.ramp, self.speed * t / self.ramp
        return self.first + self.speed * (t - 0.5 * self.ramp), self.speed

    def window(self, s: np.ndarray) -> np.ndarray:
        """Weight of the bend at each route position `s` [m]."""
        enter = np.clip((s - self.bend_start) / self.edge + 0.5, 0.0, 1.0)
        leave = np.clip((self.bend_start + self.radius * self.angle - s) / self.edge + 0.5, 0.0, 1.0)
        return enter * leave


class Record(NamedTuple):
    """Samples of one run; nodes along the second axis (n + 1), elements likewise (n)."""

    time: np.ndarray
    hose: np.ndarray
    core: np.ndarray
    hose_speed: np.ndarray
    core_speed: np.ndarray
    hose_tension: np.ndarray
    inboard: np.ndarray
    device_work: float
    bulkhead_work: float


def table(scene: BendScene, record: Record) -> dict[str, object]:
    """The numbers of physics 7a from the samples of one run."""
    apart = (record.core - record.hose) - (record.core[0] - record.hose[0])
    greatest = np.abs(apart).max(axis=1)
    lowest = record.hose_tension.min(axis=1)
    at = [int(np.argmin(np.abs(record.time - t))) for t in INSTANTS if t <= record.time[-1] + 1e-9]
    steady = record.inboard[(record.time >= STEADY[0]) & (record.time <= STEADY[1])]
    crossing, dwell = ruck_times(record.time, record.hose_tension)
    return {
        "registration_mm": {f"{record.time[i]:g}": round(1e3 * greatest[i], 3) for i in at},
        "registration_max_mm": round(1e3 * float(greatest.max()), 3),
        "inboard_mean_N": _rounded(steady.mean() if steady.size else None),
        "inboard_ripple_std_N": _rounded(steady.std() if steady.size else None),
        "inboard_ripple_half_range_N": _rounded(0.5 * np.ptp(steady) if steady.size else None),
        "capstan_N": round(scene.capstan, 3),
        "lowest_hose_tension_N": {f"{record.time[i]:g}": round(float(lowest[i]), 3) for i in at},
        "lowest_hose_tension_so_far_N": {f"{record.time[i]:g}": round(float(lowest[: i + 1].min()), 3) for i in at},
        "ruck_first_crossing_s": crossing,
        "ruck_first_dwell_s": dwell,
        "device_work_J": round(record.device_work, 3),
        "bulkhead_work_J": round(record.bulkhead_work, 3),
        **_hose_on_bend(scene, record),
    }


def ruck_times(time: np.ndarray, hose_tension: np.ndarray) -> tuple[float | None, float | None]:
    """First time any element is below the ruck force [s]; first time one has stayed there for the dwell."""
    below = hose_tension < RUCK_FORCE
    any_below = np.flatnonzero(below.any(axis=1))
    if any_below.size == 0:
        return None, None
    needed = round(RUCK_DWELL / (time[1] - time[0]))
    count = np.zeros(hose_tension.shape[1], dtype=int)
    for i in range(any_below[0], len(time)):
        count = np.where(below[i], count + 1, 0)
        if count.max() > needed:
            return round(float(time[any_below[0]]), 4), round(float(time[i]), 4)
    return round(float(time[any_below[0]]), 4), None


def _hose_on_bend(scene: BendScene, record: Record) -> dict[str, object]:
    """Speeds on the bend: mean over the nodes inside, start of the hose, greatest slip against the core."""
    weight = scene.window(record.hose)
    inside = np.maximum(weight.sum(axis=1), 1e-12)  # none inside: speeds of zero
    hose = (weight * record.hose_speed).sum(axis=1) / inside
    core = (weight * record.core_speed).sum(axis=1) / inside
    moving = np.flatnonzero(hose < -0.01)
    cruise = (record.time >= STEADY[0]) & (record.time <= STEADY[1])
    pick = [int(np.argmin(np.abs(record.time - t))) for t in (0.4, 0.6, 0.8, 1.0, 2.0, 5.0)]
    slip = np.abs(np.where(weight > 0.5, record.core_speed - record.hose_speed, 0.0)).max(axis=1)
    return {
        "hose_speed_on_bend": {f"{record.time[i]:g}": round(float(hose[i]), 4) for i in pick},
        "core_speed_on_bend": {f"{record.time[i]:g}": round(float(core[i]), 4) for i in pick},
        "hose_starts_s": round(float(record.time[moving[0]]), 4) if moving.size else None,
        "hose_speed_range_5_15": _range(hose[cruise]),
        "greatest_slip_hose_core_5_15": float(slip[cruise].max()) if cruise.any() else None,
    }


def trajectory(record: Record, every: int = 10) -> dict[str, np.ndarray]:
    """What a pointwise comparison needs, single precision: tension, registration, lowest hose tension."""
    apart = (record.core - record.hose) - (record.core[0] - record.hose[0])
    signals = {
        "time": record.time,
        "inboard": record.inboard,
        "registration": np.abs(apart).max(axis=1),
        "lowest_hose_tension": record.hose_tension.min(axis=1),
    }
    return {name: values[::every].astype(np.float32) for name, values in signals.items()}


def _range(values: np.ndarray) -> list[float] | None:
    return [round(float(values.min()), 4), round(float(values.max()), 4)] if values.size else None


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(float(value), 3)


def parameters(scene: BendScene) -> dict[str, float]:
    """All parameters of the scene, for the JSON file."""
    return asdict(scene)
