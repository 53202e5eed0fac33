"""Belt and chain on fairlead beside scipy, in one run on one machine: error, time, counters, ratios.

    python benchmarks/compare.py            quick set, about four minutes
    python benchmarks/compare.py --full     all methods and tolerances, half an hour

Contenders take turns, several rounds, so that a busy spell of the machine hits all alike; a time is the median of
its rounds. The first round of each contender is not counted (imports, caches). Writes data/compare.json and the
figure docs/benchmarks.png; docs/benchmarks.md says how to read them.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import statistics
import sys
from collections.abc import Iterable
from typing import Any

from machine import machine, sentence  # first: it settles the number of threads before numpy is there

from contenders import Attempt, Contender, of_fairlead, of_scipy  # isort: skip
from peer_cases import Belt, Chain  # isort: skip
from work_precision import figure  # isort: skip

HERE = pathlib.Path(__file__).parent
DATA, FIGURE = HERE / "data" / "compare.json", HERE.parent / "docs" / "benchmarks.png"
ROUNDS = 5  # counted, for what is quick
SPENT = 8.0  # s of CPU time, so that load does not cut the rounds; who has used more does not start another
CASES = {"belt": Belt(), "chain-100": Chain(100)}
AIMS = {"belt": (1e-4, 50.0), "chain-100": (1e-4, 10.0)}  # error, how many times faster than scipy's best
ERRORS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)


def measure(contenders: Iterable[Contender]) -> list[dict[str, Any]]:
    """One row per contender: medians of its rounds, or the reason why it failed."""
    rivals = list(contenders)
    attempts: list[list[Attempt]] = [[] for _ in rivals]
    failed: dict[int, str] = {}
    for round_ in range(ROUNDS + 1):
        for k, rival in enumerate(rivals):
            if k in failed or sum(one.cpu for one in attempts[k]) > SPENT:
                continue
            try:
                attempts[k].append(rival.attempt())
            except (RuntimeError, TimeoutError, ValueError) as problem:
                failed[k] = str(problem)
            if round_ == 0:
                print(".", end="", flush=True, file=sys.stderr)
    print(file=sys.stderr)
    return [row(rival, attempts[k], failed.get(k)) for k, rival in enumerate(rivals)]


def row(rival: Contender, attempts: list[Attempt], failed: str | None) -> dict[str, Any]:
    """What is kept of a contender; times in seconds."""
    about = {name: getattr(rival, name) for name in ("series", "program", "law", "method", "accuracy", "width")}
    if failed is not None:
        return {**about, "failed": failed}
    counted = attempts[1:] or attempts
    times = {name: statistics.median(getattr(one, name) for one in counted) for name in ("cpu", "solve", "wall")}
    times |= {f"least_{name}": min(getattr(one, name) for one in counted) for name in ("cpu", "solve")}
    return {**about, "error": attempts[0].error, **times, "rounds": len(counted), "counters": attempts[0].counters}


def cheapest(rows: list[dict], program: str, wanted: float) -> dict | None:
    """The row of a program with the least CPU time at an error of at most `wanted`."""
    good = [one for one in rows if one["program"] == program and one.get("error", 1.0) <= wanted]
    return min(good, key=lambda one: one["cpu"]) if good else None


def ratios(rows: list[dict]) -> list[dict[str, Any]]:
    """Per error asked for: fairlead's and scipy's cheapest row, and how many times less CPU time fairlead takes."""
    table = []
    for wanted in ERRORS:
        ours, theirs = (cheapest(rows, program, wanted) for program in ("fairlead", "scipy"))
        if ours is not None:
            ratio = theirs["cpu"] / ours["cpu"] if theirs else None
            table.append({"error": wanted, "fairlead": ours, "scipy": theirs, "ratio": ratio})
    return table


def show(name: str, rows: list[dict]) -> None:
    """Print all rows of a case, and the ratios."""
    print(f"\n{name}: ms; error over 0.1 m (closed form or converged reference)")
    print(f"{'':26}{'accuracy':>9}{'width':>8}{'error':>10}{'CPU':>10}{'loop':>10}{'wall':>10}"
          f"{'steps':>8}{'rhs':>8}{'LU':>7}{'switches':>9}{'rounds':>7}")  # fmt: skip
    for one in rows:
        head = f"{one['series']:26}{one['accuracy']:9.0e}{one['width'] or 0:8.0e}"
        if "failed" in one:
            print(f"{head}   failed: {one['failed'][:90]}")
            continue
        count = one["counters"]
        evaluations, factored = count.get("rhs", count.get("nfev")), count.get("factorisations", count.get("nlu"))
        times = "".join(f"{1e3 * one[key]:10.2f}" for key in ("cpu", "least_solve", "wall"))
        counts = f"{count['steps']:8}{evaluations:8}{factored:7}{count.get('switches', 0):9}{one['rounds']:7}"
        print(f"{head}{one['error']:10.1e}{times}{counts}")
    print(f"\n{'error at most':14}{'fairlead CPU':>14}  {'by':26}{'scipy CPU':>12}  {'by':26}{'ratio':>7}")
    for line in ratios(rows):
        print(ratio_line(line))
    wanted, aim = AIMS[name]
    reached = next((line["ratio"] for line in ratios(rows) if line["error"] == wanted), None)
    if reached:
        verdict = "met" if reached >= aim else "NOT met"
        print(f"aim: {aim:g} times faster at {wanted:g}; measured {reached:.1f}: {verdict}")


def ratio_line(line: dict) -> str:
    """One line of the table of ratios."""
    ours, theirs = line["fairlead"], line["scipy"]
    text = f"{line['error']:<14.0e}{1e3 * ours['cpu']:11.2f} ms  {label(ours):26}"
    if theirs is None:
        return text + "   scipy does not get there"
    return text + f"{1e3 * theirs['cpu']:9.1f} ms  {label(theirs):26}{line['ratio']:7.1f}"


def label(one: dict) -> str:
    """Who won, with the setting."""
    width = f", {one['width']:.0e} m/s" if one["width"] else ""
    return f"{one['law']} {one['method']} {one['accuracy']:.0e}{width}"


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true", help="all methods and tolerances of scipy")
    parser.add_argument("--case", choices=list(CASES), action="append", help="only this case; nothing is written")
    options = parser.parse_args()
    found = machine()
    print(sentence(found))
    result: dict[str, Any] = {"machine": found, "full": options.full, "cases": {}}
    for name in options.case or CASES:
        case = CASES[name]
        rows = measure([*of_fairlead(case, options.full), *of_scipy(case, options.full)])
        result["cases"][name] = {"rows": rows, "ratios": ratios(rows)}
        show(name, rows)
    if not options.case:
        DATA.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
        figure(result, FIGURE)
        print(f"\nwrote {DATA.relative_to(HERE.parent)} and {FIGURE.relative_to(HERE.parent)}")


if __name__ == "__main__":
    main()
