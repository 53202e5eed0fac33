"""Everything that takes part in the comparison: fairlead's engines at their accuracies, its peers at their tolerances.

A contender is called again and again and returns an `Attempt`: times, error, counters. All are judged by
`peers.error` at the same sample times: for fairlead these are its recording grid, filled from the dense output
of the engine as for scipy. fairlead solves the bundled models `belt` and `hundred_blocks`; its peers the same
equations as `peer_cases.py` writes them down in numpy, MuJoCo as a model of its own kind.
"""

from __future__ import annotations

import functools
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from peer_cases import Belt, Chain
from peer_cvode import cvode
from peer_mujoco import INTEGRATORS, mujoco, steps
from peer_pathsim import SOLVERS, pathsim
from peer_scipy import event_driven, smooth
from peers import Case, Peer, error, reference_positions, sample_times

LIMIT, LIMIT_LONG = 30.0, 150.0  # CPU time [s] after which an attempt is given up; of long chains and the full set
LONG = 200  # blocks; of a longer chain most ways take minutes: fewer tolerances


@dataclass(frozen=True)
class Attempt:
    """One run. `cpu`: processor time of the call; `solve`: of fairlead's loop alone; `wall`: the call by the clock."""

    error: float
    cpu: float
    solve: float
    wall: float
    counters: dict[str, int]


@dataclass(frozen=True)
class Contender:
    """Who, how, and the call that makes one attempt.

    `accuracy` is the tolerance asked for (of MuJoCo the step [s]), `width` the creep or the width of the smooth
    law [m/s].
    """

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


def contenders(case: Case, full: bool) -> list[Contender]:
    """All that take part in a case; the quick set leaves out what is known to be slower or less exact."""
    of = (of_fairlead, of_scipy, of_cvode, of_pathsim, of_mujoco)
    return [each for group in of for each in group(case, full)]


def of_fairlead(case: Case, full: bool) -> Iterator[Contender]:
    """Every engine with exact friction, and binding over its creep."""
    long = _long(case)
    ways: dict[tuple[str, str], tuple[float, ...]] = {
        ("hold", "rodas5p"): (1e-3, 1e-5) if long else tuple(10.0**-k for k in range(2, 9)),
        ("hold", "rodas3p"): () if long else (1e-3, 1e-4, 1e-5),
        ("hold", "stepping"): (1e-2, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, *((3e-7,) if long else ())),
        ("hold", "ida"): (1e-3,) if long else (1e-2, 1e-3, 1e-4, 1e-5),
    }
    for (law, method), accuracies in ways.items():
        for accuracy in accuracies:
            call = functools.partial(fairlead, case, law, method, accuracy, None, _limit(case, full))
            yield Contender("fairlead", law, method, accuracy, None, call)
    for creep in (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)[: 5 if full else 3 if long else 4]:
        accuracy = 1e-3  # of the steps; the creep alone decides the error
        call = functools.partial(fairlead, case, "binding", "rodas5p", accuracy, creep, _limit(case, full))
        yield Contender("fairlead", "binding", "rodas5p", accuracy, creep, call)


def of_scipy(case: Case, full: bool) -> Iterator[Contender]:
    """Exact switches with five methods, the smooth law with three."""
    small, long = isinstance(case, Belt) or case.blocks < 100, _long(case)
    everything = {method: range(3, 10) for method in ("Radau", "BDF", "LSODA", "RK45", "DOP853")}
    quick = {"LSODA": range(5, 10), "RK45": range(3, 9), "DOP853": range(4, 10), "BDF": (5, 7), "Radau": (4, 6)}
    slow = {"LSODA": range(4, 8), "RK45": range(3, 6), "DOP853": (6, 7), "BDF": (6,), "Radau": (4,)}
    longest = {"LSODA": (7,), "RK45": (5,), "DOP853": (7,), "BDF": (6,), "Radau": (5,)}  # looser ones chatter
    chosen = everything if full else longest if long else quick if small else slow
    for method, powers in chosen.items():
        for k in powers:
            run = functools.partial(event_driven, case, method, 10.0**-k, _limit(case, full))
            yield _peer_of(case, "scipy", "events", method, 10.0**-k, None, run)
    widths = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6) if full else (1e-3, 1e-4, 1e-5)
    for method in ("Radau", "BDF", "LSODA") if full or long else ("LSODA",):
        for width in widths if full or not long else (*widths, 3e-6) if method == "LSODA" else widths[:1]:
            for k in (4, 5) if full else (4,):
                run = functools.partial(smooth, case, method, 10.0**-k, width, _limit(case, full))
                yield _peer_of(case, "scipy", "smooth", method, 10.0**-k, width, run)


