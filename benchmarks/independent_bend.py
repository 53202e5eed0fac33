"""The single bend test by scipy on a right-hand side of its own: an answer that owes nothing to fairlead.

The equations are those of `bend_equations.py`. Radau or BDF, with the analytic sparse Jacobian, has to find
every kink of the friction law by its error control; there are no events but the corner of the speed ramp.

    python benchmarks/independent_bend.py --mu 0.35 --creep 1e-4 --elements 60 --rtol 1e-5
"""

import argparse
import json
import platform
import time as clock
from pathlib import Path

import numpy as np
import scipy
from bend_equations import Bend
from bend_scene import BendScene, Record, parameters, table, trajectory
from scipy.integrate import BDF, Radau

SOLVERS = {"Radau": Radau, "BDF": BDF}
POSITION_SCALE = 1e-2  # [m]; rtol times this moves the core tension by 0.2 N at rtol 1e-5
SPEED_SCALE = 0.3  # [m/s]


def integrate(bend: Bend, method: str, rtol: float, sample: float, wall: float) -> tuple[Record, dict[str, object]]:
    """Run to the end, with a restart at the corner of the speed ramp; sample on the dense output."""
    scene = bend.scene
    weights = np.tile([POSITION_SCALE] * 2 + [SPEED_SCALE] * 2, bend.n - 1)
    atol = rtol * np.concatenate([weights, [POSITION_SCALE, SPEED_SCALE, 1e4, 1e4]])
    speeds = np.concatenate([np.tile([False, False, True, True], bend.n - 1), [False, True, False, False]])
    atol[speeds] = np.minimum(atol[speeds], scene.creep / 10.0)
    times = np.arange(0.0, scene.stop + 0.5 * sample, sample)
    states = np.empty((times.size, bend.size))
    t, y, done = 0.0, bend.initial(), 0
    began, count = clock.perf_counter(), {"steps": 0, "nfev": 0, "njev": 0, "nlu": 0}
    for bound in (min(scene.ramp, scene.stop), scene.stop):
        if bound <= t:
            continue
        solver = SOLVERS[method](bend.rhs, t, y, bound, rtol=1e-13, atol=atol, jac=bend.jacobian)
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                raise RuntimeError(f"{method} stopped at t = {solver.t:.6f} s: {message}")
            reach = np.searchsorted(times, solver.t + 1e-12, side="right")
            if reach > done:
                states[done:reach] = solver.dense_output()(times[done:reach]).T
                done = reach
            count["steps"] += 1
            if clock.perf_counter() - began > wall:
                raise TimeoutError(f"wall limit reached at t = {solver.t:.4f} s after {count['steps']} steps")
        t, y = solver.t, solver.y
        count = {**count, **{k: count[k] + getattr(solver, k) for k in ("nfev", "njev", "nlu")}}
    count["wall_s"] = round(clock.perf_counter() - began, 1)
    return sampled(bend, times, states), count


def sampled(bend: Bend, times: np.ndarray, states: np.ndarray) -> Record:
    """Motions and tensions at the sample times."""
    motions = [bend.motion(t, y) for t, y in zip(times, states, strict=True)]
    hose, core, hose_speed, core_speed = (np.array(part) for part in zip(*motions, strict=True))
    forces = [bend.forces(m) for m in motions]
    tension = np.array([f.hose_tension for f in forces])
    inboard = np.array([f.hose_tension[0] + f.core_tension[0] for f in forces])
    return Record(times, hose, core, hose_speed, core_speed, tension, inboard, states[-1, -2], states[-1, -1])


def run(
    scene: BendScene, law: str, method: str, rtol: float, sample: float = 1e-3, wall: float = 3600.0
) -> dict[str, object]:
    """One run with its settings, counters, table and versions."""
    record, count = integrate(Bend(scene, law), method, rtol, sample, wall)
    return summary(scene, law, method, rtol, record, count)


def summary(
    scene: BendScene, law: str, method: str, rtol: float, record: Record, count: dict[str, object]
) -> dict[str, object]:
    """What is kept of a run."""
    return {
        "engine": f"scipy {method}",
        "law": law,
        "rtol": rtol,
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
    parser.add_argument("--rtol", type=float, default=1e-5, help="accuracy; positions are weighted by 10 mm")
    parser.add_argument("--law", choices=("line", "tanh"), default="line")
    parser.add_argument("--method", choices=tuple(SOLVERS), default="Radau")
    parser.add_argument("--stop", type=float, default=20.0, help="end time [s]")
    parser.add_argument("--wall", type=float, default=3600.0, help="give up after this many seconds")
    parser.add_argument("--output", type=Path, help="JSON file to write")
    parser.add_argument("--trajectory", type=Path, help="NPZ file to write, every 10 ms")
    a = parser.parse_args()
    scene = BendScene(mu=a.mu, creep=a.creep, elements=a.elements, stop=a.stop)
    record, count = integrate(Bend(scene, a.law), a.method, a.rtol, 1e-3, a.wall)
    result = summary(scene, a.law, a.method, a.rtol, record, count)
    print(json.dumps({k: result[k] for k in ("engine", "law", "rtol", "table", "counters")}, indent=1))
    if a.output:
        a.output.write_text(json.dumps(result, indent=1) + "\n")
    if a.trajectory:
        np.savez_compressed(a.trajectory, **trajectory(record))


if __name__ == "__main__":
    main()
