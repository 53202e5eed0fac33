"""Quantities in time as numbers: pieces, and sines whose amplitudes are pieces too.

    w(t) = P(t) + sine(t) + sum of A_k(t) sin(omega_k t + phi_k)      P and A_k piecewise polynomials

Sums, products, integrals and derivatives of such are such again, so a sine may be multiplied, gated and integrated
exactly:

    sin a sin b     = (cos(a - b) - cos(a + b))/2
    int A sin(s)    = C cos(s) + S sin(s) + a constant for every piece,     s = omega t + phi
                      C = -A/omega + A''/omega^3 - A''''/omega^5,  S = A'/omega^2 - A'''/omega^4
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fairlead.component.piecewise import DEGREE, FAR, REFERENCE, PiecewisePolynomial, Sine, constant, pieces

SWING = "swing_"
"""What the swings of a wave are called in paths: `velocity.swing_0`."""
QUARTER = math.pi / 2
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Swing:
    """A(t) sin(omega t + phase): a sine whose amplitude changes in time."""

    polynomial: PiecewisePolynomial
    omega: float
    phase: float = 0.0

    @property
    def sine(self) -> Sine:
        """What a kernel multiplies the pieces with."""
        return Sine(1.0 if self.polynomial.terms.any() else 0.0, self.omega, self.phase)

    def __call__(self, t: float) -> float:
        """Value at time t."""
        return self.polynomial(t) * math.sin(self.omega * t + self.phase)


@dataclass(frozen=True)
class Wave:
    """A quantity in time: a piecewise polynomial, one sine that never ends, and sines whose amplitudes change."""

    polynomial: PiecewisePolynomial
    sine: Sine = field(default_factory=Sine)
    swings: tuple[Swing, ...] = ()

    def __call__(self, t: float) -> float:
        """Value at time t."""
        steady = self.polynomial(t) + self.sine.amplitude * math.sin(self.sine.omega * t + self.sine.phase)
        return steady + sum(swing(t) for swing in self.swings)

    def __getattr__(self, name: str) -> Swing:
        """A swing by its name in paths."""
        number = name.removeprefix(SWING)
        if name.startswith(SWING) and number.isdigit() and int(number) < len(self.swings):
            return self.swings[int(number)]
        raise AttributeError(f"a quantity in time has no {name!r}")

    @property
    def is_swinging(self) -> bool:
        """True if there is a sine in it."""
        return self.sine.amplitude != 0 or any(swing.sine.amplitude for swing in self.swings)

    @cached_property
    def borders(self) -> tuple[float, ...]:
        """Instants at which a piece ends, in order."""
        tables = (self.polynomial, *(swing.polynomial for swing in self.swings))
        return tuple(sorted({x for table in tables for x in table.borders}))

    @property
    def parts(self) -> tuple[Swing, ...]:
        """All sines, also the one that never ends."""
        whole = self.sine
        first = (Swing(constant(whole.amplitude), whole.omega, whole.phase),) if whole.amplitude else ()
        return (*first, *self.swings)

    def jumps(self) -> Iterator[tuple[float, float]]:
        """(place, height) of every border, with how far the value jumps there."""
        for x in self.borders:
            height = self.polynomial.jump_at(x)
            height += sum(s.polynomial.jump_at(x) * math.sin(s.omega * x + s.phase) for s in self.swings)
            yield x, height

    def scaled(self, factor: float, offset: float = 0.0) -> Wave:
        """The wave factor * wave + offset."""
        one, swings = self.sine, (Swing(_scaled(s.polynomial, factor), s.omega, s.phase) for s in self.swings)
        sine = Sine(one.amplitude * factor, one.omega, one.phase)
        return Wave(_scaled(self.polynomial, factor, offset), sine, tuple(swings))

    def derivative(self) -> Wave:
        """The rate, piece by piece."""
        one = self.sine
        sine = Sine(one.amplitude * one.omega, one.omega, one.phase + QUARTER)
        swings = []
        for s in self.swings:
            swings.append(Swing(s.polynomial.derivative(), s.omega, s.phase))
            swings.append(Swing(_scaled(s.polynomial, s.omega), s.omega, s.phase + QUARTER))
        return Wave(self.polynomial.derivative(), sine, _gathered(swings))

    def integral(self, start: float) -> Wave:
        """Antiderivative that is zero at `start`; the pieces that do not swing are of degree three at most."""
        one, sine, given = self.sine, Sine(), self.polynomial
        if one.omega == 0:
            given = _scaled(given, 1.0, one.amplitude * math.sin(one.phase))
        elif one.amplitude != 0:
            sine = Sine(one.amplitude / one.omega, one.omega, one.phase - QUARTER)
        swings = _gathered([part for swing in self.swings for part in _integrated(swing)])
        path = _continuous(given.integral(start), swings)
        whole = Wave(path, sine, swings)
        return Wave(_scaled(path, 1.0, -whole(start)), sine, swings)


def polynomial(value: PiecewisePolynomial | Wave | Swing) -> PiecewisePolynomial:
    """The pieces of a table or of a quantity in time; of a swing those of its amplitude."""
    return value if isinstance(value, PiecewisePolynomial) else value.polynomial


def steady(value: float) -> Wave:
    """A wave that never changes."""
    return Wave(constant(value))


def wave(path: PiecewisePolynomial, parts: list[Swing]) -> Wave:
    """The sum of pieces and sines in its normal form: sines in step are one, the first that never ends stands apart."""
    parts, sine = list(_gathered(parts)), Sine()
    for k, part in enumerate(parts):
        if part.omega == 0:
            path = added(path, _scaled(part.polynomial, math.sin(part.phase)))
        elif sine.amplitude == 0 and part.polynomial.never_changes:
            sine = Sine(float(part.polynomial.terms[0, 0]), part.omega, part.phase)
            parts[k] = Swing(constant(0.0), part.omega, part.phase)
    return Wave(path, sine, tuple(p for p in parts if p.omega != 0 and p.sine.amplitude))


def add(a: Wave, b: Wave) -> Wave:
    """The sum of two."""
    return wave(added(a.polynomial, b.polynomial), [*a.parts, *b.parts])


def times(a: Wave, b: Wave) -> Wave:
    """The product of two. Raises OverflowError where a piece would be of a degree above four."""
    path, parts = multiplied(a.polynomial, b.polynomial), []
    parts += [Swing(multiplied(a.polynomial, s.polynomial), s.omega, s.phase) for s in b.parts]
    parts += [Swing(multiplied(b.polynomial, s.polynomial), s.omega, s.phase) for s in a.parts]
    for one in a.parts:
        for other in b.parts:
            both = _scaled(multiplied(one.polynomial, other.polynomial), 0.5)
            parts.append(Swing(both, one.omega - other.omega, one.phase - other.phase + QUARTER))
            parts.append(Swing(both, one.omega + other.omega, one.phase + other.phase - QUARTER))
    return wave(path, parts)


def added(a: PiecewisePolynomial, b: PiecewisePolynomial) -> PiecewisePolynomial:
    """Piece by piece over the borders of both."""
    if len(a.rows) == 1 and not a.terms.any():
        return b
    borders, at, about = _common(a, b)
    return pieces(borders, (_about(a, at, about) + _about(b, at, about)).tolist())


def multiplied(a: PiecewisePolynomial, b: PiecewisePolynomial) -> PiecewisePolynomial:
    """Piece by piece over the borders of both. Raises OverflowError where the degree is too high."""
    borders, at, about = _common(a, b)
    one, other = _about(a, at, about), _about(b, at, about)
    terms = [np.convolve(x, y) for x, y in zip(one, other, strict=True)]
    if any(row[DEGREE + 1 :].any() for row in terms):
        raise OverflowError(f"the product has pieces of a degree above {DEGREE}")
    return pieces(borders, [row[: DEGREE + 1].tolist() for row in terms])


def _common(a: PiecewisePolynomial, b: PiecewisePolynomial) -> tuple[list[float], Floats, Floats]:
    """The borders of both; of every piece between them a place inside, and the reference its terms are about."""
    borders = sorted({x for p in (a, b) for x in p.borders})
    starts = [-FAR, *borders]
    references = [x if x > -FAR else (borders[0] if borders else 0.0) for x in starts]
    inside = [(x + y) / 2 if x > -FAR and y < FAR else (y - 1 if x <= -FAR and y < FAR else x + 1 if x > -FAR else 0.0)
              for x, y in zip(starts, [*borders, FAR], strict=True)]  # fmt: skip
    return borders, np.array(inside), np.array(references)


def _about(p: PiecewisePolynomial, at: Floats, references: Floats) -> Floats:
    """Coefficients (n, DEGREE + 1), about each reference, of the pieces that hold the places `at` (n,)."""
    number = np.clip(np.searchsorted(p.left, at, side="right") - 1, 0, len(p.rows) - 1)
    shift, terms = (references - p.rows[number, REFERENCE])[:, None], p.terms[number]
    made = np.zeros((len(at), DEGREE + 1))
    for power in range(DEGREE, -1, -1):  # Horner's scheme in y = x + shift
        made[:, 1:] = made[:, 1:] * shift + made[:, :-1]
        made[:, :1] = made[:, :1] * shift + terms[:, power : power + 1]
    return made


def _scaled(p: PiecewisePolynomial, factor: float, offset: float = 0.0) -> PiecewisePolynomial:
    made = PiecewisePolynomial(p.rows.copy())
    made.terms[:] *= factor
    made.terms[:, 0] += offset
    return made


def _gathered(parts: list[Swing]) -> tuple[Swing, ...]:
    """Sines that are in step, or against each other, as one; those of no size are left out."""
    found: dict[tuple[float, float], PiecewisePolynomial] = {}
    for part in parts:
        omega, phase, sign = abs(part.omega), part.phase, 1.0
        if part.omega < 0:  # sin(-x) = -sin(x)
            phase, sign = -phase, -1.0
        for known in found:
            turns = (phase - known[1]) / math.pi
            if known[0] == omega and abs(turns - round(turns)) < 1e-14:
                phase, sign = known[1], sign * (-1.0) ** round(turns)
                break
        more = _scaled(part.polynomial, sign)
        found[omega, phase] = added(found[omega, phase], more) if (omega, phase) in found else more
    return tuple(Swing(p, omega, phase) for (omega, phase), p in found.items() if p.terms.any())


def _integrated(swing: Swing) -> Iterator[Swing]:
    """Two sines that make, but for a constant for every piece, the integral of one."""
    rates = [swing.polynomial]
    for _ in range(DEGREE):
        rates.append(rates[-1].derivative())
    w = swing.omega
    cosine = [_scaled(rates[0], -1 / w), _scaled(rates[2], w**-3), _scaled(rates[4], -(w**-5))]
    sine = [_scaled(rates[1], w**-2), _scaled(rates[3], -(w**-4))]
    for terms, phase in ((cosine, swing.phase + QUARTER), (sine, swing.phase)):
        whole = PiecewisePolynomial(terms[0].rows.copy())
        whole.terms[:] = sum(term.terms for term in terms)
        yield Swing(whole, w, phase)


def _continuous(path: PiecewisePolynomial, swings: tuple[Swing, ...]) -> PiecewisePolynomial:
    """The pieces of an integral with what its sines need to go on from piece to piece without a jump."""
    if not swings:
        return path
    levels = [0.0]
    borders = sorted({x for s in swings for x in s.polynomial.borders})
    for x in borders:
        jump = sum(s.polynomial.jump_at(x) * math.sin(s.omega * x + s.phase) for s in swings)
        levels.append(levels[-1] - jump)
    return added(path, pieces(borders, [[level] for level in levels]))
