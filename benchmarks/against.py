"""What a run costs beside another checkout of the project: counters, CPU time of the loop and of a call, in pairs.

    git worktree add ../old ac213c8 && make -C ../old .venv/test.done
    python benchmarks/against.py ../old                      all scenes, nine interleaved pairs, an hour
    python benchmarks/against.py ../old --scene belt --pairs 3
    python benchmarks/against.py ../old --commands           belt and single_bend from the shell, without figures

Each run has a process of its own, with the Python and the bundled models of its checkout; the two take turns. A scene
is run once to fill the caches, and then timed. `aside` is what a call of `Model.run(out=None)` takes beside the loop.
Ratios are this checkout over the other, the median of the pairs. A scene that the other does not bundle is left out.
A command is `fairlead run` of the netlist here without its `plots`, from its start to its end, caches warm.
"""

from __future__ import annotations

import argparse
import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time
import warnings
from typing import Any

from outcomes import watched

HERE = pathlib.Path(__file__).resolve()
SCENES: dict[str, tuple[str, dict[str, str]]] = {
    "belt": ("belt", {}),
    "hundred_blocks": ("hundred_blocks", {}),
    "thousand_blocks": ("hundred_blocks", {"blocks": "1000"}),
    "single_bend_50": ("single_bend", {"element": "0.3 m"}),
    "single_bend_800": ("single_bend", {"element": "0.01875 m", "run.stop": "4 s"}),
    "guidance_route": ("guidance_route", {}),
    "long_deployment": ("long_deployment", {"run.stop": "60 s"}),
    "long_route": ("long_route", {}),
}
COUNTS = ("steps", "rejected", "rhs", "jacobians", "factorisations", "solves", "guards", "switches", "located")
SHORT = 0.5  # s of CPU: a run that takes less is repeated
REPEATS = 15
COMMANDS = ("belt", "single_bend")
WRITTEN = {"PYTHONDONTWRITEBYTECODE": ""}
"""A command that may not keep what Python makes of its modules would make it each time."""


def run(scene: str) -> dict[str, Any]:
    """One scene by the Python that runs this: counters, CPU of the loop and of the whole call, peak memory."""
    import fairlead

    name, settings = SCENES[scene]
    model = fairlead.load(name, set=settings)
    calls: list[float] = []
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(), watched() as kept:
        warnings.simplefilter("ignore")
        os.chdir(folder)  # a checkout that cannot keep a run in memory writes it there
        while len(calls) < (REPEATS if not calls or calls[-1] < SHORT else 2):
            begun = time.process_time()
            model.run(out=None, force=True)
            calls.append(time.process_time() - begun)
    counters = kept[-1].counters
    return {
        **{count: int(getattr(counters, count)) for count in COUNTS},
        "loop": min(one.loop_cpu for one in kept[1:]),
        "aside": min(call - one.loop_cpu for call, one in zip(calls[1:], kept[1:], strict=True)),
        "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "end": float(kept[-1].t),
    }


def bundled(checkout: pathlib.Path, scene: str) -> bool:
    """Whether a checkout has the model of a scene."""
    return (checkout / "models" / f"{SCENES[scene][0]}.yaml").exists()


def by(checkout: pathlib.Path, scene: str) -> dict[str, Any]:
    """The same by the Python of a checkout."""
    words = [str(checkout / ".venv" / "bin" / "python"), str(HERE), "--run", scene]
    told = subprocess.run(words, check=True, stdout=subprocess.PIPE, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    return json.loads(told.stdout.splitlines()[-1])


def compare(other: pathlib.Path, scene: str, pairs: int) -> None:
    """Print the table of one scene."""
    found = [(by(HERE.parent.parent, scene), by(other, scene)) for _ in range(pairs)]
    print(f"\n{scene}, {pairs} pairs, to t = {found[0][0]['end']:g} and {found[0][1]['end']:g} s\n")
    print("| figure | here | there | ratio | least to largest |\n|" + 5 * " --- |")
    for figure in (*COUNTS, "loop", "aside", "memory"):
        here, there = (statistics.median(pair[k][figure] for pair in found) for k in (0, 1))
        ratios = sorted(a[figure] / b[figure] for a, b in found if b[figure])
        middle = f"{statistics.median(ratios):.2f} | {ratios[0]:.2f} to {ratios[-1]:.2f}" if ratios else " | "
        print(f"| {figure} | {here:.6g} | {there:.6g} | {middle} |")
    sys.stdout.flush()


def shell(checkout: pathlib.Path, netlist: pathlib.Path) -> float:
    """Seconds of CPU of one command, with all it starts."""
    words = [str(checkout / ".venv" / "bin" / "fairlead"), "run", str(netlist), "--force", "--quiet"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    out = netlist.parent / f"{checkout.name}-results"
    subprocess.run([*words, "--out", str(out)], check=True, stderr=subprocess.DEVNULL, env={**os.environ, **WRITTEN})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def compare_commands(other: pathlib.Path, pairs: int) -> None:
    """Print a table of whole commands."""
    import yaml

    print(f"\n`fairlead run` without figures, {pairs} pairs, s of CPU\n")
    print("| scene | here | there | ratio | least to largest |\n|" + 5 * " --- |")
    here = HERE.parent.parent
    for scene in COMMANDS:
        with tempfile.TemporaryDirectory() as folder:
            netlist = pathlib.Path(folder, f"{scene}.yaml")
            written = yaml.safe_load((here / "models" / netlist.name).read_text(encoding="utf-8"))
            written["record"].pop("plots")
            netlist.write_text(yaml.safe_dump(written, sort_keys=False), encoding="utf-8")
            found = [(shell(here, netlist), shell(other, netlist)) for _ in range(pairs + 1)][1:]
        ratios = sorted(a / b for a, b in found)
        least = (min(pair[k] for pair in found) for k in (0, 1))
        middle = f"{statistics.median(ratios):.2f} | {ratios[0]:.2f} to {ratios[-1]:.2f}"
        print(f"| {scene} | " + " | ".join(f"{one:.3g}" for one in least) + f" | {middle} |")


def main() -> None:
    """Compare, or run one scene for the process that compares."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("other", nargs="?", type=pathlib.Path, help="the other checkout, with a .venv of its own")
    parser.add_argument("--scene", action="append", choices=SCENES, help="one scene; may be given several times")
    parser.add_argument("--commands", action="store_true", help="whole commands instead")
    parser.add_argument("--pairs", type=int, default=9)
    parser.add_argument("--run", choices=SCENES, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.run:
        print(json.dumps(run(given.run)))
        return
    if given.other is None:
        parser.error("name the other checkout")
    other = given.other.resolve()
    if given.commands:
        compare_commands(other, given.pairs)
        return
    for scene in given.scene or SCENES:
        if bundled(other, scene):
            compare(other, scene, given.pairs)
        else:
            print(f"\n{scene}: {other} has no such model")


if __name__ == "__main__":
    main()
