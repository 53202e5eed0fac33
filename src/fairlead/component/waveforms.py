"""Quantities in time as a user writes them: a number, or a map of terms that add up.

    constant: 3 N
    ramp: {to: 3 N, over: 1 s, from: 0 N, start: 0 s}
    step: {to: 3 N, at: 1 s, from: 0 N}
    drift: {rate: 0.05 m/s, start: 0 s}
    sine: {amplitude: 1 N, frequency: 2 Hz, phase: 0 deg, offset: 0 N}
    trapezoid: {to: 3 N, start: 0 s, rise: 1 s, stay: 5 s, fall: 1 s, from: 0 N}
    pulses: {to: 3 N, every: 1 s, wide: 0.2 s, count: 10, rise: 0 s, start: 0 s, from: 0 N}
    product: {of: {ramp: {to: 3 N, over: 1 s}}, times: {step: {to: 2, at: 5 s, from: 1}}}
    gate: {of: {ramp: {to: 3 N, over: 1 s}}, start: 2 s, stop: 5 s}
    table: a table (tables.py), with t for x

Several terms of a kind are a list: `ramp: [{to: 3 N, over: 1 s}, {to: -3 N, over: 1 s, start: 5 s}]`.
"""

from __future__ import annotations

import itertools
import math
import pathlib
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.component.given import Waveform
from fairlead.component.piecewise import DEGREE, FAR, PiecewisePolynomial, Sine, constant, pieces
from fairlead.component.tables import MOST_POINTS, TableError, only, points, si_at
from fairlead.component.values import Wave
from fairlead.errors import did_you_mean, listing
from fairlead.quantities import QuantityError, wanted, written

HIGHEST = DEGREE - 1
"""Degree of the pieces of a product; a velocity is integrated once more."""


def read_waveform(value: Any, declared: Waveform, folder: pathlib.Path) -> Wave | None:
    """A quantity in time, in SI. Raises TableError."""
    if value is None or isinstance(value, Wave):
        return value
    return _wave(value, declared.unit, folder)


def _wave(value: Any, unit: str, folder: pathlib.Path) -> Wave:
    if not isinstance(value, Mapping):
        return Wave(constant(written(value, unit)))
    if not value:
        raise TableError("nothing is given", f"Give {listing(TERMS)}. Or: {wanted(unit)}")
    polynomial: PiecewisePolynomial | None = None
    sine = Sine()
    for path, name, settings in _terms(value):
        try:
            term = TERMS[name](settings, unit, folder)
        except TableError as error:
            raise error.below(*path) from None
        if isinstance(term, tuple):
            if sine.amplitude != 0 and term[1].amplitude != 0:
                raise TableError("there is a sine already", "Add others to the signal of one more source.", path)
            term, sine = term
        polynomial = term if polynomial is None else add(polynomial, term)
    return Wave(constant(0.0) if polynomial is None else polynomial, sine)


def _terms(value: Mapping[str, Any]) -> Iterator[tuple[tuple[str | int, ...], str, Any]]:
    """Path, kind and settings of every term; several of a kind stand in a list."""
    for name, settings in value.items():
        if name not in TERMS:
            near = did_you_mean(str(name), TERMS)
            what = f"there is no such waveform. {near}".rstrip(" .")
            raise TableError(what, f"There are {listing(TERMS)}.", (str(name),), of_name=True)
        if isinstance(settings, list) and settings and (name != "table" or isinstance(settings[0], Mapping)):
            for k, one in enumerate(settings):
                yield (name, k), name, one
        else:
            yield (name,), name, settings


def _numbers(settings: Any, **declared: tuple[str, float | None]) -> dict[str, float]:
    """Settings in SI: name -> (unit, default or None when it must be given)."""
    only(settings, set(declared), {n for n, (_, default) in declared.items() if default is None})
    return {n: si_at(settings.get(n, default), unit, n) for n, (unit, default) in declared.items()}


def _positive(settings: dict[str, float], *names: str) -> None:
    for name in names:
        if settings[name] < 0:
            raise TableError(f" = {settings[name]:g} s is negative", "A time span is zero or more.", (name,))


