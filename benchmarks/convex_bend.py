"""The single bend by an engine of another kind: implicit Euler on speeds, one convex problem a step.

Over a step of length h the loads N, which count the arc that a node has, and the friction coefficients are frozen at
their values at its start.
The speeds V at its end then minimise (Moreau's time stepping written as a minimisation; physics 1.11)

    1/2 sum M (V - v)^2  +  energy of springs and dampers at the end  -  h F_ext V  +  h sum H(V_rel),

where H is the Huber function: quadratic (slope g0 = 1.25 F/v_c) up to the friction force F and linear
beyond. Its derivative is the saturated friction line; with v_c -> 0 it is Coulomb's set-valued law. The
function is convex whatever sticks or slips, so Newton's method with a line search always finds the
minimum; the Hessian has two bands when hose and core are numbered alternately. First order in h; adds
numerical damping. No zones, no events.

    python benchmarks/convex_bend.py --mu 0.60 --creep 1e-4 --elements 60 --step 1e-3
"""

import argparse
import json
import platform
import time as clock
from pathlib import Path
from typing import NamedTuple

import numpy as np
import scipy
from bend_scene import BendScene, Record, parameters, table
from scipy.linalg.lapack import dpbsv

NEWTON_LIMIT = 200
TOLERANCE = 1e-10  # on the gradient of the step, an impulse [N s]; 1e-7 N at h = 1 ms


class Step(NamedTuple):
    """The convex problem of one step, all arrays over the unknown speeds, elements or inner nodes."""

    start: np.ndarray
    hose_force: np.ndarray
    core_force: np.ndarray
    guide: np.ndarray
    bulkhead: np.ndarray
    drive: float


