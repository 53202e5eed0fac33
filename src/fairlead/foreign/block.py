"""The block that an FMU is in a model: a controller whose samples are its communication points.

At the point t_k = t_0 + k H the FMU has been brought from t_{k-1} to t_k with the inputs that were given at t_{k-1};
then it gets the inputs of t_k, and its outputs are held until t_{k+1}.

Where the FMU can give and take its state, a run with it can be saved and restored: copies of a block share one process,
and the one that goes on puts its state there first.
"""

from __future__ import annotations

import functools
import inspect
import math
import weakref
from collections.abc import Callable
from typing import Any, ClassVar

from fairlead.component.controller import Controller
from fairlead.component.declare import Input, Output
from fairlead.component.given import Entries, Parameter
from fairlead.foreign.description import Fmu
from fairlead.foreign.process import ForeignProcess
from fairlead.foreign.refusals import ForeignError, Refused
from fairlead.foreign.signals import Signals
from fairlead.foreign.variables import Variable

TIME_LIMIT = 30.0
"""s, of every call; a step of a large model takes some seconds, and a user waits no longer than that for a hang."""
NOT_ALLOWED = "An FMU is foreign code. If you trust it, run with --allow-fmu (in Python: load(..., allow_fmu=True))."


class State:
    """Where the FMU was, kept in its process as long as somebody knows this."""

    def __init__(self, process: ForeignProcess, limit: float) -> None:
        """Keep where it is now. Raises ForeignError."""
        self.token: int = process.ask({"do": "save"}, limit)["token"]
        weakref.finalize(self, process.forget, self.token).atexit = False


class ForeignBlock(Controller, abstract=True):
    """Base of blocks for FMUs; `block_of` makes the class for one."""

    starts = Entries("What is set before the start, of variables and clocks of the FMU.", default=())
    time_limit = Parameter("s", "Longest that one call may take.", default=TIME_LIMIT, above=0)
    _fmu: ClassVar[Fmu]
    _signals: ClassVar[Signals]
    _allowed: ClassVar[bool]
    _process: ForeignProcess
    _state: State | None

    @property
    def _step(self) -> float:
        return float(vars(self)["period"])

    @property
    def _limit(self) -> float:
        return float(vars(self)["time_limit"])

    @property
    def _starts(self) -> dict[str, Any]:
        return dict(vars(self)["starts"])

    def begin(self) -> None:
        """Start the process, and load the FMU there. Raises ForeignError."""
        if not self._allowed:
            raise ForeignError(f"{self._fmu.file.name} is not run. {NOT_ALLOWED}")
        fmu, signals = self._fmu, self._signals
        self._process, self._state, self._points = ForeignProcess(fmu.file.name), None, 0
        self._begin = math.nan
        self._process.occupant = weakref.ref(self)
        opening = {"do": "open", "folder": self._process.folder, "period": self._step,
                   **told_of(fmu, signals), **self._starts}  # fmt: skip
        try:
            self._ask(opening)
        except BaseException:
            self._process.close()
            raise

    def end(self) -> None:
        """End the process."""
        self._process.close()

    def _exchange(self, t: float, inputs: dict[str, float]) -> dict[str, float]:
        """One communication point. Raises ForeignError."""
        self._take_the_process()
        try:
            given = [one.own(inputs[one.name]) for one in self._signals.inputs]
        except Refused as error:
            raise ForeignError(f"{error.what}. {error.way_out}") from None
        if self._points == 0:
            self._begin = t
        now = self._begin + self._points * self._step
        said = self._ask({"do": "step", "to": now, "inputs": given})
        self._points += 1
        found = {}
        for one, value in zip(self._signals.outputs, said["outputs"], strict=True):
            if not math.isfinite(value):
                inside = f" (its {one.variable.name})" if one.variable.name != one.name else ""
                raise ForeignError(f"{self._fmu.file.name} gives {one.name}{inside} = {value}. Look at its inputs, "
                                   "or at the communication step, which is its period.")  # fmt: skip
            found[one.name] = one.scale.si(value)
        return found

    def _ask(self, question: dict[str, Any]) -> dict[str, Any]:
        return self._process.ask(question, self._limit)

    def _take_the_process(self) -> None:
        """Be the one whose state is in the process."""
        other = self._process.occupant()
        if other is self:
            return
        if other is not None:
            other._state = State(self._process, self._limit)
        assert self._state is not None
        self._ask({"do": "load", "token": self._state.token})
        self._process.occupant = weakref.ref(self)

    def __deepcopy__(self, memo: Any) -> ForeignBlock:
        """Another one that goes on from here. Raises ForeignError where the FMU cannot give its state."""
        if not self._fmu.keeps_state:
            raise ForeignError(f"{self._fmu.file.name} cannot give its state (canGetAndSetFMUState), so a run with it "
                               "cannot be saved. Export it with that, or do without save and restore.")  # fmt: skip
        if self._process.occupant() is self:
            self._state = State(self._process, self._limit)
        made = object.__new__(type(self))
        vars(made).update(vars(self))
        return made


def told_of(fmu: Fmu, signals: Signals) -> dict[str, Any]:
    """What the process is told of an FMU: worker.py says what it is."""

    def value(one: Variable) -> list[Any]:
        return [one.kind, one.reference, one.size, one.place, list(one.clocks)]

    return {
        "file": str(fmu.file), "version": fmu.version, "token": fmu.token, "identifier": fmu.identifier,
        "name": fmu.name, "keeps_state": fmu.keeps_state, "events": fmu.events, "splits": fmu.splits,
        "inputs": [value(one.variable) for one in signals.inputs],
        "outputs": [value(one.variable) for one in signals.outputs],
        "clocks": [[one.name, one.reference, one.timing, one.interval, one.shift] for one in fmu.clocks.values()],
        "watched": [[one.reference, list(one.clocks)] for one in fmu.variables.values()
                    if one.kind == "Clock" and one.causality in ("output", "local")],
    }  # fmt: skip


def not_allowed(kind: type) -> str:
    """The file of an FMU that may not run, of a class of block for one; "" for any other class."""
    return kind._fmu.file.name if issubclass(kind, ForeignBlock) and not kind._allowed else ""


@functools.lru_cache(maxsize=256)
def block_of(fmu: Fmu, signals: Signals, *, allowed: bool) -> type[ForeignBlock]:
    """The class of block for an FMU with these signals."""
    declared: dict[str, Any] = {one.name: Input(one.scale.unit, one.description, one.start, signed=True)
                                for one in signals.inputs}  # fmt: skip
    declared |= {one.name: Output(one.scale.unit, one.description) for one in signals.outputs}
    body = {
        "_fmu": fmu,
        "_signals": signals,
        "_allowed": allowed,
        "sample": _sample([one.name for one in signals.inputs]),
    }
    return type("FmuBlock", (ForeignBlock,), {"__module__": __name__, "__doc__": fmu.name, **declared, **body})


def _sample(inputs: list[str]) -> Callable[..., dict[str, float]]:
    """The method that a controller is asked by: its arguments go by the names of signals."""

    def sample(self: ForeignBlock, t: float, **given: float) -> dict[str, float]:
        return self._exchange(t, given)

    by_name = inspect.Parameter.POSITIONAL_OR_KEYWORD
    sample.__signature__ = inspect.Signature([inspect.Parameter(name, by_name) for name in ("self", "t", *inputs)])  # type: ignore[attr-defined]
    return sample
