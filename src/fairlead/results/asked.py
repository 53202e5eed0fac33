"""What a Result answers when it is asked for something in a form that it does not take."""

from __future__ import annotations

from collections.abc import Iterable
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.arguments import Arguments
from fairlead.errors import UsageError, shown
from fairlead.quantities import QuantityError, si

NUMBERS = "iuf"
"""Kinds of arrays of real numbers: no True and False, no texts, and no times of a calendar in units of their own."""
SEVERAL = '"block.x", "block.*" or ["block.x", "pad.slip"]'


def refuse_no_file(called: str, path: object, names: object = None) -> None:
    """Raise ModelError for a file that cannot be written, and for no names at all; `called` is the method."""
    asked = Arguments(f"Result.{called}")
    asked.new_file("path", path)
    if isinstance(names, list | tuple) and not names:
        asked.alone("names", names, "Leave it out to have all signals.")
    asked.refuse()


def refuse_no_height(height: object) -> None:
    """Raise ModelError for the height of a frame that is no number of pixels."""
    asked = Arguments("Result.animation")
    asked.whole("height", height, 1)
    asked.refuse()


def not_names(names: object) -> str:
    """How to write names of signals instead of these; "" where they may be names. Each is looked up elsewhere."""
    if names is None or (isinstance(names, Iterable) and not isinstance(names, bytes)):
        return ""
    return f"Write it as {SEVERAL}, or leave it out to have all."


def times_of(t: Any) -> NDArray[np.float64]:
    """Times [s]: a number, a text with its unit, or several of either. Raises UsageError."""
    if isinstance(t, str):
        try:
            return np.asarray(si(t, "s"))
        except QuantityError as error:
            raise UsageError(f"t = {shown(t)} is no time: {error.what}.\n    {error.allowed}") from None
    if isinstance(t, list | tuple) and any(isinstance(one, str) for one in t):
        return np.array([times_of(one) for one in t])
    try:
        if (given := np.asarray(t)).dtype.kind in NUMBERS and not _has_bools(t):  # None would become nan
            return given.astype("f8")
    except (TypeError, ValueError):
        pass
    raise UsageError(f"t = {shown(t)} is no time: give a number of seconds, or an array of them.")


def _has_bools(t: Any) -> bool:
    """Whether there is True or False among numbers in a list, of which numpy makes 1 and 0."""
    return isinstance(t, bool | np.bool_) or (isinstance(t, list | tuple) and any(map(_has_bools, t)))


def instead_of(name: object) -> str:
    """What to write for several signals, or for some of the values of one."""
    if isinstance(name, slice):
        return f'\n    Name it first: result["NAME"][{name.start or ""}:{name.stop or ""}].'
    if isinstance(name, list | tuple) and name and all(isinstance(one, str) for one in name):
        return f'\n    Write to_pandas({list(name)}) for a table of them, or one name: result["{name[0]}"].'
    if isinstance(name, tuple) and len(name) == 2 and isinstance(name[0], str) and isinstance(name[1], Real):
        return f'\n    A value at a time is result.at("{name[0]}", {name[1]}).'
    return ""
