"""Plays all hard cases and shows what came of them: `make hard`, or `python -m tests.hard [--only ...] [--budget ...]`.

Every row is kept in a file as soon as it is known, under a key of all that decides it; a round that was interrupted
goes on where it stopped. The page is that of one commit: a row that was played at another one does not count.
"""

from __future__ import annotations

import argparse
import fnmatch
import time
from dataclasses import replace
from pathlib import Path

from rich.console import Console
from rich.table import Table

from tests.hard.attempt import Attempt
from tests.hard.kept import Kept, commit, version
from tests.hard.known import disagreements
from tests.hard.page import write
from tests.hard.peers.table import play as play_peers
from tests.hard.registry import ENGINES, Row, rows
from tests.hard.worker import Worker

ROOT = Path(__file__).parents[2]
KEPT, PAGE = ROOT / "results" / "hard" / "rows.jsonl", ROOT / "docs" / "stability.md"
PRICES = ("cheap", "fair", "slow")  # the order in which rows are played, within it that of the engines
COLOURS = {"ok": "green", "stopped": "yellow", "wrong": "red", "stuck": "red", "crashed": "red"}


def main(words: list[str] | None = None) -> int:
    """Play, print, write; the exit code is 0 when just the rows fail that known.py lists, else 1."""
    asked = _options().parse_args(words)
    if asked.peers:
        return play_peers(PAGE)
    chosen = [row for row in rows() if not asked.only or _fits(row, asked.only)]
    console, kept, worker = Console(), Kept(asked.kept), Worker()
    status = console.status("")
    status.start()
    ends = time.monotonic() + asked.budget if asked.budget else float("inf")
    done: list[tuple[Row, Attempt]] = []
    left: list[Row] = []
    try:
        for number, row in enumerate(sorted(chosen, key=_price), 1):
            status.update(f"{number}/{len(chosen)} {row.name}")
            found = None if asked.again else kept.get(row)
            if found is None and (asked.write or time.monotonic() > ends):
                left.append(row)
                continue
            if found is None:
                found = replace(worker.play(row), version=version(row), commit=commit())
                kept.put(found)
                if found.verdict != "ok":
                    console.print(_said(found), highlight=False, soft_wrap=True)
            done.append((row, found))
    except KeyboardInterrupt:
        console.print("Interrupted; what was played is kept, the next call goes on from here.")
        left = [row for row in chosen if row not in [played for played, _ in done]]
    finally:
        worker.end()
        status.stop()
    done.sort(key=lambda pair: chosen.index(pair[0]))
    if asked.table:
        console.print(table(done))
    console.print(summary(done))
    if left:
        console.print(f"{len(left)} of {len(chosen)} rows are still to be played at commit {commit()}.")
    if not asked.only:
        write(PAGE, done, sorted(left, key=chosen.index))
        console.print(f"Written to {PAGE.relative_to(ROOT)}.")
    wrong = list(disagreements(attempt for _, attempt in done))
    for said in wrong:
        console.print(said, highlight=False, soft_wrap=True)
    return 1 if wrong else 0


def _options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.hard", description=__doc__)
    only = "rows with these words in their name, or a pattern with *; may be given again"
    parser.add_argument("--only", action="append", metavar="WORDS", help=only)
    parser.add_argument("--budget", type=float, metavar="S", help="start no further row after so many seconds")
    parser.add_argument("--again", action="store_true", help="play rows again that are known")
    parser.add_argument("--write", action="store_true", help="play nothing, write the page from the rows that are kept")
    parser.add_argument("--table", action="store_true", help="print every row, known ones too")
    parser.add_argument("--peers", action="store_true", help="play other tools, and write their part of the page alone")
    parser.add_argument("--kept", type=Path, default=KEPT, help="where rows are kept")
    return parser


def _fits(row: Row, patterns: list[str]) -> bool:
    return any(fnmatch.fnmatch(row.name, one) or one in row.name for one in patterns)


def _price(row: Row) -> tuple[int, int]:
    return PRICES.index(row.case.cost), ENGINES.index(row.engine)


def _said(attempt: Attempt) -> str:
    name = f"{attempt.case} / {attempt.engine} / {attempt.treatment}"
    return f"[{COLOURS[attempt.verdict]}]{attempt.verdict}[/] {name} {attempt.reason}"


def table(done: list[tuple[Row, Attempt]]) -> Table:
    """Every row: verdict, time, switches, energy closure."""
    made = Table("case", "engine", "treatment", "auto", "verdict", "time [s]", "switches", "closure", "reason")
    for _, one in done:
        closure = "" if one.closure is None else f"{one.closure:.1e}"
        made.add_row(one.case, one.engine, one.treatment, "auto" if one.auto else "",
                     f"[{COLOURS[one.verdict]}]{one.verdict}[/]", f"{one.seconds:.2f}", str(one.switches), closure,
                     one.reason)  # fmt: skip
    return made


def summary(done: list[tuple[Row, Attempt]]) -> Table:
    """How many of each engine and treatment came through, and on the engine that auto picks."""
    attempts = [attempt for _, attempt in done]
    treatments = list(dict.fromkeys(one.treatment for one in attempts))
    made = Table("engine", *treatments, title="rows that came through, of those played")
    for engine in (*ENGINES, "auto"):
        of_engine = [one for one in attempts if (one.auto if engine == "auto" else one.engine == engine)]
        made.add_row(engine, *(share([one for one in of_engine if one.treatment == word]) for word in treatments))
    return made


def share(attempts: list[Attempt]) -> str:
    """`12 of 13`, or nothing."""
    return f"{sum(one.verdict == 'ok' for one in attempts)} of {len(attempts)}" if attempts else "-"
