"""`python -m tests.invariance`: play scenes under every change that must not matter, and tell what differed.

Without arguments the bundled models and a hundred random scenes with fixed seeds are played, as `make invariance` does.

    --fresh N        N random scenes of each kind with new seeds, which are printed
    --seed S         the first of these seeds, to play them again
    --only WORD ...  changes whose name contains one of the words, such as BLAS
    --scene NAME     scenes whose name contains it
    --python PATH    the interpreter of another checkout, to see how that one does

    --nudge SHARE    one change instead: the start moved by this share of each unknown, to see how sensitive a scene is

    --first-difference SCENE   tell the first trial step at which a scene and its twins in another order differ by more
                               than rounding, and the values that may have decided there (lockstep.py)
"""

from __future__ import annotations

import argparse
import concurrent.futures
import math
import os
import pathlib
import random
import sys
import tempfile
from collections.abc import Sequence

from tests.invariance.known import KNOWN
from tests.invariance.lockstep import CHANGES, first_difference, tries, twins
from tests.invariance.outcome import Outcome
from tests.invariance.plays import Play, bundled, crowd, hundred, random_plays
from tests.invariance.ties import TIES
from tests.invariance.trials import (
    PLAIN,
    ROUNDING,
    Trial,
    differences,
    differences_until,
    horizons,
    play,
    trials,
)

CROWDS = range(6)


def main() -> int:
    """Play, and return 1 if something differed that is no tie."""
    parser = argparse.ArgumentParser(prog="python -m tests.invariance", formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--fresh", type=int)
    parser.add_argument("--seed", type=int)
    parser.add_argument("--only", nargs="+", default=[""])
    parser.add_argument("--scene", default="")
    parser.add_argument("--python", default=sys.executable)
    parser.add_argument("--nudge", type=float)
    parser.add_argument("--first-difference", metavar="SCENE")
    asked = parser.parse_args()
    if asked.first_difference:
        return _first_difference(next(one for one in _plays(None, None) if one.name == asked.first_difference))
    chosen = [one for one in _plays(asked.fresh, asked.seed) if asked.scene in one.name]
    changes = [trial for trial in trials() if any(word in trial.name for word in asked.only)]
    if asked.nudge:
        changes = [Trial(f"start moved by {asked.nudge:g}", equal=False, job={"nudge": asked.nudge})]
    for trial in (trial for trial in changes if trial.lacking):
        print(f"{trial.name}: {trial.lacking}")
    wrong = 0
    with (
        tempfile.TemporaryDirectory() as folder,
        concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool,
    ):
        place = pathlib.Path(folder)
        here = [PLAIN, *(trial for trial in changes if not trial.lacking)]
        runs = [pool.submit(play, trial, chosen, place / str(k), asked.python) for k, trial in enumerate(here)]
        plain, in_force = runs[0].result()
        print(f"{len(chosen)} scenes\n  {PLAIN.name}: {in_force}", flush=True)
        for trial, run in zip(here[1:], runs[1:]):
            other, in_force = run.result()
            found = differences(trial, chosen, plain, other)
            apart = [one for one in chosen if one.name in found and not trial.equal and not asked.nudge]
            wrong += _told(trial, found, in_force, *_sensitive(apart, plain, other, place, asked.python))
    return 1 if wrong else 0


def _first_difference(one: Play) -> int:
    apart = 0
    for change in CHANGES:
        with tempfile.TemporaryDirectory() as folder:
            here, other = twins(one, change, pathlib.Path(folder))
            found = first_difference(tries(here), tries(other))
        print(f"{one.name}, {change} in another order:\n{found or 'every step is the same'}")
        apart += bool(found)
    return 1 if apart else 0


def _plays(fresh: int | None, seed: int | None):
    if fresh is None:
        return [*bundled(), *hundred(), *map(crowd, CROWDS)]
    begin = random.randrange(10**6) if seed is None else seed
    print(f"random scenes with seeds {begin} to {begin + fresh - 1}; again: --fresh {fresh} --seed {begin}")
    return random_plays(range(begin, begin + fresh), range(begin, begin + fresh))


def _sensitive(apart: Sequence[Play], plain: dict[str, Outcome], other: dict[str, Outcome], place: pathlib.Path,
               python: str) -> tuple[dict[str, float], dict[str, list[str]]]:  # fmt: skip
    """Of scenes that differ: until when they can be foretold, and what differs before that."""
    if not apart:
        return {}, {}
    until = {name: t for name, t in horizons(apart, plain, place / "moved", python).items() if t < math.inf}
    return until, differences_until([one for one in apart if one.name in until], until, plain, other)


def _told(trial: Trial, found: dict[str, list[str]], in_force: str, until: dict[str, float],
          before: dict[str, list[str]]) -> int:  # fmt: skip
    """Print what came of a change; how many scenes differ that are neither ties nor known to.

    A scene that parts from itself when its start is moved by no more than rounding is held to the time before that.
    """
    known = TIES | KNOWN.get(trial.name, {})
    held = {name for name in until if name not in before}
    wrong = sum(name not in known and name not in held for name in found)
    bound = "equal bit by bit" if trial.equal else "within the bounds"
    print(f"  {trial.name}: {in_force}\n    " + (f"{wrong} scenes differ" if wrong else bound))
    for name, said in found.items():
        if name in held:
            print(f"    {name}: the same for {until[name]:.3g} s; then it parts from itself too, moved by {ROUNDING:g}")
        else:
            print(f"    {name}{' (known)' if name in known else ''}: {'; '.join(said)}", flush=True)
    return wrong


if __name__ == "__main__":
    raise SystemExit(main())
