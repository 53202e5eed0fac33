"""The processes that work for the page: one that stays and checks, one that stays and completes, one for a run.

Code of libraries is executed in these alone. Each has a time limit or can be stopped, and the page stays when it dies.
"""

from __future__ import annotations

import contextlib
import json
import os
import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import Any

COMMAND = (sys.executable, "-m", "fairlead.view.work")
PATIENCE = 60.0  # s for a text: a first check compiles the laws of its components
SLOW = "The netlist was given up: its {} took longer than {:g} s."
NOUNS = {"check": "check", "complete": "completion"}
GONE = "The process that worked on it ended unexpectedly (code {})."


class Worker:
    """A process that answers requests one after the other. It has a group of its own, which ends with it."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
            encoding="utf-8", start_new_session=os.name == "posix",  # Ctrl-C in the terminal is for the server alone
        )  # fmt: skip
        self._lines: queue.Queue[str] = queue.Queue()
        threading.Thread(target=self._listen, daemon=True).start()

    def ask(self, request: dict[str, Any]) -> None:
        """Send a request; a process that is gone tells so in its answer."""
        with contextlib.suppress(OSError):
            assert self._process.stdin is not None
            self._process.stdin.write(json.dumps(request) + "\n")
            self._process.stdin.flush()

    def answer(self, patience: float | None = None) -> dict[str, Any] | None:
        """The next line of the answer; None when the process is gone. Raises queue.Empty after `patience` seconds."""
        line = self._lines.get(timeout=patience)
        return json.loads(line) if line else None

    def interrupt(self) -> None:
        """What Ctrl-C is: a run ends early and keeps what was computed."""
        if os.name == "posix":
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGINT)
        else:
            self._process.terminate()

    def end(self) -> int:
        """End it and all that it started, at once; gives its exit code."""
        if os.name == "posix":
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
        else:
            self._process.kill()
        return self._process.wait(timeout=60)

    def _listen(self) -> None:
        for line in self._process.stdout or ():
            self._lines.put(line)
        self._lines.put("")


class Helper:
    """Has one kind of work done, one text at a time; of several that wait only the last."""

    def __init__(self, do: str, patience: float = PATIENCE) -> None:
        self._do = do
        self._worker: Worker | None = None
        self._patience = patience
        self._turn, self._newest = threading.Lock(), 0

    def ask(self, request: dict[str, Any]) -> dict[str, Any] | None:
        """What `work` answers; None when a newer text has come meanwhile."""
        self._newest += 1
        mine = self._newest
        with self._turn:
            if mine != self._newest:
                return None
            self._worker = self._worker or Worker()
            self._worker.ask({**request, "do": self._do})
            try:
                answer = self._worker.answer(self._patience)
            except queue.Empty:
                self.end()
                return failure(SLOW.format(NOUNS[self._do], self._patience))
            if answer is None:
                return failure(GONE.format(self.end()))
            return answer

    def end(self) -> int:
        """End the process; the next text has another one."""
        worker, self._worker = self._worker, None
        return worker.end() if worker else 0


class Runner:
    """One run at a time, and how far it is."""

    def __init__(self, finished: Callable[[int], None]) -> None:
        self._finished = finished
        self._worker: Worker | None = None
        self._lock = threading.Lock()
        self.number = 0
        self.state: dict[str, Any] = {"state": "idle"}

    def start(self, request: dict[str, Any], out: str) -> bool:
        """Begin; False when a run goes on."""
        with self._lock:
            if self.state["state"] == "running":
                return False
            self.number += 1
            self.state = {"state": "running", "number": self.number, "fraction": 0.0, "t": 0.0}
            self._worker = Worker()
            self._worker.ask({**request, "do": "run", "out": out})
            threading.Thread(target=self._follow, args=(self._worker, self.number), daemon=True).start()
            return True

    def stop(self) -> None:
        """End the run early; asked a second time, at once."""
        with self._lock:
            if self.state["state"] != "running" or self._worker is None:
                return
            if self.state.get("stopping"):
                self._worker.end()
            else:
                self.state["stopping"] = True
                self._worker.interrupt()

    def end(self) -> None:
        """End a run without waiting for what it computed."""
        if self._worker is not None:
            self._worker.end()

    def _follow(self, worker: Worker, number: int) -> None:
        answer = worker.answer()
        while answer is not None and "fraction" in answer:
            self.state |= answer
            answer = worker.answer()
        code = worker.end()
        stopped = self.state.get("stopping", False)
        if answer is None:
            answer = failure("The run was stopped before it had results." if stopped else GONE.format(code))
        if "status" in answer:
            self._finished(number)
        self.state = {"state": "done", "number": number, "page": "status" in answer, **answer}


def failure(said: str) -> dict[str, Any]:
    """An answer that is one sentence."""
    return {"faults": [{"line": 0, "column": 0, "here": False, "said": said}], "warnings": []}
