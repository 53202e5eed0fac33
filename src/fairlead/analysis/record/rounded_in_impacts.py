"""Contacts that round friction off, and are pressed by what took an impulse: a sentence that they passed none on.

In an impact a contact that holds exactly takes up to mu times the impulse that presses it (events/impulse.py).
Laws that round friction off have their zones by forces and slips of finite size, and are as they were before the blow.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from fairlead.analysis.record.chattering import MOST_NAMED
from fairlead.system.compiled.system import System

CREEP = "creep"
"""The role of the output by which a contact is known."""
RIGID = 2
"""From this on a row takes any impulse, see `Facts.takes_impulse`."""


def remark(system: System, lost: Mapping[str, float]) -> str:
    """What to tell where impacts took energy (`lost`, by part) and such contacts are in the scene; "" for nothing."""
    rounded = pressed_by_impulses(system) if lost else []
    return _of_rounded(rounded, lost) if rounded else ""


def _listed(names: list[str]) -> str:
    """The first names, and how many more."""
    return ", ".join(names[:MOST_NAMED]) + (f" and {len(names) - MOST_NAMED} more" if names[MOST_NAMED:] else "")


def _of_rounded(names: list[str], lost: Mapping[str, float]) -> str:
    is_, has, its = ("is", "has", "its") if len(names) == 1 else ("are", "have", "their")
    return (
        f"{_listed(names)} {is_} pressed by a force that is an impulse in an impact, and {has} passed no friction on "
        f"there: {its} method rounds friction off. Impacts took energy in this run ({_listed(list(lost))}). "
        "With method: hold, or karnopp, a contact rubs in them too."
    )


def pressed_by_impulses(system: System) -> list[str]:
    """Contacts that never hold exactly and whose force follows one that takes any impulse, by name."""
    told: set[int] = set(np.flatnonzero(system.takes_impulse >= RIGID).tolist())  # and signals that follow them
    before = 0
    while len(told) > before:
        before = len(told)
        for block in system.blocks:
            for inputs, outputs in zip(block.in_index.tolist(), block.sig_index.tolist(), strict=True):
                told |= {outputs[o] for o, i in block.kernel.structure.d_signals if inputs[i] in told}
    contacts = {signal.name.rpartition(".")[0] for signal in system.signals if signal.role == CREEP}
    found = []
    for block in system.blocks:
        s = block.kernel.structure
        for instance, inputs in zip(block.instances, block.in_index.tolist(), strict=True):
            if instance.path in contacts and not s.holds and any(inputs[i] in told for _, i in s.d_flows):
                found.append(instance.path)
    return found
