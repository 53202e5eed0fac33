"""Scenes are judged alike on machines of any speed."""

import pytest

from tests.scenes import observed

PATIENCE = 30.0
"""Times the wall time that the command allows a run, which is for the machine of docs/random_scenes.md, and alone."""


@pytest.fixture(autouse=True)
def no_clock_decides(monkeypatch: pytest.MonkeyPatch) -> None:
    """A run that takes long is no other verdict; one that hangs is still ended."""
    monkeypatch.setattr(observed, "WALL", PATIENCE * observed.WALL)
