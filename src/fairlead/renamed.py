"""Outputs that were called otherwise: the old name still means the signal, where nothing else has it.

    now_called("rotor.rate", known)       "rotor.speed", if `known` has no rotor.rate
"""

from __future__ import annotations

from collections.abc import Collection

OUTPUTS = {
    "turned": ("angle",), "rate": ("speed",), "applied": ("force", "torque"), "given": ("flow",),
    **{f"level{side}": (f"pressure{side}",) for side in ("", "_a", "_b", "_?", "_*", "*")},
}  # fmt: skip
"""What an output of an old name may be called: as its port. Sides of a drive are often asked for by a pattern."""


def word_of_today(last: str, known: Collection[str]) -> str:
    """The same of its last word alone, by the names that its owner has."""
    return next((today for today in OUTPUTS.get(last, ()) if today in known), "")


def of_today(name: str) -> list[str]:
    """A dotted name or pattern whose last word is one of the old ones, as it may be today."""
    owner, dot, last = name.rpartition(".")
    return [f"{owner}.{today}" for today in OUTPUTS.get(last, ())] if dot else []


def now_called(name: str, known: Collection[str]) -> str:
    """Today's name of what nothing in `known` is called any more; "" where the name is right, or means nothing."""
    today = of_today(name) if name not in known else []
    return next((one for one in today if one in known), "")
