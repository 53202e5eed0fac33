"""`python -m tests.scenes.verdicts --class limits --seeds 0:225`: play random scenes and count what comes of them.

    --class CLASS ...   classes; all when not given      --seeds FIRST:END   seeds; all that count when not given
    --engine ENGINE     rodas, ida or stepping           --jobs N            processes
    --markdown          the counts as a table for docs/random_scenes.md

Every scene that is not right is printed with its reason. Ends with 1 when a class misses its bounds: at least 80 %
right, under 5 % set aside, none wrong that tests/scenes/known.py does not list.
"""

from __future__ import annotations

import argparse
import collections
import concurrent.futures
import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, field

from tests.scenes.classes import CLASSES, SCENES, VERSION
from tests.scenes.known import KNOWN
from tests.scenes.verdict import RIVALS, Verdict, judge

RIGHT, ASIDE = 0.80, 0.05
WORDS = ("right", "aside", "refused", "ended", "wrong")


@dataclass
class Count:
    """What came of the scenes of one class."""

    kind: str
    words: collections.Counter[str] = field(default_factory=collections.Counter)
    horizons: int = 0
    """How many of the right ones are judged up to a horizon only."""
    alone: int = 0
    """How many of the right ones the rival took no part in."""
    unlisted: list[int] = field(default_factory=list)
    """Seeds that are wrong and not known to be."""
    seconds: float = 0.0

    def take(self, seed: int, verdict: Verdict, seconds: float) -> None:
        """Count a scene."""
        self.words[verdict.word] += 1
        self.seconds += seconds
        self.horizons += verdict.word == "right" and verdict.horizon < math.inf
        self.alone += verdict.word == "right" and bool(verdict.rival)
        if verdict.word == "wrong" and seed not in KNOWN.get(self.kind, {}):
            self.unlisted.append(seed)

    @property
    def total(self) -> int:
        """How many were played."""
        return sum(self.words.values())

    @property
    def within(self) -> bool:
        """True if the class keeps its bounds."""
        return (
            self.words["right"] >= RIGHT * self.total and self.words["aside"] < max(ASIDE * self.total, 1)
            and not self.unlisted
        )  # fmt: skip

    def __str__(self) -> str:
        counts = ", ".join(f"{self.words[word]} {word}" for word in WORDS if self.words[word])
        more = f"; {self.horizons} up to a horizon" if self.horizons else ""
        more += f"; {self.alone} without a rival" if self.alone else ""
        return f"{self.kind}: {counts} of {self.total}{more}; {self.seconds / max(self.total, 1):.2f} s each"


def main() -> int:
    """Play what is asked for; 1 if a class misses its bounds."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.scenes.verdicts", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("--class", dest="kinds", nargs="+", choices=list(CLASSES), default=list(CLASSES))
    parser.add_argument("--seeds", default=f"0:{SCENES}")
    parser.add_argument("--engine", choices=list(RIVALS), default="rodas")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--markdown", action="store_true")
    asked = parser.parse_args()
    first, _, end = asked.seeds.partition(":")
    seeds = range(int(first), int(end or int(first) + 1))
    print(f"generators of version {VERSION}, engine {asked.engine}, seeds {seeds.start} to {seeds.stop - 1}",
          flush=True)  # fmt: skip
    counts = []
    for kind in asked.kinds:
        count = Count(kind)
        for seed, verdict, seconds in played(kind, seeds, asked.engine, asked.jobs):
            count.take(seed, verdict, seconds)
            if verdict.word != "right":
                why = KNOWN.get(kind, {}).get(seed)
                print(f"  {kind} {seed}: {verdict.word}: {verdict.why[:300]}" + (f" (known: {why})" if why else ""),
                      flush=True)  # fmt: skip
        print(count, flush=True)
        counts.append(count)
    if asked.markdown:
        print("\n".join(table(counts)))
    return 0 if all(count.within for count in counts) else 1


def played(kind: str, seeds: range, engine: str, jobs: int) -> Iterator[tuple[int, Verdict, float]]:
    """Seed, verdict, and processor time [s] of each scene, in the order of seeds."""
    if jobs == 1:
        yield from (_play(kind, seed, engine) for seed in seeds)
        return
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        yield from pool.map(_play, [kind] * len(seeds), seeds, [engine] * len(seeds))


def _play(kind: str, seed: int, engine: str) -> tuple[int, Verdict, float]:
    begun = time.process_time()
    verdict = judge(CLASSES[kind](seed), engine)
    return seed, verdict, time.process_time() - begun


def table(counts: list[Count]) -> list[str]:
    """The counts as a table in Markdown."""
    lines = ["| class | scenes | right | of these up to a horizon | set aside | refused | ended | wrong |"]
    lines.append("| --- " * 8 + "|")
    for c in counts:
        w = c.words
        right = f"{w['right']} ({w['right'] / c.total:.0%})"
        rest = " | ".join(str(w[word]) for word in ("aside", "refused", "ended", "wrong"))
        lines.append(f"| {c.kind} | {c.total} | {right} | {c.horizons} | {rest} |")
    return lines


if __name__ == "__main__":
    raise SystemExit(main())
