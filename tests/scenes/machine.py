"""A netlist read as mechanics, by itself: parameters in SI, who is joined to whom, and what moves as one."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import yaml

FACTORS = {"m": 1.0, "mm": 1e-3, "us": 1e-6, "ms": 1e-3, "deg": math.pi / 180, "kN": 1e3, "mm/s": 1e-3}
PLACE = {"Mass": ("x", "v"), "Inertia": ("angle", "speed"), "MotionSource": ("x", "v")}
"""Outputs of a component that are the place and the speed of the node it is joined to."""
FIXED = ("Ground", "Housing")
TIED = {"Rack": ("pinion", "rack", "radius"), "Gear": ("a", "b", "ratio"), "RigidLink": ("a", "b", None)}
"""The motion of the second port is that of the first times a parameter."""


def si(value: Any) -> Any:
    """A quantity as a number in SI, `12 kN` or a bare number; anything else as it is, maps and lists through."""
    if isinstance(value, dict):
        return {key: si(one) for key, one in value.items()}
    if isinstance(value, list):
        return [si(one) for one in value]
    if isinstance(value, str):
        number, _, unit = value.partition(" ")
        try:
            return float(number) * FACTORS.get(unit, 1.0)
        except ValueError:
            return value
    return value


@dataclass
class Node:
    """Ports that are joined: their place and speed by the name of a signal, or fixed."""

    ports: list[tuple[str, str]] = field(default_factory=list)
    place: tuple[str, str] | None = None
    fixed: bool = False
    given: bool = False


class Machine:
    """Components with parameters in SI, and nodes by port."""

    def __init__(self, text: str) -> None:
        tree = yaml.safe_load(text)
        self.parts: dict[str, dict[str, Any]] = si(tree["components"])
        self.method = tree.get("friction", {}).get("method", "hold")
        self.node: dict[tuple[str, str], Node] = {}
        self.nodes: list[Node] = []
        for join in tree["connections"]:
            self._join([tuple(port.split(".", 1)) for port in join])
        for node in self.nodes:
            for name, _ in node.ports:
                kind = self.parts[name]["type"]
                if kind in PLACE:
                    node.place = (f"{name}.{PLACE[kind][0]}", f"{name}.{PLACE[kind][1]}")
                node.fixed |= kind in FIXED
                node.given |= kind in (*FIXED, "MotionSource")

    @property
    def bends(self) -> bool:
        """True if a contact creeps or bends at rest."""
        return any(part.get("method", self.method) != "hold" for part in self.parts.values())

    def _join(self, ports: list[Any]) -> None:
        """Joins of one port in several lines make one node."""
        found = {id(self.node[port]): self.node[port] for port in ports if port in self.node}
        into = next(iter(found.values()), None) or Node()
        if into not in self.nodes:
            self.nodes.append(into)
        for other in list(found.values())[1:]:
            into.ports += other.ports
            self.nodes.remove(other)
        into.ports += [port for port in ports if port not in self.node]
        for port in into.ports:
            self.node[port] = into

    def groups(self) -> list[list[tuple[Node, float]]]:
        """Nodes that are tied rigidly, each with the ratio of its motion to that of the first."""
        ties = []
        for name, part in self.parts.items():
            if part["type"] in TIED:
                a, b, key = TIED[part["type"]]
                if (name, a) in self.node and (name, b) in self.node:
                    ties.append((self.node[name, a], self.node[name, b], part[key] if key else 1.0))
        left, found = list(self.nodes), []
        while left:
            group, todo = [], [(left[0], 1.0)]
            while todo:
                node, ratio = todo.pop()
                if any(node is one for one in left):
                    left = [one for one in left if one is not node]
                    group.append((node, ratio))
                    todo += [(b, ratio * r) for a, b, r in ties if a is node]
                    todo += [(a, ratio / r) for a, b, r in ties if b is node]
            found.append(group)
        return found

    def across(self, name: str, port: str) -> tuple[str, str] | None:
        """Signals of place and speed at a port; empty names where it is fixed, None where nothing shows them."""
        node = self.node.get((name, port))
        if node is None:
            return None
        return ("", "") if node.fixed else node.place


Node.__eq__ = object.__eq__  # type: ignore[method-assign,assignment]  # nodes are who they are, not what they hold
