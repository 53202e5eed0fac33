"""python -m tests.mistakes [--only PATTERN] [--verbose]: play the mistakes; print what is missing and the score."""

from __future__ import annotations

import argparse
import tempfile
import time
from collections import Counter
from pathlib import Path

from tests.mistakes.catalogue import ALL, CATALOGUE
from tests.mistakes.entry import Mistake
from tests.mistakes.judge import Answer, faults
from tests.mistakes.play import Desk, play


def main() -> None:
    """Play what was asked for."""
    parser = argparse.ArgumentParser(prog="python -m tests.mistakes", description=__doc__)
    parser.add_argument("--only", default="", help="a piece of the names: `python`, `decimal comma`")
    parser.add_argument("--verbose", action="store_true", help="print the answers too, of those that are good as well")
    asked = parser.parse_args()
    chosen = {name: mistake for name, mistake in ALL.items() if asked.only.lower() in name.lower()}
    begun = time.process_time()
    found = {name: played(name, mistake, asked.verbose) for name, mistake in chosen.items()}
    score(found)
    print(f"{time.process_time() - begun:.1f} s of processor time")


def played(name: str, mistake: Mistake, verbose: bool) -> list[str]:
    """Play one on a desk of its own, print its line, and return what is wrong with the answer."""
    with tempfile.TemporaryDirectory() as folder:
        answer = play(mistake, Desk(Path(folder)))
    wrong = faults(mistake, answer)
    if wrong or verbose:
        print(f"{name}: {', '.join(wrong) or 'good'}")
    if verbose:
        show(mistake, answer)
    return wrong


def show(mistake: Mistake, answer: Answer) -> None:
    """Print what was expected, and the answer."""
    print(f"    place {' | '.join(mistake.place)};  part {' & '.join(mistake.part)};  cure {' | '.join(mistake.cure)}")
    print("\n".join(f"    > {line.rstrip()}" for line in answer.text.splitlines() if line.strip()), end="\n\n")


def score(found: dict[str, list[str]]) -> None:
    """Print how many are answered well, by kind, and how often each fault is met."""
    print()
    for kind in CATALOGUE:
        of_kind = [wrong for name, wrong in found.items() if name.startswith(f"{kind}:")]
        counts = Counter(fault for wrong in of_kind for fault in wrong)
        told = ", ".join(f"{fault} {count}" for fault, count in counts.most_common())
        print(f"{kind:10} {sum(not wrong for wrong in of_kind):4} of {len(of_kind):3}   {told}")
    print(f"{'all':10} {sum(not wrong for wrong in found.values()):4} of {len(found):3}")


if __name__ == "__main__":
    main()
