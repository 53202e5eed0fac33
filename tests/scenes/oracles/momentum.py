"""Momentum: what moves as one gains m dv = integral of F dt and dx = integral of v dt, F what its neighbours show.

Forces and speeds are integrated over the recorded rows, between the instants at which speeds jump. It sees forces
with a wrong sign or ratio, neighbours left out, steps that do not solve their equations, motions that drift from
their speeds. It cannot see a force that is wrong on both sides and shown as it acts (laws.py does), nor what happens
in an instant (impulses.py).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from tests.scenes.machine import PLACE, Machine, Node
from tests.scenes.observed import NOMINAL, Observed
from tests.scenes.steps import ends, integrals

PER_ACCURACY, WHERE_IT_BENDS = 1.0, 30.0
"""Accuracies of what passes that may be missing; and of scenes with contacts that creep or bend at rest, whose
friction changes within a step by more than the rows show."""

FORCES: dict[str, tuple[str, dict[str, int]]] = {
    "Spring": ("tension", {"a": 1, "b": -1}), "SpringDamper": ("tension", {"a": 1, "b": -1}),
    "Tether": ("tension", {"a": 1, "b": -1}), "Damper": ("tension", {"a": 1, "b": -1}),
    "ForceSensor": ("tension", {"a": 1, "b": -1}), "TorqueSensor": ("torque", {"a": -1, "b": 1}),
    "TorsionSpring": ("torque", {"a": 1, "b": -1}), "RotationalDamper": ("torque", {"a": 1, "b": -1}),
    "Backlash": ("torque", {"a": -1, "b": 1}), "Contact": ("friction", {"a": 1, "b": -1}),
    "Clutch": ("torque", {"a": 1, "b": -1}), "Brake": ("torque", {"shaft": -1}), "Bearing": ("torque", {"shaft": -1}),
    "ForceSource": ("force", {"flange": 1}), "TorqueSource": ("torque", {"shaft": 1}),
    "EndStop": ("force", {"a": 1, "b": -1}), "RigidStop": ("force", {"a": -1, "b": 1}),
    "Cam": ("force", {"follower": 1}), "Crank": ("force", {"slider": 1}),
}  # fmt: skip
"""Type -> its output that is a force, and its sign on the body that is joined to a port."""
SILENT = ("Mass", "Inertia", "Rack", "Gear", "RigidLink")
"""Types that add no force to what they are joined to."""


def momentum(run: Observed, machine: Machine) -> str:
    """What is wrong with a body; nothing if all obey Newton's law to an accuracy of what passes."""
    factor = run.accuracy * (WHERE_IT_BENDS if machine.bends else PER_ACCURACY)
    for group in machine.groups():
        if any(node.given for node, _ in group):
            continue
        found = _inertias(group, machine)
        forces = _forces(group, machine, run)
        if not found or forces is None:
            continue
        total = sum(m * r * r for m, r, _, _ in found)
        _, ratio, place, speed = found[0]
        v, x = run.columns[speed] / ratio, run.columns[place] / ratio
        for what, off, allowed in (
            ("momentum", *_missing(total * v, forces, run, total * NOMINAL[run.units[speed]] / abs(ratio))),
            ("motion", *_missing(x, [v], run, NOMINAL[run.units[place]] / abs(ratio))),
        ):
            if off > factor * allowed:
                return f"{what}: of {speed.rpartition('.')[0]} {off:.2g} are missing, allowed {factor * allowed:.2g}"
    return ""


def isolated(run: Observed, machine: Machine) -> str:
    """What is wrong with the momentum of all, where nothing outside acts; impacts change nothing of it."""
    kinds = {part["type"] for part in machine.parts.values()}
    if kinds - {"Mass", "Spring", "SpringDamper", "Tether", "Damper", "Contact", "RigidStop", "ForceSensor"}:
        return ""
    masses = [(part["mass"], run.columns[f"{name}.v"]) for name, part in machine.parts.items() if "mass" in part]
    total = sum(m * v for m, v in masses)
    size = sum(m * max(np.abs(v).max(), NOMINAL["m/s"]) for m, v in masses)
    off = float(np.abs(total - total[0]).max())
    return f"momentum: the sum changes by {off:.2g} of {size:.2g} N s" if off > run.accuracy * size else ""


