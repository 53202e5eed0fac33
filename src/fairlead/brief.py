"""How things show themselves in Python: a line where their fields would fill screens.

    in_a_line(model.system)      '<System flat=FlatModel, n=75, blocks=tuple of 9, ...>'
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence, Set
from typing import Any

LONGEST_TEXT = 40
LONGEST_LINE = 400


def in_a_line(thing: Any) -> str:
    """The class of a dataclass and its fields, long ones by kind and size; never more than 400 characters."""
    shown = (f"{one.name}={brief(getattr(thing, one.name, None))}" for one in dataclasses.fields(thing) if one.repr)
    told = f"<{type(thing).__name__} {', '.join(shown)}>"
    return told if len(told) <= LONGEST_LINE else f"{told[: LONGEST_LINE - 4]}...>"


def brief(value: Any) -> str:
    """A number or a short text as it is; of anything else what it is and how much of it."""
    if value is None or isinstance(value, bool | int | float):
        return repr(value)
    if isinstance(value, str):
        return repr(value if len(value) <= LONGEST_TEXT else f"{value[: LONGEST_TEXT - 3]}...")
    if hasattr(value, "shape") and hasattr(value, "dtype"):
        size = " x ".join(map(str, value.shape))
        return f"{value.dtype}[{size}]"
    if isinstance(value, Mapping | Sequence | Set):
        return f"{type(value).__name__} of {len(value)}"
    return type(value).__name__
