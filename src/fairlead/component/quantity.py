"""What a law reads while it is traced: a symbol that has no value, and says so when it is asked for one.

SymPy compares and counts symbols by their structure: `p.share == 0.5` is False whatever the share, `if p.share:` is
taken always. In a law either would choose a branch once and for all, without a word. So a law that asks is told, and
`tracing` keeps the question in case the law catches what is raised.

The same holds for all that is reckoned from symbols, `1 - p.share == 0` or `{1: 2}.get(1 - p.share)`. Such expressions
are SymPy's own, so `watched` has SymPy itself say when one of them is compared, counted or hashed by somebody else. It
takes a little of SymPy's speed, so it is for classes of users; the tests ask the bundled library.
"""

from __future__ import annotations

import functools
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

import sympy

MAY_ASK = ("sympy", "fairlead")
"""Packages whose own code may compare symbols; the bundled library may not."""
LIBRARY = "fairlead.components"
_questions: list[list[str]] = []


class Asked(Exception):
    """A law has asked a symbol for its value."""


class Quantity(sympy.Symbol):
    """A symbol that a law may reckon with, and not compare by value."""

    __slots__ = ()

    def __eq__(self, other: Any) -> bool:
        """Whether it is the same symbol; a law may not ask."""
        if _questions:
            _refuse(sys._getframe(1))
        return sympy.Symbol.__eq__(self, other)  # or NotImplemented

    def __ne__(self, other: Any) -> bool:
        """Whether it is another symbol; a law may not ask."""
        if _questions:
            _refuse(sys._getframe(1))
        return sympy.Symbol.__ne__(self, other)

    def __bool__(self) -> bool:
        """True, as all symbols are; a law may not ask."""
        if _questions:
            _refuse(sys._getframe(1))
        return True

    __hash__ = sympy.Symbol.__hash__  # what SymPy does all the time; `watched` asks who does it


_lock = threading.Lock()
_watching = 0
_before: list[tuple[type, str, Any]] = []
"""What SymPy's classes had before they were watched; None for what they did not have."""


@contextmanager
def watched() -> Iterator[None]:
    """Meanwhile a law may not compare, count or hash what is reckoned from symbols either."""
    global _watching
    with _lock:
        _watching += 1
        if _watching == 1:
            _watch()
    try:
        yield
    finally:
        with _lock:
            _watching -= 1
            if not _watching:
                _leave_alone()


def _watch() -> None:
    kinds = (sympy.Float, sympy.Integer, sympy.NumberSymbol, sympy.And, sympy.Tuple, sympy.Expr)
    found = dict.fromkeys(base for kind in kinds for base in kind.__mro__ if issubclass(base, sympy.Basic))
    for kind in found:
        for name in ("__eq__", "__ne__"):
            if name in vars(kind):
                _replace(kind, name, _comparing(vars(kind)[name]))
    for kind in (sympy.Basic, Quantity):
        _replace(kind, "__hash__", _hashing(vars(kind)["__hash__"]))
    for kind in (sympy.Expr, sympy.logic.boolalg.BooleanFunction):
        _replace(kind, "__bool__", _counting)


def _replace(kind: Any, name: str, by: Callable[..., Any]) -> None:
    _before.append((kind, name, vars(kind).get(name)))
    setattr(kind, name, by)


def _leave_alone() -> None:
    while _before:
        kind, name, had = _before.pop()
        if had is None:
            delattr(kind, name)
        else:
            setattr(kind, name, had)


def _comparing(compare: Callable[..., Any]) -> Callable[..., Any]:
    def compared(self: Any, other: Any) -> Any:
        if _questions:
            _ask(sys._getframe(1), self, other)
        return compare(self, other)

    return compared


def _hashing(hashed: Callable[..., int]) -> Callable[..., int]:
    def hash_of(self: Any) -> int:
        if _questions:
            _ask(sys._getframe(1), self)
        return hashed(self)

    return hash_of


def _counting(self: Any) -> bool:
    if _questions:
        _ask(sys._getframe(1), self)
    return True


def _ask(frame: FrameType, *values: Any) -> None:
    """Refuse a question about what has symbols in it; constants may be compared."""
    if not _may_ask(frame) and any(isinstance(one, sympy.Basic) and one.free_symbols for one in values):
        _refuse(frame)


@contextmanager
def tracing() -> Iterator[list[str]]:
    """While a law is run: the questions it asks, each with its place."""
    asked: list[str] = []
    _questions.append(asked)
    try:
        yield asked
    finally:
        _questions.pop()


def _refuse(frame: FrameType) -> None:
    if not _may_ask(frame):
        asking = _author_of(frame)
        _questions[-1].append(f"{asking.f_code.co_filename}:{asking.f_lineno}")
        raise Asked


def _author_of(frame: FrameType) -> FrameType:
    """Who asks through others, as `np.any([s])` or `Counter([s])` does."""
    asking: FrameType | None = frame
    while asking is not None:
        root = str(asking.f_globals.get("__name__", "")).partition(".")[0]
        if root not in sys.stdlib_module_names and "site-packages" not in asking.f_code.co_filename:
            return asking
        asking = asking.f_back
    return frame


def _may_ask(frame: FrameType) -> bool:
    return _is_framework(str(frame.f_globals.get("__name__", "")))


@functools.cache
def _is_framework(name: str) -> bool:
    return name.partition(".")[0] in MAY_ASK and not f"{name}.".startswith(f"{LIBRARY}.")
