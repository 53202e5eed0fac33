"""Whether the defaults are what the study recommends: what a netlist gets that says nothing of friction and accuracy.

    python benchmarks/defaults.py                    all bundled models; writes the second table of docs/accuracy.md
    python benchmarks/defaults.py belt capstan       these only, printed

Every model with contacts is run as if its netlist left out `method`, `creep`, `accuracy` and `engine` (exact hold at
1e-4), beside other accuracies and binding. The error is all of it, numerical and of the model: against exact hold at
accuracy 1e-7.
"""

from __future__ import annotations

import argparse
import math
import pathlib
from dataclasses import dataclass

import fairlead.models

import fairlead
from fairlead.analysis.cost.choice import percent, seconds
from fairlead.analysis.cost.compared_outputs import outputs
from fairlead.analysis.cost.deviation import output_errors, worst
from fairlead.analysis.cost.timed_run import Timed, timed_run
from fairlead.analysis.treatments.treatments import creep, treatment, treatment_of

PAGE = pathlib.Path(__file__).resolve().parents[1] / "docs" / "accuracy.md"
PINNED = {"single_bend": {"method": "binding", "line.ruck_force": "null"}}  # the law of the paper
BEGIN, END = "<!-- table: benchmarks/defaults.py -->", "<!-- end of table of defaults -->"
EXACT = "hold"
CREEPS = {"binding": 1e-4, "binding, creep 1 um/s": 1e-6, EXACT: None}  # m/s
CHOICES = (
    ("binding", "1e-2"), ("binding", "1e-3"), ("binding", "1e-4"), ("binding, creep 1 um/s", "1e-3"),
    (EXACT, "1e-2"), (EXACT, "1e-3"), (EXACT, "1e-4"),
)  # fmt: skip
PROBE, CAP = 4.0, 60.0  # s; a scene that takes longer is run over the part of its time that it reaches
TARGET = 0.01


@dataclass(frozen=True)
class Cell:
    """A run with its error; `error` is None when it did not finish."""

    timed: Timed
    error: float | None

    def __str__(self) -> str:
        if self.error is None:
            return "too slow" if self.timed.status == "budget" else self.timed.status
        return f"{percent(self.error)}, {seconds(self.timed.cpu)}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", help="bundled models; default: all, and the page is written")
    options = parser.parse_args()
    folder = pathlib.Path(next(iter(fairlead.models.__path__)))
    names = options.models or sorted(path.stem for path in folder.glob("*.yaml"))
    columns = [f"{method} {accuracy}" for method, accuracy in CHOICES]
    lines, found = [["model", "time", *columns], ["---"] * (2 + len(columns))], []
    for name in names:
        print(name, flush=True)
        model = fairlead.load(name, set=PINNED.get(name))
        if treatment_of(model):
            part, cells = study(name, model)
            lines.append([name, part, *map(str, cells)])
            found.append(cells)
    lines.append(["within 1 %", "", *(verdict(column) for column in zip(*found, strict=True))])
    text = "\n".join("| " + " | ".join(line) + " |" for line in lines)
    print(text)
    if not options.models:
        page = PAGE.read_text(encoding="utf-8")
        before, _, rest = page.partition(BEGIN)
        PAGE.write_text(f"{before}{BEGIN}\n\n{text}\n\n{END}{rest.partition(END)[2]}", encoding="utf-8")


def study(name: str, model: fairlead.Model) -> tuple[str, list[Cell]]:
    """The time that was run, and a cell for each treatment and accuracy."""
    def load(more: dict[str, str]) -> fairlead.Model:
        return fairlead.load(name, set={**PINNED.get(name, {}), **more})

    names, units, _ = outputs(model, ["*"])
    start, stop = model.netlist.run.start, model.netlist.run.stop
    exact = {**treatment(model, EXACT), "run.engine": "rodas", "run.accuracy": "1e-7"}
    probe = timed_run(load, exact, names, (start, stop), PROBE)
    part = f"{stop - start:g} s"
    if probe.status == "budget":
        stop = start + float(f"{0.9 * (probe.reached - start):.1g}")
        part = f"{stop - start:g} s (part)"
    reference = timed_run(load, exact, names, (start, stop), CAP)
    cells = []
    for method, accuracy in CHOICES:
        said, speed = treatment(model, method.partition(",")[0]), CREEPS[method]
        if speed is not None:
            said |= creep(model, speed)
        timed = timed_run(load, {**said, "run.engine": "auto", "run.accuracy": accuracy}, names, (start, stop), CAP)
        error = None
        if timed.finished and reference.finished:
            most = worst(output_errors(names, units, timed.values, reference.values))
            error = most.relative if most else 0.0
        cells.append(Cell(timed, error))
    return part, cells


def verdict(column: tuple[Cell, ...]) -> str:
    """In how many models a choice is within the target, and the geometric mean of its times."""
    done = [cell for cell in column if cell.error is not None]
    good = sum(cell.error <= TARGET for cell in done if cell.error is not None)
    mean = math.exp(sum(math.log(max(cell.timed.cpu, 1e-6)) for cell in done) / max(len(done), 1))
    return f"**{good} of {len(column)}, {seconds(mean)}**"


if __name__ == "__main__":
    main()
