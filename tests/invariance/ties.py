"""Scenes of which two outcomes are equally right, so that the last digit may decide.

A tie is a property of the scene, not of the engine: two contacts reach their limits at one instant by symmetry, or a
body comes to rest exactly where it would slide again. Each entry says which two outcomes there are and why neither is
wrong.
"""

TIES: dict[str, str] = {}
"""The name of a scene (see plays.py) -> which outcomes are tied, and why."""
