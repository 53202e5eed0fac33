"""Whether `fairlead effects` keeps its budget on lines, and how many switches it judges in it.

    python benchmarks/effects_kept.py [--budget 60]        eight minutes

Each scene is studied twice by the command with nothing kept: the first time compiles the laws of all switches, which is
outside the budget; the second, with caches warm, is told.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

from machine import machine

SCENES = ("single_bend", "guidance_route", "long_route", "hundred_blocks")


def studied(name: str, budget: float) -> str:
    """A row: wall time of the whole command over its budget, switches judged, without effect, and left out."""
    with tempfile.TemporaryDirectory() as folder:
        words = [sys.executable, "-m", "fairlead", "effects", name, "--fresh", "--out", folder, "-q"]
        for _ in range(2):
            begun = time.perf_counter()
            subprocess.run([*words, "--budget", f"{budget:g} s"], check=True)
            took = time.perf_counter() - begun
        found = json.loads((pathlib.Path(folder) / "effects.json").read_text(encoding="utf-8"))
    counts = [len(found[key]) for key in ("rows", "untouched", "left_out")]
    return f"| `{name}` | {took:.1f} s | {100 * (took / budget - 1):+.0f} % | {' | '.join(map(str, counts))} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", default=SCENES, help="bundled models")
    parser.add_argument("--budget", type=float, default=60.0, help="seconds for each scene")
    options = parser.parse_args()
    print(machine())
    print(f"| scene | took | over {options.budget:g} s | judged | without effect | left out |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name in options.scenes:
        print(studied(name, options.budget), flush=True)


if __name__ == "__main__":
    main()
