"""Scenes that are not right, by class and seed, and why; a scene leaves the list when it becomes right.

Each is wrong by an oracle of ours; docs/random_scenes.md counts them.
"""

from __future__ import annotations

DRUM = (
    "the work that a drum's drive gives is wrong where a given speed of the drum swings, 1 % at accuracy 1e-4. It is "
    "metered through the stiff bond of the line that is wound on. The motion agrees; the closure of the run tells it"
)

KNOWN: dict[str, dict[int, str]] = {"routes": dict.fromkeys((32, 59, 98, 166, 219), DRUM)}
"""Class -> seed -> why."""
