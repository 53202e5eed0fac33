"""What `fairlead view` has done in a process of its own: a netlist checked, completed, or run and put on a page.

    python -m fairlead.view.work     reads one request a line from standard input, answers in lines of JSON

    {"do": "check", "file", "text", "set", "libraries", "allow_fmu"}    -> {"faults": [...], "warnings": [...]}
    {"do": "complete", ..., "cursor"}    -> {"begin", "items": [{"text", "about"}, ...]}
    {"do": "run", ..., "out": FOLDER}    -> {"fraction", "t"} as it goes, then {"status", "sentence"} or {"faults"}

A fault is {"line", "column", "here", "said"}: `here` when it stands in the netlist itself, `said` as `fairlead check`
says it.
"""

from __future__ import annotations

import functools
import json
import os
import pathlib
import sys
import time
import warnings
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, TextIO

from fairlead.errors import FairleadError, Fault, ModelError, RunWarning
from fairlead.netlist.files import display

if TYPE_CHECKING:
    from fairlead.model import Model
    from fairlead.view.completion import Completion

_answers: TextIO = sys.stdout
PAUSE = 0.1  # s between two words on how far a run is


def answer(asked: dict[str, Any]) -> None:
    """Do what is asked and say what came of it."""
    try:
        say(WORK[asked["do"]](asked))
    except ModelError as error:
        say({"faults": told(error.faults, asked["file"]), "warnings": []})
    except FairleadError as error:
        say({"faults": told([Fault(None, str(error))], asked["file"]), "warnings": []})


def say(words: dict[str, Any]) -> None:
    """A line for the one who asked."""
    _answers.write(json.dumps(words) + "\n")
    _answers.flush()


def told(faults: Iterable[Fault], file: str) -> list[dict[str, Any]]:
    """Faults as the page lists them."""
    own = display(pathlib.Path(file))
    return [{"line": one.where.line if one.where else 0, "column": one.where.column if one.where else 0,
             "here": one.where is not None and one.where.file == own, "said": str(one)} for one in faults]  # fmt: skip


def _model(asked: dict[str, Any]) -> Model:
    from fairlead.simulate import opened

    return opened(asked["file"], asked["set"], asked["libraries"], asked["allow_fmu"], asked["text"])


def _check(asked: dict[str, Any]) -> dict[str, Any]:
    return {"faults": [], "warnings": told(_model(asked).check(), asked["file"])}


def _complete(asked: dict[str, Any]) -> dict[str, Any]:
    return _completion(tuple(asked["libraries"])).at(asked["text"], asked["cursor"])


@functools.cache
def _completion(libraries: tuple[str, ...]) -> Completion:
    from fairlead.component.registry import known_types
    from fairlead.view.completion import Completion

    return Completion(known_types(libraries))


def _run(asked: dict[str, Any]) -> dict[str, Any]:
    from fairlead.analysis.margins.kept import compare_with_statics
    from fairlead.analysis.statics.to_show import shown_besides
    from fairlead.report import page

    spoken = 0.0

    def progress(fraction: float, t: float, _: Any) -> None:
        nonlocal spoken
        if time.monotonic() - spoken >= PAUSE:
            spoken = time.monotonic()
            say({"fraction": fraction, "t": t})

    model = _model(asked)
    shown_besides(model)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RunWarning)  # the page has them
        result = model.run(out=asked["out"], force=True, progress=progress, check=False)
    compare_with_statics(model.flat, result)
    page.write(result)
    return {"status": result.status, "sentence": str(result.run.get("sentence") or "")}


WORK = {"check": _check, "complete": _complete, "run": _run}


def main() -> None:
    """Answer until nobody asks any more. What a library prints does not mix with the answers."""
    global _answers
    _answers = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    for line in sys.stdin:
        answer(json.loads(line))


if __name__ == "__main__":
    main()
