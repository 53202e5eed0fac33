"""What is kept goes on where it stopped; what fails is shown; the list of known failures names rows that exist."""

from __future__ import annotations

import fnmatch
from dataclasses import replace

from tests.hard import page
from tests.hard.attempt import Attempt
from tests.hard.kept import Kept, version
from tests.hard.known import KNOWN
from tests.hard.registry import rows

ROW = next(rows())
DONE = Attempt(ROW.case.name, ROW.engine, ROW.treatment, "wrong", "x is 1, must be 2", auto=True, version=version(ROW))


def test_an_attempt_is_kept_until_its_content_changes(tmp_path):
    kept = Kept(tmp_path / "rows.jsonl")
    assert kept.get(ROW) is None
    kept.put(DONE)
    assert Kept(kept.path).get(ROW) == DONE
    kept.put(replace(DONE, version="of something else"))
    assert Kept(kept.path).get(ROW) is None
    assert Kept(kept.path).last(ROW) is not None


def test_the_page_shows_a_failure_with_its_reason_and_counts_it(tmp_path):
    page.write(tmp_path / "page.md", [(ROW, DONE)], 3)
    text = (tmp_path / "page.md").read_text(encoding="utf-8")
    assert "| `auto` | 0 of 1 (1 wrong) |" in text
    assert f"| {ROW.case.name} | {ROW.engine} | {ROW.treatment} | auto | **wrong** | x is 1, must be 2 |" in text
    assert ROW.case.oracle in text
    assert "3 of all wait" in text


def test_every_known_failure_is_that_of_a_row():
    names = [(row.case.name, row.engine, row.treatment) for row in rows()]
    for *patterns, reason in KNOWN:
        assert reason
        assert any(all(map(fnmatch.fnmatch, name, patterns)) for name in names), patterns


def test_every_case_says_what_it_is_and_has_an_oracle():
    assert not [row.case.name for row in rows() if not row.case.what or not row.case.oracle]
