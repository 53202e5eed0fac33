"""What `make test` leaves to `make test-all` stands for tests that there are."""

from pathlib import Path

import pytest

from tests.slow import LEFT_TO_TEST_ALL, is_left

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("pattern", [one for one in LEFT_TO_TEST_ALL if "::" in one])
def test_each_pattern_names_a_test(pattern):
    file, _, name = pattern.partition("::")
    text = (ROOT / file).read_text(encoding="utf-8")
    if name.startswith("test_"):
        assert f"def {name.partition('*')[0].partition('[')[0]}" in text


def test_brackets_are_letters_and_stars_are_anything():
    assert is_left("tests/hard/test_hard_cases.py::test_hard_case[a_block_/_ida_/_lugre]")
    assert not is_left("tests/hard/test_hard_cases.py::test_hard_case[a_block_/_ida_/_hold]")
    assert is_left("tests/integrate/test_linear.py::test_one_plan_serves_every_zone[0-dense]")
