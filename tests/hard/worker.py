"""Rows played in a process of their own, so that one that hangs or takes the process with it is a row like others."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess

from tests.hard.attempt import OVER, Attempt, attempt
from tests.hard.registry import Row, rows

MERCY = 60.0  # s beyond the budget: compiling, and what a run may take when it notices late


class Worker:
    """A process that plays rows one after the other, replaced when it is lost."""

    def __init__(self) -> None:
        self._process: SpawnProcess | None = None
        self._line: Connection | None = None

    def play(self, row: Row) -> Attempt:
        """The attempt at a row; stuck when no answer comes in time, crashed when the process ends."""
        if self._process is None or self._line is None:
            self._start()
        assert self._line is not None
        self._line.send((row.case.name, row.engine, row.treatment))
        limit = OVER * row.case.budget + MERCY
        try:
            if self._line.poll(limit):
                return Attempt(**self._line.recv())
            verdict, reason = "stuck", f"no answer within {limit:.0f} s; the process was ended"
        except (EOFError, ConnectionResetError):
            verdict, reason = "crashed", "the process ended by itself"
        self.end()
        return Attempt(row.case.name, row.engine, row.treatment, verdict, reason, seconds=limit)  # type: ignore[arg-type]

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")
        self._line, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs,), daemon=True)
        self._process.start()
        theirs.close()

    def end(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            self._process.join()
        self._process = self._line = None


def _serve(line: Connection) -> None:
    """Play what is asked for until nobody asks any more."""
    table = {(row.case.name, row.engine, row.treatment): row for row in rows()}
    for asked in _asked(line):
        line.send(attempt(table[asked]).plain())


def _asked(line: Connection) -> Iterator[tuple[str, str, str]]:
    try:
        while True:
            yield line.recv()
    except (EOFError, KeyboardInterrupt):
        return
