"""How cost grows, and what a user waits for: the chain by its length, a long line compiled, commands from the shell.

    python benchmarks/scaling.py

    per step    CPU time of a step of the chain with N blocks, and the exponent p of a fit ~ N^p
    compile     from component instances to a System for a line of 1000 elements, kernels cached
    shell       `fairlead run single_bend` to its results and figures; `import fairlead`; `fairlead --help`

Times are medians of several runs, each stage of a run apart. The first run fills the caches and is not counted.
Writes data/scaling.json.
"""

from __future__ import annotations

import functools
import json
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from typing import Any

from machine import Timed, machine, sentence, timed  # first: it settles the number of threads before numpy is there

import numpy as np  # isort: skip
from contenders import compiled  # isort: skip
from peer_cases import Chain  # isort: skip

DATA = pathlib.Path(__file__).parent / "data" / "scaling.json"
BLOCKS = (100, 300, 1000, 3000)
STEPS = 1000  # of each chain, from rest
ROUNDS = 5
ELEMENTS = 1000
STAGES = ("load", "assembly", "flat", "system")
AIMS = {"exponent": 1.1, "compile": 1.0, "run single_bend": 3.0, "import fairlead": 0.5, "fairlead --help": 0.5}


def per_step(blocks: int) -> dict[str, float]:
    """CPU time of one attempted step; planning is measured by a run of one step and taken off."""
    planned, stepped = ([_stepping(blocks, most) for _ in range(3)] for most in (1, STEPS))
    cpu = min(cpu for cpu, _ in stepped) - min(cpu for cpu, _ in planned)
    attempts = stepped[0][1] - planned[0][1]
    return {"blocks": blocks, "attempts": attempts, "step": cpu / attempts, "planning": min(cpu for cpu, _ in planned)}


def _stepping(blocks: int, most: int) -> tuple[float, int]:
    from fairlead.integrate import Run, integrate

    system = compiled(Chain(blocks), "hold", 1e-3)
    begun = time.process_time()
    outcome = integrate(system, Run(stop=3.0, method="rodas5p", max_steps=most, record=[]))
    cpu = time.process_time() - begun
    return cpu, outcome.counters.steps + outcome.counters.rejected


def exponent(rows: Sequence[dict[str, float]]) -> float:
    """Slope of the fit in logarithms."""
    logs = np.log([[row["blocks"], row["step"]] for row in rows])
    return float(np.polyfit(logs[:, 0], logs[:, 1], 1)[0])


def stages() -> dict[str, float]:
    """CPU time of every stage of a line of ELEMENTS elements; `compile` is flattening and compiling together."""
    import fairlead

    model = fairlead.load("single_bend", set={"element": f"{15 / ELEMENTS} m"})
    found = {"load": timed(lambda: fairlead.load("single_bend", set={"element": f"{15 / ELEMENTS} m"})).cpu}
    for stage in STAGES[1:]:
        found[stage] = timed(functools.partial(getattr, model, stage)).cpu
    return {**found, "compile": found["flat"] + found["system"]}


def shell(command: Sequence[str]) -> Timed:
    """CPU and wall time of a command in a fresh process."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after, wall = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter() - begun
    return Timed(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall)


def commands(folder: str) -> dict[str, list[str]]:
    """What is typed."""
    program = [sys.executable, "-m", "fairlead"]
    return {
        "run single_bend": [*program, "run", "single_bend", "--force", "--out", f"{folder}/run"],
        "import fairlead": [sys.executable, "-c", "import fairlead"],
        "fairlead --help": [*program, "--help"],
    }


def repeated(work: Callable[[], Timed], rounds: int = ROUNDS) -> dict[str, float]:
    """Medians and least of several calls, after one that is not counted."""
    work()
    found = [work() for _ in range(rounds)]
    middle = {name: statistics.median(getattr(one, name) for one in found) for name in ("cpu", "wall")}
    return {**middle, "least_wall": min(one.wall for one in found)}


def within(name: str, value: float) -> str:
    """The verdict beside a figure."""
    return f"aim {AIMS[name]:g}: {'met' if value <= AIMS[name] else 'NOT met'}"


def main() -> None:
    """Measure, print, write."""
    found = machine()
    print(sentence(found))
    result: dict[str, Any] = {"machine": found}

    result["chain"] = [per_step(blocks) for blocks in BLOCKS]
    result["exponent"] = exponent(result["chain"])
    for row in result["chain"]:
        print(
            f"chain of {row['blocks']:5} blocks: {1e6 * row['step']:9.1f} us a step, planned in {row['planning']:.3f} s"
        )
    print(f"exponent {result['exponent']:.2f} ({within('exponent', result['exponent'])})")

    stages()
    rounds = [stages() for _ in range(ROUNDS)]
    result["line"] = {name: statistics.median(one[name] for one in rounds) for name in rounds[0]}
    print(f"line of {ELEMENTS} elements: " + ", ".join(f"{k} {v:.2f} s" for k, v in result["line"].items())
          + f" ({within('compile', result['line']['compile'])})")  # fmt: skip

    result["shell"] = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, command in commands(folder).items():
            took = result["shell"][name] = repeated(functools.partial(shell, command))
            print(f"{name}: CPU {took['cpu']:.2f} s, wall {took['wall']:.2f} s (least {took['least_wall']:.2f} s); "
                  f"{within(name, took['least_wall'])}")  # fmt: skip
    DATA.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
