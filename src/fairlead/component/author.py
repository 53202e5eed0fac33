"""An author's function is called with symbols; what goes wrong in it is told at the author's own line."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from fairlead.component.class_checks import source_place
from fairlead.component.quantity import tracing
from fairlead.component.replies import AnswerError
from fairlead.component.symbols import TraceError

BRANCHES = "a law must not branch on values; write one law per zone"
AUTHORS = ("fairlead.components.", "fairlead_library_")
"""How the modules begin in which laws and parts of laws are written."""


def called_with(function: Callable[..., Any], arguments: dict[str, Any]) -> Any:
    """Call an author's function; any failure becomes a TraceError at the author's own line."""
    code = function.__code__
    wanted = code.co_varnames[: code.co_argcount]
    try:
        with tracing() as asked:
            said = function(**{name: arguments[name] for name in wanted})
    except Exception as error:
        if asked:
            raise branches(asked[0], function) from error
        if isinstance(error, AnswerError):  # of a part, with its own place
            raise TraceError(" ".join(str(error).split())) from error
        place, name = _deepest(error, function)
        raise TraceError(f"{place}: {name}: {_explained(error)}") from error
    if asked:
        raise branches(asked[0], function)
    return said


def _deepest(error: Exception, function: Callable[..., Any]) -> tuple[str, str]:
    """file:line and name of the function of an author's in which it fails: the law, or one of a part that it asks."""
    code, module = function.__code__, str(function.__globals__.get("__name__"))
    place, name = f"{code.co_filename}:{code.co_firstlineno}", function.__qualname__
    step = error.__traceback__
    while step is not None:
        frame, where = step.tb_frame, str(step.tb_frame.f_globals.get("__name__", ""))
        if where == module or where.startswith(AUTHORS):
            place = f"{frame.f_code.co_filename}:{step.tb_lineno}"
            name = function.__qualname__ if frame.f_code is code else getattr(frame.f_code, "co_qualname", name)
        step = step.tb_next
    return place, name


def author_of(error: BaseException, kind: type) -> tuple[str, str]:
    """file:line and name of the method of a class, or of a part of one, in which something fails."""
    place, name, step = source_place(kind), kind.__name__, error.__traceback__
    while step is not None:
        frame, where = step.tb_frame, str(step.tb_frame.f_globals.get("__name__", ""))
        if where == kind.__module__ or where.startswith(AUTHORS):
            place, name = f"{frame.f_code.co_filename}:{step.tb_lineno}", frame.f_code.co_name
        step = step.tb_next
    return place, name


def branches(place: str, function: Callable[..., Any]) -> TraceError:
    """Of a law that asks a symbol for its value, by `==`, `in`, `if` or `not`."""
    return TraceError(f"{place}: {function.__qualname__}: {BRANCHES}")


def _explained(error: Exception) -> str:
    """What an author did to a symbol that only a number can bear."""
    if isinstance(error, TraceError):
        return str(error)
    if "truth value" in str(error):
        return BRANCHES
    if "convert expression to float" in str(error) or "ufunc" in str(error):
        return "functions of math and numpy want numbers; import sqrt, exp, sin, ... from fairlead.component"
    return f"{type(error).__name__}: {error}"
