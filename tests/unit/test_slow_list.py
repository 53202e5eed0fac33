"""What `make test` leaves to `make test-all` stands for tests that there are."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from tests.conftest import COLLECTED
from tests.slow import (
    DRAWN,
    EACH_VALUE_ONCE,
    LEFT_TO_TEST_ALL,
    each_value_once,
    fits,
    is_left,
    left_to_test_every,
    repeats,
)

PATTERNS = (*LEFT_TO_TEST_ALL, *EACH_VALUE_ONCE, *(f"{function}*" for function in DRAWN))
ROOT = Path(__file__).parents[2]


def test_each_pattern_names_a_test():
    for pattern in PATTERNS:
        file, _, name = pattern.partition("::")
        if name.startswith("test_"):
            function = name.partition("*")[0].partition("[")[0]
            assert f"def {function}" in (ROOT / file).read_text(encoding="utf-8"), pattern


def test_each_pattern_fits_a_test_of_the_folders_that_are_collected(request):
    if not all(Path(given).is_dir() for given in request.config.args):
        pytest.skip("whole folders are not collected here")
    names = request.config.stash[COLLECTED]
    for pattern in PATTERNS:
        file = pattern.partition("::")[0]
        place = file.partition("*")[0].rpartition("/")[0] if "*" in file else file
        there = [name for name in names if name.startswith(place)]
        assert not there or any(fits(pattern, name) for name in there), pattern


def test_brackets_are_letters_and_stars_are_anything():
    assert is_left("tests/hard/test_hard_cases.py::test_hard_case[a_block_/_ida_/_lugre]")
    assert not is_left("tests/hard/test_hard_cases.py::test_hard_case[a_block_/_stepping_/_hold]")
    assert is_left("tests/integrate/test_linear.py::test_one_plan_serves_every_zone[0-dense]")


@pytest.mark.parametrize("sizes", [(3, 3, 3), (2, 4), (4, 2, 2), (5,), (2, 3, 4)])
def test_of_a_product_each_value_is_played_by_no_more_than_the_longest_parameter_asks(sizes):
    product = [[]]
    for axis, size in enumerate(sizes):
        product = [[*member, (axis, value)] for member in product for value in range(size)]
    played = each_value_once(product)
    every = {(axis, value) for axis, size in enumerate(sizes) for value in range(size)}
    assert set().union(*(product[k] for k in played)) == every
    assert len(played) == max(sizes)


def test_what_is_slow_already_plays_no_value_and_one_parameter_is_no_product():
    def test(name, slow=False, **given):
        marks = [pytest.mark.parametrize(parameter, []).mark for parameter in given]
        return SimpleNamespace(
            nodeid=f"tests/models/test_x.py::{name}", callspec=SimpleNamespace(params=given),
            iter_markers=lambda _kind: iter(marks), get_closest_marker=lambda _kind: slow or None,
        )  # fmt: skip

    single = [test("test_a[1]", x=1), test("test_a[2]", x=2)]
    product = [test("test_b[1-1]", slow=True, x=1, y=1), test("test_b[1-2]", x=1, y=2), test("test_b[2-1]", x=2, y=1),
               test("test_b[2-2]", x=2, y=2)]  # fmt: skip
    assert list(repeats([*single, *product])) == [product[3]]


def test_of_the_slow_tests_of_a_function_some_are_drawn_whatever_their_order_and_one_more_changes_one_at_most():
    function, many = next(iter(DRAWN.items()))

    def tests(numbers):
        return [SimpleNamespace(nodeid=f"{function}[{k}]", get_closest_marker=lambda _kind: True) for k in numbers]

    def drawn(numbers):
        left = {test.nodeid for test in left_to_test_every(tests(numbers))}
        return {test.nodeid for test in tests(numbers)} - left

    few, more = drawn(range(3 * many)), drawn(range(3 * many + 1))
    assert len(few) == len(more) == many
    assert drawn(range(3 * many - 1, -1, -1)) == few
    assert len(few - more) <= 1
    quick = [SimpleNamespace(nodeid=f"{function}[1]", get_closest_marker=lambda _kind: None)]
    assert not list(left_to_test_every(quick))
