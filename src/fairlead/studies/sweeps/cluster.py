"""Cases on a cluster of dask.distributed, whose own deployments reach SLURM, Kubernetes and clouds.

The job is a plugin of the workers, so that those have it which come later or start again. Cases go out a few at a
time; those of a worker that is lost are computed by others. The scheduler suspects every task that a dying worker had,
also one that only waited there. So cases on which workers die again and again are tried one by one, and those that are
suspected again are tried last, each with the cluster to itself: what still kills workers then is a row of status
`killed`, and nothing else is.
"""

from __future__ import annotations

import math
import threading
import time
from collections import Counter, deque
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from fairlead.cases.row import ERROR, KILLED, Row
from fairlead.errors import FairleadError, UsageError
from fairlead.studies.sweeps.farm import Case, Done
from fairlead.studies.sweeps.job import Job
from fairlead.studies.sweeps.parcel import Parcel

CHUNK = 8
"""Cases of one task: a scheduler needs a millisecond for each."""
AHEAD = 3
"""Tasks in flight for each thread of the cluster."""
TRIES = 3
LOOK_AGAIN = 2.0
"""Seconds after which it is asked again how large the cluster is."""
TIMEOUT = "15 s"
NOBODY = 60.0
"""Seconds without any worker after which a sweep ends; nannies and job queues need a while for a new one."""
LOOK = 0.01
"""Seconds between two looks for rows that are ready."""
FETCH = 5.0
"""Seconds in which rows that are ready must arrive; those of a worker that has died meanwhile never do."""
MISSING = "A cluster needs dask.distributed.\n    Install it: pip install 'fairlead[cluster]'"
NO_WORKERS = (
    "The scheduler {} has had no worker for {:g} s.\n"
    "    What was computed is in the table. Start workers (dask worker {}), and type the same to go on."
)
LOST = "The scheduler {} is gone.\n    What was computed is in the table. Start it again, and type the same to go on."

_PARCELS: dict[str, Parcel] = {}
_HERE = threading.local()


