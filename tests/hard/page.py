"""The page docs/stability.md: what holds where, failures first, then every case with its oracle."""

from __future__ import annotations

import datetime
import os
import platform
import re
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

from tests.hard.attempt import Attempt
from tests.hard.known import known_failure
from tests.hard.peers.table import peers_of, with_peers
from tests.hard.registry import ENGINES, TREATMENTS, Row

Done = Sequence[tuple[Row, Attempt]]
MARKS = {"ok": "ok", "stopped": "**stopped**", "wrong": "**wrong**", "stuck": "**stuck**", "crashed": "**crashed**"}
LONGEST = 220  # characters of a reason

HEAD = """\
# Hard cases: what stays stable

How far can you trust a run of a difficult scene? This page lists scenes that were chosen to break an engine, and the
result of each. If you want to know about your own scene, find the case nearest to it below, and read its row.
[Validation](validation.md) compares realistic models with known answers, [random scenes](random_scenes.md) has many
more drawn at random.

Each scene has an *oracle*. This is a rule that decides without the engine whether a result is right: a closed form, a
balance of energy or momentum, monotonicity, or symmetry. Each scene runs on every engine: `rodas` (with its second
method as `rodas3p`), `stepping` and `ida`. It runs with exact hold, with robust binding (creep 1e-5 m/s unless the
case says otherwise) and with LuGre, where they apply. `make hard` repeats all of them:

```sh
make hard                                                # all rows; an interrupted round goes on, at the same commit
.venv/bin/python -m tests.hard --only tether --table     # rows with a word in their name
.venv/bin/python -m tests.hard --budget 300              # start nothing new after 300 s
.venv/bin/python -m tests.hard --peers                   # other tools (extra `bench`), their part of this page alone
```

`make hard` writes this page from rows of one commit. The cases are in `tests/hard/cases`, scenes without a generator
in `models/hard`. `tests/hard/known.py` lists the rows that fail and those that the tests leave to `make hard`.

| verdict | meaning |
|---|---|
| ok | finished, or refused where the oracle says so; satisfies the oracle; energy balances; held contacts do not slip |
| stopped | ended before its stop, with a message that says where and why; it reported nothing wrong |
| wrong | finished, and a reported result is wrong |
| stuck | its budget of time ran out, or it gave no answer |
| crashed | an exception, or the process ended |

Energy balances if at most ten times `accuracy` is missing of the energy that passed, or of 0.1 J if less passed. So the
closure in the tables below, which is relative to the energy that passed, may be large where little passed.
"""


def write(path: Path, done: Done, left: Sequence[Row]) -> None:
    """Write the page; `left` are the rows that are not played yet. Raises ValueError for rows of several commits."""
    commits = sorted({attempt.commit for _, attempt in done})
    if len(commits) > 1:
        raise ValueError(f"rows of {', '.join(commits)}: play them all at one commit, with `make hard`")
    parts = [HEAD, _played(done, left), _summary(done), _failures(done), _waiting(left), _cases(done), _made(done)]
    peers = peers_of(path.read_text(encoding="utf-8")) if path.exists() else ""
    text = "\n".join(parts)
    path.write_text(with_peers(text, peers) if peers else text, encoding="utf-8")


def failures(text: str) -> set[tuple[str, str, str]]:
    """(case, engine, treatment) of the rows that a page shows as failing."""
    rows = _table(text.partition("## What fails")[2].partition("\n## ")[0])
    return {(case, engine, treatment) for case, engine, treatment, *_ in rows}


def waiting(text: str) -> set[tuple[str, str, str]]:
    """(case, engine, treatment) of the rows that a page says are not played."""
    rows = _table(text.partition("## Not played")[2].partition("\n## ")[0])
    return {(case, engine, one) for case, engine, some in rows for one in some.split(", ")}


def _table(text: str) -> list[list[str]]:
    """The cells of a table below its head, `|` inside a cell written as `\\|`."""
    lines = [line for line in text.splitlines() if line.startswith("| ")][2:]
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip("|"))] for line in lines]


def _played(done: Done, left: Sequence[Row]) -> str:
    commit = done[0][1].commit if done else "none"
    told = f"**Played at commit {commit}: {len(done)} of {len(done) + len(left)} rows**"
    return told + (", the others are listed below.\n" if left else ".\n")


def _waiting(left: Sequence[Row]) -> str:
    lines = ["## Not played", ""]
    if not left:
        return "\n".join([*lines, "Nothing.", ""])
    lines += ["Rows that no round has come to at this commit.", "", _line("case", "engine", "treatments"),
              _line(*["---"] * 3)]  # fmt: skip
    found: dict[tuple[str, str], list[str]] = {}
    for row in left:
        found.setdefault((row.case.name, row.engine), []).append(row.treatment)
    return "\n".join([*lines, *(_line(*names, ", ".join(words)) for names, words in found.items()), ""])


