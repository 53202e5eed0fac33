"""What each guess of slip_fronts.py saves: passes, solves and evaluations of J with it and without it.

    python benchmarks/slip_fronts.py [--scene row_1000]       minutes: the loop is compiled once without each

The guards judge what is guessed, so the steps are the same. Each variant is a copy of the project, changed in one line.
`row_1000` is the row of stiction_rows.py with equal levels and 1000 blocks, `falling_1000` that with stiction 1.3 times
sliding, `line_800` the first second of `single_bend` with 800 elements, whose normal force follows the tension.
"""

from __future__ import annotations

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import warnings
from typing import Any

from outcomes import watched

ROOT = pathlib.Path(__file__).resolve().parents[1]
FILE = pathlib.Path("src/fairlead/integrate/stepping/slip_fronts.py")
AS_IT_IS, NONE = "all", "none"
WITHOUT = {
    AS_IT_IS: (),
    "no prediction": (("HANDED_ON, RUNS_ON = 0.8, 0.7", "HANDED_ON, RUNS_ON = 0.8, 0.0"),),
    "no redistribution": (("HANDED_ON, RUNS_ON = 0.8, 0.7", "HANDED_ON, RUNS_ON = 0.0, 0.7"),),
    "no learning": (("    found = guards.n_guards\n", "    found = 0\n"),),
    NONE: (("HANDED_ON, RUNS_ON = 0.8, 0.7", "HANDED_ON, RUNS_ON = 0.0, 0.0"),
          ("    found = guards.n_guards\n", "    found = 0\n")),
}  # fmt: skip
SCENES = ("blocks_100", "blocks_1000", "row_1000", "falling_1000", "line_800")
COUNTS = ("steps", "settling_passes", "solves", "factorisations", "jacobians")


def play(scene: str) -> dict[str, Any]:
    """Counters of one scene by the fairlead that this process imports."""
    import stiction_rows

    import fairlead

    kind, size = scene.split("_")
    settings = {"run.engine": "stepping"}
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(), watched() as kept:
        warnings.simplefilter("ignore")
        if kind == "blocks":
            model, settings["blocks"] = "hundred_blocks", size
        elif kind == "line":
            model, settings["element"], settings["run.stop"] = "single_bend", f"{15 / int(size)} m", "1 s"
        else:
            path = pathlib.Path(folder) / "row.yaml"
            level = 1.3 if kind == "falling" else 1.0
            path.write_text(stiction_rows.netlist(int(size), level, 0.01, 3.0), encoding="utf-8")
            model, settings["run.accuracy"] = str(path), "1e-4"
        fairlead.load(model, set=settings).run(out=None, force=True)
    return {count: int(getattr(kept[-1].counters, count)) for count in COUNTS}


def by(variant: str, scenes: list[str], folder: pathlib.Path) -> dict[str, dict[str, Any]]:
    """Counters of scenes by a copy of the project without what `variant` names."""
    for part in ("src", "components", "models", "benchmarks"):
        shutil.copytree(ROOT / part, folder / part, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", folder)
    text = (folder / FILE).read_text(encoding="utf-8")
    for old, new in WITHOUT[variant]:
        if text.count(old) != 1:
            raise SystemExit(f"{FILE} has no single {old!r}.")
        text = text.replace(old, new)
    (folder / FILE).write_text(text, encoding="utf-8")
    words = [sys.executable, str(folder / "benchmarks" / "slip_fronts.py"), "--play", *scenes]
    environment = {**os.environ, "PYTHONPATH": str(folder / "src"), "OPENBLAS_NUM_THREADS": "1"}
    told = subprocess.run(words, check=True, stdout=subprocess.PIPE, env=environment, cwd=folder)
    return json.loads(told.stdout.splitlines()[-1])


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", action="append", choices=SCENES)
    parser.add_argument("--play", nargs="+", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.play:
        print(json.dumps({scene: play(scene) for scene in given.play}))
        return
    scenes = given.scene or list(SCENES)
    found = {}
    for variant in WITHOUT:
        with tempfile.TemporaryDirectory() as folder:
            found[variant] = by(variant, scenes, pathlib.Path(folder) / "copy")
    print(f"| scene | guesses | {' | '.join(COUNTS)} |\n|{(2 + len(COUNTS)) * ' --- |'}")
    for scene in scenes:
        for variant, counted in found.items():
            print(f"| {scene} | {variant} | {' | '.join(str(counted[scene][count]) for count in COUNTS)} |")


if __name__ == "__main__":
    main()
