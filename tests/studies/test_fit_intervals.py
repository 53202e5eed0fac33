"""Intervals of stick-slip oscillators hold the truth as often as they say, and are no wider than need be.

The study is that of `benchmarks/fit_intervals.py`.
"""

import pytest

from benchmarks.fit_intervals import OSCILLATORS, study

BELT, _, PAIR = OSCILLATORS


@pytest.mark.slow
def test_intervals_hold_the_truth_in_90_to_99_of_100_seeds_and_are_near_the_cramer_rao_bound(tmp_path) -> None:
    found = list(study(BELT, 100, tmp_path))
    assert [one.parameter for one in found] == list(BELT.parameters)
    for one in found:
        assert 90 <= one.held <= 99, one
        assert one.width < 1.5, one
        assert not one.untold


@pytest.mark.slow
def test_a_pair_of_which_the_record_feels_the_product_alone_is_named_with_every_noise(tmp_path) -> None:
    told = {one.parameter: one.untold for one in study(PAIR, 10, tmp_path)}
    pair = {"The data do not tell mu and pressed apart": 10}
    assert told == {"k": {}, "mu": pair, "pressed": pair}
