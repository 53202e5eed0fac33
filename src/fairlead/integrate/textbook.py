"""A problem from plain functions: for tests, for trying a method, for users without a netlist.

    def rhs(t, y, zones, f): f[0] = -y[0]
    problem = textbook(initial=[1.0], rhs=rhs, jacobian=..., compile=True)

The functions write into their last argument(s):

    rhs(t, y, zones, f)            jacobian(t, y, zones, J, ft)   J[n, n], or J[nnz] with `pattern`
    mass(zones, M)                 guards(t, y, zones, g)
    switch(t, y, zones, fired)     slip(t, y, zones, r) -> how many rows hold
    next_time(t, zones)            at_time(t, y, zones) -> 1 if anything changed
    outputs(t, y, zones, out)

`switch` changes `zones` (and y, for a jump) in place. With compile=True numba compiles them, and a
step costs what it costs in a real model; without, they are called back in Python: any object may be
used, slowly, and an exception in one of them ends the run and is raised.
"""

from __future__ import annotations

import ctypes
import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fairlead.integrate.facts import Plain
from fairlead.integrate.problem import Booleans, Bytes, Floats, Integers, Pattern, Run

Law = Callable[..., Any]


@dataclass(frozen=True, eq=False)
class TextbookProblem(Plain):
    """A `Problem` whose callbacks came from plain functions; see the module docstring."""

    callbacks: Mapping[str, int]
    initial: Floats
    pattern: Pattern
    mass_pattern: Pattern
    zones: Integers
    """At the start; of an instance live memory, and `context` its address."""
    differential: Booleans
    quadrature: Booleans
    absolute: Floats
    relative: Floats
    cap: Floats
    guard_tolerance: Floats
    guard_machine: Integers
    n_outputs: int
    unknown_names: Sequence[str]
    machine_names: Sequence[str]
    guard_names: Sequence[str]
    names_of_zones: Mapping[int, Sequence[str]]
    failures: list[BaseException] = field(default_factory=list)
    keep_alive: Any = field(default=None, repr=False)
    context: int = 0

    @property
    def room(self) -> int:
        """Bytes of the zones."""
        return 8 * len(self.zones)

    def instance(self, run: Run, piece: Bytes | None = None) -> TextbookProblem:
        """The problem with zones of its own; the weights are those that were given, whatever accuracy is asked for."""
        live = self.zones.copy() if piece is None else piece.view(np.int64)
        live[:] = self.zones
        return dataclasses.replace(self, zones=live, context=int(live.ctypes.data))

    def remembered(self) -> None:
        """Nothing: plain functions have no state."""

    def remind(self, known: None) -> None:
        """Nothing."""

    def zone_names(self, machine: int) -> Sequence[str]:
        """Names of the zones of one machine."""
        if machine in self.names_of_zones:
            return self.names_of_zones[machine]
        return [str(number) for number in range(16)]

    def raise_if_failed(self) -> None:
        """Raise the first exception a Python callback ended with, if any."""
        if self.failures:
            raise self.failures[0]


def full_pattern(n: int) -> Pattern:
    """The pattern of a matrix that may be full."""
    return Pattern(np.arange(0, n * n + 1, n, dtype=np.int64), np.tile(np.arange(n, dtype=np.int64), n))


def textbook(
    initial: Sequence[float],
    rhs: Law,
    jacobian: Law,
    mass: Law | None = None,
    *,
    guards: Law | None = None,
    switch: Law | None = None,
    slip: Law | None = None,
    next_time: Law | None = None,
    at_time: Law | None = None,
    outputs: Law | None = None,
    n_outputs: int = 0,
    zones: Sequence[int] = (),
    guard_machine: Sequence[int] = (),
    guard_tolerance: float | Sequence[float] = 1e-9,
    algebraic: Sequence[int] = (),
    quadrature: Sequence[int] = (),
    absolute: float | Sequence[float] = 1e-6,
    relative: float | Sequence[float] = 1e-6,
    cap: float | Sequence[float] = np.inf,
    pattern: Pattern | None = None,
    mass_pattern: Pattern | None = None,
    unknown_names: Sequence[str] = (),
    machine_names: Sequence[str] = (),
    guard_names: Sequence[str] = (),
    zone_names: Mapping[int, Sequence[str]] | None = None,
    compile: bool = False,
) -> TextbookProblem:
    """Build a problem; `algebraic` and `quadrature` are positions in y.

    Without `mass`, M is one for differential unknowns. Patterns default to full matrices (the mass to
    a diagonal when `mass` is not given); with a pattern given, the function fills its entries instead
    of a square array.
    """
    n, ng, nz = len(initial), len(guard_machine), len(zones)
    differential = np.ones(n, dtype=bool)
    differential[list(algebraic)] = False
    depends = np.zeros(n, dtype=bool)
    depends[list(quadrature)] = True
    if mass is None:
        where = np.flatnonzero(differential)
        starts = np.concatenate([[0], np.cumsum(differential)]).astype(np.int64)
        mass_pattern, mass = Pattern(starts, where.astype(np.int64)), _ones
    laws = {
        "rhs": rhs, "jacobian": jacobian, "mass": mass, "guards": guards, "switch": switch, "slip": slip,
        "next_time": next_time, "at_time": at_time, "outputs": outputs,
    }  # fmt: skip
    given = {name: law for name, law in laws.items() if law is not None}
    sizes = _Sizes(n, ng, nz, n_outputs, pattern, mass_pattern)
    failures: list[BaseException] = []
    keep: Any
    if compile:
        from fairlead.integrate.textbook_compiled import compile_laws

        keep, addresses = compile_laws(given, sizes)
    else:
        keep, addresses = _python_callbacks(given, sizes, failures)

    def each(value: float | Sequence[float], length: int) -> Floats:
        return np.broadcast_to(np.asarray(value, dtype=np.float64), (length,)).copy()

    return TextbookProblem(
        callbacks=addresses,
        initial=np.array(initial, dtype=np.float64),
        pattern=pattern or full_pattern(n),
        mass_pattern=mass_pattern or full_pattern(n),
        zones=np.array(zones, dtype=np.int64),
        differential=differential,
        quadrature=depends,
        absolute=each(absolute, n),
        relative=each(relative, n),
        cap=each(cap, n),
        guard_tolerance=each(guard_tolerance, ng),
        guard_machine=np.array(guard_machine, dtype=np.int64),
        n_outputs=n_outputs,
        unknown_names=tuple(unknown_names) or tuple(f"y[{i}]" for i in range(n)),
        machine_names=tuple(machine_names) or tuple(f"machine {i}" for i in range(nz)),
        guard_names=tuple(guard_names) or tuple(f"guard {i}" for i in range(ng)),
        names_of_zones=dict(zone_names or {}),
        failures=failures,
        keep_alive=keep,
    )


