"""Tables and quantities in time as a user writes them, turned into piecewise polynomials.

A table is a list of [x, y] pairs, a map {x: [...], y: [...], kind: linear|cubic}, or {file: data.csv}.

A quantity in time is a number, or a map of terms that add up:

    constant: 3 N
    ramp: {to: 3 N, over: 1 s, from: 0 N, start: 0 s}
    step: {to: 3 N, at: 1 s, from: 0 N}
    drift: {rate: 0.05 m/s, start: 0 s}
    sine: {amplitude: 1 N, frequency: 2 Hz, phase: 0 deg, offset: 0 N}
    trapezoid: {to: 3 N, start: 0 s, rise: 1 s, stay: 5 s, fall: 1 s, from: 0 N}
    table: as above, with t for x
"""

from __future__ import annotations

import csv
import itertools
import math
import pathlib
from collections.abc import Callable, Mapping, Set
from typing import Any

import numpy as np

from fairlead.component.declare import Table, Waveform
from fairlead.component.piecewise import (
    DEGREE,
    FAR,
    PiecewisePolynomial,
    Sine,
    constant,
    linear_table,
    monotone_cubic_table,
    pieces,
)  # fmt: skip
from fairlead.component.values import Wave
from fairlead.errors import did_you_mean, listing
from fairlead.quantities import si, wanted

MOST_POINTS = 100_000
MOST_BYTES = 10_000_000


def read_table(value: Any, declared: Table, folder: pathlib.Path) -> PiecewisePolynomial:
    """A table in SI. Raises ValueError with what is wrong and what is allowed."""
    if isinstance(value, PiecewisePolynomial):
        return value
    x, y, kind = _points(value, declared.x, declared.y, "x", folder)
    return {"linear": linear_table, "cubic": monotone_cubic_table}[kind](x, y)


def read_waveform(value: Any, declared: Waveform, folder: pathlib.Path) -> Wave | None:
    """A quantity in time, in SI. Raises ValueError."""
    if value is None or isinstance(value, Wave):
        return value
    if not isinstance(value, Mapping):
        return Wave(constant(si(value, declared.unit)))
    if not value:
        raise ValueError(f"nothing is given; allowed are {listing(TERMS)}, or {wanted(declared.unit)}")
    polynomial, sine = constant(0.0), Sine()
    for name, settings in value.items():
        if name not in TERMS:
            raise ValueError(f"there is no waveform {name}. {did_you_mean(str(name), TERMS)} It has {listing(TERMS)}.")
        term = TERMS[name](settings, declared.unit, folder)
        if isinstance(term, tuple):
            term, sine = term
        polynomial = add(polynomial, term)
    return Wave(polynomial, sine)


def _points(value: Any, x_unit: str, y_unit: str, x_name: str, folder: pathlib.Path) -> tuple[Any, Any, str]:
    kind = "linear"
    if isinstance(value, Mapping):
        _only(value, {x_name, "y", "kind", "file"})
        kind = str(value.get("kind", "linear"))
        if kind not in ("linear", "cubic"):
            raise ValueError(f"kind = {kind} is not one of linear, cubic")
        rows = _from_file(value["file"], folder) if "file" in value else _columns(value, x_name)
    else:
        rows = value
    if not isinstance(rows, list) or any(not isinstance(row, list | tuple) or len(row) != 2 for row in rows):
        raise ValueError(f"a table is a list of [{x_name}, y] pairs, or a map with {x_name}, y and kind, or with file")
    if not 2 <= len(rows) <= MOST_POINTS:
        raise ValueError(f"a table has 2 to {MOST_POINTS} points, this one has {len(rows)}")
    x = [si(row[0], x_unit) for row in rows]
    y = [si(row[1], y_unit) for row in rows]
    for before, after in itertools.pairwise(x):
        if not after > before:
            raise ValueError(f"{x_name} must rise from point to point; {after:g} follows {before:g}")
    return np.array(x), np.array(y), kind


def _columns(value: Mapping[str, Any], x_name: str) -> list[list[Any]]:
    x, y = value.get(x_name), value.get("y")
    if not isinstance(x, list) or not isinstance(y, list) or len(x) != len(y):
        raise ValueError(f"{x_name} and y must be lists of the same length")
    return [list(pair) for pair in zip(x, y, strict=True)]


