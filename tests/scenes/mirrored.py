"""The mirror image of a scene: all that has a direction turned round, so that every motion must be its opposite."""

from __future__ import annotations

from typing import Any

import yaml

SIGNED = {
    "Mass": ("position", "velocity"), "Inertia": ("angle", "speed"), "ForceSource": ("force",),
    "TorqueSource": ("torque",), "MotionSource": ("velocity", "position", "origin"), "Spring": ("free_length",),
    "SpringDamper": ("free_length",), "Cam": (), "Crank": (),
}  # fmt: skip
"""Parameters with a direction, by type."""
TURNED = ("Tether", "RigidStop")
"""Types whose ends change places: they act one way only."""
WITHIN = ("constant", "to", "from", "amplitude", "offset", "rate")
"""What has the direction of a quantity in time."""
REFUSED = ("Cam", "Crank", "Rod", "Route")
"""Types that have no mirror image made of themselves."""


SHOWN = (".x", ".v", ".angle", ".speed")
"""Ends of the names of signals that are the opposite in the mirror image."""


def mirrored(text: str) -> str:
    """The mirror image of a netlist; empty where it has parts that cannot be turned round."""
    tree = yaml.safe_load(text)
    turned = set()
    for name, part in tree["components"].items():
        if part["type"] in REFUSED:
            return ""
        for key in SIGNED.get(part["type"], ()):
            if key in part:
                part[key] = _opposite(part[key])
        if part["type"] == "EndStop":
            part["lower"], part["upper"] = _opposite(part["upper"]), _opposite(part["lower"])
        if part["type"] in TURNED:
            turned.add(name)
    tree["connections"] = [[_port(port, turned) for port in join] for join in tree["connections"]]
    return yaml.safe_dump(tree, sort_keys=False)


def _port(port: str, turned: set[str]) -> str:
    name, _, end = port.partition(".")
    return f"{name}.{ {'a': 'b', 'b': 'a'}[end] }" if name in turned and end in "ab" else port


def _opposite(value: Any) -> Any:
    if isinstance(value, dict):
        turned = {}
        for term, given in value.items():
            if term == "constant":
                turned[term] = _opposite(given)
            else:
                turned[term] = {key: _opposite(one) if key in WITHIN else one for key, one in given.items()}
        return turned
    if isinstance(value, str):
        return value.removeprefix("-") if value.startswith("-") else f"-{value}"
    return -value