def _path_of_points(times: list[float], levels: list[float]) -> PiecewisePolynomial:
    """Straight lines through points; two points at one time are a jump."""
    borders, terms = [times[0]], [[levels[0]]]
    for (t0, y0), (t1, y1) in itertools.pairwise(zip(times, levels, strict=True)):
        if t1 > t0:
            terms.append([y0, (y1 - y0) / (t1 - t0)])
            borders.append(t1)
    return pieces(borders, [*terms, [levels[-1]]])


def _ramp(settings: Any, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    s = _numbers(settings, to=(unit, None), over=("s", None), start=("s", 0.0), **{"from": (unit, 0.0)})
    _positive(s, "over")
    return _path_of_points([s["start"], s["start"] + s["over"]], [s["from"], s["to"]])


def _step(settings: Any, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    s = _numbers(settings, to=(unit, None), at=("s", 0.0), **{"from": (unit, 0.0)})
    return pieces([s["at"]], [[s["from"]], [s["to"]]])


def _drift(settings: Any, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    s = _numbers(settings, rate=(f"{unit}/s", None), start=("s", 0.0))
    return pieces([s["start"]], [[0.0], [0.0, s["rate"]]])


def _trapezoid(settings: Any, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    s = _numbers(settings, to=(unit, None), start=("s", 0.0), rise=("s", None), stay=("s", None), fall=("s", None),
                 **{"from": (unit, 0.0)})  # fmt: skip
    _positive(s, "rise", "stay", "fall")
    times = [s["start"]]
    for phase in ("rise", "stay", "fall"):
        times.append(times[-1] + s[phase])
    return _path_of_points(times, [s["from"], s["to"], s["to"], s["from"]])


def _sine(settings: Any, unit: str, folder: pathlib.Path) -> tuple[PiecewisePolynomial, Sine]:
    s = _numbers(settings, amplitude=(unit, None), frequency=("Hz", None), phase=("rad", 0.0), offset=(unit, 0.0))
    return constant(s["offset"]), Sine(s["amplitude"], 2 * math.pi * s["frequency"], s["phase"])


def _table(settings: Any, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    return points(settings, "s", unit, "t", folder)


def _constant(settings: Any, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    return constant(si_at(settings, unit))


def _pulses(settings: Any, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    """Equal pulses, each `wide` from where it begins to rise to where it has fallen."""
    s = _numbers(settings, to=(unit, None), every=("s", None), wide=("s", None), count=("1", None), rise=("s", 0.0),
                 start=("s", 0.0), **{"from": (unit, 0.0)})  # fmt: skip
    _positive(s, "every", "wide", "rise")
    count = int(s["count"])
    if count != s["count"] or not 1 <= count <= MOST_POINTS // 4:
        what = f" = {s['count']:g} is no number of pulses"
        raise TableError(what, f"Give a whole number up to {MOST_POINTS // 4}.", ("count",))
    if not 0 < s["wide"] < s["every"] or 2 * s["rise"] > s["wide"]:
        what = "pulses are narrower than the time between them, and as wide as their rise and fall at least"
        raise TableError(what, "Make wide less than every, and rise at most half of wide.")
    times, levels = [], []
    for k in range(count):
        begin = s["start"] + k * s["every"]
        times += [begin, begin + s["rise"], begin + s["wide"] - s["rise"], begin + s["wide"]]
        levels += [s["from"], s["to"], s["to"], s["from"]]
    return _path_of_points(times, levels)


def _product(settings: Any, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    only(settings, {"of", "times"}, {"of", "times"})
    return times(_piecewise(settings, "of", unit, folder), _piecewise(settings, "times", "1", folder))


def _gate(settings: Any, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    """What it is given between two times, zero before and after."""
    only(settings, {"of", "start", "stop"}, {"of", "stop"})
    start, stop = si_at(settings.get("start", 0.0), "s", "start"), si_at(settings["stop"], "s", "stop")
    if not stop > start:
        raise TableError(f" = {stop:g} s is not after start = {start:g} s", "A gate opens before it shuts.", ("stop",))
    return times(_piecewise(settings, "of", unit, folder), pieces([start, stop], [[0.0], [1.0], [0.0]]))


def _piecewise(settings: Mapping[str, Any], name: str, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    """A quantity in time that has pieces only. Raises TableError for one with a sine."""
    try:
        wave = _wave(settings[name], unit, folder)
    except TableError as error:
        raise error.below(name) from None
    except QuantityError as error:
        raise TableError(f" = {error.what}", error.allowed, (name,)) from None
    if wave.sine.amplitude != 0:
        what = "a sine has no ends, and cannot be a factor"
        raise TableError(what, "Multiply it in a class of your own, or give it as a table.", (name,))
    return wave.polynomial


TERMS: dict[str, Callable[[Any, str, pathlib.Path], Any]] = {
    "constant": _constant, "ramp": _ramp, "step": _step, "drift": _drift, "sine": _sine, "trapezoid": _trapezoid,
    "pulses": _pulses, "product": _product, "gate": _gate, "table": _table,
}  # fmt: skip


def add(a: PiecewisePolynomial, b: PiecewisePolynomial) -> PiecewisePolynomial:
    """Piece by piece over the borders of both."""
    if len(a.rows) == 1 and not a.rows[0, 3:].any():
        return b
    borders, at, about = _common(a, b)
    return pieces(borders, (_about(a, at, about) + _about(b, at, about)).tolist())


def _common(
    a: PiecewisePolynomial, b: PiecewisePolynomial
) -> tuple[list[float], NDArray[np.float64], NDArray[np.float64]]:
    """The borders of both; of every piece between them a place inside, and the reference its terms are about."""
    borders = sorted({x for p in (a, b) for x in p.rows[1:, 0]})
    starts = [-FAR, *borders]
    references = [x if x > -FAR else (borders[0] if borders else 0.0) for x in starts]
    inside = [(x + y) / 2 if x > -FAR and y < FAR else (y - 1 if x <= -FAR and y < FAR else x + 1 if x > -FAR else 0.0)
              for x, y in zip(starts, [*borders, FAR], strict=True)]  # fmt: skip
    return borders, np.array(inside), np.array(references)


def _about(p: PiecewisePolynomial, at: NDArray[np.float64], references: NDArray[np.float64]) -> NDArray[np.float64]:
    """Coefficients (n, DEGREE + 1), about each reference, of the pieces that hold the places `at` (n,)."""
    number = np.clip(np.searchsorted(p.rows[:, 0], at, side="right") - 1, 0, len(p.rows) - 1)
    given = p.rows[number]
    shift = (references - given[:, 2])[:, None]
    made = np.zeros((len(at), DEGREE + 1))
    for power in range(DEGREE, -1, -1):  # Horner's scheme in y = x + shift
        made[:, 1:] = made[:, 1:] * shift + made[:, :-1]
        made[:, :1] = made[:, :1] * shift + given[:, 3 + power : 4 + power]
    return made


def times(a: PiecewisePolynomial, b: PiecewisePolynomial) -> PiecewisePolynomial:
    """The product, piece by piece over the borders of both. Raises TableError where its degree is too high."""
    borders, at, about = _common(a, b)
    one, other = _about(a, at, about), _about(b, at, about)
    terms = [np.convolve(x, y) for x, y in zip(one, other, strict=True)]
    if any(row[HIGHEST + 1 :].any() for row in terms):
        what = f"the product has pieces of a degree above {HIGHEST}"
        raise TableError(what, "Multiply straight lines and levels, such as ramps and steps.")
    return pieces(borders, [row[: DEGREE + 1].tolist() for row in terms])


def waveform_schema(declared: Waveform) -> dict[str, Any]:
    """JSON Schema of a quantity in time."""
    terms: dict[str, Any] = {name: {} for name in TERMS}
    named = {"type": "object", "properties": terms, "additionalProperties": False, "minProperties": 1}
    return {
        "description": f"{declared.doc} {wanted(declared.unit)}".strip(),
        "anyOf": [{"type": ["number", "string"]}, named],
    }