def _from_file(name: Any, folder: pathlib.Path) -> list[list[Any]]:
    """Two columns of a CSV file inside the netlist's folder; a header line is passed over."""
    path = (folder / str(name)).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise ValueError(f"file {name} lies outside the folder of the netlist")
    if not path.is_file():
        raise ValueError(f"there is no file {name} in the folder of the netlist")
    if path.stat().st_size > MOST_BYTES:
        raise ValueError(f"file {name} is larger than {MOST_BYTES} bytes")
    with path.open(encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.reader(stream) if row and not row[0].lstrip().startswith("#")]
    try:
        float(rows[0][0])
    except (ValueError, IndexError):
        rows = rows[1:]
    try:
        return [[float(row[0]), float(row[1])] for row in rows]
    except (ValueError, IndexError) as error:
        raise ValueError(f"file {name} is not two columns of numbers: {error}") from error


def _only(settings: Any, allowed: Set[str], needed: Set[str] = frozenset()) -> None:
    if not isinstance(settings, Mapping):
        raise ValueError(f"expected a map with {listing(sorted(allowed))}")
    for name in settings:
        if name not in allowed:
            raise ValueError(
                f"there is no {name} here. {did_you_mean(str(name), allowed)} It has {listing(sorted(allowed))}."
            )
    for name in sorted(needed - set(settings)):
        raise ValueError(f"{name} is missing; needed are {listing(sorted(needed))}")


def _numbers(settings: Any, **declared: tuple[str, float | None]) -> dict[str, float]:
    """Settings in SI: name -> (unit, default or None when it must be given)."""
    _only(settings, set(declared), {n for n, (_, default) in declared.items() if default is None})
    return {n: si(settings.get(n, default), unit) for n, (unit, default) in declared.items()}


def _positive(settings: dict[str, float], *names: str) -> None:
    for name in names:
        if settings[name] < 0:
            raise ValueError(f"{name} = {settings[name]:g} s must not be negative")


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
    t, y, kind = _points(settings, "s", unit, "t", folder)
    return {"linear": linear_table, "cubic": monotone_cubic_table}[kind](t, y)


def _constant(settings: Any, unit: str, folder: pathlib.Path) -> PiecewisePolynomial:
    return constant(si(settings, unit))


TERMS: dict[str, Callable[[Any, str, pathlib.Path], Any]] = {
    "constant": _constant, "ramp": _ramp, "step": _step, "drift": _drift, "sine": _sine, "trapezoid": _trapezoid,
    "table": _table,
}  # fmt: skip


def add(a: PiecewisePolynomial, b: PiecewisePolynomial) -> PiecewisePolynomial:
    """Piece by piece over the borders of both."""
    if len(a.rows) == 1 and not a.rows[0, 3:].any():
        return b
    borders = sorted({x for p in (a, b) for x in p.rows[1:, 0]})
    starts = [-FAR, *borders]
    references = [x if x > -FAR else (borders[0] if borders else 0.0) for x in starts]
    inside = [(x + y) / 2 if x > -FAR and y < FAR else (y - 1 if x <= -FAR and y < FAR else x + 1 if x > -FAR else 0.0)
              for x, y in zip(starts, [*borders, FAR], strict=True)]  # fmt: skip
    terms = [sum(_about(p, at, r) for p in (a, b)) for at, r in zip(inside, references, strict=True)]
    return pieces(borders, [list(t) for t in terms])


def _about(p: PiecewisePolynomial, at: float, reference: float) -> Any:
    """Coefficients, about `reference`, of the piece that holds `at`."""
    row = p.rows[p.piece_at(at)]
    shifted = np.polynomial.Polynomial(row[3:])(np.polynomial.Polynomial([reference - row[2], 1.0]))
    return np.pad(shifted.coef, (0, DEGREE + 1 - len(shifted.coef)))


def table_schema(declared: Table) -> dict[str, Any]:
    """JSON Schema of a table."""
    number = {"type": ["number", "string"]}
    pairs = {"type": "array", "items": {"type": "array", "items": number, "minItems": 2, "maxItems": 2}}
    column = {"type": "array", "items": number}
    named = {"x": column, "y": column, "kind": {"enum": ["linear", "cubic"]}, "file": {"type": "string"}}
    in_columns = {"type": "object", "properties": named, "additionalProperties": False}
    return {"description": declared.doc, "anyOf": [pairs, in_columns]}


def waveform_schema(declared: Waveform) -> dict[str, Any]:
    """JSON Schema of a quantity in time."""
    terms: dict[str, Any] = {name: {} for name in TERMS}
    named = {"type": "object", "properties": terms, "additionalProperties": False, "minProperties": 1}
    return {
        "description": f"{declared.doc} {wanted(declared.unit)}".strip(),
        "anyOf": [{"type": ["number", "string"]}, named],
    }
