"""Play any number of damaged inputs by hand, and leave those that were answered badly in a folder.

    python -m tests.fuzz netlists --count 5000 --seed 7 --only belt --keep /tmp/found
    python -m tests.fuzz results --count 500 --seed 7        folders of results
    python -m tests.fuzz cache --count 500                   entries of the cache of compiled code

Without a seed a fresh one is taken and printed, so that what was found can be had again.
"""

from __future__ import annotations

import argparse
import os
import pathlib
import random
import resource
import sys
import tempfile
from collections import Counter

from tests.fuzz import cache, netlists, results
from tests.fuzz.verdict import judge

MOST_MEMORY = 4 << 30  # bytes of address space: what wants more is told as a MemoryError
PLAYED = {"cache": cache.play, "results": results.play}


def main() -> int:
    """Play, print each class of bad answers once with the mutant that showed it; 1 if there are any."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["netlists", *PLAYED])
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--only", default="", help="names of the netlists to damage, separated by commas")
    parser.add_argument("--verb", default="check", help="another verb that runs nothing: statics, graph, describe")
    parser.add_argument("--keep", type=pathlib.Path, default=None, help="folder for what was answered badly")
    asked = parser.parse_args()
    seed = random.SystemRandom().randrange(10**6) if asked.seed is None else asked.seed
    print(f"seed {seed}")
    if asked.what in PLAYED:
        return play(asked.what, seed, asked.count)
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, resource.RLIM_INFINITY))
    told: Counter[str] = Counter()
    codes: Counter[object] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for mutant in netlists.mutants(pathlib.Path(folder), seed, asked.count, asked.only.split(",")):
            verdict = judge(mutant.file, verb=asked.verb)
            codes[verdict.code] += 1
            for complaint in verdict.complaints:
                told[complaint] += 1
                if told[complaint] == 1:
                    print(f"--- {mutant}: {complaint}", flush=True)
                    if asked.keep:
                        asked.keep.mkdir(parents=True, exist_ok=True)
                        (asked.keep / f"{mutant}.yaml").write_bytes(mutant.file.read_bytes())
    print("exit codes:", ", ".join(f"{code}: {count}" for code, count in sorted(codes.items(), key=str)))
    for complaint, count in told.most_common():
        print(f"{count:6} {complaint}")
    return 1 if told else 0


def play(what: str, seed: int, count: int) -> int:
    """Play what keeps its own verdicts, and print each bad answer; 1 if there are any."""
    told = 0
    with tempfile.TemporaryDirectory() as folder:
        if what == "cache":
            os.environ["FAIRLEAD_CACHE"] = folder
        for complaint in PLAYED[what](pathlib.Path(folder), seed, count):
            told += 1
            print(complaint, flush=True)
    print(f"{told} of {count} were answered badly")
    return 1 if told else 0


if __name__ == "__main__":
    sys.exit(main())
