"""How long the contract takes for each part of the library: CPU seconds of its properties, by class.

    python benchmarks/contract_times.py                     all parts, the dearest first; half a minute
    python benchmarks/contract_times.py Diode Relay         these parts
    python benchmarks/contract_times.py --compiled Relay    with the properties for which a kernel is compiled

Of each class one form is asked, the first; of a family such as Contact one of each member. A composite has no law, and
so no contract. Time depends on machine and load: compare two runs in turns, and look at the medians.
"""

from __future__ import annotations

import argparse
import statistics
import time

from fairlead.component.base import Composite
from fairlead.component.registry import known_types
from fairlead.testing import checks
from fairlead.testing.contract import Check

COMPILED = ("derivatives", "machine_code", "instances")


def forms(names: list[str], *, compiled: bool) -> dict[str, list[Check]]:
    """Class -> the properties of its first form."""
    types = known_types()
    if unknown := sorted(set(names) - set(types)):
        raise SystemExit(f"there is no part {', '.join(unknown)}")
    found: dict[str, list[Check]] = {}
    for name in names or sorted(types):
        if issubclass(types[name], Composite):
            if names:
                print(f"{name} is a composite: it has no law, and so no contract")
            continue
        first: dict[str, str] = {}
        for check in checks(types[name]):
            word = first.setdefault(check.kind.__name__, repr(check.chosen))
            if repr(check.chosen) == word and (compiled or check.name not in COMPILED):
                found.setdefault(check.kind.__name__, []).append(check)
    return found


def seconds(asked: list[Check]) -> float:
    """CPU time of properties, one after the other."""
    begin = time.process_time()
    for check in asked:
        check()
    return time.process_time() - begin


def main() -> None:
    """Print a row for each class, and their sum and median."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", help="types; default: all")
    parser.add_argument("--compiled", action="store_true", help="the properties as well for which a kernel is compiled")
    given = parser.parse_args()
    asked = forms(given.parts, compiled=given.compiled)
    if not asked:
        return
    seconds(next(iter(asked.values())))  # what is imported once counts for none
    took = {name: seconds(of) for name, of in asked.items()}
    for name, cpu in sorted(took.items(), key=lambda row: -row[1]):
        print(f"{name:32}{len(asked[name]):4} properties {cpu:8.2f} s")
    print(f"{len(took)} classes, {sum(took.values()):.1f} s in all, median {statistics.median(took.values()):.2f} s")


if __name__ == "__main__":
    main()
