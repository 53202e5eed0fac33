"""FMUs for the tests, and netlists beside them."""

from __future__ import annotations

import itertools
import os
import pathlib
import textwrap
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import fairlead
from fairlead.foreign import process
from tests.fmu_import.build import COMPILER, NO_COMPILER, maker


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """Where FMUs and netlists lie."""
    return tmp_path_factory.mktemp("fmus")


@pytest.fixture(scope="session")
def make(folder: pathlib.Path) -> Callable[..., pathlib.Path]:
    """make("decay", version=3) -> the FMU, in `folder`."""
    pytest.importorskip("fmpy")
    if COMPILER is None:
        pytest.skip(NO_COMPILER)
    return maker(folder)


@pytest.fixture
def load(folder: pathlib.Path) -> Callable[..., Any]:
    """load(text, **settings) -> Model: a netlist beside the FMUs, which may run."""
    numbers = itertools.count()

    def read(text: str, *, allow_fmu: bool = True, **settings: Any) -> Any:
        path = folder / f"{os.environ.get('PYTEST_CURRENT_TEST', '').__hash__()}_{next(numbers)}.yaml"
        path.write_text("schema: 1\nname: scene\n" + textwrap.dedent(text), encoding="utf-8")
        return fairlead.load(path, allow_fmu=allow_fmu, **settings)

    return read


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[Any]]:
    """Processes of FMUs that were started in the test; all have ended when it is over.

    The first test that wants an FMU also starts a compiler, whichever test that is.
    """
    found: list[Any] = []
    start = process.subprocess.Popen

    def noted(command: Any, *given: Any, **more: Any) -> Any:
        made = start(command, *given, **more)
        if process.__package__ + ".worker" in command:
            found.append(made)
        return made

    monkeypatch.setattr(process.subprocess, "Popen", noted)
    yield found
    for one in found:
        if one.poll() is None:
            os.killpg(one.pid, 9)
            one.wait(timeout=10)
