"""Everything that takes part in the comparison: fairlead at its accuracies, scipy at its tolerances.

A contender is called again and again and returns an `Attempt`: times, error, counters. All are judged by
`peers.error` at the same sample times: for fairlead these are its recording grid, filled from the dense output
of the method as for scipy. fairlead solves the bundled models `belt` and `hundred_blocks`; scipy the same
equations as `peer_cases.py` writes them down in numpy.
"""

from __future__ import annotations

import functools
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from peer_cases import Belt
from peers import Case, Peer, error, event_driven, reference_positions, sample_times, smooth

WALL = 120.0  # [s]; an attempt that takes longer is given up


@dataclass(frozen=True)
class Attempt:
    """One run. `solve`: inside fairlead's compiled loop; `wall`: from the netlist to the states, without files."""

    error: float
    cpu: float
    solve: float
    wall: float
    counters: dict[str, int]


@dataclass(frozen=True)
class Contender:
    """Who, how, and the call that makes one attempt; `width` is the creep or the width of the smooth law [m/s]."""

    program: str
    law: str
    method: str
    accuracy: float
    width: float | None
    attempt: Callable[[], Attempt]

    @property
    def series(self) -> str:
        """The name of its line in the figure."""
        return f"{self.program} {self.law} {self.method}"


def of_fairlead(case: Case, full: bool) -> Iterator[Contender]:
    """Hold at all accuracies with the method of order 5, at some with order 3; binding over its creep."""
    accuracies = [10.0**-k for k in range(2, 10)]
    for method, chosen in (("rodas5p", accuracies), ("rodas3p", accuracies[2 : 7 if full else 4])):
        for accuracy in chosen:
            call = functools.partial(fairlead, case, "hold", method, accuracy, None)
            yield Contender("fairlead", "hold", method, accuracy, None, call)
    for creep in (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)[: 5 if full else 4]:
        accuracy = 1e-3  # of the steps; the creep alone decides the error
        call = functools.partial(fairlead, case, "binding", "rodas5p", accuracy, creep)
        yield Contender("fairlead", "binding", "rodas5p", accuracy, creep, call)


def of_scipy(case: Case, full: bool) -> Iterator[Contender]:
    """Exact switches with five methods, the smooth law with three; the quick set leaves out what is slow."""
    belt = isinstance(case, Belt)
    everything = {method: range(3, 10) for method in ("Radau", "BDF", "LSODA", "RK45", "DOP853")}
    quick = {"LSODA": range(4, 8), "RK45": range(3, 6), "DOP853": (6, 7), "BDF": (6,), "Radau": (4,)}
    for method, powers in (everything if belt or full else quick).items():
        for k in powers:
            call = functools.partial(_peer, case, functools.partial(event_driven, case, method, 10.0**-k, WALL))
            yield Contender("scipy", "events", method, 10.0**-k, None, call)
    widths = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6) if belt or full else (1e-2, 1e-3, 1e-4)
    for method in ("Radau", "BDF", "LSODA") if full else ("LSODA",):
        for width in widths:
            for k in (4, 5) if full else (4,):
                call = functools.partial(_peer, case, functools.partial(smooth, case, method, 10.0**-k, width, WALL))
                yield Contender("scipy", "smooth", method, 10.0**-k, width, call)


def fairlead(case: Case, law: str, method: str, accuracy: float, creep: float | None) -> Attempt:
    """One run of the bundled model. Raises RuntimeError when it does not reach its end."""
    from fairlead.integrate import Run, integrate

    times = sample_times(case)
    begun = time.perf_counter()
    system = compiled(case, law, accuracy, creep)
    chosen = system.record(["block.x" if isinstance(case, Belt) else "rod.block[*].x"])
    cpu = time.process_time()
    outcome = integrate(system, Run(stop=case.stop, every=case.stop / (times.size - 1), method=method, max_wall=WALL))
    cpu = time.process_time() - cpu
    if not outcome.ok:
        raise RuntimeError(outcome.sentence)
    positions = outcome.values[outcome.sides == 0, : len(chosen)]  # without the two sides of each switch
    wall = time.perf_counter() - begun
    if not np.allclose(outcome.times[outcome.sides == 0], times, rtol=0.0, atol=1e-12):
        raise RuntimeError("the recorded times are not those of the reference")
    states = np.zeros((times.size, 2 * positions.shape[1]))
    states[:, 0::2] = positions
    counters = {name: value for name, value in vars(outcome.counters).items() if isinstance(value, int)}
    found = error(case, Peer(times, states, 0.0, counters), reference(case))
    return Attempt(found, cpu, outcome.loop_wall, wall, counters)


def compiled(case: Case, law: str, accuracy: float, creep: float | None = None) -> Any:
    """The bundled model of a case as a System, fresh from its netlist."""
    import fairlead

    settings = {"friction.method": law, "run.accuracy": str(accuracy)}
    if creep is not None:
        settings["friction.creep"] = str(creep)
    if not isinstance(case, Belt):
        settings["blocks"] = str(case.blocks)
    return fairlead.load("belt" if isinstance(case, Belt) else "hundred_blocks", set=settings).system


def _peer(case: Case, run: Callable[[], Peer]) -> Attempt:
    cpu = time.process_time()
    peer = run()
    cpu = time.process_time() - cpu
    return Attempt(error(case, peer, reference(case)), cpu, peer.wall, peer.wall, peer.counters)


@functools.cache
def reference(case: Case) -> np.ndarray:
    """Positions at the sample times, read once."""
    return reference_positions(case)
