"""Whether `fairlead check` answered a netlist well, whatever the netlist was.

A good answer is exit code 0 or 1, within some seconds, no traceback, and a place for every mistake.
"""

from __future__ import annotations

import json
import pathlib
import signal
import traceback
from dataclasses import dataclass, field
from typing import Any

from typer.testing import CliRunner

from fairlead.cli import app

PATIENCE = 30.0  # s of this process; a check that compiles a law for the first time takes one or two
LONGEST_ANSWER = 1_000_000  # characters


class Endless(BaseException):
    """Raised by the alarm clock; no handler of fairlead takes it for a mistake."""


@dataclass
class Verdict:
    """The exit code of a check, and what was bad about the answer; a class of bad answers has one wording."""

    code: object
    complaints: list[str] = field(default_factory=list)


def judge(file: pathlib.Path, *more: str, verb: str = "check", patience: float = PATIENCE) -> Verdict:
    """Run a verb on a netlist in this process: `check`, or another that runs nothing, such as `statics` or `graph`."""
    as_json = ["--json"] if verb == "check" else []
    before = signal.signal(signal.SIGPROF, _too_long)
    signal.setitimer(signal.ITIMER_PROF, patience)
    try:
        result = CliRunner().invoke(app, [verb, str(file), *as_json, *more])
    except Endless as error:
        return Verdict("endless", [f"took more than {patience:g} s, in {_place(error)}"])
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
    complaints = []
    if result.exit_code not in ((0, 1) if as_json else (0, 1, 2)):
        complaints.append(f"exit code {result.exit_code}: {_cause(result.exception)}")
    elif len(result.output) > LONGEST_ANSWER:
        complaints.append(f"an answer of more than {LONGEST_ANSWER} characters")
    elif as_json:
        complaints += _unplaced(result.stdout)
    return Verdict(result.exit_code, complaints)


def _unplaced(answer: str) -> list[str]:
    """Mistakes without a place, by the first words of what they say."""
    told: dict[str, Any] = json.loads(answer)
    faults = told["faults"] + told["warnings"]
    if not told["ok"] and not told["faults"]:
        return ["no mistakes are told"]
    return sorted({f"no place: {fault['what'][:60]}" for fault in faults if not fault["file"]})


def _cause(error: BaseException | None) -> str:
    """The exception behind an exit, and where it was raised."""
    while error is not None and (inner := error.__cause__ or error.__context__) is not None:
        error = inner
    if error is None:
        return "nothing was raised"
    text = str(error).splitlines()[0][:80] if str(error) else ""
    return f"{type(error).__name__} in {_place(error)}: {text}"


def _place(error: BaseException) -> str:
    """The last of our own lines that an exception came from."""
    trace = traceback.extract_tb(error.__traceback__)
    last = ([entry for entry in trace if "/fairlead/" in entry.filename] or trace)[-1]
    return f"{last.name} ({pathlib.Path(last.filename).name}:{last.lineno})"


def _too_long(*_: object) -> None:
    raise Endless
