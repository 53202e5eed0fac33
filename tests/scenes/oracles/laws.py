"""Laws: every force is the one that the netlist's numbers give at the places and speeds shown.

    spring      k (b - a - L)                  tether   the same, never below 0
    damper      c (vb - va)                    stop     rigid: force >= 0, gap >= 0, not both above
    friction    sliding: N mu(|v|) against the slip;   at rest: at most N mu_s;   N given in time or by a signal
    source      the quantity in time

written here once more, from docs/physics.md. It sees a wrong law, sign, coefficient or limit, friction that drives,
contacts that hold more than they can, stops that pull. Friction is judged at the ends of steps: inside a step it is
shown by the dense output, not by its curve. What a contact holds beyond its limit, or a stop pulls, counts by its
impulse, since one that toggles is kept in its zone for a dwell, at most a millionth of the span.

It cannot see whether the motion follows from the forces (momentum.py), nor judge treatments of sticking that bend or
creep, nor lines on routes.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.special import lambertw

from tests.scenes.machine import Machine
from tests.scenes.observed import NOMINAL, Observed
from tests.scenes.steps import INSIDE, integrals

PER_ACCURACY = 30.0
STILL = 1e-5
"""Slip [m/s] below which a contact may hold or slide: ten times what it is caught with."""
OPEN = 1e-5
"""Normal force [N] below which a contact may be open."""
TOUCHES = 1e-6
"""Gap [m] up to which a rigid stop may push."""


def laws(run: Observed, machine: Machine) -> str:
    """What is wrong with a force; nothing if all are what the netlist says."""
    for name, part in machine.parts.items():
        if (judge := JUDGES.get(part["type"])) and (said := judge(name, part, machine, run)):
            return f"laws: {said}"
    return ""


def _unlike(name: str, signal: str, right: Any, run: Observed) -> str:
    """Where a signal is not what it should be."""
    shown = run.columns[f"{name}.{signal}"]
    size = max(NOMINAL[run.units[f"{name}.{signal}"]], float(np.abs(shown).max(initial=0.0)))
    off = np.abs(shown - right)
    if (k := int(np.argmax(off))) is not None and off[k] > PER_ACCURACY * run.accuracy * size:
        return f"{name}.{signal} is {shown[k]:.6g} at {run.t[k]:.6g} s, off by {off[k]:.2g}"
    return ""


def _ends(name: str, machine: Machine, run: Observed, ports: tuple[str, str] = ("a", "b")) -> Any:
    """(place of a, speed of a, place of b, speed of b), or None where they are not shown."""
    found = [machine.across(name, port) for port in ports]
    if None in found:
        return None
    return [run.columns[signal] if signal else 0.0 for pair in found for signal in pair]


def _spring(name: str, part: Any, machine: Machine, run: Observed) -> str:
    if (ends := _ends(name, machine, run)) is None:
        return ""
    xa, va, xb, vb = ends
    k, c = part["stiffness"], part.get("damping", 0.0)
    return _unlike(name, "tension", k * (xb - xa - part.get("free_length", 0.0)) + c * (vb - va), run)


def _tether(name: str, part: Any, machine: Machine, run: Observed) -> str:
    if (ends := _ends(name, machine, run)) is None:
        return ""
    xa, _, xb, _ = ends
    return _unlike(name, "tension", np.maximum(0.0, part["stiffness"] * (xb - xa - part.get("length", 0.0))), run)


def _damper(name: str, part: Any, machine: Machine, run: Observed) -> str:
    if (ends := _ends(name, machine, run)) is None:
        return ""
    signal = "torque" if part["type"] == "RotationalDamper" else "tension"
    return _unlike(name, signal, part["damping"] * (ends[3] - ends[1]), run)


def _shaft(name: str, part: Any, machine: Machine, run: Observed) -> str:
    if (ends := _ends(name, machine, run)) is None:
        return ""
    xa, va, xb, vb = ends
    return _unlike(name, "torque", part["stiffness"] * (xb - xa) + part.get("damping", 0.0) * (vb - va), run)


def _bumper(name: str, part: Any, machine: Machine, run: Observed) -> str:
    if (ends := _ends(name, machine, run)) is None:
        return ""
    xa, va, xb, vb = ends
    right = 0.0
    for d, at in ((1, part["upper"]), (-1, part.get("lower", 0.0))):
        deep = d * (xb - xa - at)
        pushes = np.maximum(0.0, 1 + part["damping"] * d * (vb - va))  # torn off, it holds nothing
        right = right + d * part["stiffness"] * np.maximum(0.0, deep) * pushes
    return _unlike(name, "force", right, run)


def _rigid(name: str, part: Any, machine: Machine, run: Observed) -> str:
    force, gap = run.columns[f"{name}.force"], run.columns[f"{name}.gap"]
    least = PER_ACCURACY * run.accuracy * max(NOMINAL["N"], float(np.abs(force).max(initial=0.0)))
    into = TOUCHES + PER_ACCURACY * run.accuracy * NOMINAL["m"]
    pulled = float(np.sum(integrals(np.maximum(0.0, -force - least), run.t, run.side)))
    if pulled > PER_ACCURACY * run.accuracy * NOMINAL["m/s"]:
        return f"{name} pulls with {-force.min():.2g} N, {pulled:.2g} N s in all"
    if gap.min(initial=0.0) < -into:
        return f"{name} is run into by {-gap.min():.2g} m"
    if (np.where(gap > into, np.abs(force), 0.0) > least).any():
        return f"{name} pushes over a gap"
    return ""


def _source(name: str, part: Any, machine: Machine, run: Observed) -> str:
    what = "force" if "force" in part else "torque"
    right = in_time(part.get(what), run.t, run.side)
    return "" if right is None else _unlike(name, what, right, run)


def in_time(wave: Any, t: np.ndarray, side: np.ndarray) -> np.ndarray | None:
    """A quantity in time at rows; in the first row of an instant what was before it. None for a table."""
    if not isinstance(wave, dict):
        return np.full(len(t), float(wave))
    late = np.where((side == -1) & (np.diff(t, prepend=-1.0) > 0), -1e-12, 1e-12)
    total = np.zeros(len(t)) + wave.get("constant", 0.0)
    for term, given in wave.items():
        if term == "table":
            return None
        if term == "sine":
            angle = 2 * math.pi * given["frequency"] * t + given.get("phase", 0.0)
            total = total + given.get("offset", 0.0) + given["amplitude"] * np.sin(angle)
        elif term == "drift":
            total = total + given["rate"] * np.maximum(0.0, t - given.get("start", 0.0))
        elif term == "step":
            total = total + np.where(t + late < given["at"], given.get("from", 0.0), given["to"])
        elif term in ("ramp", "trapezoid"):
            low, high, at = given.get("from", 0.0), given["to"], given.get("start", 0.0)
            rise = given.get("over", given.get("rise"))
            times, values = [at, at + rise], [low, high]
            if term == "trapezoid":
                times += [times[-1] + given["stay"], times[-1] + given["stay"] + given["fall"]]
                values += [high, low]
            total = total + np.interp(t, times, values)
    return total


def _contact(name: str, part: Any, machine: Machine, run: Observed) -> str:
    if f"{name}.friction" not in run.columns:
        return ""
    normal = _normal(name, part, machine, run)
    return _friction(f"{name}.friction", f"{name}.slip", 1.0, part, machine, normal, run)


def _rubbing(name: str, part: Any, machine: Machine, run: Observed) -> str:
    normal = _normal(name, part, machine, run)
    return _friction(f"{name}.torque", f"{name}.slip", part["radius"], part, machine, normal, run)


def _normal(name: str, part: Any, machine: Machine, run: Observed) -> Any:
    """The normal force: given, or the signal that is joined to it."""
    node = machine.node.get((name, "normal"))
    if node is None:
        return part.get("normal_force")
    for other, output in node.ports:
        if output != "normal":
            if machine.parts[other]["type"] == "SignalSource":
                return in_time(machine.parts[other]["value"], run.t, run.side)
            return run.columns[f"{other}.{output}"]
    return None


def _friction(signal: str, slip_of: str, lever: float, part: Any, machine: Machine, normal: Any, run: Observed) -> str:
    """Against the slip, of the size that the curve gives; at rest not above the limit."""
    shown, slip = run.columns[signal] / lever, run.columns[slip_of]
    size = max(NOMINAL["N"], float(np.abs(shown).max(initial=0.0)))
    least = PER_ACCURACY * run.accuracy * size
    slides = np.abs(slip) > STILL + PER_ACCURACY * run.accuracy * NOMINAL["m/s"]
    drives = np.where(slides, -shown * np.sign(slip), 0.0)
    bends = part.get("method", machine.method) != "hold"
    if not bends and drives.max(initial=0.0) > least:
        return f"{signal} drives the slip with {drives.max():.2g} N"
    if bends or normal is None:
        return ""
    normal = np.maximum(0.0, normal)
    rest, sliding = curve(part["curve"], np.abs(slip))
    most = np.maximum(rest, sliding)
    off = np.abs(shown - normal * sliding * np.sign(slip))
    off = np.where(slides & (normal > OPEN) & (run.side != INSIDE), off, 0.0)
    if (k := int(np.argmax(off))) is not None and off[k] > least:
        return f"{signal} is {shown[k]:.6g} N at {run.t[k]:.6g} s, off its curve by {off[k]:.2g} N"
    over = np.abs(shown) - np.maximum(normal, OPEN) * most - least
    held = float(np.sum(integrals(np.where(slides, 0.0, np.maximum(0.0, over)), run.t, run.side)))
    if held > PER_ACCURACY * run.accuracy * NOMINAL["m/s"]:
        return f"{signal} is above its limit at rest by {over.max() + least:.2g} N, {held:.2g} N s in all"
    return ""


def curve(given: Any, v: np.ndarray) -> tuple[float, np.ndarray]:
    """Coefficient from rest, and at slip speeds v >= 0."""
    if not isinstance(given, dict):
        return float(given), np.full(len(v), float(given))
    kind, low = given["curve"], given.get("coulomb", 0.0)
    rest = given.get("stiction", low)
    if kind == "coulomb":
        return rest, np.full(len(v), low)
    if kind == "viscous":
        return rest, low + given["rate"] * v
    if kind == "stribeck":
        return rest, low + (rest - low) * np.exp(-((v / given["velocity"]) ** 2))
    assert kind == "hump"
    top, at = given["peak"], given["peak_velocity"]
    r = (rest - low) / (top - low)
    v0 = at / (1 + float(lambertw(-r / math.e).real)) if r else at
    c = (rest - low) / (v0 - at) if r else (top - low) * math.e / at
    return rest, low + (rest - low + c * v) * np.exp(-v / v0)


JUDGES = {
    "Spring": _spring, "SpringDamper": _spring, "Tether": _tether, "Damper": _damper, "RotationalDamper": _damper,
    "TorsionSpring": _shaft, "EndStop": _bumper, "RigidStop": _rigid, "ForceSource": _source, "TorqueSource": _source,
    "Contact": _contact, "Clutch": _rubbing, "Brake": _rubbing, "Bearing": _rubbing,
}  # fmt: skip
