"""Functions of the loop as plain Python, on the memory of machine code: nothing is compiled, and indices are checked.

What a function calls is plain as well, and a struct has the fields of its owner alone.
"""

from __future__ import annotations

import ctypes
import functools
import importlib
import sys
import types
from collections.abc import Callable
from typing import Any

import numpy as np

from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.memory.layout import LAYOUT

_made: dict[int, Any] = {}
_scopes: dict[int, dict[str, Any]] = {}


def plain_room(name: str, *owners: str) -> Callable[..., Any]:
    """call(memory, ...) of a function by its name, such as "events.chatter.block", given these structs; "" is all."""
    module, _, function = name.rpartition(".")
    made = _plain(getattr(importlib.import_module(f"fairlead.integrate.{module}"), function))

    def call(at: Memory, *arguments: Any) -> Any:
        every = _Owner(at.struct.view(LAYOUT)[0])
        structs = [functools.reduce(getattr, owner.split("."), every) if owner else every for owner in owners]
        addresses = [one.ctypes.data if isinstance(one, np.ndarray) else one for one in arguments]
        with np.errstate(all="ignore"):  # as in compiled code
            return made(*structs, *addresses)

    return call


def switching(at: Memory, switch: Callable[[float, list[int]], None]) -> Any:
    """Have zones of this memory changed by switch(t, guards that fired). Keep what is returned."""

    def called(_c: int, t: float, _y: int, at_fired: int, count: int) -> int:
        switch(t, indices(at_fired, count).tolist())
        return count

    kept = ctypes.CFUNCTYPE(ctypes.c_int64, *_FIELD, ctypes.c_int64)(called)
    at.number["call_switch"] = ctypes.cast(kept, ctypes.c_void_p).value
    return kept


class _Owner:
    """A struct, by the names of its fields."""

    def __init__(self, record: Any) -> None:
        vars(self)["record"] = record

    def __getattr__(self, name: str) -> Any:
        value = self.record[name]
        if isinstance(value, np.void):
            return _Owner(value)
        return int(value) if isinstance(value, np.integer) else value

    def __setattr__(self, name: str, value: Any) -> None:
        self.record[name] = value


class _View(np.ndarray):
    """An array in which no index counts from the end."""

    def __getitem__(self, k: Any) -> Any:
        value = super().__getitem__(self._within(k))
        return int(value) if isinstance(value, np.int64) else value

    def __setitem__(self, k: Any, value: Any) -> None:
        super().__setitem__(self._within(k), value)

    def _within(self, k: Any) -> Any:
        if not isinstance(k, slice) and not 0 <= k < len(self):
            raise IndexError(f"{k} in an array of {len(self)}")
        return k


def reals(address: int, length: int) -> Any:
    """The doubles at an address."""
    return _view(ctypes.c_double, address, length)


def indices(address: int, length: int) -> Any:
    """The whole numbers at an address."""
    return _view(ctypes.c_int64, address, length)


def _view(kind: Any, address: int, length: int) -> Any:
    size = max(int(length), 0)
    made = np.ctypeslib.as_array((kind * size).from_address(int(address))) if size else np.zeros(0, kind)
    return made.view(_View)


_FIELD = (ctypes.c_int64, ctypes.c_double, ctypes.c_int64, ctypes.c_int64)


def _function_at(result: Any, *kinds: Any) -> Callable[..., Any]:
    made = ctypes.CFUNCTYPE(result, *kinds)
    return lambda address, arguments: made(int(address))(*arguments)


_i, _d = ctypes.c_int64, ctypes.c_double
OUTSIDE = {
    "reals": reals, "indices": indices, "field_at": _function_at(None, *_FIELD),
    "jacobian_at": _function_at(None, *_FIELD, _i), "mass_at": _function_at(None, _i, _i),
    "slip_at": _function_at(_i, *_FIELD), "switch_at": _function_at(_i, *_FIELD, _i),
    "next_time_at": _function_at(_d, _i, _d), "at_time_at": _function_at(_i, _i, _d, _i),
}  # fmt: skip
"""What stands for the intrinsics of memory/foreign.py."""


def _plain(given: Any) -> Any:
    """A compiled function, or one of foreign.py, as Python; anything else as it is."""
    foreign = sys.modules["fairlead.integrate.memory.foreign"]
    for name, one in OUTSIDE.items():
        if given is getattr(foreign, name):
            return one
    function = getattr(given, "py_func", None)
    if function is None:
        return given
    if id(function) not in _made:
        scope = _scope(function.__globals__)
        _made[id(function)] = types.FunctionType(function.__code__, scope, function.__name__)
    return _made[id(function)]


def _scope(given: dict[str, Any]) -> dict[str, Any]:
    """The names of a module, its functions plain."""
    if id(given) not in _scopes:
        made = _scopes[id(given)] = {}  # before it is filled: functions call each other
        made.update((name, _plain(value)) for name, value in given.items())
    return _scopes[id(given)]
