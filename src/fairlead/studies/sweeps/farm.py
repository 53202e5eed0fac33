"""Processes of this machine that compute cases, and outlive a case that kills one of them.

The executors of Python's library end as a whole when one process dies, with all cases that wait. Here each process has
a pipe. When it is gone, the case that it was at is tried once more in a new one, since something else may have killed
it; if that dies as well, the case is a row of status `killed`. The others go back to the queue.

A process of a short case that is woken for each row would wake the first process as often, which takes a core from one
of the others meanwhile. So a process has cases for `IN_HAND` seconds, and the first process looks for rows a few times
in that span.
"""

from __future__ import annotations

import multiprocessing
import multiprocessing.connection as connections
import os
import signal
import time
from collections import deque
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from typing import Any

from fairlead.cases.row import KILLED, Row, Value
from fairlead.errors import FairleadError
from fairlead.studies.sweeps.job import Job

AHEAD, MOST_AHEAD = 3, 100
"""Cases that a process has got, at least and at most: it does not wait for the next one, and little is lost with it."""
IN_HAND = 0.2
"""Seconds for which a process has cases, where they are short."""
LOOKS = 4
"""Looks for rows within `IN_HAND`: no process is out of cases before the second."""
TRIES = 2
MOST_STARTS = 3
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
READY = "ready"
Case = tuple[int, Mapping[str, Value]]
Done = tuple[int, Row]


@dataclass
class Worker:
    """One process: its pipe, and the cases it has got."""

    process: Any
    pipe: Any
    cases: deque[Case] = field(default_factory=deque)
    ready: bool = False


@dataclass(frozen=True)
class Here:
    """This process itself, in the place of a farm."""

    job: Job

    def __enter__(self) -> Here:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def rows(self, cases: Iterator[Case]) -> Iterator[Done]:
        """Rows of all cases, one after the other."""
        return ((number, self.job.row(values)) for number, values in cases)


class Farm:
    """So many processes; `rows` gives back rows as they come. Use it in a `with`."""

    def __init__(self, job: Job, processes: int) -> None:
        self.job, self.processes = job, processes
        self._workers: list[Worker] = []
        self._tried: dict[int, int] = {}
        self._failed_starts = 0
        self._rows, self._seconds = 0, 0.0

    @property
    def given(self) -> int:
        """Cases that processes have got and whose rows were not taken yet."""
        return sum(len(worker.cases) for worker in self._workers)

    @property
    def ahead(self) -> int:
        """Cases that each process is to have, by the length of those so far."""
        if not self._rows:
            return AHEAD
        return min(MOST_AHEAD, max(AHEAD, round(IN_HAND * self._rows / max(self._seconds, 1e-9))))

    def __enter__(self) -> Farm:
        return self

    def __exit__(self, *_: object) -> None:
        for worker in self._workers:
            worker.process.terminate()
            worker.pipe.close()
        for worker in self._workers:
            worker.process.join()

    def rows(self, cases: Iterator[Case]) -> Iterator[Done]:
        """Rows of all cases, in the order of their ends. Raises FairleadError when no process starts."""
        again: deque[Case] = deque()
        left = True
        while True:
            while left or again or any(worker.cases for worker in self._workers):
                left = self._hand_out(cases, again) and left
                if not any(worker.cases for worker in self._workers):
                    break
                yield from self._collect(again)
            if not left and not again:
                return

    def _hand_out(self, cases: Iterator[Case], again: deque[Case]) -> bool:
        """Fill up what the processes have got; False when there are no more cases."""
        for turn in range(self.ahead):
            for place in range(self.processes):
                if place < len(self._workers) and len(self._workers[place].cases) > turn:
                    continue
                case = again.popleft() if again else next(cases, None)
                if case is None:
                    return False
                if place >= len(self._workers):
                    self._workers.append(self._start())
                worker = self._workers[place]
                worker.cases.append(case)
                with suppress(OSError):  # it is gone, which `_collect` finds out
                    worker.pipe.send(case)
        return True

    def _collect(self, again: deque[Case]) -> Iterator[Done]:
        """Rows that have come since; waits for one."""
        if self.ahead > AHEAD:
            time.sleep(IN_HAND / LOOKS)
        ready = connections.wait([worker.pipe for worker in self._workers if worker.cases or not worker.ready])
        for worker in [one for one in self._workers if one.pipe in ready]:
            yield from self._take(worker, again)

    def _take(self, worker: Worker, again: deque[Case]) -> Iterator[Done]:
        """All rows that a process has sent, and what it was at if it is gone."""
        try:
            while worker.pipe.poll():
                told = worker.pipe.recv()
                if told == READY:
                    worker.ready, self._failed_starts = True, 0
                    continue
                number, row = told
                worker.cases.popleft()
                self._rows, self._seconds = self._rows + 1, self._seconds + row.seconds
                yield number, row
        except (EOFError, OSError):
            yield from self._bury(worker, again)

    def _bury(self, worker: Worker, again: deque[Case]) -> Iterator[Done]:
        """Blame the case that a dead process was at, and give the others back."""
        worker.process.join()
        self._workers.remove(worker)
        worker.pipe.close()
        cases = [*worker.cases]
        if not worker.ready:
            self._failed_starts += 1
            if self._failed_starts >= MOST_STARTS:
                raise FairleadError(
                    f"Processes for the cases do not start: {MOST_STARTS} ended ({_ended(worker.process.exitcode)}).\n"
                    "    In a Python file, guard what starts the sweep by: if __name__ == '__main__':"
                )
        elif cases:
            number, values = cases[0]
            self._tried[number] = self._tried.get(number, 0) + 1
            if self._tried[number] >= TRIES:
                said = f"The process that computed it ended: {_ended(worker.process.exitcode)}, {TRIES} times."
                yield number, Row(self.job.key(values), values, KILLED, said)
                cases = cases[1:]
        again.extendleft(reversed(cases))

    def _start(self) -> Worker:
        context = multiprocessing.get_context("spawn")  # a copy of a process with threads may hang
        here, there = context.Pipe()
        process = context.Process(target=work, args=(there, self.job), daemon=True)
        with _one_thread_each():
            process.start()
        there.close()
        return Worker(process, here)


def work(pipe: Any, job: Job) -> None:
    """The life of a process: cases in, rows out, until the pipe closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C goes to all of a group; the first process ends the others
    with suppress(EOFError, OSError):
        pipe.send(READY)
        while True:
            number, values = pipe.recv()
            pipe.send((number, job.row(values)))


def _ended(code: int | None) -> str:
    if code is not None and code < 0:
        with suppress(ValueError):
            return f"by {signal.Signals(-code).name}"
    return f"exit code {code}"


@contextmanager
def _one_thread_each() -> Iterator[None]:
    """Libraries of a new process take one thread, unless the user has chosen: there is a process for every core."""
    chosen = [name for name in THREADS if name not in os.environ]
    os.environ.update(dict.fromkeys(chosen, "1"))
    try:
        yield
    finally:
        for name in chosen:
            os.environ.pop(name, None)
