"""What is changed of a scene that must not matter, and how much may come of it."""

from __future__ import annotations

import json
import math
import os
import pathlib
import subprocess
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from tests.invariance import outcome
from tests.invariance.outcome import Outcome
from tests.invariance.plays import Play
from tests.invariance.renaming import SCHEMES, renamed
from tests.invariance.reordering import shuffled
from tests.invariance.settings import lacking, settings

ROOT = pathlib.Path(__file__).parents[2]

ROUNDING, MOVES = 1e-14, range(1, 13)
"""What rounding comes to in sums of some ten terms, as a share of an unknown; seeds of the ways to move a start. Of a
route that is chaotic from 0.48 s on, none of the first four may show it."""


@dataclass(frozen=True)
class Trial:
    """A change: environment of the process, changed netlist with the way back to its names, what the worker does.

    `equal` says that not a bit may differ. Without it the order of sums may show, within the bounds of `outcome.apart`.
    """

    name: str
    equal: bool = True
    environment: dict[str, str] = field(default_factory=dict)
    change: Callable[[str], tuple[str, Callable[[str], str]]] | None = None
    job: dict[str, Any] = field(default_factory=dict)
    backwards: bool = False

    @property
    def lacking(self) -> str:
        """Why it cannot be had on this machine; empty if it can."""
        return lacking(self.environment)


PLAIN = Trial("plain")


def trials() -> list[Trial]:
    """Every change, the cheapest to explain first."""
    seeds = {name: {"PYTHONHASHSEED": str(k)} for k, name in enumerate(SCHEMES)}
    return [
        Trial("run twice, after other runs", job={"times": 2}, backwards=True),
        Trial("seven steps a slice", job={"attempts": 7}),
        *(Trial(name, environment=seeds[name], change=_renaming(scheme)) for name, scheme in SCHEMES.items()),
        *(Trial(name, environment=values) for name, values in settings().items() if values),
        Trial("instances and unknowns in another order", equal=False, job={"order": 1}),
        Trial("netlist in another order", equal=False, change=_shuffling),
    ]


def _renaming(scheme: Callable[[int], str]) -> Callable[[str], tuple[str, Callable[[str], str]]]:
    return lambda text: renamed(text, scheme)


def _shuffling(text: str) -> tuple[str, Callable[[str], str]]:
    return shuffled(text, 1), str


def play(trial: Trial, plays: Sequence[Play], folder: pathlib.Path, python: str = sys.executable
         ) -> tuple[dict[str, Outcome], str]:  # fmt: skip
    """Play scenes in a process of their own: what came out of each, and what was in force. Raises RuntimeError."""
    folder.mkdir(parents=True, exist_ok=True)
    jobs, back = [], {}
    for k, one in enumerate(reversed(plays) if trial.backwards else plays):
        text, back[one.name] = trial.change(one.text) if trial.change else (one.text, str)
        scene = folder / f"scene{k}.yaml"
        scene.write_text(text, encoding="utf-8")
        jobs.append({"scene": str(scene), "out": str(folder / f"{one.name}.kept"), **trial.job})
    (folder / "jobs.json").write_text(json.dumps(jobs))
    command = [python, "-m", "tests.invariance.worker", str(folder / "jobs.json")]
    done = subprocess.run(command, cwd=ROOT, env=os.environ | trial.environment, text=True, capture_output=True)
    if done.returncode:
        raise RuntimeError(f"{trial.name}:\n{done.stderr[-3000:]}")
    found = {one.name: outcome.read(folder / f"{one.name}.kept").renamed(back[one.name]) for one in plays}
    return found, done.stdout.splitlines()[0]


def differences(trial: Trial, plays: Iterable[Play], plain: dict[str, Outcome], other: dict[str, Outcome]
                ) -> dict[str, list[str]]:  # fmt: skip
    """What a change has made of each scene that it should have left alone."""
    found = {}
    for one in plays:
        a, b = plain[one.name], other[one.name]
        said = outcome.unlike(a, b) if trial.equal else outcome.apart(a, b, one.accuracy)
        if said:
            found[one.name] = said
    return found


def horizons(plays: Sequence[Play], plain: dict[str, Outcome], folder: pathlib.Path, python: str = sys.executable
             ) -> dict[str, float]:  # fmt: skip
    """When each scene parts from itself, moved at the start by ROUNDING of each unknown; inf if it does not."""
    found = dict.fromkeys((one.name for one in plays), math.inf)
    for seed in MOVES:
        moved, _ = play(Trial("moved", job={"nudge": ROUNDING, "seed": seed}), plays, folder / str(seed), python)
        for one in plays:
            found[one.name] = min(found[one.name], outcome.parted(plain[one.name], moved[one.name], one.accuracy))
    return found


def differences_until(plays: Iterable[Play], until: dict[str, float], plain: dict[str, Outcome],
                      other: dict[str, Outcome]) -> dict[str, list[str]]:  # fmt: skip
    """What the order of sums has made of each scene before these times that rounding does not explain."""
    found = {}
    for one in plays:
        a, b = (outcome.until(which[one.name], until[one.name]) for which in (plain, other))
        said = outcome.apart(a, b, one.accuracy)
        if said:
            found[one.name] = said
    return found