class ConvexBend:
    """The chain with unknown speeds (hose 1, core 1, hose 2, core 2, ..., end); node 0 is driven."""

    def __init__(self, scene: BendScene, step: float) -> None:
        self.scene, self.h, self.n = scene, step, scene.elements
        self.hose_k = scene.hose_stiffness / scene.pitch
        self.core_k = scene.core_stiffness / scene.pitch
        damping = 2.0 * scene.damping_ratio
        self.hose_c = damping * np.sqrt(self.hose_k * scene.hose_mass * scene.pitch)
        self.core_c = damping * np.sqrt(self.core_k * scene.core_mass * scene.pitch)
        lengths = scene.node_length
        self.mass = np.empty(2 * self.n - 1)
        self.mass[0:-1:2], self.mass[1:-1:2] = (
            scene.hose_mass * lengths[1:-1],
            scene.core_mass * lengths[1:-1],
        )
        self.mass[-1] = (scene.hose_mass + scene.core_mass) * lengths[-1]
        self.hose = scene.start.copy()
        self.core = scene.start.copy()
        self.speed = np.zeros(2 * self.n - 1)
        self.hose_tension = np.full(self.n, scene.outboard * scene.hose_share)
        self.core_tension = scene.outboard - self.hose_tension
        self.hose_rest = scene.pitch - self.hose_tension / self.hose_k
        self.core_rest = scene.pitch - self.core_tension / self.core_k
        self.newton = 0
        self.works = np.zeros(2)

    def split(self, speed: np.ndarray, drive: float) -> tuple[np.ndarray, np.ndarray]:
        """Hose and core speeds of all nodes, each (n + 1,)."""
        ends = speed[-1:]
        return np.concatenate([[drive], speed[0:-1:2], ends]), np.concatenate([[drive], speed[1:-1:2], ends])

    def prepare(self, t_end: float) -> Step:
        """Freeze loads and coefficients at the start of the step."""
        s = self.scene
        hose_speed, core_speed = self.speed[0:-1:2], self.speed[1:-1:2]
        core_mean = 0.5 * (self.core_tension[1:] + self.core_tension[:-1])
        beneath = core_mean
        if s.by_place:
            middle = 0.5 * (self.core[1:] + self.core[:-1])
            beneath = np.interp(self.hose[1:-1], middle, self.core_tension)
        both = beneath + 0.5 * (self.hose_tension[1:] + self.hose_tension[:-1])
        hose_turn, core_turn = (0.5 * (each[2:] - each[:-2]) / s.radius for each in (self.hose, self.core))
        guide = s.mu * np.maximum(both, 0.0) * hose_turn * s.window(self.hose[1:-1])
        slide = np.exp(-(((core_speed - hose_speed) / s.stribeck_speed) ** 2))
        coefficient = s.bulkhead_coulomb + (s.bulkhead_stiction - s.bulkhead_coulomb) * slide
        bulkhead = coefficient * core_mean * core_turn * s.window(self.core[1:-1])
        hose_force = self.hose_k * (np.diff(self.hose) - self.hose_rest)
        core_force = self.core_k * (np.diff(self.core) - self.core_rest)
        before = s.haul(t_end - self.h)[0]
        drive = (s.haul(t_end)[0] - before) / self.h  # the mean speed of the step: the end stays on its path
        return Step(self.speed, hose_force, core_force, guide, bulkhead, drive)

    def energy(self, step: Step, speed: np.ndarray) -> float:
        """The function to be minimised, up to a constant [J]."""
        hose, core = self.split(speed, step.drive)
        total = 0.5 * self.mass @ (speed - step.start) ** 2 - self.h * self.scene.outboard * speed[-1]
        stiff = self.h * self.hose_k + self.hose_c
        rate = np.diff(hose)
        total += self.h * np.sum(step.hose_force * rate + 0.5 * stiff * rate**2)
        stiff = self.h * self.core_k + self.core_c
        pull = np.maximum(step.core_force + stiff * np.diff(core), 0.0)
        total += self.h * np.sum(pull**2) / (2.0 * stiff)
        total += self.h * np.sum(huber(hose[1:-1], step.guide, self.scene.creep))
        return float(total + self.h * np.sum(huber((core - hose)[1:-1], step.bulkhead, self.scene.creep)))

    def gradient(self, step: Step, speed: np.ndarray) -> tuple[np.ndarray, tuple]:
        """Gradient [N s] and what the Hessian needs: tensions and frictions at the end of the step."""
        hose, core = self.split(speed, step.drive)
        hose_tension = step.hose_force + (self.h * self.hose_k + self.hose_c) * np.diff(hose)
        core_tension = np.maximum(step.core_force + (self.h * self.core_k + self.core_c) * np.diff(core), 0.0)
        guide, guide_slope = line(hose[1:-1], step.guide, self.scene.creep)
        bulkhead, bulkhead_slope = line((core - hose)[1:-1], step.bulkhead, self.scene.creep)
        out = self.mass * (speed - step.start)
        out[0:-1:2] -= self.h * (np.diff(hose_tension) - guide + bulkhead)
        out[1:-1:2] -= self.h * (np.diff(core_tension) - bulkhead)
        out[-1] -= self.h * (self.scene.outboard - hose_tension[-1] - core_tension[-1])
        return out, (hose_tension, core_tension, guide, guide_slope, bulkhead, bulkhead_slope)

    def hessian(self, parts: tuple) -> np.ndarray:
        """Upper bands of the Hessian, shape (3, 2 n - 1), as LAPACK's dpbsv wants them."""
        _, core_tension, _, guide_slope, _, bulkhead_slope = parts
        hose = self.h * (self.h * self.hose_k + self.hose_c)
        core = self.h * (self.h * self.core_k + self.core_c) * (core_tension > 0.0)
        band = np.zeros((3, self.mass.size))
        band[2] = self.mass
        band[2, 0:-1:2] += 2.0 * hose + self.h * (guide_slope + bulkhead_slope)
        band[2, 1:-1:2] += core[:-1] + core[1:] + self.h * bulkhead_slope
        band[2, -1] += hose + core[-1]
        band[1, 1:-1:2] = -self.h * bulkhead_slope
        band[0, 2:-1:2] = -hose
        band[0, 3:-1:2] = -core[1:-1]
        band[0, -1] = -hose  # from hose n-1, two places before the end
        band[1, -1] -= core[-1]  # from core n-1, its neighbour
        return band

    def advance(self, t_end: float) -> None:
        """One step; afterwards state, tensions and works are those of its end."""
        step = self.prepare(t_end)
        speed = self.speed
        slope, parts = self.gradient(step, speed)
        value = self.energy(step, speed)
        for _ in range(NEWTON_LIMIT):
            if np.abs(slope).max() < TOLERANCE:
                break
            direction = -dpbsv(self.hessian(parts), slope)[1]
            speed, slope, parts, value = self._search(step, speed, direction, slope, value)
            self.newton += 1
        else:
            raise RuntimeError(f"Newton did not converge in the step to t = {t_end:.4f} s")
        self._accept(step, speed, parts)

    def _search(self, step: Step, speed: np.ndarray, direction: np.ndarray, slope: np.ndarray, value: float) -> tuple:
        """Halve the Newton step until the energy falls enough (Armijo), up to rounding."""
        share, promise, rounding = 1.0, float(slope @ direction), 1e-13 * (1.0 + abs(value))
        while True:
            trial = speed + share * direction
            reached = self.energy(step, trial)
            if reached <= value + 1e-4 * share * promise + rounding or share < 1e-6:
                return trial, *self.gradient(step, trial), reached
            share *= 0.5

    def _accept(self, step: Step, speed: np.ndarray, parts: tuple) -> None:
        hose, core = self.split(speed, step.drive)
        self.hose_tension, self.core_tension = parts[0], parts[1]
        self.works += self.h * np.array([parts[2] @ hose[1:-1], parts[4] @ (core - hose)[1:-1]])
        self.hose = self.hose + self.h * hose
        self.core = self.core + self.h * core
        self.speed = speed


