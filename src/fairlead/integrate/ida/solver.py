"""SUNDIALS IDA as the `ida` engine uses it: one object per restart, its callbacks in compiled code.

Linear systems are solved by GMRES, preconditioned by the exact factors of cj M - J that `rodas` would use
(sparse, in the planned order, or full when small), so that one iteration of GMRES solves them. The direct
solvers of the package will not do. Measured with scikit-sundae 1.2 (SUNDIALS 7.9):

1. Its sparse one (SuperLU_MT) loses 10 to 45 kB of memory per factorisation, and frees memory twice when an
   object is dropped that was started but has not factorised yet, which ends the process.
2. Its dense and band ones take the Jacobian as a full array of Python, whatever its pattern.

J and its factors are made afresh for every iteration of Newton, which then needs one: compiled, they cost less than
a call of Python, and what an old J leaves in the solution keeps the order of IDA down. The transistor amplifier
took 250 000 steps that way at an accuracy of 1e-6, and takes 4300.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from fairlead.errors import UsageError
from fairlead.integrate.codes import DONE, SINGULAR
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.problem import Floats, Integers, Status

ROOT_FOUND = 2
"""The status of IDA for a step that ends at a root."""
CLOSEST = 4 * float(np.finfo(float).eps)
"""IDA refuses a way below 2 eps (|t| + |stop|), its IDA_TOO_CLOSE: two samples that rounding alone parts."""
WARNINGS = "SUNLOGGER_WARNING_FILENAME"
"""Where the logger of SUNDIALS writes warnings; empty for nowhere."""


class Refused(Exception):
    """A matrix could not be factorised; raised through IDA, so that it is left at once."""

    def __init__(self, status: Status) -> None:
        super().__init__(status)
        self.status = status


@dataclass(frozen=True)
class Step:
    """What one internal step of IDA led to."""

    t: float
    y: Floats
    rate: Floats
    rooted: Integers
    """Guards that rose through zero at t."""


def require_package() -> Any:
    """The module sksundae.ida; raises UsageError with the cure when it cannot be imported."""
    try:
        return importlib.import_module("sksundae.ida")
    except ImportError as missing:
        raise UsageError(
            f"The engine ida needs the package scikit-sundae, which cannot be imported ({missing}).\n"
            "    Install it with  pip install 'fairlead[ida]', or choose run.engine: rodas."
        ) from None


class Solver:
    """One IDA object after the other, for the memory of one run."""

    def __init__(self, memory: Memory, kernels: Mapping[str, Callable[..., int]]) -> None:
        """Nothing runs yet; `kernels` are the functions of ida/kernels.py."""
        self.package = require_package()
        self.memory, self.address, self.kernels = memory, memory.address, kernels
        self.n_guards = int(memory.number["n_guards"])
        self.no_root = np.zeros(0, np.int64)
        self.object: Any = None

    @property
    def running(self) -> bool:
        """True from a start to the next failure."""
        return self.object is not None

    def start(self, t: float, y: Floats, rate: Floats, **options: Any) -> None:
        """Start from (t, y, y'), which must be consistent; `options` are those of IDA."""
        if self.n_guards > 0:
            options |= {"eventsfn": self._events(), "num_events": self.n_guards}
        with _silence(), _no_warnings():
            self.object = self.package.IDA(
                self._residual, linsolver="gmres", precond=self.package.IDAPrecond(None, self._solve),
                jactimes=self.package.IDAJacTimes(self._prepare, self._multiply), **options,
            )  # fmt: skip
            self.object.init_step(t, y, rate)

    def step(self, stop: float) -> Step | None:
        """One internal step that does not pass `stop`; None if IDA cannot make one."""
        if stop - self.memory.number["t"] <= CLOSEST * abs(stop):
            array = self.memory.array
            return Step(stop, array["y"].copy(), array["slope"].copy(), self.no_root)
        try:
            with _silence():
                made = self.object.step(stop, "onestep", stop)
        except KeyError:  # the package has no name for some of IDA's refusals
            self.object = None
            return None
        except BaseException:
            self.object = None  # left in the middle of a step
            raise
        if not made.success or not made.t > self.memory.number["t"]:
            self.object = None
            return None
        rooted = self.no_root
        if made.status == ROOT_FOUND:
            rooted = np.flatnonzero(made.i_events[-1] > 0).astype(np.int64)
        return Step(float(made.t), made.y, made.yp, rooted)

    def _residual(self, t: float, y: Floats, rate: Floats, r: Floats) -> None:
        self.kernels["residual"](self.address, t, y.ctypes.data, rate.ctypes.data, r.ctypes.data)

    def _prepare(self, t: float, y: Floats, rate: Floats, r: Floats, cj: float) -> None:
        status = self.kernels["prepare"](self.address, t, y.ctypes.data, cj)
        if status != DONE:  # what is not SINGULAR asks for other pivots
            raise Refused(Status.SINGULAR if status == SINGULAR else Status.REPLAN)

    def _solve(self, t: float, y: Floats, rate: Floats, r: Floats, b: Floats, x: Floats, cj: float,
               tolerance: float) -> None:  # fmt: skip
        self.kernels["solve_prepared"](self.address, b.ctypes.data, x.ctypes.data)

    def _multiply(self, t: float, y: Floats, rate: Floats, r: Floats, v: Floats, product: Floats, cj: float) -> None:
        self.kernels["multiply"](self.address, cj, v.ctypes.data, product.ctypes.data)

    def _events(self) -> Callable[..., None]:
        """The root functions, a function of its own for each object: the package keeps what it found on it."""

        def guards(t: float, y: Floats, rate: Floats, g: Floats) -> None:
            self.kernels["guards"](self.address, t, y.ctypes.data, g.ctypes.data)

        guards.direction = [1] * self.n_guards  # type: ignore[attr-defined]
        return guards


@contextlib.contextmanager
def _no_warnings() -> Iterator[None]:
    """What is made meanwhile gives no warnings of SUNDIALS, which go to the stdout of the process, below Python's.

    The one that comes with every start is of root functions that stay at zero over the first step: the guards of
    contacts at rest, say. A variable of the environment that is set already stands: SUNLOGGER_WARNING_FILENAME names a
    file for them (SUNDIALS 7.9 documentation, "Status and error logging").
    """
    if WARNINGS in os.environ:
        yield
        return
    os.environ[WARNINGS] = ""
    try:
        yield
    finally:
        os.environ.pop(WARNINGS, None)


def _silence() -> contextlib.redirect_stdout[io.StringIO]:
    """The package prints what SUNDIALS has to say about a failure; the run ends with a sentence of its own."""
    return contextlib.redirect_stdout(io.StringIO())
