"""The page docs/stability.md: what holds where, failures first, then every case with its oracle."""

from __future__ import annotations

import datetime
import os
import platform
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

from tests.hard.attempt import Attempt
from tests.hard.registry import ENGINES, TREATMENTS, Case, Row

Done = Sequence[tuple[Row, Attempt]]
MARKS = {"ok": "ok", "stopped": "**stopped**", "wrong": "**wrong**", "stuck": "**stuck**", "crashed": "**crashed**"}
LONGEST = 220  # characters of a reason

HEAD = """\
# Hard cases: what stays stable

Scenes chosen to break an engine, each with an oracle from physics: a closed form, a balance of energy or momentum,
monotonicity, symmetry. Each is played on every engine (`rodas`, with its second method as `rodas3p`; `stepping`; `ida`)
and with exact hold, robust binding (creep 1e-5 m/s unless the case says otherwise) and LuGre, where they apply.

```sh
make hard                                                # all rows; goes on where an interrupted round stopped
.venv/bin/python -m tests.hard --only tether --table     # rows with a word in their name
.venv/bin/python -m tests.hard --budget 300              # start nothing new after 300 s
```

This page is written by `make hard`; the cases are in `tests/hard/cases`, scenes without a generator in `models/hard`.

| verdict | means |
|---|---|
| ok | finished; the oracle is satisfied, energy adds up to ten accuracies, what holds does not slip |
| stopped | ended before its stop, with a message that says where and why; nothing wrong was told |
| wrong | it finished, and something told is not so |
| stuck | its budget of time ran out, or no answer came |
| crashed | an exception, or the process ended |
"""


def write(path: Path, done: Done, left: int) -> None:
    """Write the page; `left` rows are not played yet."""
    parts = [HEAD, _summary(done), _failures(done), _cases(done), _made(done, left)]
    path.write_text("\n".join(parts), encoding="utf-8")


def _summary(done: Done) -> str:
    attempts = [attempt for _, attempt in done]
    words = [word for word in (*TREATMENTS, "none") if any(one.treatment == word for one in attempts)]
    lines = ["## Summary", "", "Rows that came through, of those played. `auto` counts rows on the engine that",
             "`run.engine: auto` picks for their scenes; `none` are scenes without a contact.", "",
             _line("engine", *words), _line(*["---"] * (len(words) + 1))]  # fmt: skip
    for engine in (*ENGINES, "auto"):
        mine = [one for one in attempts if (one.auto if engine == "auto" else one.engine == engine)]
        lines.append(_line(f"`{engine}`", *(_share([one for one in mine if one.treatment == w]) for w in words)))
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
    lines = ["## What fails", "", "Rows on the engine that `auto` picks first.", ""]
    if not bad:
        return "\n".join([*lines, "Nothing.", ""])
    lines += [_line("case", "engine", "treatment", "auto", "verdict", "reason"), _line(*["---"] * 6)]
    for one in bad:
        reason = one.reason if len(one.reason) <= LONGEST else one.reason[: LONGEST - 4] + " ..."
        told = reason.replace("|", "\\|").replace("<", "&lt;")
        lines.append(_line(one.case, one.engine, one.treatment, "auto" if one.auto else "", MARKS[one.verdict], told))
    return "\n".join([*lines, ""])


def _cases(done: Done) -> str:
    lines = [
        "## The cases",
        "",
        "Times are wall times of a row, set-up and oracle included; closure is the worst of its runs.",
        "",
    ]
    theme = ""
    for case in dict.fromkeys(row.case.name for row, _ in done):
        mine = [(row, one) for row, one in done if row.case.name == case]
        first = mine[0][0].case
        if first.theme != theme:
            theme = first.theme
            lines += [f"### {theme.replace('_', ' ').capitalize()}", ""]
        lines += _case(first, [one for _, one in mine])
    return "\n".join(lines)


def _case(case: Case, attempts: list[Attempt]) -> list[str]:
    words = list(dict.fromkeys(one.treatment for one in attempts))
    lines = [f"**{case.name}.** {case.what}", f"*Oracle:* {case.oracle}", "",
             _line("engine", *words), _line(*["---"] * (len(words) + 1))]  # fmt: skip
    for engine in dict.fromkeys(one.engine for one in attempts):
        cells = {one.treatment: _cell(one) for one in attempts if one.engine == engine}
        lines.append(_line(f"`{engine}`", *(cells.get(word, "-") for word in words)))
    return [*lines, ""]


def _cell(one: Attempt) -> str:
    closure = "" if one.closure is None else f", closure {one.closure:.0e}"
    auto = " (auto)" if one.auto else ""
    return f"{MARKS[one.verdict]}{auto}, {one.seconds:.2g} s, {one.switches} switches{closure}"


def _made(done: Done, left: int) -> str:
    packages = ", ".join(f"{name} {version(name)}" for name in ("fairlead", "numpy", "numba", "scikit-sundae"))
    total = sum(one.seconds for _, one in done)
    today = datetime.date.today().isoformat()
    played = f"{len(done)} rows, {total:.0f} s; {left} not played yet."
    machine = f"{platform.system()} {platform.machine()}, {os.cpu_count()} processors ({today})."
    return f"{played} Python {platform.python_version()}, {packages}, {machine}\n"


def _line(*cells: str) -> str:
    return "| " + " | ".join(cells) + " |"
