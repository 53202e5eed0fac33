"""What users call from Python says what it does, and speaks of each of its arguments."""

from __future__ import annotations

import inspect
import pathlib
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


SOURCES = pathlib.Path(fairlead.__file__).parent
EXAMPLES = {"file.py", "mine.py", "NAME.py"}
"""What users may call a file of theirs."""


def test_files_that_the_source_names_exist():
    """By their names, or by the end of their paths; a reader who follows a name should come to something."""
    root = pathlib.Path(__file__).parents[2]
    folders = ("src", "components", "tests", "benchmarks", "docs", "building")
    known = [f"/{path.relative_to(root).as_posix()}" for folder in folders for path in (root / folder).rglob("*.py")]
    lost = []
    for path in SOURCES.rglob("*.py"):
        for name in re.findall(r"(?<![\w./-])((?:\w+/)*\w+\.py)\b", path.read_text(encoding="utf-8")):
            if name not in EXAMPLES and not any(one.endswith(f"/{name}") for one in known):
                lost.append((path.relative_to(SOURCES).as_posix(), name))
    assert not lost


def test_there_is_much_to_look_at():
    assert {"Model.run", "Result.at", "load", "run"} <= set(OFFERED)
