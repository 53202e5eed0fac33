"""What a new value of a parameter costs beside loading and compiling anew, kernels cached.

    python benchmarks/new_value.py [model]

Median processor time of nine calls each, taken in turns in one process.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable

import fairlead

CALLS = 9
VALUES = {
    "a friction (mu)": lambda k: {"mu": 0.3 + 0.01 * k},
    "the pull at the end (tail)": lambda k: {"tail": f"{150 + k} N"},
    "a mass (line.core.mass)": lambda k: {"line.core.mass": f"{4.2 + 0.01 * k} kg/m"},
    "the place of the line (line.start)": lambda k: {"line.start": f"{-46 + 0.01 * k} m"},
}


def seconds(call: Callable[[], fairlead.Model]) -> tuple[float, fairlead.Model]:
    """Processor time of a call that gives a model, compiled."""
    begun = time.process_time()
    model = call()
    assert model.system.n > 0
    return time.process_time() - begun, model


def main(name: str) -> None:
    """Print the table."""
    model = fairlead.load(name)
    model.with_values(mu=0.29)  # whatever is imported and cached is there now
    print(f"| {name}: other value of | load and compile, ms | with_values, ms | ratio | shared |")
    print("| --- | --- | --- | --- | --- |")
    for said, values in VALUES.items():
        fresh, other = [], []
        for k in range(CALLS):
            given = values(k)
            fresh.append(seconds(lambda g=given: fairlead.load(name, {n: str(v) for n, v in g.items()}))[0])
            took, made = seconds(lambda g=given: model.with_values(**g))
            other.append(took)
        one, two = statistics.median(fresh), statistics.median(other)
        shared = "no" if made.rebuilt else "yes"
        print(f"| {said} | {1e3 * one:.0f} | {1e3 * two:.0f} | {one / two:.1f} | {shared} |", flush=True)


if __name__ == "__main__":
    main(*(sys.argv[1:] or ["long_route"]))
