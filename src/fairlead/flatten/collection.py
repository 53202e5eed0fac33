"""Python's cyclic garbage collector rests while a model is built."""

from __future__ import annotations

import functools
import gc
from collections.abc import Callable
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


def collected_later(build: Callable[P, R]) -> Callable[P, R]:
    """Call `build` without collections, which start again after it, also when it raises.

    A long line becomes half a million objects that all stay. The collector would look through them again and
    again as they grow in number and find nothing: a fifth of the time for 1000 elements (benchmarks/scaling.py).
    """

    @functools.wraps(build)
    def called(*args: P.args, **kwargs: P.kwargs) -> R:
        was_on = gc.isenabled()
        gc.disable()
        try:
            return build(*args, **kwargs)
        finally:
            if was_on:
                gc.enable()

    return called
