"""What a law reads while it is traced: a symbol that has no value, and says so when it is asked for one.

SymPy compares and counts symbols by their structure: `p.share == 0.5` is False whatever the share, `if p.share:` is
taken always. In a law either would choose a branch once and for all, without a word. So a law that asks is told, and
`tracing` keeps the question in case the law catches what is raised.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
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
            _refuse()
        return sympy.Symbol.__eq__(self, other)  # or NotImplemented

    def __ne__(self, other: Any) -> bool:
        """Whether it is another symbol; a law may not ask."""
        if _questions:
            _refuse()
        return sympy.Symbol.__ne__(self, other)

    def __bool__(self) -> bool:
        """True, as all symbols are; a law may not ask."""
        if _questions:
            _refuse()
        return True

    __hash__ = sympy.Symbol.__hash__


@contextmanager
def tracing() -> Iterator[list[str]]:
    """While a law is run: the questions it asks, each with its place."""
    asked: list[str] = []
    _questions.append(asked)
    try:
        yield asked
    finally:
        _questions.pop()


def _refuse() -> None:
    frame = sys._getframe(2)
    if not _may_ask(frame):
        _questions[-1].append(f"{frame.f_code.co_filename}:{frame.f_lineno}")
        raise Asked


def _may_ask(frame: FrameType) -> bool:
    name = str(frame.f_globals.get("__name__", ""))
    return name.partition(".")[0] in MAY_ASK and not f"{name}.".startswith(f"{LIBRARY}.")