def _missing(what: np.ndarray, rates: list[np.ndarray], run: Observed, nominal: float) -> tuple[float, float]:
    """By how much a quantity is off the integral of its rates, at most, and what passed at most."""
    at = ends(run.side)
    change, dt = np.diff(what[at]), np.diff(run.t[at])
    change = np.where(dt > 0, change, 0.0)
    gained = sum(integrals(rate, run.t, run.side) for rate in rates)
    off = np.abs(np.cumsum(change - gained)).max(initial=0.0)
    passed = sum(float(np.sum(integrals(np.abs(rate), run.t, run.side))) for rate in rates)
    # rows are left out where they are known to half an accuracy of the largest value of a rate
    rows = sum(float(np.abs(rate).max(initial=0.0)) * float(run.t[-1] - run.t[0]) for rate in rates)
    return float(off), max(nominal, passed, rows, float(np.abs(what).max(initial=0.0)))


def _inertias(group: list[tuple[Node, float]], machine: Machine) -> list[tuple[float, float, str, str]]:
    """(inertia, ratio, place, speed) of the bodies in a group."""
    found = []
    for node, ratio in group:
        for name, _ in node.ports:
            part = machine.parts[name]
            if part["type"] in ("Mass", "Inertia"):
                place, speed = PLACE[part["type"]]
                found.append((part.get("mass", part.get("moment")), ratio, f"{name}.{place}", f"{name}.{speed}"))
    return found


def _forces(group: list[tuple[Node, float]], machine: Machine, run: Observed) -> list[np.ndarray] | None:
    """What acts on a group, by neighbour; None where a neighbour does not show its force."""
    found = []
    for node, ratio in group:
        for name, port in node.ports:
            kind = machine.parts[name]["type"]
            if kind in SILENT:
                continue
            if kind in MOVING and (shown := MOVING[kind](name, port, machine, run)) is not None:
                found.append(ratio * shown)
                continue
            signal, signs = FORCES.get(kind, ("", {}))
            if port not in signs or f"{name}.{signal}" not in run.columns:
                return None
            found.append(ratio * signs[port] * run.columns[f"{name}.{signal}"])
    return found


def _angle(name: str, machine: Machine, run: Observed) -> np.ndarray | None:
    """The angle of the shaft that is joined to a crank or cam, through gears too."""
    for group in machine.groups():
        if any((name, "shaft") in node.ports for node, _ in group):
            here = next(ratio for node, ratio in group if (name, "shaft") in node.ports)
            for node, ratio in group:
                if node.place is not None:
                    return run.columns[node.place[0]] * here / ratio
    return None


def _crank(name: str, port: str, machine: Machine, run: Observed) -> np.ndarray | None:
    if port != "shaft" or (angle := _angle(name, machine, run)) is None:
        return None
    part = machine.parts[name]
    r, across = part["radius"], part["radius"] * np.sin(angle) - part.get("offset", 0.0)
    lever = r * np.sin(angle) + across * r * np.cos(angle) / np.sqrt(part["rod"] ** 2 - across**2)
    return lever * run.columns[f"{name}.force"]


def _cam(name: str, port: str, machine: Machine, run: Observed) -> np.ndarray | None:
    if port != "shaft" or (angle := _angle(name, machine, run)) is None:
        return None
    part = machine.parts[name]
    lever = -part["lift"] * (np.sin(angle) + part.get("share", 0.0) * np.cos(2 * angle) / 2)
    return lever * run.columns[f"{name}.force"]


def _rod(name: str, port: str, machine: Machine, run: Observed) -> np.ndarray | None:
    """The tension draws each end towards the other."""
    axis, end = port[0], port[1]
    across = [machine.across(name, f"{axis}{k}") for k in "12"]
    if None in across:
        return None
    one, two = (run.columns[place[0]] if place and place[0] else 0.0 for place in across)
    return run.columns[f"{name}.tension"] * (two - one) * (1 if end == "1" else -1) / machine.parts[name]["length"]


def _gearbox(name: str, port: str, machine: Machine, run: Observed) -> np.ndarray:
    """The torque carried drives b less the loss, and holds a back by the ratio."""
    carried = run.columns[f"{name}.torque"]
    return -machine.parts[name]["ratio"] * carried if port == "a" else carried - run.columns[f"{name}.loss"]


MOVING: dict[str, Callable[[str, str, Machine, Observed], np.ndarray | None]] = {
    "Crank": _crank, "Cam": _cam, "Rod": _rod, "Gearbox": _gearbox,
}  # fmt: skip
"""Types whose force acts by a ratio of its own, and may move."""


def judged_bodies(machine: Machine, run: Observed) -> Iterator[str]:
    """Names of the bodies that `momentum` judges."""
    for group in machine.groups():
        if not any(node.given for node, _ in group) and _forces(group, machine, run) is not None:
            yield from (speed.rpartition(".")[0] for _, _, _, speed in _inertias(group, machine))
