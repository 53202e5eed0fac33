"""Textbook laws compiled by numba to C functions (imported only when asked for)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numba
from numba import carray, types

_I, _D = types.CPointer(types.int64), types.CPointer(types.float64)
_d, _i, _v = types.float64, types.int64, types.void
_FIELD = _v(_I, _d, _D, _D)
_SIGNATURES = {
    "rhs": _FIELD, "jacobian": _v(_I, _d, _D, _D, _D), "mass": _v(_I, _D), "guards": _FIELD,
    "switch": _i(_I, _d, _D, _I, _i), "slip": _i(_I, _d, _D, _D), "next_time": _d(_I, _d),
    "at_time": _i(_I, _d, _D), "outputs": _FIELD,
}  # fmt: skip


def compile_laws(laws: Mapping[str, Callable[..., Any]], sizes: Any) -> tuple[Any, dict[str, int]]:
    """Compile each law behind its C signature; the functions to keep alive, and their addresses."""
    n, nz = sizes.n, sizes.zones
    square = sizes.pattern is None
    entries = n * n if square else len(sizes.pattern.rows)
    mass_square = sizes.mass_pattern is None
    mass_entries = n * n if mass_square else len(sizes.mass_pattern.rows)
    law = {name: numba.njit(error_model="numpy")(given) for name, given in laws.items()}

    def field(function: Callable[..., Any], length: int) -> Callable[..., Any]:
        def call(ctx: Any, t: float, y: Any, out: Any) -> None:
            function(t, carray(y, n), carray(ctx, nz), carray(out, length))

        return call

    bodies: dict[str, Callable[..., Any]] = {
        "rhs": field(law["rhs"], n),
        "jacobian": _jacobian(law["jacobian"], n, nz, entries, square),
        "mass": _mass(law["mass"], n, nz, mass_entries, mass_square),
    }
    if "guards" in law:
        bodies["guards"] = field(law["guards"], sizes.guards)
    if "outputs" in law:
        bodies["outputs"] = field(law["outputs"], sizes.outputs)
    makers = {"switch": _switch, "slip": _slip, "next_time": _next_time, "at_time": _at_time}
    for name, make in makers.items():
        if name in law:
            bodies[name] = make(law[name], n, nz)
    keep = {name: numba.cfunc(_SIGNATURES[name], error_model="numpy")(body) for name, body in bodies.items()}
    return keep, {name: int(function.address) for name, function in keep.items()}


def _jacobian(law: Any, n: int, nz: int, entries: int, square: bool) -> Callable[..., Any]:
    def into_square(ctx: Any, t: float, y: Any, values: Any, ft: Any) -> None:
        flat, rate = carray(values, entries), carray(ft, n)
        flat[:] = 0.0
        rate[:] = 0.0
        law(t, carray(y, n), carray(ctx, nz), flat.reshape((n, n)).T, rate)

    def into_pattern(ctx: Any, t: float, y: Any, values: Any, ft: Any) -> None:
        rate = carray(ft, n)
        rate[:] = 0.0
        law(t, carray(y, n), carray(ctx, nz), carray(values, entries), rate)

    return into_square if square else into_pattern


def _mass(law: Any, n: int, nz: int, entries: int, square: bool) -> Callable[..., Any]:
    def into_square(ctx: Any, values: Any) -> None:
        flat = carray(values, entries)
        flat[:] = 0.0
        law(carray(ctx, nz), flat.reshape((n, n)).T)

    def into_pattern(ctx: Any, values: Any) -> None:
        law(carray(ctx, nz), carray(values, entries))

    return into_square if square else into_pattern


def _switch(law: Any, n: int, nz: int) -> Callable[..., Any]:
    def call(ctx: Any, t: float, y: Any, fired: Any, count: int) -> int:
        law(t, carray(y, n), carray(ctx, nz), carray(fired, count))
        return 1

    return call


def _slip(law: Any, n: int, nz: int) -> Callable[..., Any]:
    def call(ctx: Any, t: float, y: Any, r: Any) -> int:
        return law(t, carray(y, n), carray(ctx, nz), carray(r, n))

    return call


def _next_time(law: Any, n: int, nz: int) -> Callable[..., Any]:
    def call(ctx: Any, t: float) -> float:
        return law(t, carray(ctx, nz))

    return call


def _at_time(law: Any, n: int, nz: int) -> Callable[..., Any]:
    def call(ctx: Any, t: float, y: Any) -> int:
        return law(t, carray(y, n), carray(ctx, nz))

    return call
