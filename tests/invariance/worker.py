"""Plays scenes in a process of its own: `python -m tests.invariance.worker JOBS.json`.

JOBS is a list of {scene, out, times, order, nudge, seed, attempts}: a netlist, the file for what comes out of it, how
many times the model is run (the last run counts), a seed for another order of the flat model, by how much the start
is moved and with which seed (see `moved`), and how many steps the loop is asked for at a time. The first line printed
says what is in force.
"""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import json
import pathlib
import sys
import tempfile
from collections.abc import Iterator
from typing import Any
from unittest import mock

import numpy as np

import fairlead
from fairlead.integrate.parts import ActiveSubsystem
from tests.invariance.outcome import of_result, write
from tests.invariance.reordering import permuted
from tests.invariance.settings import in_force


def play(scene: str, out: str, times: int = 1, order: int | None = None, nudge: float = 0.0, seed: int = 1,
         attempts: int = 0) -> None:  # fmt: skip
    """Run a scene and keep what comes out."""
    model = fairlead.load(scene)
    if order is not None:
        model.flat = permuted(model.flat, order)
    with tempfile.TemporaryDirectory() as folder, moved(nudge, seed), in_slices(attempts):
        for k in range(times):
            result = model.run(out=pathlib.Path(folder) / str(k), check=False)
        write(pathlib.Path(out), of_result(result))


@contextlib.contextmanager
def moved(nudge: float, seed: int) -> Iterator[None]:
    """Runs begin with each unknown moved this way or that by `nudge` of itself and of the size that counts as 1."""
    begin = ActiveSubsystem.__init__

    def begin_moved(self: ActiveSubsystem, *given: Any) -> None:
        begin(self, *given)
        accuracy = given[1].accuracy or 1.0
        y, nominal = self.whole.array["y"], self.whole.array["absolute"] / accuracy
        y += nudge * np.random.default_rng(seed).choice((-1.0, 1.0), len(y)) * (np.abs(y) + nominal)

    with mock.patch.object(ActiveSubsystem, "__init__", begin_moved) if nudge else contextlib.nullcontext():
        yield


@contextlib.contextmanager
def in_slices(attempts: int) -> Iterator[None]:
    """Runs leave the loop after so many trial steps, not as often as the clock says; 0 leaves that as it is."""
    with contextlib.ExitStack() as stack:
        if attempts:
            loop = importlib.import_module(f"fairlead.integrate.{next(filter(_is_there, LOOPS))}")
            stack.enter_context(mock.patch.object(loop, "FIRST_ATTEMPTS", attempts))
            stack.enter_context(mock.patch.object(loop, "next_attempts", return_value=attempts))
        yield


LOOPS = ("underway", "driver")
"""Modules that enter the loop; the second one in older checkouts, of which `--python` plays scenes too."""


def _is_there(name: str) -> bool:
    return importlib.util.find_spec(f"fairlead.integrate.{name}") is not None


if __name__ == "__main__":
    print(in_force(), flush=True)
    for job in json.loads(pathlib.Path(sys.argv[1]).read_text()):
        play(**job)
