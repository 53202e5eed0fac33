"""Plays scenes in a process of its own: `python -m tests.invariance.worker JOBS.json`.

JOBS is a list of {scene, out, times, order}: a netlist, the file for what comes out of it, how many times the model is
run (the last run counts), and a seed for another order of the flat model. The first line printed says what is in force.
"""

from __future__ import annotations

import json
import pathlib
import sys
import tempfile

import fairlead
from tests.invariance.outcome import of_result, write
from tests.invariance.reordering import permuted
from tests.invariance.settings import in_force


def play(scene: str, out: str, times: int = 1, order: int | None = None) -> None:
    """Run a scene and keep what comes out."""
    model = fairlead.load(scene)
    if order is not None:
        model.flat = permuted(model.flat, order)
    with tempfile.TemporaryDirectory() as folder:
        for k in range(times):
            result = model.run(out=pathlib.Path(folder) / str(k))
        write(pathlib.Path(out), of_result(result))


if __name__ == "__main__":
    print(in_force(), flush=True)
    for job in json.loads(pathlib.Path(sys.argv[1]).read_text()):
        play(**job)
