"""Callbacks of a system in plain Python, as they are written: on arrays with nothing else around them."""

from __future__ import annotations

import math
import types
from collections import defaultdict
from collections.abc import Callable
from typing import Any

import numpy as np

from fairlead.kernels import layout
from fairlead.system.callbacks import table


def plain(**given: Any) -> dict[str, Callable[..., Any]]:
    """Every callback by name; `given` takes the place of those of that name, as of one that asks kernels."""
    scope: dict[str, Any] = {name: value for name, value in vars(layout).items() if name.isupper()}
    scope |= {"i8": _itself, "f8": _itself, "sign": np.sign, "sqrt": math.sqrt}
    every = {one.__name__: one for one in (*table.SHARED, *(one for one, _, _ in table.CALLBACKS.values()))}
    scope |= {name: types.FunctionType(one.__code__, scope, name) for name, one in every.items()}
    scope |= given
    return scope


def context(**arrays: Any) -> dict[int, Any]:
    """A context: numbers and arrays by the names of their places in lower case; arrays are read flat. The rest is 0."""
    made: dict[int, Any] = defaultdict(int)
    for name, value in arrays.items():
        made[getattr(layout, name.upper())] = value.ravel() if isinstance(value, np.ndarray) else value
    return made


def _itself(given: Any) -> Any:
    return given
