"""The error that `compare` shows: relative to how far a signal moves, and of what hardly moves to what moves most."""

from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.analysis.cost.compare import LEAST, _error


class Recorded(dict[str, np.ndarray]):
    """Positions by name at common times, as a result has them."""

    t = np.linspace(0.0, 1.0, 101)

    @property
    def signals(self):
        return [SimpleNamespace(name=name, unit="m") for name in self]

    def match(self, _pattern):
        return list(self)


def test_a_block_that_moves_by_rounding_does_not_make_the_error():
    """A difference of 1e-9 m on a range of 1e-12 m is not an error of a thousand where another block moves by 0.1 m."""
    t = Recorded.t
    right = Recorded(moves=0.1 * t, rests=1e-12 * t)
    found = Recorded(moves=0.1 * t + 1e-4, rests=1e-12 * t + 1e-9)
    error, name = _error(found, right, "*")
    assert (name, error) == ("moves", pytest.approx(1e-4 / 0.1))


def test_a_block_that_should_rest_and_does_not_still_counts():
    """Relative to a thousandth of what moves most, so that 1 mm beside 0.1 m is an error of ten."""
    t = Recorded.t
    error, name = _error(Recorded(moves=0.1 * t, rests=0 * t + 1e-3), Recorded(moves=0.1 * t, rests=0 * t), "*")
    assert (name, error) == ("rests", pytest.approx(1e-3 / (LEAST * 0.1)))
