"""Whether `fairlead cost` keeps what it says on lines: its budget, its columns, and the error of what it advises.

    python benchmarks/cost_kept.py [--budget 120]        half an hour; prints the tables of docs/accuracy.md

The three scenes are studied by the command, with nothing kept and all caches warm. Then routes that no study has seen
are studied, the advice for 5 % is followed over the time studied, and the run is compared with one that the study did
not make: `rodas` at a third of the accuracy of its references, by its second method.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time
from typing import Any

from machine import machine

import fairlead
from fairlead.analysis.cost.choice import choose, error, percent
from fairlead.analysis.cost.compared_outputs import outputs
from fairlead.analysis.cost.cost import TIGHTER, cost
from fairlead.analysis.cost.deviation import output_errors
from fairlead.analysis.cost.ladder import ACCURACIES
from fairlead.analysis.cost.timed_run import timed_run

SCENES = (("single_bend", {"mu": "0.6"}), ("guidance_route", {}), ("long_route", {}))
UNSEEN = (
    ("single_bend", {"mu": "0.45", "route.stations[0].angle": "60 deg", "line.tension": "500 N", "tow.force": "500 N"}),
    ("guidance_route", {"mu": "0.25", "route.stations[4].angle": "75 deg", "ship": "3 m/s"}),
    ("long_route", {"mu": "0.4", "route.stations[2].angle": "60 deg", "tail": "200 N"}),
)
TARGET = 0.05


def told(name: str, settings: dict[str, str]) -> str:
    """The scene in a word."""
    return f"`{name}`" + "".join(f", {key.rpartition('.')[2]} {value}" for key, value in settings.items())


def by_command(name: str, settings: dict[str, str], budget: float) -> list[str]:
    """Wall time over the budget, and by column how many lines have it."""
    with tempfile.TemporaryDirectory() as folder:
        words = [sys.executable, "-m", "fairlead", "cost", name, "--fresh", "--out", folder, "-q"]
        words += [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
        for seconds in (budget, budget):  # the first one warms what is compiled once
            begun = time.perf_counter()
            subprocess.run([*words, "--budget", f"{seconds:g} s"], check=True)
            took = time.perf_counter() - begun
        found = json.loads((pathlib.Path(folder) / "cost.json").read_text())
    rows = [row for row in found["rows"] if row["status"] == "finished"]
    kinds = ("numerical", "modelling", "discretisation")
    columns = [sum(row["error"][key] is not None for row in rows) for key in kinds]
    return [told(name, settings), f"{found['span'][1]:g} s", f"{took:.0f} s", f"{100 * (took / budget - 1):+.0f} %",
            str(len(rows)), *map(str, columns), percent(found["floor"])]  # fmt: skip


def followed(name: str, settings: dict[str, str], budget: float) -> list[str]:
    """The error that the advice told, and that of a run that follows it against a run of another kind."""

    def load(more: Any) -> Any:
        return fairlead.load(name, set={**settings, **more})

    study = cost(load, budget=budget)
    choice = choose(study, TARGET)
    if choice.row is None:
        return [told(name, settings), choice.sentence]
    names, units, _ = outputs(load({}), ["*"])
    exact = {key: value for key, value in choice.settings.items() if key not in ("run.engine", "run.accuracy")}
    exact |= {"run.engine": "rodas", "run.method": "rodas3p", "run.accuracy": f"{TIGHTER * min(ACCURACIES) / 3:g}"}
    runs = [timed_run(load, one, names, study.span, 600.0) for one in (choice.settings, exact)]
    if not all(one.finished for one in runs):
        return [told(name, settings), *(one.reason or one.status for one in runs)]
    had = study.size(output_errors(names, units, runs[0].values, runs[1].values))
    numerical, below = study.told(choice.row.numerical, choice.row)
    return [told(name, settings), choice.row.rung.label, f"{'<' if below else ''}{percent(numerical)}", percent(had),
            percent(error(study, choice.row)), "means" if study.sensitive else "each moment"]  # fmt: skip


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--budget", type=float, default=120.0)
    budget = parser.parse_args().budget
    print(machine())
    print("| scene | studied to | took | beyond the budget | rows | numerical | modelling | elements | floor |")
    print("|" + 9 * " --- |")
    for name, settings in SCENES:
        print(f"| {' | '.join(by_command(name, settings, budget))} |", flush=True)
    print("\n| route | advised | predicted | found | numerical or modelling | compared by |\n|" + 6 * " --- |")
    for name, settings in UNSEEN:
        print(f"| {' | '.join(followed(name, settings, budget))} |", flush=True)


if __name__ == "__main__":
    main()
