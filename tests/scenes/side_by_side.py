"""Two scenes in one netlist that nothing joins: each must go as it goes alone."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import yaml

import fairlead
from tests.invariance.renaming import entry, renamed, text_of
from tests.scenes.classes import Scene
from tests.scenes.observed import NOMINAL

ROWS = 100
LEFT, RIGHT = "lx", "rx"
"""What the names of either scene begin with."""


def joined(left: str, right: str) -> tuple[str, tuple[Callable[[str], str], Callable[[str], str]]]:
    """Both netlists in one, run as the first asks; for each what turns the new names back into its own."""
    (one, left_back), (other, right_back) = renamed(left, _named(LEFT)), renamed(right, _named(RIGHT))
    tree, more = yaml.compose(one), yaml.compose(other)
    for part in ("components", "connections"):
        entry(tree, part).value += entry(more, part).value
    return text_of(tree), (left_back, right_back)


def _named(first: str) -> Callable[[int], str]:
    return lambda k: first + "".join(chr(ord("a") + int(digit)) for digit in f"{k:03d}")


def stop_of(scene: Scene) -> float:
    """How long a scene runs [s]."""
    found = re.search(r"run: \{stop: (\S+) s", scene.text)
    assert found is not None
    return float(found[1])


def motions(scene: Scene, text: str, stop: float, engine: str, accuracy: float) -> dict[str, np.ndarray]:
    """Places and angles by name, in ROWS + 1 rows up to `stop`; each as a share of the size that counts as one."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.yaml"
        file.write_text(text, encoding="utf-8")
        settings = {"run.stop": f"{stop} s", "record.every": f"{stop / ROWS} s"}
        model = fairlead.load(file, set=settings, libraries=scene.libraries)
    result = model.run(out=None, engine=engine, accuracy=accuracy)
    grid = np.minimum(np.linspace(0.0, stop, ROWS + 1), result.t[-1])
    return {
        signal.name: result.at(signal.name, grid) / max(NOMINAL[signal.unit], np.abs(result[signal.name]).max())
        for signal in result.signals if signal.unit in ("m", "rad")
    }  # fmt: skip
