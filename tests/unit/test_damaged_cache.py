"""A sample of damaged entries of the cache; `python -m tests.fuzz cache` plays any number."""

from pathlib import Path

import pytest

from tests.fuzz import cache


def test_a_damaged_entry_is_never_taken_for_what_was_asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FAIRLEAD_CACHE", str(tmp_path))
    tmp_path.chmod(0o700)
    assert list(cache.play(tmp_path, seed=1, count=100)) == []
