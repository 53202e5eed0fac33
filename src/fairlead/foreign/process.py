"""A process for the code of one FMU, and questions to it that end in time.

    process = ForeignProcess(opening, where)        worker.py, in a session of its own
    process.ask({"do": "step", ...}, limit)         its answer; raises ForeignError

Question and answer are one line of JSON each. An answer that does not come within the limit, or a process that ends,
is told in a sentence, and the process is ended with all it has started. It also ends by itself when this one does,
since its standard input is closed then.
"""

from __future__ import annotations

import collections
import contextlib
import json
import os
import pathlib
import queue
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import weakref
from collections.abc import Callable
from typing import IO, Any

from fairlead.errors import shown
from fairlead.foreign import underway
from fairlead.foreign.refusals import FAILED, ForeignError

START_LIMIT = 120.0  # s, for Python to start and import FMPy on a busy machine
HEARD = 30.0
"""s, for a process to end whose output has, and for what was printed to be read: long on busy machines only."""
LAST_WORDS = 3  # lines of what the code printed that are told when it fails
MOST_PRINTED = 400  # characters of them
DOES = {"open": "its initialisation", "step": "doStep", "save": "getFMUState", "load": "setFMUState"}
"""Where it is while none of its calls is under way, by the question."""


class ForeignProcess:
    """The process of one FMU. `of` names it in messages."""

    def __init__(self, of: str) -> None:
        """Start; nothing of the FMU is loaded yet."""
        self.of = of
        self.occupant: Callable[[], Any] = lambda: None
        """Whose state is in the process, of those that share it; None when nobody knows him any more."""
        self.folder = tempfile.mkdtemp(prefix="fairlead_fmu_")
        self._underway = pathlib.Path(f"{self.folder}.call")
        underway.make(self._underway)
        command = [sys.executable, "-P", "-m", "fairlead.foreign.worker", str(self._underway)]
        pipe = subprocess.PIPE
        self._process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, start_new_session=True)
        assert self._process.stdout is not None
        assert self._process.stderr is not None
        self._answers: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._words: collections.deque[str] = collections.deque(maxlen=LAST_WORDS)
        self._heard = threading.Semaphore(0)
        words = (self._process.stderr, self._words, self._heard)
        listening = [
            threading.Thread(target=_answers, args=(self._process.stdout, self._answers), daemon=True),
            threading.Thread(target=_words, args=words, daemon=True),
        ]
        for thread in listening:
            thread.start()
        self.close = weakref.finalize(self, _close, self._process, self.folder, listening)
        """End it, with all it has started; again does nothing. Also done when nobody knows it any more."""
        self._answer("its start", START_LIMIT)

    def ask(self, question: dict[str, Any], limit: float) -> dict[str, Any]:
        """The answer within `limit` [s]. Raises ForeignError."""
        doing = DOES.get(question["do"], question["do"])
        if not self.close.alive:
            raise ForeignError(f"the process of {self.of} has ended. Start the run anew.")
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(json.dumps(question).encode() + b"\n")
            self._process.stdin.flush()
        except OSError:
            raise self._gone(doing) from None
        return self._answer(doing, limit)

    def forget(self, token: int) -> None:
        """Free a state; one of a process that has ended is gone."""
        if self.close.alive:
            with contextlib.suppress(ForeignError):
                self.ask({"do": "free", "token": token}, START_LIMIT)

    def _answer(self, doing: str, limit: float) -> dict[str, Any]:
        try:
            line = self._answers.get(timeout=limit)
        except queue.Empty:
            doing = underway.read(self._underway) or doing
            self.close()
            what = f"{self.of} did not come back from {doing} within {limit:g} s, so its process was ended"
            raise ForeignError(f"{what}. Give it a longer time_limit, or mend the FMU.{self._said()}") from None
        if not line:
            raise self._gone(doing)
        answer: dict[str, Any] = json.loads(line)
        if "error" in answer:
            raise ForeignError(f"{self.of}: {answer['error']}.{self._said()}")
        return answer

    def _gone(self, doing: str) -> ForeignError:
        """The process has ended by itself."""
        try:
            code = self._process.wait(HEARD)
        except subprocess.TimeoutExpired:
            code = 0
        doing = underway.read(self._underway) or doing
        self.close()
        with contextlib.suppress(ValueError):
            ended = f"by {signal.Signals(-code).name}" if code < 0 else f"with exit code {code}"
            return ForeignError(f"the process of {self.of} ended {ended} in {doing}. The FMU crashes there; "
                                f"ask its maker, or run it by itself:  fmpy simulate FILE.{self._said()}")  # fmt: skip
        return ForeignError(f"the process of {self.of} ended in {doing}.{self._said()}")

    def _said(self) -> str:
        """The last that the code printed before it failed or ended."""
        self._heard.acquire(timeout=HEARD)
        words = " | ".join(line for line in self._words if line)
        return f" It printed: {shown(words, MOST_PRINTED)}" if words else ""


def _answers(stream: IO[bytes], to: queue.SimpleQueue[bytes]) -> None:
    for line in stream:
        to.put(line)
    to.put(b"")


def _words(stream: IO[bytes], to: collections.deque[str], heard: threading.Semaphore) -> None:
    """Take in what is printed; `heard` counts how often all of it before an error was, and before the end."""
    for line in stream:
        if words := line.removesuffix(FAILED)[:2000].decode(errors="replace").strip():
            to.append(words)
        if line.endswith(FAILED):
            heard.release()
    heard.release()


def _close(process: subprocess.Popen[bytes], folder: str, listening: list[threading.Thread]) -> None:
    """End a process with its group, wait for it and its last words, and remove what was unpacked for it."""
    if hasattr(os, "killpg"):
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(timeout=10)
    for thread, stream in zip([None, *listening], (process.stdin, process.stdout, process.stderr), strict=True):
        if thread is not None and thread is not threading.current_thread():  # who collects garbage may be any
            thread.join(HEARD)
        if stream is not None and not (thread and thread.is_alive()):  # a child of another group may keep it open
            with contextlib.suppress(OSError):
                stream.close()
    shutil.rmtree(folder, ignore_errors=True)
    with contextlib.suppress(OSError):
        pathlib.Path(f"{folder}.call").unlink()