def _summary(done: Done) -> str:
    attempts = [attempt for _, attempt in done]
    words = [word for word in (*TREATMENTS, "none") if any(one.treatment == word for one in attempts)]
    lines = ["## Summary", "",
             "Each cell counts the rows that are `ok`, of all rows run. `auto` counts rows on the engine that",
             "`run.engine: auto` picks for their scenes; `none` are scenes without a contact.", "",
             _line("engine", *words), _line(*["---"] * (len(words) + 1))]  # fmt: skip
    for engine in (*ENGINES, "auto"):
        mine = [one for one in attempts if (one.auto if engine == "auto" else one.engine == engine)]
        lines.append(_line(f"`{engine}`", *(_share([one for one in mine if one.treatment == w]) for w in words)))
    mine = [one for one in attempts if one.auto]
    good = sum(one.verdict == "ok" for one in mine)
    told = f"So leave `run.engine` at `auto`: {good} of its {len(mine)} rows are right. What the others show stands"
    lines += ["", told, "first in [What fails](#what-fails)."]
    return "\n".join([*lines, ""])


def _share(attempts: list[Attempt]) -> str:
    if not attempts:
        return "-"
    good = sum(one.verdict == "ok" for one in attempts)
    bad = ", ".join(f"{sum(o.verdict == word for o in attempts)} {word}" for word in MARKS
                    if word != "ok" and any(o.verdict == word for o in attempts))  # fmt: skip
    return f"{good} of {len(attempts)}" + (f" ({bad})" if bad else "")


def _failures(done: Done) -> str:
    bad = sorted((one for _, one in done if one.verdict != "ok"), key=lambda one: not one.auto)
    lines = ["## What fails", "", "The rows of the engine that `auto` picks come first.", ""]
    if not bad:
        return "\n".join([*lines, "Nothing.", ""])
    lines += [_line("case", "engine", "treatment", "auto", "verdict", "what came", "why"), _line(*["---"] * 7)]
    for one in bad:
        reason = one.reason if len(one.reason) <= LONGEST else one.reason[: LONGEST - 4] + " ..."
        told = reason.replace("|", "\\|").replace("<", "&lt;")
        why = known_failure(one.case, one.engine, one.treatment) or "**not known**"
        auto = "auto" if one.auto else ""
        lines.append(_line(one.case, one.engine, one.treatment, auto, MARKS[one.verdict], told, why))
    return "\n".join([*lines, ""])


def _cases(done: Done) -> str:
    told = (
        "Each cell has the verdict (*ok* on the engine of `auto`), total wall time, number of switches and worst "
        "energy closure."
    )
    lines = ["## The cases", "", told, ""]
    themes: dict[str, dict[str, list[tuple[Row, Attempt]]]] = {}
    for row, one in done:
        themes.setdefault(row.case.theme, {}).setdefault(row.case.title, []).append((row, one))
    for theme, titles in themes.items():
        lines += [f"### {theme.replace('_', ' ').capitalize()}", ""]
        for title, mine in titles.items():
            lines += _titled(title, mine)
    return "\n".join(lines)


def _titled(title: str, mine: Done) -> list[str]:
    """A case with all its variants: what it is, its oracle, and how each engine fared."""
    first = mine[0][0].case
    words = list(dict.fromkeys(row.treatment for row, _ in mine))
    lines = [f"**{title.capitalize()}.** {first.what}", f"*Oracle:* {first.oracle}", "",
             _line("variant", "engine", *words), _line(*["---"] * (len(words) + 2))]  # fmt: skip
    for name, engine in dict.fromkeys((row.case.name, row.engine) for row, _ in mine):
        cells = {one.treatment: _cell(one) for _, one in mine if (one.case, one.engine) == (name, engine)}
        variant = name.removeprefix(title).removeprefix(", ")
        lines.append(_line(variant, f"`{engine}`", *(cells.get(word, "-") for word in words)))
    return [*lines, ""]


def _cell(one: Attempt) -> str:
    verdict = MARKS[one.verdict] if not one.auto or one.verdict != "ok" else "*ok*"
    closure = "" if one.closure is None else f", {one.closure:.0e}"
    return f"{verdict}, {one.seconds:.2g} s, {one.switches}{closure}"


def _made(done: Done) -> str:
    packages = ", ".join(f"{name} {version(name)}" for name in ("fairlead", "numpy", "numba", "scikit-sundae"))
    total = sum(one.seconds for _, one in done)
    today = datetime.date.today().isoformat()
    played = f"{len(done)} rows, {total:.0f} s."
    machine = f"{platform.system()} {platform.machine()}, {os.cpu_count()} processors ({today})."
    return f"{played} Python {platform.python_version()}, {packages}, {machine}\n"


def _line(*cells: str) -> str:
    return "| " + " | ".join(cells) + " |"
