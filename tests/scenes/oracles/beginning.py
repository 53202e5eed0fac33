"""The beginning: every place and speed that the netlist gives is there at the start.

It sees start values that are erased or averaged away. It cannot see what becomes of bodies that nothing was given
for, and does not ask scenes with rigid stops, which may meet at the start and take speeds away.
"""

from __future__ import annotations

from tests.scenes.machine import PLACE, Machine
from tests.scenes.observed import Observed

GIVEN = {"Mass": ("position", "velocity"), "Inertia": ("angle", "speed")}


def beginning(run: Observed, machine: Machine) -> str:
    """Which start value is not there; nothing if all are."""
    if any(part["type"] == "RigidStop" for part in machine.parts.values()):
        return ""
    for name, part in machine.parts.items():
        for key, signal in zip(GIVEN.get(part["type"], ()), PLACE.get(part["type"], ())):
            if key in part:
                shown = float(run.columns[f"{name}.{signal}"][0])
                if abs(shown - part[key]) > run.accuracy * run.size(f"{name}.{signal}"):
                    return f"beginning: {name}.{signal} is {shown:.6g} at the start, given was {part[key]:.6g}"
    return ""
