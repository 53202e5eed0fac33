"""Fixtures of the models."""

import pytest

from fairlead.system import carried, probing


@pytest.fixture
def brief(monkeypatch):
    """Little margin, so that much is woken and left out again in a short run."""
    monkeypatch.setattr(carried, "KEPT_FREE", 4)
    monkeypatch.setattr(probing, "NEAR", 0.5)
