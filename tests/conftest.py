"""Scenes for the tests: short netlists, and classes of a user, written where they are used.

A test says what it simulates in the words a user would write, then compares with a closed form of
`tests/reference`, which knows nothing of fairlead.
"""

from __future__ import annotations

import gc
import itertools
import os
import signal
import sys
import textwrap
from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

import hypothesis
import pytest

import fairlead
from tests.compiling import compile_share, read_share
from tests.slow import is_left, left_to_test_every, repeats

Scene = Callable[..., Any]

os.environ.setdefault("SYMPY_CACHE_SIZE", "20000")
"""What SymPy remembers, here and in processes that tests start; it reads this when it is imported. With its own 1000,
tests that trace one class after another take a quarter longer."""

hypothesis.settings.register_profile(
    "same", derandomize=True, deadline=None, database=None, suppress_health_check=list(hypothesis.HealthCheck)
)
hypothesis.settings.load_profile("same")
"""The same examples everywhere, however slow the machine; others by hand: pytest --hypothesis-profile=default."""

if providers := sys.modules.get("hypothesis.internal.conjecture.providers"):
    # Nor do examples depend on what is imported: hypothesis would read all of fairlead for numbers that stand in it,
    # to try them too, which takes each worker two seconds where no folder .hypothesis keeps them.
    vars(providers)["is_local_module_file"] = lambda path: False


COLLECTED = pytest.StashKey[list[str]]()
"""Names of all tests that were collected, whether they are run or not."""
YOUNG = 1_000_000
"""Objects that are made before Python looks for circles among them. What tests trace and compile is large and goes by
itself; by default Python would look through all of it every 700 objects, a sixth of the time of the contract suite."""


@pytest.hookimpl(wrapper=True)
def pytest_collection(session: pytest.Session) -> Generator[None, object, object]:
    """Do not look for garbage among what collecting makes, twelve thousand tests and their modules: it stays."""
    gc.disable()
    try:
        read_share(session.config)
        return (yield)
    finally:
        gc.freeze()  # nor later: each look would take half a second
        gc.set_threshold(YOUNG, 50, 1000)
        gc.enable()


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark as slow what `tests/slow.py` leaves to `make test-all`, and as exhaustive what that leaves to be drawn."""
    config.stash[COLLECTED] = [item.nodeid for item in items]
    for item in items:
        if is_left(item.nodeid):
            item.add_marker(pytest.mark.slow)
    for item in repeats(items):
        item.add_marker(pytest.mark.slow)
    for item in left_to_test_every(items):
        item.add_marker(pytest.mark.exhaustive)


@pytest.fixture(scope="session", autouse=True)
def ctrl_c_works() -> None:
    """A shell that starts the tests in the background has Ctrl-C ignored, in them and in all they start."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session", autouse=True)
def loops_are_compiled(request: pytest.FixtureRequest) -> None:
    """Each worker compiles a loop before its first test, so that with cold caches none waits for two."""
    compile_share(request.session)


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    """scene(text, **overrides) -> Model: a netlist without its first two lines, written to a file of its own."""
    numbers = itertools.count()

    def make(text: str, libraries: tuple[str, ...] = (), **overrides: Any) -> Any:
        path = tmp_path / f"scene{next(numbers)}.yaml"
        path.write_text("schema: 1\nname: scene\n" + textwrap.dedent(text), encoding="utf-8")
        return fairlead.load(path, set={name: str(value) for name, value in overrides.items()}, libraries=libraries)

    return make


@pytest.fixture
def library(tmp_path: Path) -> Callable[[str], str]:
    """library(text) -> path of a Python file with component classes, to be given as `libraries=(path,)`."""
    numbers = itertools.count()

    def write(text: str) -> str:
        path = tmp_path / f"classes{next(numbers)}.py"
        path.write_text("from fairlead.component import *\n" + textwrap.dedent(text), encoding="utf-8")
        return str(path)

    return write


@pytest.fixture
def simulate(scene: Scene, tmp_path: Path) -> Scene:
    """simulate(text, **overrides) -> Result: the same, run to its stop, which it must reach."""
    numbers = itertools.count()

    def run(text: str, libraries: tuple[str, ...] = (), **overrides: Any) -> Any:
        result = scene(text, libraries, **overrides).run(out=tmp_path / f"run{next(numbers)}")
        assert result.status == "finished", result.run["sentence"]
        return result

    return run


@pytest.fixture(scope="session")
def bundled(tmp_path_factory: pytest.TempPathFactory) -> Scene:
    """bundled(name, {"run.stop": "2 s"}) -> Result of a bundled model; each run is made once for all tests."""
    done: dict[Any, Any] = {}

    def run(name: str, overrides: dict[str, Any] | None = None) -> Any:
        settings = {key: str(value) for key, value in (overrides or {}).items()}
        key = (name, *sorted(settings.items()))
        if key not in done:
            model = fairlead.load(name, set=settings)
            done[key] = model.run(out=tmp_path_factory.mktemp(name) / "run")
        result = done[key]
        assert result.status == "finished", result.run["sentence"]
        return result

    return run
