"""Plays the peers, and writes their part of docs/stability.md, with a commit line of its own."""

from __future__ import annotations

import datetime
from importlib.metadata import version
from pathlib import Path

from tests.hard.kept import commit
from tests.hard.peers.cases import PeerCase, cases
from tests.hard.peers.played import CPU, TOOLS, Unable

TITLE = "## Other tools beside fairlead"
END = "<!-- end of other tools -->"
HEAD = f"""\
{TITLE}

The table has the hard cases that other tools can state, with the same closed forms. Each cell is the largest difference
from the right result; `ok` is within the bound of the hard case. Each tool has its best form
(`tests/hard/peers/played.py`):

- **scipy**: `solve_ivp`, a terminal event for each contact, a new start at each event and each jump; rtol 1e-10. Zones,
  forces of held contacts and the order of release are written by hand
  (`tests/hard/peers/dry.py`, which PathSim uses too).
- **PathSim**: one ODE block, the largest guard as an event; RKDP87, tolerance 1e-10.
- **MuJoCo**: `frictionloss` of joints and tendons, as hard as its step of 0.1 ms allows; the
  better of `implicitfast` and `RK4`.
- **fairlead**: the netlist as it stands, `rodas`, exact hold, accuracy as in the hard case (1e-6; the shafts 1e-5).

```sh
.venv/bin/pip install -e .[bench]
.venv/bin/python -m tests.hard --peers
```
"""


def play(page: Path) -> int:
    """Play all, write the page; 1 if fairlead misses a bound."""
    lines = [_line("case", "bound", *TOOLS), _line(*["---"] * (len(TOOLS) + 2))]
    notes, missed = [], 0
    for case in cases():
        cells = []
        for tool in TOOLS:
            cell, note = judged(case, tool)
            cells.append(cell)
            notes += [note] if note else []
            missed += tool == "fairlead" and not cell.startswith("ok")
        lines.append(_line(case.name, f"{case.within:g} {case.unit}", *cells))
        print(lines[-1], flush=True)
    told = [f"- {note}" for note in dict.fromkeys(notes)]
    text = "\n".join([HEAD, *lines, "", *told, "", _made(), END])
    page.write_text(with_peers(page.read_text(encoding="utf-8"), text), encoding="utf-8")
    return 1 if missed else 0


def judged(case: PeerCase, tool: str) -> tuple[str, str]:
    """The cell, and a note where it has no number."""
    try:
        error = case.error(TOOLS[tool](case))
    except Unable as why:
        return "cannot", f"{tool} cannot state it: {why}."
    except TimeoutError as why:
        return "**stuck**", f"{tool}, {case.name}: {why} (allowed {CPU:g} s)."
    except Exception as why:  # noqa: BLE001  a tool that throws has failed, and is shown as such
        return "**ended**", f"{tool}, {case.name}: {type(why).__name__}, {' '.join(str(why).split())[:160]}"
    size = f"{error:.1e} {case.unit}"
    return (f"ok, {size}" if error <= case.within else f"**off by {size}**"), ""


def with_peers(page: str, part: str) -> str:
    """The page with this part, in place of the one it had."""
    old = peers_of(page)
    return page.replace(old, part) if old else page.replace("## What fails", f"{part}\n\n## What fails", 1)


def peers_of(page: str) -> str:
    """The part that a page has; nothing if it has none."""
    begin, end = page.find(TITLE), page.find(END)
    return page[begin : end + len(END)] if 0 <= begin < end else ""


def _made() -> str:
    packages = ", ".join(f"{name} {version(name)}" for name in ("fairlead", "scipy", "pathsim", "mujoco"))
    return f"Other tools played at commit {commit()}, {datetime.date.today().isoformat()}: {packages}.\n"


def _line(*cells: str) -> str:
    return "| " + " | ".join(cells) + " |"
