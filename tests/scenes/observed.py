"""What a run shows, as plain arrays: what every oracle is given, so that a test may falsify it."""

from __future__ import annotations

import re
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import fairlead
from tests.scenes.classes import Scene

NOMINAL = {"m": 1e-2, "m/s": 0.1, "rad": 1e-2, "rad/s": 1.0, "N": 10.0, "N*m": 10.0}
"""Sizes that an accuracy is relative to at least (docs/netlist.md, Small motions)."""
MOTIONS = ("m", "m/s", "rad", "rad/s")
WALL = 20.0
"""Time [s] that a run may take."""


@dataclass
class Observed:
    """A run: rows (k,), columns (k,) by name, units, how it ended, energy in J, times of zone changes."""

    t: np.ndarray
    side: np.ndarray
    columns: dict[str, np.ndarray]
    units: dict[str, str]
    status: str
    said: str
    energy: dict[str, Any]
    switches: np.ndarray
    accuracy: float

    def motions(self) -> list[str]:
        """Signals that are places, angles and speeds, but for the creep of what should not slip."""
        return [name for name, unit in self.units.items() if unit in MOTIONS and not name.endswith("creep_rate")]

    def at(self, name: str, grid: np.ndarray) -> np.ndarray:
        """A signal between rows by straight lines: rows are dense enough for that (docs/integrator.md)."""
        return np.interp(grid, self.t, self.columns[name])

    def size(self, name: str) -> float:
        """The largest value of a signal, or the size that counts as 1 where that is more."""
        return max(NOMINAL[self.units[name]], float(np.abs(self.columns[name]).max(initial=0.0)))


def loaded(scene: Scene, text: str = "", **settings: str) -> Any:
    """The model of a scene, or of another text of it, with every step recorded. Raises FairleadError."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.yaml"
        path.write_text(every_step(text or scene.text), encoding="utf-8")
        return fairlead.load(path, set=settings, libraries=scene.libraries)


def every_step(text: str) -> str:
    """A netlist that records every step instead of a grid."""
    return re.sub(r"record: \{every: [^,]*, ", "record: {", text)


def observed(model: Any, accuracy: float, engine: str = "rodas", **settings: Any) -> Observed:
    """Run a model. Raises FairleadError when it is refused."""
    settings = {"max_wall": WALL, **settings}
    result = model.run(out=None, engine=engine, accuracy=accuracy, check=False, **settings)
    names = [signal.name for signal in result.signals]
    values = result.columns()
    return Observed(
        result.t, result.side, dict(zip(names, values.T)), {name: result.unit(name) for name in names}, result.status,
        result.run.get("sentence", ""), dict(result.run["energy"]), np.unique([event.t for event in result.events]),
        accuracy,
    )  # fmt: skip
