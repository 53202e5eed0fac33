"""How the cost of the single bend grows with its elements: time per simulated second at a fixed error.

    python benchmarks/bend_growth.py                           all engines, 50 to 3200 elements
    python benchmarks/bend_growth.py --engine stepping --elements 800

The bundled `single_bend` with exact friction (hold), 2 s: the ramp of the haul and a second after it. The error is
the larger of the end and the rms error of all positions over 0.1 m, against scipy on equations of its own
(`bend_reference.py`), up to 800 elements; beyond, the accuracy that was needed at 800 is taken. For each engine and
size the loosest accuracy is chosen that reaches the error. No peer takes part: none of them has friction whose
normal force follows from the tension of the line. Writes data/bend_growth.json.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import statistics
from typing import Any

from machine import machine, sentence  # first: it settles the number of threads before numpy is there

import numpy as np  # isort: skip

DATA = pathlib.Path(__file__).parent / "data"
FILE = DATA / "bend_growth.json"
ELEMENTS = (50, 200, 800, 3200)
ACCURACIES = (1e-2, 3e-3, 1e-3, 5e-4, 4e-4, 3e-4, 1e-4, 3e-5, 1e-5)
ENGINES = ("stepping", "rodas", "ida")
STOP, SCALE, WANTED = 2.0, 0.1, 1e-3
LIMIT = 120.0  # s by the clock; a run that takes longer is given up
ROUNDS, SPENT = 3, 20.0  # runs of the chosen accuracy; s of CPU time after which no other is started
AIM, AIM_ELEMENTS, AIM_EXPONENT = 0.2, 800, 1.1  # s per simulated second; the exponent from 50 to 3200 elements


def run(elements: int, engine: str, accuracy: float) -> tuple[Any, np.ndarray]:
    """One run; its outcome and the positions [times, hose and core nodes] every 0.1 s."""
    import fairlead
    from fairlead.integrate import Run, integrate

    settings = {"element": f"{15.0 / elements!r} m", "friction.method": "hold", "run.accuracy": str(accuracy)}
    system = fairlead.load("single_bend", set=settings).system
    signals = ["line.hose_node[*].x", "line.core_node[*].x"]
    places = [
        k for layer in ("hose", "core") for k, signal in enumerate(system.recording(signals).recorded)
        if signal.name.startswith(f"line.{layer}_node") and signal.name.endswith(".x")
    ]  # fmt: skip
    outcome = integrate(system, Run(stop=STOP, every=0.1, engine=engine, max_wall=LIMIT, record=signals))
    return outcome, outcome.values[outcome.sides == 0][:, places]


def error(positions: np.ndarray, reference: np.ndarray) -> float:
    """The larger of end and rms error, over SCALE."""
    miss = positions - reference
    return float(max(np.abs(miss[-1]).max(), np.sqrt(np.mean(miss**2))) / SCALE)


def measure(elements: int, engine: str, start: int) -> dict[str, Any]:
    """The first accuracy from place `start` on whose error is small enough, with times; or why there is none."""
    stored = DATA / f"bend_elements_{elements}.npz"
    reference = np.load(stored)["positions"] if stored.exists() else None
    row: dict[str, Any] = {"elements": elements, "engine": engine}
    for place in range(start, len(ACCURACIES)):
        outcome, positions = run(elements, engine, ACCURACIES[place])
        if not outcome.ok:
            row["failed"] = f"accuracy {ACCURACIES[place]:g}: {outcome.sentence}"
            if outcome.status.is_budget:
                break  # a tighter one takes longer
            continue
        found = error(positions, reference) if reference is not None else None
        if found is None or found <= WANTED:
            cpu = [outcome.loop_cpu]
            while len(cpu) < ROUNDS and sum(cpu) < SPENT:
                cpu.append(run(elements, engine, ACCURACIES[place])[0].loop_cpu)
            counters = {name: value for name, value in vars(outcome.counters).items() if isinstance(value, int)}
            row.pop("failed", None)
            return {**row, "place": place, "accuracy": ACCURACIES[place], "error": found,
                    "per_second": statistics.median(cpu) / STOP, "counters": counters}  # fmt: skip
        row["failed"] = f"error {found:.1e} at accuracy {ACCURACIES[place]:g}"
    return row


def exponent(rows: list[dict[str, Any]]) -> float | None:
    """Slope of time per simulated second over elements in logarithms."""
    good = [(row["elements"], row["per_second"]) for row in rows if "per_second" in row]
    if len(good) < 2:
        return None
    logs = np.log(good)
    return float(np.polyfit(logs[:, 0], logs[:, 1], 1)[0])


def line(row: dict[str, Any]) -> str:
    """One row as text."""
    head = f"{row['engine']:9} {row['elements']:5} elements: "
    if "per_second" not in row:
        return head + row["failed"]
    rejected = sum(number for name, number in row["counters"].items() if name.startswith("rejected_"))
    count, found = row["counters"], "no reference" if row["error"] is None else f"error {row['error']:.1e}"
    return (
        f"{head}{row['per_second']:8.3f} s per simulated second at accuracy {row['accuracy']:g}, {found}; "
        f"{count['steps']} steps, {rejected} rejected, "
        f"{count['solves']} solves, {count['switches']} switches"
    )


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--engine", choices=ENGINES, action="append")
    parser.add_argument("--elements", type=int, action="append")
    options = parser.parse_args()
    found = machine()
    print(sentence(found))
    print(f"single bend with exact friction, {STOP:g} s, error at most {WANTED:g} over {SCALE:g} m; processor time")
    for engine in options.engine or ENGINES:
        ours, place = [], 0
        for elements in options.elements or ELEMENTS:
            row = {**measure(elements, engine, place), "commit": found["commit"], "date": found["date"]}
            place = row.get("place", place)  # a finer line never needs less
            ours.append(row)
            print(line(row), flush=True)
            keep(row, found)
        grows = exponent(ours)
        if grows is not None:
            print(f"{engine:9} exponent {grows:.2f} (aim at most {AIM_EXPONENT})")
        for row in ours:
            if row["elements"] == AIM_ELEMENTS and "per_second" in row and engine == "stepping":
                print(f"aim at {AIM_ELEMENTS} elements: {AIM} s per simulated second, here {row['per_second']:.3f} s")


def keep(row: dict[str, Any], found: dict[str, object]) -> None:
    """Write a row into the data file, in the place of an earlier one of the same engine and size."""
    stored = json.loads(FILE.read_text(encoding="utf-8"))["rows"] if FILE.exists() else []
    rows = [one for one in stored if (one["engine"], one["elements"]) != (row["engine"], row["elements"])] + [row]
    rows.sort(key=lambda one: (ENGINES.index(one["engine"]), one["elements"]))
    FILE.write_text(json.dumps({"machine": found, "wanted": WANTED, "rows": rows}, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
