"""The closed forms of sliding against a numerical integration of the same equation, and against each other."""

import math

import numpy as np
import pytest

from fairlead.analysis.statics.sliding import Piece, along, beyond


def integrated(piece, tension, friction, run, steps=4000):
    """dT/ds = friction (pressed + wall (T - lightened) curvature) - load by Runge and Kutta; the wall is that of T."""

    def slope(value):
        pressing = value - piece.lightened
        pressing = abs(pressing) if piece.all_round else max(pressing, 0.0)
        return friction * (piece.pressed + pressing * piece.curvature) - piece.load

    h = run / steps
    for _ in range(steps):
        a = slope(tension)
        b = slope(tension + h / 2 * a)
        c = slope(tension + h / 2 * b)
        d = slope(tension + h * c)
        tension += h / 6 * (a + 2 * b + 2 * c + d)
    return tension


@pytest.mark.parametrize("seed", range(60))
def test_a_piece_of_any_kind_is_what_integration_gives(seed):
    """A third of these pass through zero tension on the way, where the wall changes and integration has a corner."""
    draw = np.random.default_rng(seed)
    piece = Piece(
        0.0, float(draw.uniform(0.3, 4.0)), float(draw.choice([0.0, 0.4, 1.5])), float(draw.choice([0.0, 15.0, 60.0])),
        float(draw.choice([0.0, -40.0, 25.0])), bool(draw.random() < 0.5), float(draw.choice([0.0, 8.0])),
    )  # fmt: skip
    friction, tension = float(draw.uniform(-0.9, 0.9)), float(draw.uniform(-60, 120))
    run = piece.length * float(draw.choice([-1.0, 1.0]))
    want = integrated(piece, tension, friction, run)
    assert beyond(piece, tension, friction, run) == pytest.approx(want, rel=1e-5, abs=1e-3)


@pytest.mark.parametrize("seed", range(20))
def test_there_and_back_is_where_it_began(seed):
    draw = np.random.default_rng(seed)
    piece = Piece(0.0, 2.0, 0.8, 10.0, -5.0)
    friction, tension = float(draw.uniform(-0.9, 0.9)), float(draw.uniform(20, 120))
    there = beyond(piece, tension, friction, 2.0)
    assert there < 0 or beyond(piece, there, friction, -2.0) == pytest.approx(tension)


def test_along_gives_the_ends_from_either_end():
    piece = Piece(3.0, 5.0, 0.5)
    places = np.linspace(3.0, 5.0, 9)
    outward, inward = along(piece, 100.0, 0.4, places, begin=True), along(piece, 100.0, 0.4, places, begin=False)
    np.testing.assert_allclose(outward, 100 * np.exp(0.2 * (places - 3)))
    np.testing.assert_allclose(inward, 100 * np.exp(0.2 * (places - 5)))


def test_without_tension_and_without_load_nothing_grows():
    assert beyond(Piece(0.0, 2.0, 1.0), 0.0, 0.5, 2.0) == 0.0
    assert beyond(Piece(0.0, 2.0, 1.0, pressed=3.0), 0.0, 0.5, 2.0) == pytest.approx(3 * (math.exp(1.0) - 1))
