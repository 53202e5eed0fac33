"""Outputs that were called otherwise: the old name still means the signal, where nothing else has it.

    now_called("rotor.rate", known)       "rotor.speed", if `known` has no rotor.rate
"""

from __future__ import annotations

from collections.abc import Collection

OUTPUTS = {
    "turned": "angle", "rate": "speed",
    **{f"level{side}": f"pressure{side}" for side in ("", "_a", "_b", "_?", "_*", "*")},
}  # fmt: skip
"""The old name of an output by the one it has: that of the port. Sides of a drive are often asked for by a pattern."""


def word_of_today(last: str) -> str:
    """The same of its last word alone."""
    return OUTPUTS.get(last, "")


def of_today(name: str) -> str:
    """A dotted name or pattern whose last word is one of the old ones, as it is today; else ""."""
    owner, dot, last = name.rpartition(".")
    return f"{owner}.{OUTPUTS[last]}" if dot and last in OUTPUTS else ""


def now_called(name: str, known: Collection[str]) -> str:
    """Today's name of what nothing in `known` is called any more; "" where the name is right, or means nothing."""
    today = of_today(name) if name not in known else ""
    return today if today in known else ""