def of_cvode(case: Case, full: bool) -> Iterator[Contender]:
    """SUNDIALS CVODE with the guards as root functions, both of its methods."""
    long = _long(case)
    for method in ("BDF", "Adams"):
        for k in range(3, 9) if full or not long else range(4, 10) if method == "BDF" else (4, 6, 8):
            run = functools.partial(cvode, case, method, 10.0**-k, _limit(case, full))
            yield _peer_of(case, "sundae", "events", method, 10.0**-k, None, run)


def of_pathsim(case: Case, full: bool) -> Iterator[Contender]:
    """PathSim's explicit methods, of which the longer chains take the cheaper ones."""
    blocks = 1 if isinstance(case, Belt) else case.blocks
    for method in SOLVERS if full or blocks < 100 else SOLVERS[:2] if blocks < 1000 else SOLVERS[:1]:
        for k in range(2, 8) if full else (3, 4, 6) if blocks < 100 else (3, 5) if blocks < 1000 else (3,):
            run = functools.partial(pathsim, case, method, 10.0**-k, _limit(case, full))
            yield _peer_of(case, "PathSim", "events", method, 10.0**-k, None, run)


def of_mujoco(case: Case, full: bool) -> Iterator[Contender]:
    """MuJoCo's integrators over their steps; the belt is tried once, to say why it cannot be done."""
    tried = 6 if full or isinstance(case, Belt) or case.blocks < 100 else 3 if case.blocks < 1000 else 1
    for integrator in INTEGRATORS[:1] if isinstance(case, Belt) else INTEGRATORS:
        for step in (0.0,) if isinstance(case, Belt) else steps(case, integrator)[:tried]:
            run = functools.partial(mujoco, case, integrator, step, _limit(case, full))
            yield _peer_of(case, "MuJoCo", "frictionloss", integrator, step, None, run)


def _limit(case: Case, full: bool) -> float:
    return LIMIT_LONG if full or _long(case) else LIMIT


def _long(case: Case) -> bool:
    return isinstance(case, Chain) and case.blocks > LONG


def fairlead(case: Case, law: str, method: str, accuracy: float, creep: float | None, limit: float) -> Attempt:
    """One run of the bundled model. Raises RuntimeError when it does not reach its end."""
    from fairlead.integrate import Run, integrate

    times = sample_times(case)
    system = compiled(case, law, accuracy, creep)
    signals = ["block.x" if isinstance(case, Belt) else "rod.block[*].x"]
    chosen = system.recording(signals).chosen
    engine = {"method": method} if method.startswith("rodas") else {"engine": method}
    run = Run(stop=case.stop, every=case.stop / (times.size - 1), max_wall=2 * limit, record=signals, **engine)
    cpu, wall = time.process_time(), time.perf_counter()
    outcome = integrate(system, run)
    cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    if not outcome.ok:
        raise RuntimeError(outcome.sentence)
    positions = outcome.values[outcome.sides == 0, : len(chosen)]  # without the two sides of each switch
    if not np.allclose(outcome.times[outcome.sides == 0], times, rtol=0.0, atol=1e-12):
        raise RuntimeError("the recorded times are not those of the reference")
    states = np.zeros((times.size, 2 * positions.shape[1]))
    states[:, 0::2] = positions
    counters = {name: value for name, value in vars(outcome.counters).items() if isinstance(value, int)}
    return Attempt(error(case, Peer(times, states, counters), reference(case)), cpu, outcome.loop_cpu, wall, counters)


def compiled(case: Case, law: str, accuracy: float, creep: float | None = None) -> Any:
    """The bundled model of a case as a System, fresh from its netlist."""
    import fairlead

    settings = {"friction.method": law, "run.accuracy": str(accuracy)}
    if creep is not None:
        settings["friction.creep"] = str(creep)
    if not isinstance(case, Belt):
        settings["blocks"] = str(case.blocks)
    return fairlead.load("belt" if isinstance(case, Belt) else "hundred_blocks", set=settings).system


def _peer_of(case: Case, program: str, law: str, method: str, accuracy: float, width: float | None,
             run: Callable[[], Peer]) -> Contender:  # fmt: skip
    return Contender(program, law, method, accuracy, width, functools.partial(_attempt, case, run))


def _attempt(case: Case, run: Callable[[], Peer]) -> Attempt:
    cpu, wall = time.process_time(), time.perf_counter()
    peer = run()
    cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    return Attempt(error(case, peer, reference(case)), cpu, cpu, wall, peer.counters)


@functools.cache
def reference(case: Case) -> np.ndarray:
    """Positions at the sample times, read once."""
    return reference_positions(case)
