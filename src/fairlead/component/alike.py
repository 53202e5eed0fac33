"""Whether two values of parameters are the same to the last bit, and which parts of them are not."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from fairlead.component.values import Group, Values


class Other(NamedTuple):
    """What stands in the place of a part: the part itself, what it is now, and whether that differs."""

    was: Values
    now: Values
    differs: bool


Parts = dict[int, Other]
"""By the identity of a part, what stands in its place."""


def agree(one: Any, other: Any, parts: Parts | None = None) -> bool:
    """True if two values are the same: Values, groups, tables, waves, lists, words and numbers.

    With `parts`, parts of one type (a curve beside a curve) may differ; what stands in the place of each goes there.
    """
    if one is other and parts is None:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, Values):
        return _same_type(one, other) and all(
            _within(one.given[name], other.given[name], parts) for name in _names(one)
        )
    if isinstance(one, Group):
        return _each(vars(one), vars(other), parts)
    if isinstance(one, Mapping):
        return _each(one, other, parts)
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(_within(*pair, parts) for pair in zip(one, other, strict=True))
    if isinstance(one, np.ndarray):
        return one.dtype == other.dtype and one.shape == other.shape and one.tobytes() == other.tobytes()
    if dataclasses.is_dataclass(one):
        return all(agree(getattr(one, f.name), getattr(other, f.name)) for f in dataclasses.fields(one))
    if isinstance(one, float):
        return math.copysign(1.0, one) == math.copysign(1.0, other) and (one == other or one != one != other != other)
    return bool(one == other)


def _each(one: Mapping[str, Any], other: Mapping[str, Any], parts: Parts | None) -> bool:
    return one.keys() == other.keys() and all(_within(one[name], other[name], parts) for name in one)


def _within(one: Any, other: Any, parts: Parts | None) -> bool:
    """The same for what stands inside: here a part may differ."""
    if parts is None or not isinstance(one, Values) or not isinstance(other, Values):
        return agree(one, other, parts)
    if one.type is not other.type:
        return False
    parts[id(one)] = Other(one, other, not agree(one, other))
    return True


def _same_type(one: Values, other: Values) -> bool:
    return one.type is other.type and one.effects == other.effects and _names(one) == _names(other)


def _names(values: Values) -> set[str]:
    """What was given, without the derived numbers that somebody asked for since."""
    return values.given.keys() - values.type.declaration.derived.keys()
