"""What users call from Python says what it does, and speaks of each of its arguments."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import fairlead
import fairlead.cases


def offered() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Functions and public methods that `fairlead` and `fairlead.cases` hand out, each once."""
    seen = set[int]()
    for home in (fairlead, fairlead.cases):
        for name in home.__all__:
            found = [(name, getattr(home, name))]
            if inspect.isclass(found[0][1]):
                found += [(f"{name}.{key}", one) for key, one in inspect.getmembers(found[0][1], callable)
                          if not key.startswith("_")]  # fmt: skip
            for key, one in found:
                if callable(one) and str(getattr(one, "__module__", "")).startswith("fairlead") and id(one) not in seen:
                    seen.add(id(one))
                    yield key, one


OFFERED = dict(offered())


@pytest.mark.parametrize("name", OFFERED)
def test_it_says_what_it_does_and_what_its_arguments_are(name):
    said = inspect.getdoc(OFFERED[name]) or ""
    assert said
    if not inspect.isclass(OFFERED[name]):
        asked = [one for one in inspect.signature(OFFERED[name]).parameters if one not in ("self", "cls")]
        assert [one for one in asked if not re.search(rf"\b{one}\b", said)] == []


def test_there_is_much_to_look_at():
    assert {"Model.run", "Result.at", "load", "run"} <= set(OFFERED)
