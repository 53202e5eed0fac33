"""Every value of an array once, as numpy has it."""

import numpy as np
import pytest

from fairlead.component.piecewise import horner
from fairlead.distinct import distinct


@pytest.mark.parametrize("shape", [(0,), (1,), (7,), (40,), (5, 4)])
def test_distinct_values_are_those_of_numpy(shape: tuple[int, ...]) -> None:
    values = np.random.default_rng(3).integers(-4, 5, shape)
    for given in (values, values / 3.0, np.zeros(shape)):
        found = distinct(given)
        assert found.dtype == given.dtype
        assert np.array_equal(found, np.unique(given))


def test_horners_rule_gives_the_bits_of_numpy() -> None:
    rng = np.random.default_rng(5)
    for _ in range(200):
        coefficients, s = rng.standard_normal(5) * 10.0 ** rng.integers(-9, 9, 5), rng.standard_normal(3)
        assert np.array_equal(horner(coefficients, s), np.polynomial.polynomial.polyval(s, coefficients))
