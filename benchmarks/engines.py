"""Work and precision of the engines on the chain: what `auto` goes by.

Error: the larger of the end and the root mean square error of the positions over 0.1 m, against the stored
reference of an independent engine. Time is that of the compiled loop, the best of three runs.

    python benchmarks/engines.py --blocks 100
"""

import argparse
from pathlib import Path

import numpy as np

from fairlead.integrate import Outcome, Run, integrate
from fairlead.simulate import load

SCALE = 0.1  # length that errors are referred to [m]
ACCURACIES = {"rodas": (1e-2, 1e-3, 1e-4, 1e-5), "stepping": (1e-2, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5)}
REPEATS = 3


def error(outcome: Outcome, times: np.ndarray, positions: np.ndarray) -> float:
    """Largest of end and rms error of the positions, over SCALE."""
    rows = np.searchsorted(outcome.times, times - 1e-9)
    difference = outcome.values[rows][:, : positions.shape[1]] - positions
    return float(max(np.abs(difference[-1]).max(), np.sqrt((difference**2).mean()))) / SCALE


def measure(blocks: int, engine: str, accuracy: float, times: np.ndarray) -> tuple[float, Outcome]:
    """Best time of the loop [s] over REPEATS runs, and the last outcome."""
    best, outcome = np.inf, None
    for _ in range(REPEATS):
        model = load("hundred_blocks", {"blocks": str(blocks), "run.accuracy": str(accuracy)})
        model.system.record(["rod.block[*].x"])
        outcome = integrate(model.system, Run(stop=3.0, every=float(times[1]), engine=engine))
        best = min(best, outcome.loop_wall)
    return best, outcome


def main() -> None:
    """Command line: one table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--blocks", type=int, default=100)
    blocks = parser.parse_args().blocks
    reference = np.load(Path(__file__).parent / "data" / f"chain_{blocks}.npz")
    print("| engine | accuracy | error | time [ms] | steps | rejected | solves | switches |")
    print("|---|---|---|---|---|---|---|---|")
    for engine, accuracies in ACCURACIES.items():
        for accuracy in accuracies:
            seconds, outcome = measure(blocks, engine, accuracy, reference["t"])
            c, found = outcome.counters, error(outcome, reference["t"], reference["positions"])
            print(
                f"| {engine} | {accuracy:g} | {found:.2e} | {1e3 * seconds:.1f} | {c.steps} | {c.rejected} |"
                f" {c.solves} | {c.switches} |"
            )


if __name__ == "__main__":
    main()
