"""Make a mistake and catch what fairlead answers."""

from __future__ import annotations

import contextlib
import gc
import io
import os
import signal
import subprocess
import sys
import warnings
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import Any

import fairlead
from fairlead.__main__ import main
from fairlead.errors import FairleadError
from tests.mistakes.bases import BASES
from tests.mistakes.entry import Called, Mistake, Typed
from tests.mistakes.judge import Answer, missing

SECONDS = 120  # of processor time, on a machine of any speed; longer than that is taken for a hang
A_MISTAKE_OF_FAIRLEAD = 70
PLAIN = {"COLUMNS": "400", "NO_COLOR": "1", "TERM": "dumb"}  # a wide page without colours: words stay whole


class EndlessError(BaseException):
    """The time is up; not an Exception, so that nobody takes it for one of his own."""


class Desk:
    """What a user of Python has before him: models of the bases, and a result of a short run; each is made once."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name, text in BASES.items():
            (folder / f"{name}.yaml").write_text(text, encoding="utf-8")

    @cached_property
    def puller(self) -> fairlead.Model:
        return fairlead.load(self.folder / "puller.yaml")

    @cached_property
    def haul(self) -> fairlead.Model:
        return fairlead.load(self.folder / "haul.yaml")

    @cached_property
    def result(self) -> Any:
        return self.puller.run(out=None, stop=0.2)


def play(mistake: Mistake, desk: Desk) -> Answer:
    """Make the mistake in the folder of the desk, and return the answer."""
    for name, text in mistake.make.files.items():
        (desk.folder / name).write_text(text, encoding="utf-8")
    if isinstance(mistake.make, Called):
        _ = desk.result  # made outside the limit of time
    try:
        with chdir(desk.folder), limit(SECONDS):
            return typed(mistake.make) if isinstance(mistake.make, Typed) else called(mistake, desk)
    except EndlessError:
        return Answer("", hung=True)


def typed(make: Typed) -> Answer:
    """Return what a command prints."""
    code, text = (in_another_process if make.apart else in_this_process)(make.command)
    crashed = code == A_MISTAKE_OF_FAIRLEAD or "Traceback (most recent call last)" in text
    good = code in (0, None)
    nothing = good and (text.strip().endswith("no mistakes found.") and text.count("\n") <= 1)
    return Answer("" if nothing else without_frames(text), refused=not good, crashed=crashed)


def in_this_process(command: tuple[str, ...]) -> tuple[Any, str]:
    """Return exit code and print of a command."""
    out, young = io.StringIO(), gc.get_threshold()
    with captured(out), arguments(command):
        try:
            code = main()
        except SystemExit as end:
            code = end.code
        finally:
            gc.set_threshold(*young)  # a command has the process for itself
    return code, out.getvalue()


def in_another_process(command: tuple[str, ...]) -> tuple[Any, str]:
    """Return the same of a process of its own."""
    ended = subprocess.run(
        [sys.executable, "-m", "fairlead", *command],
        env={**os.environ, **PLAIN},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return ended.returncode, ended.stdout


def called(mistake: Mistake, desk: Desk) -> Answer:
    """Return what a call raises, warns of, or gives back if that is a list of faults.

    An exception that is none of fairlead's is as good as one if it says what there is to say; else it is a traceback.
    """
    with warnings.catch_warnings(record=True) as heard, contextlib.redirect_stdout(io.StringIO()):
        warnings.simplefilter("always")
        try:
            mistake.make.call(desk)
        except FairleadError as error:
            return Answer(said(error), refused=True)
        except Exception as error:  # noqa: BLE001  whatever it is, the user sees it
            meant = type(error).__module__.startswith("fairlead.") or not missing(mistake, said(error))
            return Answer(said(error), refused=True, crashed=not meant)
    return Answer("\n".join(str(one.message) for one in heard))


def said(error: BaseException) -> str:
    """Return kind and text of an exception; a KeyError shows what it was given, as the user sees it."""
    return f"{type(error).__name__}: {error}"


def without_frames(text: str) -> str:
    """Return a text without the box that is drawn round mistakes of typing."""
    return "".join(" " if "\u2500" <= letter <= "\u257f" else letter for letter in text)


@contextlib.contextmanager
def captured(out: io.StringIO) -> Iterator[None]:
    """Take what is printed."""
    kept = {name: os.environ.get(name) for name in PLAIN}
    os.environ.update(PLAIN)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            yield
    finally:
        for name, value in kept.items():
            os.environ.pop(name, None) if value is None else os.environ.update({name: value})


@contextlib.contextmanager
def arguments(words: tuple[str, ...]) -> Iterator[None]:
    """Let `words` be what was typed behind `fairlead`."""
    kept, sys.argv = sys.argv, ["fairlead", *words]
    try:
        yield
    finally:
        sys.argv = kept


@contextlib.contextmanager
def chdir(folder: Path) -> Iterator[None]:
    """Work in a folder."""
    kept = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(kept)


@contextlib.contextmanager
def limit(seconds: float) -> Iterator[None]:
    """Raise EndlessError when so much processor time is used up, where the system can tell."""
    if not hasattr(signal, "SIGPROF"):
        yield
        return

    def ring(*_: object) -> None:
        raise EndlessError

    kept = signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, kept)
