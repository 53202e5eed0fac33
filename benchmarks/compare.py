"""Belt and chains on all engines of fairlead beside its peers, in one run on one machine: error, time, counters.

    python benchmarks/compare.py                     quick set of all cases; most of an hour
    python benchmarks/compare.py --full              all methods and tolerances, hours
    python benchmarks/compare.py --case belt         only this case is measured anew
    python benchmarks/compare.py --only stepping     only these series; --dry writes nothing
    python benchmarks/compare.py --draw              page and figure from the data file as it is

Contenders take turns, several rounds, so that a busy spell of the machine hits all alike; a time is the median of
its rounds, and what counts are ratios of CPU times. The first round of each contender is not counted (imports,
caches) unless it is the only one. Who takes too long is given up and says so. Writes data/compare.json, in which each
row has its commit and time of day, the tables of docs/benchmarks.md and the figure docs/benchmarks.png.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import statistics
import sys
import time
from collections import Counter
from typing import Any

from machine import commit, machine, sentence  # first: it settles the number of threads before numpy is there

from compare_page import write  # isort: skip
from compare_table import ratios, show  # isort: skip
from contenders import Attempt, Contender, contenders  # isort: skip
from peer_cases import Belt, Chain  # isort: skip
from peers import Unable  # isort: skip
from work_precision import figure  # isort: skip

HERE = pathlib.Path(__file__).parent
DATA, FIGURE = HERE / "data" / "compare.json", HERE.parent / "docs" / "benchmarks.png"
ROUNDS = 5  # counted, for what is quick
MOST_LATE = 2
SPENT = 3.0  # s of CPU time, so that load does not cut the rounds; who has used more does not start another
CASES = {"belt": Belt(), "chain-10": Chain(10), "chain-100": Chain(100), "chain-1000": Chain(1000)}


def measure(rivals: list[Contender]) -> list[dict[str, Any]]:
    """One row per contender: medians of its rounds, or the reason why there is none.

    Where two of a series used up their time the others are not tried: a tolerance that is too loose may chatter.
    """
    attempts: list[list[Attempt]] = [[] for _ in rivals]
    failed: dict[int, str] = {}
    late: Counter[str] = Counter()  # how many of a series used up their time
    for round_ in range(ROUNDS + 1):
        for k, rival in enumerate(rivals):
            if k in failed or sum(one.cpu for one in attempts[k]) > SPENT:
                continue
            if late[rival.series] >= MOST_LATE and not attempts[k]:
                failed[k] = f"not tried, {MOST_LATE} others did not finish"
                continue
            try:
                attempts[k].append(rival.attempt())
            except ImportError as missing:
                failed[k] = f"not installed: {missing}"
            except Unable as reason:
                failed[k] = f"cannot: {reason}"
            except TimeoutError as used_up:
                failed[k] = str(used_up)
                late[rival.series] += 1
            except (RuntimeError, ValueError) as problem:
                failed[k] = f"failed: {problem}"
            if round_ == 0:
                told = failed.get(k) or f"{attempts[k][0].cpu:.3g} s, error {attempts[k][0].error:.1e}"
                print(f"{rival.series} {rival.accuracy:.0e}: {told[:120]}", flush=True, file=sys.stderr)
    return [row(rival, attempts[k], failed.get(k)) for k, rival in enumerate(rivals)]


def row(rival: Contender, attempts: list[Attempt], failed: str | None) -> dict[str, Any]:
    """What is kept of a contender; times in seconds."""
    about = {name: getattr(rival, name) for name in ("series", "program", "law", "method", "accuracy", "width")}
    about |= {"commit": commit(), "date": time.strftime("%Y-%m-%d %H:%M")}
    if failed is not None:
        return {**about, "failed": failed}
    counted = attempts[1:] or attempts
    times = {name: statistics.median(getattr(one, name) for one in counted) for name in ("cpu", "solve", "wall")}
    times |= {f"least_{name}": min(getattr(one, name) for one in counted) for name in ("cpu", "solve")}
    return {**about, "error": attempts[0].error, **times, "rounds": len(counted), "counters": attempts[0].counters}


def stored() -> dict[str, Any]:
    """The data file as it is."""
    return json.loads(DATA.read_text(encoding="utf-8"))


def setting(one: dict[str, Any]) -> tuple[Any, ...]:
    """What tells a row from the others of its case."""
    return one["series"], one["accuracy"], one["width"]


def keep(name: str, found: dict[str, object], rows: list[dict], whole: bool) -> None:
    """Write the rows of a case into the data file at once; of a part of the contenders in the places of theirs."""
    result = stored()
    if not whole:
        new = {setting(one): one for one in rows}
        old = result["cases"].get(name, {"rows": []})["rows"]
        rows = [new.pop(setting(one), one) for one in old] + list(new.values())
    result["cases"][name] = {"machine": found, "rows": rows, "ratios": ratios(rows)}
    result["cases"] = {each: result["cases"][each] for each in CASES if each in result["cases"]}
    DATA.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true", help="all methods and tolerances")
    parser.add_argument("--case", choices=list(CASES), action="append", help="only this case")
    parser.add_argument("--only", action="append", help="only series whose name contains this")
    parser.add_argument("--dry", action="store_true", help="print only, write nothing")
    parser.add_argument("--draw", action="store_true", help="measure nothing, make page and figure from the data file")
    options = parser.parse_args()
    found = machine()
    print(sentence(found))
    for name in () if options.draw else options.case or CASES:
        rivals = [
            each
            for each in contenders(CASES[name], options.full)
            if any(word in each.series for word in options.only or [""])
        ]
        rows = measure(rivals)
        show(name, rows)
        if not options.dry:
            keep(name, found, rows, options.only is None)
    if not options.dry:
        figure(stored(), FIGURE)
        write(stored())
        print(f"\nwrote {DATA.relative_to(HERE.parent)}, {FIGURE.relative_to(HERE.parent)} and docs/benchmarks.md")


if __name__ == "__main__":
    main()
