"""What a Result answers when it is asked for something in a form that it does not take."""

from __future__ import annotations

from fairlead.arguments import Arguments


def refuse_no_path(called: str, path: object) -> None:
    """Raise ModelError for a path that is neither a text nor a Path; `called` is the method."""
    asked = Arguments(f"Result.{called}")
    asked.path("path", path)
    asked.refuse()


def instead_of(name: object) -> str:
    """What to write for several signals, or for some of the values of one."""
    if isinstance(name, slice):
        return f'\n    Name it first: result["NAME"][{name.start or ""}:{name.stop or ""}].'
    if isinstance(name, list | tuple) and name and all(isinstance(one, str) for one in name):
        return f'\n    Write to_pandas({list(name)}) for a table of them, or one name: result["{name[0]}"].'
    return ""
