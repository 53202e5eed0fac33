"""Fixtures of the models."""

import pytest

from fairlead.integrate import parts
from fairlead.system.active import entrained


@pytest.fixture
def brief(monkeypatch):
    """Little margin, so that much is reactivated and left out again in a short run."""
    monkeypatch.setattr(entrained, "KEPT_FREE", 4)
    monkeypatch.setattr(parts, "MARGIN", 2)
