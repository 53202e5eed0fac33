"""What is kept goes on where it stopped, at one commit; what fails is shown, and is what the list of failures says."""

from __future__ import annotations

import fnmatch
from dataclasses import replace
from pathlib import Path

import pytest

from tests.hard import page
from tests.hard.attempt import Attempt
from tests.hard.kept import Kept, commit, version
from tests.hard.known import KNOWN, LEFT, MENDED, WORSE, disagreements, known_failure, left_out
from tests.hard.peers import played, table
from tests.hard.peers.cases import cases
from tests.hard.peers.played import TOOLS
from tests.hard.registry import rows

PAGE = Path(__file__).parents[2] / "docs" / "stability.md"
ROWS = list(rows())
ROW = ROWS[0]
DONE = Attempt(ROW.case.name, ROW.engine, ROW.treatment, "wrong", "x is 1, must be | 2", auto=True,
               version=version(ROW), commit=commit())  # fmt: skip


def names(some):
    return {(row.case.name, row.engine, row.treatment) for row in some}


def test_an_attempt_is_kept_until_its_content_or_the_commit_changes(tmp_path):
    kept = Kept(tmp_path / "rows.jsonl")
    assert kept.get(ROW) is None
    kept.put(DONE)
    assert Kept(kept.path).get(ROW) == DONE
    for other in (replace(DONE, version="of something else"), replace(DONE, commit="of another day")):
        kept.put(other)
        assert Kept(kept.path).get(ROW) is None


def test_the_page_shows_a_failure_with_its_reason_and_counts_it(tmp_path):
    page.write(tmp_path / "page.md", [(ROW, DONE)], ROWS[1:])
    text = (tmp_path / "page.md").read_text(encoding="utf-8")
    assert "| `auto` | 0 of 1 (1 wrong) |" in text
    failure = f"| {ROW.case.name} | {ROW.engine} | {ROW.treatment} | auto | **wrong** | x is 1, must be \\| 2 |"
    assert f"{failure} **not known** |" in text
    assert ROW.case.oracle in text
    assert f"commit {DONE.commit}: 1 of {len(ROWS)} rows" in text


def test_the_page_tells_which_rows_fail_and_which_are_not_played(tmp_path):
    page.write(tmp_path / "page.md", [(ROW, DONE)], ROWS[1:])
    text = (tmp_path / "page.md").read_text(encoding="utf-8")
    assert page.failures(text) == names([ROW])
    assert page.waiting(text) == names(ROWS[1:])


def test_rows_of_two_commits_make_no_page(tmp_path):
    other = replace(DONE, case=ROWS[1].case.name, commit="of another day")
    with pytest.raises(ValueError, match="play them all at one commit"):
        page.write(tmp_path / "page.md", [(ROW, DONE), (ROWS[1], other)], [])
    assert not (tmp_path / "page.md").exists()


def test_every_pattern_of_the_lists_is_that_of_a_row():
    for *patterns, reason in (*KNOWN, *WORSE, *LEFT):
        assert reason
        assert any(all(map(fnmatch.fnmatch, name, patterns)) for name in names(ROWS)), patterns


def test_a_row_that_fails_unlisted_and_a_listed_one_that_comes_through_are_told():
    listed = next(row for row in ROWS if known_failure(row.case.name, row.engine, row.treatment))
    through = Attempt(listed.case.name, listed.engine, listed.treatment, "ok")
    fails, leaves = disagreements([DONE, replace(DONE, verdict="ok"), through, replace(through, verdict="stuck")])
    assert fails == f"{ROW.name} fails and is not in tests/hard/known.py"
    assert leaves == f"{listed.name} comes through and must leave tests/hard/known.py"


def test_every_case_that_is_not_slow_is_played_by_the_tests():
    assert {row.case.name for row in ROWS if not left_out(row)} == {
        row.case.name for row in ROWS if row.case.cost != "slow"
    }


def test_the_rows_that_the_page_shows_as_failing_are_those_of_the_list():
    text = PAGE.read_text(encoding="utf-8")
    failed, played = page.failures(text), names(ROWS) - page.waiting(text)
    mended = {name for name in failed if not known_failure(*name)}
    by_pattern = [{name for name in mended if all(map(fnmatch.fnmatch, name, one))} for one in MENDED]
    assert all(by_pattern)
    assert mended == set().union(*by_pattern)
    worse = {name for name in played for *one, _ in WORSE if all(map(fnmatch.fnmatch, name, one))}
    assert {name for name in played if known_failure(*name)} - failed == worse


def test_every_case_says_what_it_is_and_has_an_oracle():
    assert not [row.case.name for row in rows() if not row.case.what or not row.case.oracle]


def test_a_page_that_is_made_anew_keeps_the_part_of_other_tools(tmp_path):
    path, part = tmp_path / "page.md", f"{table.TITLE}\n\n| case | off by 3 m |\n{table.END}"
    page.write(path, [(ROW, DONE)], ROWS[1:])
    plain = path.read_text(encoding="utf-8")
    path.write_text(table.with_peers(plain, part), encoding="utf-8")
    page.write(path, [(ROW, DONE)], ROWS[1:])
    text = path.read_text(encoding="utf-8")
    assert table.peers_of(text) == part
    assert text.replace(f"{part}\n\n", "") == plain
    assert page.failures(text) == names([ROW])


def test_each_statement_of_a_case_by_hand_is_right_with_scipy(monkeypatch):
    """The zones, forces and order of release that scipy and PathSim are given meet the closed forms."""
    monkeypatch.setattr(played, "CPU", 600.0)  # s; the page gives 20 on its machine
    few = [one for one in cases() if one.name.split()[0] in ("stack", "equal", "belt", "load")]
    assert len(few) == 5
    for one in few:
        assert one.error(TOOLS["scipy"](one)) <= one.within
