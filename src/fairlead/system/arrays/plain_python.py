"""Controllers in plain Python behind the address of a C function, which compiled code calls at sample times."""

from __future__ import annotations

import copy
import ctypes
import inspect
import math
import traceback
import warnings
from collections.abc import Mapping, Sequence
from types import SimpleNamespace
from typing import Any

from fairlead.component.assembly import Instance
from fairlead.errors import FairleadError, RunWarning, shown
from fairlead.system.arrays.blocks import Block, Memory
from fairlead.system.numbering.unknowns import Numbering

WHOLE, POINTER = ctypes.c_int64, ctypes.c_void_p
Known = tuple[Any, BaseException | None, float]  # its object, what went wrong in it, when
AS_KERNEL = ctypes.CFUNCTYPE(None, WHOLE, POINTER, WHOLE, WHOLE, POINTER, POINTER, POINTER, POINTER)


class CalledController:
    """One controller: its object, where its inputs lie, and what went wrong in it."""

    def __init__(self, block: Block, i: int, numbering: Numbering, memory: Memory) -> None:
        """`i` is the number of the instance in its block."""
        self.instance: Instance = block.instances[i]
        self.failure: BaseException | None = None
        self.failed_at = math.nan
        self.function = AS_KERNEL(self._sampled)
        self._z, self._time = memory["z"], numbering.time
        self._object: Any = None
        self._block, self._i = block, i
        kind = self.instance.type
        self._asked = list(inspect.signature(kind.sample).parameters)[1:]  # type: ignore[attr-defined]
        self._held = {name: block.kernel.structure.parameters.index(f"#{name}") for name in kind.declaration.outputs}

    @property
    def address(self) -> int:
        """Where the function begins."""
        return int(ctypes.cast(self.function, POINTER).value or 0)

    @property
    def complaint(self) -> str:
        """What went wrong, with the author's file and line."""
        assert self.failure is not None
        if isinstance(self.failure, FairleadError):  # it says all there is to say
            return f"t = {self.failed_at:.6g} s: {self.instance.path}: {self.failure}"
        frames = traceback.extract_tb(self.failure.__traceback__)
        file = inspect.getsourcefile(self.instance.type)
        own = [(frame.filename, frame.lineno) for frame in frames if frame.filename == file]
        where, line = own[-1] if own else _of_sample(self.instance)
        place = f" ({where}:{line})" if where else ""
        what = f"{type(self.failure).__name__}: {self.failure}"
        return f"t = {self.failed_at:.6g} s: {self.instance.path}: {what}{place}"

    def known(self) -> Known:
        """A copy of what it knows: of the object, as deep as Python copies."""
        return copy.deepcopy(self._object), self.failure, self.failed_at

    def know(self, what: Known) -> None:
        """Go on from there, on a copy."""
        self._object, (self.failure, self.failed_at) = copy.deepcopy(what[0]), what[1:]

    def end(self) -> None:
        """The run is over. What fails in it is a warning: the results are there."""
        end = getattr(type(self._object), "end", None)
        if not callable(end):  # never begun, or a signal of that name
            return
        try:
            end(self._object)
        except Exception as error:  # noqa: BLE001 - of a user's method, whatever it is
            said = f"{self.instance.path}: {self.instance.type.__name__}.end fails: {type(error).__name__}: {error}"
            warnings.warn(said, RunWarning, stacklevel=2)

    def take_over(self, other: CalledController) -> None:
        """Go on where another one of the same instance was."""
        self._object, self.failure, self.failed_at = other._object, other.failure, other.failed_at

    def _sampled(self, *_: Any) -> None:
        """Take one sample. A failure is kept, and what cannot be known becomes NaN, which ends the run."""
        if self.failure is not None:
            return
        row = self._block.parameters[self._i]
        try:
            values = self._values()
        except BaseException as error:  # noqa: BLE001 - nothing can be raised through compiled code
            self.failure, self.failed_at = error, float(self._z[self._time])
            values = dict.fromkeys(self._held, math.nan)
        for name, column in self._held.items():
            row[column] = values[name]

    def _values(self) -> dict[str, float]:
        if self._object is None:
            self._object = _made(self.instance)
        said = self._object.sample(**{name: self._argument(name) for name in self._asked})
        if not isinstance(said, Mapping):
            said = {next(iter(self._held)): said} if len(self._held) == 1 else {}
        if set(said) != set(self._held):
            raise TypeError(f"sample gives {sorted(said)}, and the outputs are {sorted(self._held)}")
        values = {name: _number(name, value) for name, value in said.items()}
        for name, value in values.items():
            if not math.isfinite(value):
                raise ValueError(f"sample gives {name} = {value}")
        return values

    def _argument(self, name: str) -> Any:
        has, inputs = self.instance.type.declaration, self._block.kernel.structure.inputs
        if name == "t":
            return float(self._z[self._time])
        if name in has.inputs:
            return self._read(inputs.index(f"in:{name}"))
        across = zip(has.ports[name].domain.across, "xv", strict=False)
        return SimpleNamespace(**{said: self._read(inputs.index(f"port:{name}:{kind}")) for (said, _), kind in across})

    def _read(self, j: int) -> float:
        block, i = self._block, self._i
        return float(block.in_coef[i, j] * self._z[block.in_index[i, j]] + block.in_offset[i, j])


def called_controllers(blocks: Sequence[Block], numbering: Numbering, memory: Memory) -> list[CalledController]:
    """All controllers in plain Python, anew; their addresses take the place of kernels in `memory`."""
    found: list[CalledController] = []
    for k, (b, i) in enumerate(memory["sampled"]):
        if blocks[b].instances[i].type.declaration.python:
            if not found:
                memory["sample_kernels"] = memory["sample_kernels"].copy()
            found.append(CalledController(blocks[b], int(i), numbering, memory))
            memory["sample_kernels"][k] = found[-1].address
    return found


def _number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        nothing = "; it returns nothing" if value is None else ""
        raise TypeError(f"sample gives {name} = {shown(repr(value))}, and a number is wanted{nothing}") from None


def _of_sample(instance: Instance) -> tuple[str | None, int]:
    """File and line of the class's `sample`."""
    method = instance.type.sample  # type: ignore[attr-defined]
    return inspect.getsourcefile(method), method.__code__.co_firstlineno


def _made(instance: Instance) -> Any:
    """A fresh object of the class, its parameters as attributes."""
    made = object.__new__(instance.type)
    vars(made).update(instance.values.given)
    made.begin()  # type: ignore[attr-defined]
    return made
