"""Derivatives that are remembered part by part, and what is told by numbers at a random place."""

import numpy as np
import pytest
import sympy

from fairlead.component.registry import known_types
from fairlead.component.symbols import symbol
from fairlead.component.trace import trace
from fairlead.component.values import variant_of
from fairlead.kernels.derivative import derivative, symbols_in
from fairlead.kernels.in_floats import differs, varies
from fairlead.testing.samples import families, sample

X, Y, Z = (symbol(f"port:{name}:x") for name in "abc")
LAWS = (
    X,
    Y,
    sympy.Integer(3),
    X + Y,
    3 * X * Y**2,
    X**Y,
    2**X,
    X / (Y - Z),
    sympy.exp(-(X / Y) ** 2) * Z,
    sympy.tanh(X - Y) * sympy.Abs(X),
    sympy.sqrt(X**2 + Y**2) - 0.5 * X,
    sympy.Max(X, Y) * X,
    sympy.atan(X * Y),
    sympy.sin(X) * sympy.cos(X) / sympy.tan(Y) + sympy.log(X),
    (X + Y) * (X - Y) * (X + 2 * Z) ** 3,
    sympy.sign(X),
)


@pytest.mark.parametrize("expression", LAWS, ids=str)
def test_a_derivative_has_the_form_that_sympy_gives_it(expression):
    assert symbols_in(expression) == expression.free_symbols
    for by in (X, Y, Z):
        assert sympy.srepr(derivative(expression, by)) == sympy.srepr(sympy.diff(expression, by))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["PositionServo", "LoopedCore", "Contact"])
def test_so_have_those_of_laws_of_the_library(name):
    member, words = next(iter(families(known_types()[name])))
    for zone in trace(variant_of(sample(member, np.random.default_rng(7), words, True))).zones.values():
        for value in [*zone.flows.values(), *zone.own.values(), *zone.outputs.values()]:
            for by in value.free_symbols:
                assert sympy.srepr(derivative(value, by)) == sympy.srepr(sympy.diff(value, by))


SAME = (
    ((X + Y) * (X - Y), X**2 - Y**2),
    ((X + Y) ** 6, sympy.expand((X + Y) ** 6)),
    (1e20 * ((X + Y) * Z - X * Z - Y * Z), sympy.S.Zero),
    (sympy.exp(X + Y) - sympy.exp(X) * sympy.exp(Y), sympy.S.Zero),
    ((1e8 + X) ** 2 - 1e16 - 2e8 * X, X**2),
)


@pytest.mark.parametrize(("one", "other"), SAME)
def test_what_is_the_same_when_it_is_written_out_is_never_said_to_differ(one, other):
    assert not differs(one, other)


def test_what_differs_is_seen_where_it_has_numbers():
    assert differs(X + Y, X - Y)
    assert differs(X * Y, X * Y + 1e-3)
    assert differs(sympy.tanh(X), sympy.atan(X))
    assert not differs(sympy.sign(X), Y)  # no number is known of it
    assert not differs(1 / (X - X * 1.0), Y)  # nor here


def test_a_value_that_reads_a_difference_alone_does_not_vary_with_both():
    k = symbol("p:#k")
    assert not varies(k * (X - Y) + sympy.tanh(Y - X) * Z, [X, Y])
    assert not varies(X**2 - 2 * X * Y + Y**2, [X, Y])
    assert varies(k * (X - Y) + 1e-3 * Y, [X, Y])
    assert varies(X - Y, [X])
