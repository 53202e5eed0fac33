"""Random scenes by hand: `python -m tests.scenes --seed 7 --count 20` makes, checks and runs them.

    --kind networks|blows|routes   one kind only   --seed N --count N   which ones (a random seed when not given)
    --write FOLDER                 write them      --check              do not run them
"""

from __future__ import annotations

import argparse
import pathlib
import random
import tempfile
import time

import fairlead
from fairlead.errors import FairleadError
from tests.scenes.blows import blow
from tests.scenes.networks import network
from tests.scenes.routes import route

MAKERS = {"networks": network, "blows": lambda seed: blow(seed).text, "routes": route}


def main() -> int:
    """Make the scenes that are asked for; 1 if one of them is refused or does not end."""
    parser = argparse.ArgumentParser(prog="python -m tests.scenes", description=__doc__.split("\n")[0])
    parser.add_argument("--kind", choices=sorted(MAKERS))
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--write", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    asked = parser.parse_args()
    wrong = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = asked.write or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for kind in [asked.kind] if asked.kind else MAKERS:
            for seed in range(asked.seed, asked.seed + asked.count):
                path = folder / f"{kind}_{seed}.yaml"
                path.write_text(MAKERS[kind](seed), encoding="utf-8")
                wrong += not told(path, pathlib.Path(scratch) / path.stem, run=not asked.check)
    return 1 if wrong else 0


def told(path: pathlib.Path, out: pathlib.Path, *, run: bool) -> bool:
    """Check a scene and run it, print a line about it, and return whether all went well."""
    begun = time.process_time()
    try:
        model = fairlead.load(path)
        said = [str(remark) for remark in model.check()]
        made = time.process_time() - begun
        line = f"{path.stem:18}{model.system.n:5} unknowns, {len(model.system.zones):4} contacts,{made:6.2f} s to make"
        if run:
            begun = time.process_time()
            result = model.run(out=out, check=False)
            counters, took = result.run["counters"], time.process_time() - begun
            line += f",{counters['steps']:6} steps,{counters['switches']:5} switches,{took:6.2f} s"
            line += f": {result.run['engine']}"
            said += [] if result.status == "finished" else [result.run["sentence"]]
        print("\n    ".join([line, *said]), flush=True)
        return not run or result.status == "finished"
    except FairleadError as error:
        print(f"{path.stem}: {error}")
        return False


if __name__ == "__main__":
    raise SystemExit(main())