def huber(v: np.ndarray, limit: np.ndarray, creep: float) -> np.ndarray:
    """Dissipation potential [W] of the saturated line of slope 1.25 limit/creep."""
    edge = creep / 1.25
    return limit * np.where(np.abs(v) < edge, 0.5 * v**2 / edge, np.abs(v) - 0.5 * edge)


def line(v: np.ndarray, limit: np.ndarray, creep: float) -> tuple[np.ndarray, np.ndarray]:
    """Force [N] of the saturated line and its slope [N s/m]."""
    edge = creep / 1.25
    bound = np.abs(v) < edge
    return np.where(bound, limit * v / edge, limit * np.sign(v)), np.where(bound, limit / edge, 0.0)


def integrate(bend: ConvexBend, sample: float) -> tuple[Record, dict[str, object]]:
    """Run to the end and sample every `sample` seconds."""
    scene = bend.scene
    every, steps = round(sample / bend.h), round(scene.stop / bend.h)
    rows = [_row(bend, 0.0)]
    began = clock.perf_counter()
    for i in range(1, steps + 1):
        bend.advance(i * bend.h)
        if i % every == 0:
            rows.append(_row(bend, i * bend.h))
    count = {"steps": steps, "newton": bend.newton, "wall_s": round(clock.perf_counter() - began, 1)}
    return Record(*(np.array(column) for column in zip(*rows, strict=True)), *map(float, bend.works)), count


def _row(bend: ConvexBend, t: float) -> tuple:
    hose, core = bend.split(bend.speed, bend.scene.haul(t)[1])
    inboard = bend.hose_tension[0] + bend.core_tension[0]
    return t, bend.hose, bend.core, hose, core, bend.hose_tension, inboard


def run(scene: BendScene, step: float, sample: float = 1e-3) -> dict:
    """One run with its settings, counters, table and versions."""
    record, count = integrate(ConvexBend(scene, step), max(sample, step))
    return {
        "engine": "convex implicit Euler",
        "law": "line",
        "step": step,
        "scene": parameters(scene),
        "table": table(scene, record),
        "counters": count,
        "versions": {
            "python": platform.python_version(),
            "numpy": np.__version__,
            "scipy": scipy.__version__,
        },
    }


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mu", type=float, default=0.35, help="friction of hose on guide")
    parser.add_argument("--creep", type=float, default=1e-4, help="creep speed v_c [m/s]")
    parser.add_argument("--elements", type=int, default=60)
    parser.add_argument("--step", type=float, default=1e-3, help="step length h [s]")
    parser.add_argument("--by-place", action="store_true", help="core tension where the hose node is")
    parser.add_argument("--stop", type=float, default=20.0, help="end time [s]")
    parser.add_argument("--output", type=Path, help="JSON file to write")
    a = parser.parse_args()
    scene = BendScene(mu=a.mu, creep=a.creep, elements=a.elements, stop=a.stop, by_place=a.by_place)
    result = run(scene, a.step)
    print(json.dumps({k: result[k] for k in ("engine", "step", "table", "counters")}, indent=1))
    if a.output:
        a.output.write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