class Cluster:
    """A scheduler, by its address or its file; `rows` gives back rows as they come. Use it in a `with`."""

    def __init__(self, job: Job, address: str) -> None:
        self.job, self.address = job, address
        self._client: Any = None
        self._lost: Counter[int] = Counter()
        self._again: deque[list[Case]] = deque()
        self._suspects: deque[Case] = deque()

    def __enter__(self) -> Cluster:
        """Connect. Raises UsageError where nobody answers or the package is missing."""
        try:
            from distributed import Client
        except ImportError:
            raise UsageError(MISSING) from None
        by_file = Path(self.address).is_file()
        if not by_file and "://" not in self.address:
            way_out = (
                "Give its address, such as tcp://host:8786, or the file that dask scheduler --scheduler-file writes."
            )
            raise UsageError(f"--cluster {self.address}: there is no such file of a scheduler.\n    {way_out}")
        try:
            where = {"scheduler_file": self.address} if by_file else {"address": self.address}
            self._client = Client(**where, timeout=TIMEOUT, set_as_default=False)
            self._give()
        except (OSError, TimeoutError, ValueError) as error:
            told = " ".join(str(error).split())[:200]
            raise UsageError(
                f"--cluster {self.address}: nobody answers there ({told}).\n    Start it: dask scheduler"
            ) from None
        return self

    def _give(self) -> None:
        """Give the job to all workers; once more if one dies meanwhile, which closes the connection."""
        plugin = _plugin(self.job.scene, Parcel.of(self.job))
        for turn in range(TRIES):
            try:
                self._client.register_plugin(plugin)
                return
            except OSError:
                if turn + 1 == TRIES or self._client.status != "running":
                    raise

    def __exit__(self, *_: object) -> None:
        """Let go of the cluster, which goes on."""
        if self._client is not None:
            self._client.close(timeout=2)

    def rows(self, cases: Iterator[Case]) -> Iterator[Done]:
        """Rows of all cases, in the order of their ends. Raises FairleadError when the scheduler is lost."""
        try:
            yield from self._rows(cases)
        except OSError as error:  # also what distributed raises for a closed connection, and for a time that is over
            raise FairleadError(LOST.format(self.address)) from error

    def _rows(self, cases: Iterator[Case]) -> Iterator[Done]:
        from distributed import as_completed

        flying = as_completed([], loop=self._client.loop)
        threads, asked = 0, -math.inf
        while True:
            if time.monotonic() - asked > LOOK_AGAIN:
                threads, asked = sum(self._client.nthreads().values()), time.monotonic()
            for _ in range(AHEAD * max(threads, 1) - flying.count()):
                chunk = self._again.popleft() if self._again else _next(cases)
                if not chunk:
                    break
                flying.add(self._send(chunk))
            if flying.is_empty():
                break
            self._wait(flying)
            yield from self._landed(next(flying))
        while self._suspects:
            flying.add(self._send([self._suspects.popleft()]))
            self._wait(flying)
            yield from self._landed(next(flying), alone=True)

    def _wait(self, flying: Any) -> None:
        """Until rows are ready. Raises FairleadError when there has been no worker for long, OSError as the client."""
        asked = seen = time.monotonic()
        while not flying.has_ready():
            time.sleep(LOOK)
            now = time.monotonic()
            if now - asked > LOOK_AGAIN:
                asked = now
                seen = now if self._client.nthreads() else seen
            if now - seen > NOBODY:
                raise FairleadError(NO_WORKERS.format(self.address, NOBODY, self.address))

    def _send(self, chunk: list[Case]) -> Any:
        try:
            future = self._client.submit(compute, self.job.scene, chunk, pure=False)
        except Exception as error:
            raise FairleadError(LOST.format(self.address)) from error
        future.chunk = chunk
        return future

    def _landed(self, future: Any, *, alone: bool = False) -> Iterator[Done]:
        """What a task that has ended leaves: rows, or cases to try again; `alone`: no other was on the cluster."""
        chunk = future.chunk
        try:
            yield from future.result(timeout=FETCH)
            return
        except Exception as error:  # noqa: BLE001 - of the cluster; what a case raises is a row already
            failure, died = error, type(error).__name__ == "KilledWorker"
        self._client.nthreads()  # raises OSError where the scheduler is gone
        failed = future.status == "error" and not died
        first, values = chunk[0]
        self._lost[first] += 1
        if not died and not failed and self._lost[first] < TRIES:  # its rows were on a worker that is lost
            future.cancel()
            if alone:
                self._suspects.append(chunk[0])
            else:
                self._again.append(chunk)
        elif len(chunk) > 1:
            self._again += [[one] for one in chunk]
        elif failed:
            yield first, Row(self.job.key(values), values, ERROR, f"{type(failure).__name__}: {failure}")
        elif alone:
            yield first, Row(self.job.key(values), values, KILLED, "The workers that computed it died.")
        else:
            self._lost[first] = 0
            self._suspects.append(chunk[0])


def compute(scene: str, chunk: Sequence[Case]) -> list[Done]:
    """On a worker: rows of some cases. Each thread has structures of its own."""
    jobs: dict[str, Job] = _HERE.__dict__.setdefault("jobs", {})
    if scene not in jobs:
        jobs[scene] = _PARCELS[scene].unpack()
    return [(number, replace(jobs[scene].row(values))) for number, values in chunk]


def _next(cases: Iterator[Case]) -> list[Case]:
    chunk = []
    for case in cases:
        chunk.append(case)
        if len(chunk) == CHUNK:
            break
    return chunk


def _plugin(scene: str, parcel: Parcel) -> Any:
    from distributed import WorkerPlugin

    class Scene(WorkerPlugin):
        """Gives a worker the job; this class travels by its text."""

        def __init__(self) -> None:
            self.name, self.scene, self.parcel = f"fairlead-{scene[:16]}", scene, parcel

        def setup(self, worker: Any) -> None:
            """Take the job; it is unpacked when the first case comes."""
            from fairlead.studies.sweeps import cluster

            cluster._PARCELS[self.scene] = self.parcel

    return Scene()
