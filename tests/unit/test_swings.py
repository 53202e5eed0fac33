"""What sines are taken of that no error of a step knows: found in guards and in outputs that feed something."""

import pytest
import sympy

from fairlead.component.symbols import sine, symbol
from fairlead.kernels.structure import OF_GUARD
from fairlead.kernels.swings import by_place, swings

X, V, T, U, P = (symbol(text) for text in ("port:a:x", "port:a:v", "t", "in:u", "p:pitch"))
OMEGA = symbol(sine("value", "omega"))
INPUTS = ["port:a:x", "port:a:v", "port:a:a", "t", "in:u"]


def found(guards=(), **outputs):
    """Angles by what has them."""
    return [(name, angle) for name, angle in swings(guards, outputs, INPUTS, {sine("value", "omega")})]


@pytest.mark.parametrize(
    ("value", "angle"),
    [
        (sympy.sin(P * X) - 0.5, P * X),
        (2 * V * sympy.cos(3 * X + P + 1), 3 * X),
        (sympy.tan(U**2 - T), U**2 - T),
        (sympy.sin(sympy.Abs(X)), sympy.Abs(X)),
    ],
)
def test_what_changes_in_an_angle_is_told_without_what_is_fixed(value, angle):
    assert found([value]) == [(OF_GUARD, angle)]
    assert found(signal=value) == [("signal", angle)]


@pytest.mark.parametrize(
    "value",
    [
        sympy.sin(P),  # nothing changes
        P * sympy.sin(OMEGA * T + 1),  # its period is known
        sympy.sin(symbol("port:a:a")),  # known only after the forces
        sympy.sin(100 * sympy.sign(X)),  # it jumps, and no shorter step would help
        sympy.exp(X) - V,
    ],
)
def test_of_others_nothing_is_asked(value):
    assert found([value], signal=value) == []


def test_an_angle_that_several_read_is_told_once_and_an_output_that_feeds_nothing_not_at_all():
    shared = sympy.sin(X) + sympy.cos(X + P)
    assert found([shared], signal=shared, other=sympy.sin(2 * X), alone=None) == [(OF_GUARD, X), ("other", 2 * X)]


@pytest.mark.parametrize(
    ("zones", "asked"),
    [
        ([], []),
        ([["signal"], []], ["signal"]),
        ([["signal"], [OF_GUARD]], [OF_GUARD]),
        ([[OF_GUARD], ["signal"]], [OF_GUARD]),
        ([["signal", "other"], ["signal"]], ["signal", "other"]),
    ],
)
def test_where_zones_have_their_angles_in_different_things_they_are_asked_for_in_any_case(zones, asked):
    assert by_place(zones) == asked
