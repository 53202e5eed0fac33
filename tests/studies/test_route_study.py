"""The study of docs/studies.md: its first cases beside a closed form of what the start asks of the belts."""

import pytest

pytest.importorskip("pyarrow", reason="pyarrow is not installed; pip install 'fairlead[sweep]'")
from benchmarks.route_study import margin, pictures, study

CASES = 16


@pytest.mark.slow
def test_belts_slip_below_what_the_start_takes_and_hold_at_twice_that(tmp_path) -> None:
    frame = study(tmp_path / "sweep", CASES, processes=2)
    assert frame["status"].isin(["finished", "budget"]).all(), frame[["status", "sentence"]]
    found, broken = margin(frame), frame["limits_broken"] > 0
    assert (found < 0.8).any(), found
    assert (found > 2).any(), found
    assert broken[found < 0.8].all(), frame[found < 0.8]
    assert not broken[found > 2].any(), frame[found > 2]
    (tmp_path / "figures").mkdir()
    tornado, failures = pictures(tmp_path / "sweep", tmp_path / "figures")
    assert tornado.stat().st_size > 5000
    assert failures.stat().st_size > 5000