@dataclass(frozen=True)
class _Sizes:
    n: int
    guards: int
    zones: int
    outputs: int
    pattern: Pattern | None
    mass_pattern: Pattern | None


def _ones(zones: Integers, values: Floats) -> None:
    values[:] = 1.0


_D = ctypes.POINTER(ctypes.c_double)
_I = ctypes.POINTER(ctypes.c_int64)
_SIGNATURES: dict[str, tuple[Any, ...]] = {
    "rhs": (None, _I, ctypes.c_double, _D, _D),
    "jacobian": (None, _I, ctypes.c_double, _D, _D, _D),
    "mass": (None, _I, _D),
    "guards": (None, _I, ctypes.c_double, _D, _D),
    "switch": (ctypes.c_int64, _I, ctypes.c_double, _D, _I, ctypes.c_int64),
    "slip": (ctypes.c_int64, _I, ctypes.c_double, _D, _D),
    "next_time": (ctypes.c_double, _I, ctypes.c_double),
    "at_time": (ctypes.c_int64, _I, ctypes.c_double, _D),
    "outputs": (None, _I, ctypes.c_double, _D, _D),
}


def _python_callbacks(
    laws: Mapping[str, Law], sizes: _Sizes, failures: list[BaseException]
) -> tuple[Any, dict[str, int]]:
    """C callbacks into Python; a failure leaves nan behind, so that the loop stops, and is kept."""
    n = sizes.n

    def view(pointer: Any, length: int) -> np.ndarray:
        if length == 0:
            return np.zeros(0)
        return np.ctypeslib.as_array(pointer, (length,))

    def live(context: Any) -> Integers:
        """The zones of the run, whose address is the context."""
        return np.zeros(0, np.int64) if sizes.zones == 0 else np.ctypeslib.as_array(context, (sizes.zones,))

    def matrix(pointer: Any, pattern: Pattern | None) -> np.ndarray:
        if pattern is not None:
            return view(pointer, len(pattern.rows))
        return view(pointer, n * n).reshape(n, n).T

    def fill(law: Law, length: int) -> Callable[..., None]:
        return lambda c, t, y, out: law(t, view(y, n), live(c), view(out, length))

    def jacobian(c: Any, t: float, y: Any, values: Any, ft: Any) -> None:
        into = matrix(values, sizes.pattern)
        into[...] = 0.0
        view(ft, n)[:] = 0.0
        laws["jacobian"](t, view(y, n), live(c), into, view(ft, n))

    def mass(c: Any, values: Any) -> None:
        into = matrix(values, sizes.mass_pattern)
        into[...] = 0.0
        laws["mass"](live(c), into)

    def switch(c: Any, t: float, y: Any, fired: Any, count: int) -> int:
        zones = live(c)
        before = zones.copy()
        laws["switch"](t, view(y, n), zones, view(fired, count))
        return int(np.count_nonzero(before != zones))

    bodies: dict[str, Callable[..., Any]] = {
        "rhs": fill(laws["rhs"], n),
        "jacobian": jacobian,
        "mass": mass,
        "guards": fill(laws.get("guards", _ones), sizes.guards),
        "switch": switch,
        "slip": lambda c, t, y, r: int(laws["slip"](t, view(y, n), live(c), view(r, n))),
        "next_time": lambda c, t: float(laws["next_time"](t, live(c))),
        "at_time": lambda c, t, y: int(laws["at_time"](t, view(y, n), live(c))),
        "outputs": fill(laws.get("outputs", _ones), sizes.outputs or n),
    }

    def safely(name: str) -> Callable[..., Any]:
        def call(*arguments: Any) -> Any:
            try:
                return bodies[name](*arguments)
            except BaseException as failure:  # noqa: BLE001, ctypes would print and lose it, Ctrl-C included
                failures.append(failure)
                if name in ("rhs", "jacobian", "guards"):
                    arguments[3][0] = np.nan
                return 0

        return call

    keep = {name: ctypes.CFUNCTYPE(*_SIGNATURES[name])(safely(name)) for name in laws}
    return keep, {name: ctypes.cast(function, ctypes.c_void_p).value or 0 for name, function in keep.items()}
