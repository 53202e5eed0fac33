"""What `auto` goes by: `rodas` and `stepping` over number of contacts and accuracy, and the table that follows.

    python benchmarks/engine_choice.py            all cases, some minutes
    python benchmarks/engine_choice.py --quick    without the largest two

Both engines run the belt, the chains and the bends with exact friction at the accuracy a user asks for. An engine
keeps an accuracy if its error (end or rms of the positions, over 0.1 m, against closed form or reference) is at most
PROMISE times that. Where both keep it the faster one wins, by processor time of the compiled loop, runs in turns;
else the one that keeps it; `rodas` if none does. Printed is who wins, and `STEPPING_FROM` of src/fairlead/choice.py:
per accuracy the least number of contacts from which `stepping` wins in all cases with laws linear between switches
(belt, chains; `auto` leaves others to `rodas`). Writes data/engine_choice.json.
"""

from __future__ import annotations

import argparse
import functools
import json
import pathlib
import statistics
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from machine import machine, sentence  # first: it settles the number of threads before numpy is there

import bend_growth  # isort: skip
import numpy as np  # isort: skip
from contenders import fairlead  # isort: skip
from peer_cases import Belt, Chain  # isort: skip

DATA = pathlib.Path(__file__).parent / "data"
ACCURACIES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
ENGINES = {"rodas": "rodas5p", "stepping": "stepping"}  # by their method as contenders.py names it
PROMISE = 1.0
ROUNDS, SPENT, LIMIT = 5, 5.0, 60.0  # runs; s of processor time after which no other starts; s given to a run


@dataclass(frozen=True)
class Case:
    """A scene with its number of contacts; `run(engine, accuracy)` returns its error and seconds, or raises."""

    name: str
    contacts: int
    run: Callable[[str, float], tuple[float, float]]


def cases(quick: bool) -> list[Case]:
    """By number of contacts; of a bend of N elements every inner node touches the guide and the core."""
    chains = [Case(f"chain-{n}", n, functools.partial(peer_case, Chain(n))) for n in (10, 100, 1000)]
    known = [n for n in (50, 200, 800) if (DATA / f"bend_elements_{n}.npz").exists()]
    bends = [Case(f"bend-{n}", 2 * n - 2, functools.partial(bend_case, n)) for n in known]
    found = [Case("belt", 1, functools.partial(peer_case, Belt())), *chains, *bends]
    return sorted(found, key=lambda case: case.contacts)[: -2 if quick else None]


def peer_case(scene: Belt | Chain, engine: str, accuracy: float) -> tuple[float, float]:
    """Error and seconds of the belt or a chain."""
    found = fairlead(scene, "hold", ENGINES[engine], accuracy, None, LIMIT / 4)
    return found.error, found.solve


def bend_case(elements: int, engine: str, accuracy: float) -> tuple[float, float]:
    """Error and seconds of a bend."""
    reference = np.load(DATA / f"bend_elements_{elements}.npz")["positions"]
    outcome, positions = bend_growth.run(elements, engine, accuracy)
    if not outcome.ok:
        raise RuntimeError(outcome.sentence)
    return bend_growth.error(positions, reference), outcome.loop_cpu


def measure(case: Case, accuracy: float) -> dict[str, Any]:
    """Errors and median seconds of both engines, in turns, and who wins."""
    row: dict[str, Any] = {"case": case.name, "contacts": case.contacts, "accuracy": accuracy}
    seconds: dict[str, list[float]] = {engine: [] for engine in ENGINES}
    for _ in range(ROUNDS):
        for engine, spent in seconds.items():
            if f"{engine}_failed" in row or sum(spent) > SPENT:
                continue
            try:
                row[f"{engine}_error"], took = case.run(engine, accuracy)
                spent.append(took)
            except (RuntimeError, ValueError) as problem:
                row[f"{engine}_failed"] = str(problem)
    row |= {f"{engine}_s": statistics.median(spent) for engine, spent in seconds.items() if spent}
    return row | {"winner": winner(row, accuracy)}


def winner(row: dict[str, Any], accuracy: float) -> str:
    """The faster engine of those that keep the accuracy."""
    keeps = [engine for engine in ENGINES if row.get(f"{engine}_error", np.inf) <= PROMISE * accuracy]
    return min(keeps, key=lambda engine: row[f"{engine}_s"]) if keeps else "rodas"


def table(rows: list[dict[str, Any]]) -> list[tuple[float, int]]:
    """Per accuracy the contacts from which stepping wins in every case; accuracies where it never does are left out."""
    found = []
    for accuracy in ACCURACIES:
        best: int | None = None
        linear = [row for row in rows if row["accuracy"] == accuracy and not row["case"].startswith("bend")]
        for row in sorted(linear, key=lambda row: -row["contacts"]):
            if row["winner"] != "stepping":
                break
            best = row["contacts"]
        if best is not None:
            found.append((accuracy, best))
    return found


def line(row: dict[str, Any]) -> str:
    """One row as text."""
    parts = [f"{row['case']:11} {row['contacts']:5} contacts, accuracy {row['accuracy']:<7g}"]
    for engine in ENGINES:
        if f"{engine}_s" in row:
            parts.append(f"{engine} {1e3 * row[f'{engine}_s']:9.2f} ms, error {row[f'{engine}_error']:.1e}")
        else:
            parts.append(f"{engine} failed: {row[f'{engine}_failed'][:40]}")
    return "   ".join([*parts, row["winner"]])


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="without the largest two cases")
    quick = parser.parse_args().quick
    found = machine()
    print(sentence(found))
    rows = []
    for case in cases(quick):
        for accuracy in ACCURACIES:
            rows.append(measure(case, accuracy))
            print(line(rows[-1]), flush=True)
    chosen = table(rows)
    print(f"\nSTEPPING_FROM = {tuple(chosen)!r}")
    if not quick:
        text = json.dumps({"machine": found, "promise": PROMISE, "rows": rows, "stepping_from": chosen}, indent=1)
        (DATA / "engine_choice.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
