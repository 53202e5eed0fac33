"""Scenes that are played: every bundled model for a short while, and random ones."""

from __future__ import annotations

import pathlib
from collections.abc import Iterable
from dataclasses import dataclass

import yaml

from tests.invariance.renaming import entry, text_of, tree_of
from tests.scenes.networks import network
from tests.scenes.routes import route

MODELS = pathlib.Path(__file__).parents[2] / "models"
NETWORKS, ROUTES = range(70), range(30)
"""Seeds of the hundred random scenes that `make invariance` plays."""

BUNDLED = {
    "belt": 2.0, "block_and_spring": 2.0, "capstan": 0.6, "crustacean": 0.5, "friction_anchor": 2.0,
    "guidance_route": 1.0, "guidance_route_electric": 0.5, "guidance_route_ideal": 1.0, "hundred_blocks": 0.3,
    "long_deployment": 1.0, "power_unit": 0.5, "sandwich": 1.0, "single_bend": 0.5, "slack_start": 0.4,
    "torsion": 0.5, "valve_motor": 0.5, "weak_clamp": 1.0, "winch_drive": 1.5,
}  # fmt: skip
"""How long each bundled model is played [s]."""
ROWS = 50


@dataclass(frozen=True)
class Play:
    """A scene: what it is called, its netlist, and the accuracy it asks for."""

    name: str
    text: str

    @property
    def accuracy(self) -> float:
        """What its run block says."""
        found = entry(entry(yaml.compose(self.text), "run"), "accuracy")
        return float(found.value) if found is not None else 1e-4


def hundred() -> list[Play]:
    """The random scenes with fixed seeds."""
    return random_plays(NETWORKS, ROUTES)


def random_plays(networks: Iterable[int], routes: Iterable[int]) -> list[Play]:
    """Random networks and routes with these seeds."""
    return [Play(f"network {seed}", network(seed)) for seed in networks] + [
        Play(f"route {seed}", route(seed)) for seed in routes
    ]


def bundled() -> list[Play]:
    """Every bundled model, cut short."""
    return [Play(file.stem, _short(file)) for file in sorted(MODELS.glob("*.yaml"))]


def crowd(seed: int) -> Play:
    """A flat netlist of a hundred parts or more."""
    return Play(f"crowd {seed}", network(seed, size=45))


def _short(file: pathlib.Path) -> str:
    """A bundled model with a short run of which everything is recorded."""
    tree, stop = tree_of(file), BUNDLED.get(file.stem, 0.3)
    run = entry(tree, "run")
    run.value = [(key, value) for key, value in run.value if key.value != "stop"]
    run.value.insert(0, (yaml.ScalarNode("tag:yaml.org,2002:str", "stop"), _scalar(f"{stop} s")))
    tree.value = [(key, value) for key, value in tree.value if key.value not in ("record", "limits")]
    return text_of(tree) + f'record: {{every: {stop / ROWS:g} s, signals: ["*"]}}\n'


def _scalar(text: str) -> yaml.ScalarNode:
    return yaml.ScalarNode("tag:yaml.org,2002:str", text)
