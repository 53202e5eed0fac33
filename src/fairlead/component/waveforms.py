"""Quantities in time as a user writes them: a number, or a map of terms that add up.

    constant: 3 N
    ramp: {to: 3 N, over: 1 s, from: 0 N, start: 0 s}
    step: {to: 3 N, at: 1 s, from: 0 N}
    drift: {rate: 0.05 m/s, start: 0 s}
    sine: {amplitude: 1 N, frequency: 2 Hz, phase: 0 deg, offset: 0 N}
    trapezoid: {to: 3 N, start: 0 s, rise: 1 s, stay: 5 s, fall: 1 s, from: 0 N}
    pulses: {to: 3 N, every: 1 s, wide: 0.2 s, count: 10, rise: 0 s, start: 0 s, from: 0 N}
    product: {of: {ramp: {to: 3 N, over: 1 s}}, times: {step: {to: 2, at: 5 s, from: 1}}}
    gate: {of: {sine: {amplitude: 1 N, frequency: 2 Hz}}, start: 2 s, stop: 5 s}
    table: a table (tables.py), with t for x

Several terms of a kind are a list: `ramp: [{to: 3 N, over: 1 s}, {to: -3 N, over: 1 s, start: 5 s}]`. Whatever is a
quantity in time may be a factor or be gated, also a sine, and a sum of them (wave.py).
"""

from __future__ import annotations

import itertools
import math
import pathlib
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from fairlead.component.given import Waveform
from fairlead.component.piecewise import DEGREE, PiecewisePolynomial, Sine, constant, pieces
from fairlead.component.tables import MOST_POINTS, TableError, only, points, si_at
from fairlead.component.wave import Wave, add, steady, times
from fairlead.errors import did_you_mean, listing
from fairlead.quantities import QuantityError, wanted, written

HIGHEST = DEGREE - 1
"""Degree of the pieces of a product; a velocity is integrated once more."""
CALLED = {"square": "pulses", "rectangle": "pulses", "pulse": "pulses", "cosine": "sine with phase: 90 deg",
          "cos": "sine with phase: 90 deg", "sin": "sine", "sinus": "sine", "harmonic": "sine", "linear": "drift",
          "window": "gate", "multiply": "product", "points": "table", "file": "table with file"}  # fmt: skip
"""What others call a term."""
MOST_SINES = 16
"""In one quantity in time; each is a term of the compiled law, and a product of sines has twice as many as both."""


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
    whole: Wave | None = None
    for path, name, settings in _terms(value):
        try:
            term = TERMS[name](settings, unit, folder)
        except TableError as error:
            raise error.below(*path) from None
        term = term if isinstance(term, Wave) else Wave(term)
        whole = term if whole is None else add(whole, term)
    return _bearable(steady(0.0) if whole is None else whole)


def _bearable(made: Wave) -> Wave:
    """The wave, unless it has too many sines. Raises TableError."""
    if len(made.swings) > MOST_SINES:
        what = f"these are {len(made.swings)} sines and more, counting what products of sines make"
        raise TableError(what, f"At most {MOST_SINES} in one quantity; add others to the signal of one more source.")
    return made


def _terms(value: Mapping[str, Any]) -> Iterator[tuple[tuple[str | int, ...], str, Any]]:
    """Path, kind and settings of every term; several of a kind stand in a list."""
    for name, settings in value.items():
        if name not in TERMS:
            near = f"Did you mean {CALLED[name]}?" if name in CALLED else did_you_mean(str(name), TERMS)
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


def _sine(settings: Any, unit: str, folder: pathlib.Path) -> Wave:
    s = _numbers(settings, amplitude=(unit, None), frequency=("Hz", None), phase=("rad", 0.0), offset=(unit, 0.0))
    return Wave(constant(s["offset"]), Sine(s["amplitude"], 2 * math.pi * s["frequency"], s["phase"]))


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


def _product(settings: Any, unit: str, folder: pathlib.Path) -> Wave:
    only(settings, {"of", "times"}, {"of", "times"})
    return _times(_inner(settings, "of", unit, folder), _inner(settings, "times", "1", folder))


def _gate(settings: Any, unit: str, folder: pathlib.Path) -> Wave:
    """What it is given between two times, zero before and after."""
    only(settings, {"of", "start", "stop"}, {"of", "stop"})
    start, stop = si_at(settings.get("start", 0.0), "s", "start"), si_at(settings["stop"], "s", "stop")
    if not stop > start:
        raise TableError(f" = {stop:g} s is not after start = {start:g} s", "A gate opens before it shuts.", ("stop",))
    return _times(_inner(settings, "of", unit, folder), Wave(pieces([start, stop], [[0.0], [1.0], [0.0]])))


def _inner(settings: Mapping[str, Any], name: str, unit: str, folder: pathlib.Path) -> Wave:
    """A quantity in time inside another."""
    try:
        return _wave(settings[name], unit, folder)
    except TableError as error:
        raise error.below(name) from None
    except QuantityError as error:
        raise TableError(f" = {error.what}", error.allowed, (name,)) from None


def _times(a: Wave, b: Wave) -> Wave:
    """The product; a velocity is integrated once more, so its pieces leave room for that. Raises TableError."""
    try:
        made = times(a, b)
    except OverflowError:
        made = None
    if made is None or made.polynomial.terms[:, HIGHEST + 1 :].any():
        what = f"the product has pieces of a degree above {HIGHEST}"
        raise TableError(what, "Multiply straight lines and levels, such as ramps and steps.")
    return _bearable(made)


TERMS: dict[str, Callable[[Any, str, pathlib.Path], Any]] = {
    "constant": _constant, "ramp": _ramp, "step": _step, "drift": _drift, "sine": _sine, "trapezoid": _trapezoid,
    "pulses": _pulses, "product": _product, "gate": _gate, "table": _table,
}  # fmt: skip


IN_TIME = ("over", "start", "at", "rise", "stay", "fall", "every", "wide", "stop")
IN_ITS_UNIT = ("to", "from", "amplitude", "offset")


def numbers_in(value: Any, unit: str, *path: str) -> Iterator[tuple[tuple[str, ...], float, str]]:
    """Path, value [SI] and unit of every number in a sound quantity in time that is written as terms."""
    for inner, name, settings in _terms(value) if isinstance(value, Mapping) else ():
        at = (*path, *map(str, inner))
        if name == "constant":
            yield at, written(settings, unit), unit
        for word, one in settings.items() if isinstance(settings, Mapping) and name != "table" else ():
            if word in ("of", "times"):
                factor = "1" if word == "times" else unit
                more = ((*at, word), written(one, factor), factor) if not isinstance(one, Mapping) else None
                yield from numbers_in(one, factor, *at, word) if more is None else (more,)
            elif (known := _unit_of(word, unit)) is not None:
                yield (*at, word), written(one, known), known


def _unit_of(word: str, unit: str) -> str | None:
    """The unit of a setting of a term; None for a count."""
    if word in IN_TIME:
        return "s"
    return unit if word in IN_ITS_UNIT else {"frequency": "Hz", "phase": "rad", "rate": f"{unit}/s"}.get(word)


def waveform_schema(declared: Waveform) -> dict[str, Any]:
    """JSON Schema of a quantity in time."""
    terms: dict[str, Any] = {name: {} for name in TERMS}
    named = {"type": "object", "properties": terms, "additionalProperties": False, "minProperties": 1}
    return {
        "description": f"{declared.doc} {wanted(declared.unit)}".strip(),
        "anyOf": [{"type": ["number", "string"]}, named],
    }
