"""What `integrate` says of equations it cannot solve, and of functions that fail."""

import numpy as np
import pytest

from fairlead.integrate import Run, integrate
from fairlead.integrate.textbook import textbook


def pendulum(index):
    """A point on a circle, with its constraint as one of acceleration, speed or position (index 1, 2, 3)."""

    def equations(y):
        x, z, u, w, force = y
        constraint = {
            3: x * x + z * z - 1,
            2: x * u + z * w,
            1: u * u + w * w - 9.81 * z - force * (x * x + z * z),
        }[index]
        return np.array([u, w, -force * x, -9.81 - force * z, constraint])

    def rhs(t, y, zones, f):
        f[:] = equations(y)

    def jacobian(t, y, zones, J, ft):
        J[:] = np.array([equations(y + 1e-20j * unit).imag / 1e-20 for unit in np.eye(5)]).T

    return textbook([1.0, 0.0, 0.0, 0.0, 0.0], rhs, jacobian, algebraic=[4], unknown_names=(*"xzuw", "force"))


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("index", [2, 3])
def test_a_higher_index_is_refused_by_name(index, engine):
    outcome = integrate(pendulum(index), Run(stop=1.0, engine=engine))
    assert not outcome.ok
    assert "index 2 or 3" in outcome.sentence
    assert outcome.culprits == ("force",)


def test_index_one_is_solved():
    outcome = integrate(pendulum(1), Run(stop=1.0))
    x, z, u, w, _ = outcome.y
    assert outcome.ok
    assert (u * u + w * w) / 2 + 9.81 * z == pytest.approx(0.0, abs=1e-4)
    assert x * x + z * z == pytest.approx(1.0, abs=1e-4)


def test_what_a_function_raises_is_raised():
    def rhs(t, y, f):  # one argument too few
        f[0] = -y[0]

    def jacobian(t, y, zones, J, ft):
        J[0, 0] = -1.0

    with pytest.raises(TypeError, match="rhs"):
        integrate(textbook([1.0], rhs, jacobian), Run(stop=1.0))
