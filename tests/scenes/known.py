"""Scenes that are not right, by class and seed, and why; a scene leaves the list when it becomes right.

Each is wrong by an oracle of ours; docs/random_scenes.md counts them.
"""

from __future__ import annotations

KNOWN: dict[str, dict[int, str]] = {}
"""Class -> seed -> why."""
