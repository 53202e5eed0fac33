"""What any problem hands to an integrator, the settings of a run, and what comes back.

The equations are

    M(zones) y' = f(t, y, zones, discrete)

with M constant, possibly singular, while the zones are frozen (index 1). Zones change when a guard rises through zero:
at the end of an accepted piece, or for a trial of `stepping` that looks for the zones of its end. A problem fits
`Problem` by shape: it need not import this module. All callbacks are addresses of C functions, so that the loop is
compiled once for all problems; `context` is passed through untouched.

A `Problem` is frozen: any number of runs, in any number of threads, use it. For each run it makes an `Instance`: what
the callbacks change, the zones first of all, is the instance's own, and so are the error weights, which follow the
accuracy that the run asks for, and the choice of what is recorded.

    rhs       void   (ctx, t, y, f)               f[n]
    jacobian  void   (ctx, t, y, values, ft)      df/dy along `pattern`; ft[n] = partial f / partial t
    mass      void   (ctx, values)                M along `mass_pattern`, for the zones in force
    guards    void   (ctx, t, y, g)               g[ng]; negative inside the zone in force, -1 if not in force
    switch    int64  (ctx, t, y, fired, nfired)   sets new zones; may change y; returns how many zones changed
    slip      int64  (ctx, t, y, r)               r[n] = 0 but -v_rel on held rows; returns how many rows hold
    next_time double (ctx, t)                     the next time event strictly later than t, or inf
    at_time   int64  (ctx, t, y)                  t is the start or a time event; 1 if anything changed
    outputs   void   (ctx, t, y, out)             out[n_outputs], in the zones in force
    forces    void   (ctx, t, y, f)               all of f but quadratures: in their rows is anything
    slopes    void   (ctx, t, y, values, ft)      all of df/dy but the rows of quadratures, likewise
    drift     void   (ctx, t, y, r)               -v_rel on all held rows; slip leaves out those in which a contact
                                                  that bears a limited force slips too fast to be held

    gap       void   (ctx, t, y, r)               r[n] = 0 but -g on the rows of relations g of positions that
                                                  are kept (facts.py, moves); asked for where there are any

    ahead     void   (ctx, t, y, f)               f with given motions on the chord of a step (facts.py, mean), less
                                                  f with them where they are at t; asked for where there are any

What a problem knows beside its equations is in `facts.py`; one made of plain functions knows nothing of that.

ctx is int64*, t a double, the others double* or int64*. All after mass may be missing (or zero):
no guards, no held contacts, no time events; outputs missing records y itself; rhs, jacobian and slip
stand in for forces, slopes and drift.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any, Literal, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

import fairlead.integrate.codes as codes
from fairlead.integrate.counters import Counters
from fairlead.integrate.engine import Engine
from fairlead.integrate.facts import Facts, WithSubsystem

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]
Bytes = NDArray[np.uint8]

MOST_DWELL, DWELL_SHARE = 1e-6, 1e-2
"""Share of the span, and of the accuracy in it, that a dwell is at most when it is not given."""
CALLBACKS = (
    "rhs", "jacobian", "mass", "guards", "switch", "slip", "next_time", "at_time", "outputs", "forces", "drift",
    "slopes", "gap", "ahead", "swings",
)  # fmt: skip
"""The names a problem may use in `callbacks`; the first three must be there."""

EVENT = np.dtype(
    [("t", "f8"), ("machine", "i8"), ("before", "i8"), ("after", "i8"), ("guard", "i8"), ("position", "i8")]
)
"""One zone change: time, machine, zone before and after, the guard that fired (-1: no guard of its
own, for instance a time event), and the pass of the settling it happened in (0 first)."""


class Pattern(NamedTuple):
    """Where the entries of a sparse n x n matrix may be, by columns (CSC)."""

    starts: Integers
    """[n + 1]: column j owns the entries starts[j] .. starts[j + 1] - 1."""
    rows: Integers
    """[nnz], ascending within a column."""

    def __repr__(self) -> str:
        """How large it is."""
        return f"<Pattern of {len(self.starts) - 1} columns, {len(self.rows)} entries>"


class AnyPattern(Protocol):
    """What serves as a `Pattern`: anything with these two arrays."""

    @property
    def starts(self) -> Integers:
        """As in Pattern."""

    @property
    def rows(self) -> Integers:
        """As in Pattern."""


class Problem(Facts, Protocol):
    """The shape of a problem; see the module docstring for the callbacks."""

    @property
    def callbacks(self) -> Mapping[str, int]:
        """Addresses of C functions by the names in CALLBACKS."""

    @property
    def initial(self) -> Floats:
        """[n]: y at the start; algebraic entries are a first guess."""

    @property
    def pattern(self) -> AnyPattern:
        """Where df/dy may have entries."""

    @property
    def mass_pattern(self) -> AnyPattern:
        """Where M may have entries, in any zones."""

    @property
    def zones(self) -> Integers:
        """[nz]: the zone of each machine at the start."""

    @property
    def differential(self) -> Booleans:
        """[n]; False: y_i is algebraic, its column of M is empty."""

    @property
    def quadrature(self) -> Booleans:
        """[n]; True: nothing depends on y_i and it has no weight in the error norm."""

    @property
    def guard_machine(self) -> Integers:
        """[ng]; the machine each guard belongs to, -1 for none."""

    @property
    def unknown_names(self) -> Sequence[str]:
        """[n]."""

    @property
    def machine_names(self) -> Sequence[str]:
        """[nz]."""

    @property
    def guard_names(self) -> Sequence[str]:
        """[ng]."""

    def zone_names(self, machine: int) -> Sequence[str]:
        """Names of the zones of one machine, by the numbers in `zones`."""

    @property
    def room(self) -> int:
        """Bytes that the callbacks change in a run, zones among them."""

    def instance(self, run: Run, piece: Bytes | None = None) -> Instance:
        """The problem in one run, at work in `piece`: `room` bytes, zero at first; None: in memory of its own.

        All that its callbacks change lies there, and no address, so that a copy of the bytes is a copy of the state.
        """


class Instance(Problem, WithSubsystem, Protocol):
    """A problem in one run: what the callbacks work on, and what the run chooses."""

    @property
    def context(self) -> int:
        """What every callback gets first; passed through untouched."""

    @property
    def zones(self) -> Integers:
        """[nz]: live memory that the callbacks read and `switch` writes, the zone of each machine."""

    @property
    def absolute(self) -> Floats:
        """[n]: the error weight of y_i is min(absolute_i + relative_i |y_i|, cap_i)."""

    @property
    def relative(self) -> Floats:
        """[n], see absolute."""

    @property
    def cap(self) -> Floats:
        """[n], see absolute."""

    @property
    def guard_tolerance(self) -> Floats:
        """[ng]; at an accepted point no guard may be above this.

        Of a step with switches inside that is judged before its end is moved by the error of its rule
        (docs/stepping.md).
        """

    @property
    def n_outputs(self) -> int:
        """How many numbers `outputs` writes."""

    def remembered(self) -> Any:
        """A copy of what callbacks in plain Python know beside."""

    def remind(self, known: Any) -> None:
        """Give callbacks in plain Python back what they knew."""

    def raise_if_failed(self) -> None:
        """Raise what a callback in plain Python ended with, unless the problem tells that by itself."""


@dataclass(frozen=True)
class Run:
    """Settings of one run. None means: the integrator chooses, as stated."""

    stop: float
    start: float = 0.0
    accuracy: float | None = None
    """From which the problem has its error weights; None: those that it states itself."""
    record: Sequence[str] | None = None
    """Names of the outputs to record, with * and ?, of a problem that has names for them; None: all."""
    every: float | None = None
    """Record on this grid (and both sides of each event); None: every accepted step."""
    between: bool = False
    """Hand over rows inside steps as well, and with a grid the ends of steps (`Block.side`)."""
    engine: Literal["rodas", "stepping", "ida"] | Engine = "rodas"
    """rodas: Rosenbrock, every switch located; stepping: the midpoint rule made one of order three, zones found with
    each step (theta_step.py) or, up to `most_located` machines, every switch located; ida: BDF by SUNDIALS, every
    switch located (ida/loop.py), which needs scikit-sundae; or one of one's own (engine.py)."""
    method: Literal["rodas5p", "rodas3p"] = "rodas5p"
    """Of `rodas`."""
    theta: float = 0.5
    """Of `stepping`: 1/2, of order three (third_order.py); above it, up to 1, the theta rule alone, of order one."""
    most_located: int = 40
    """Of `stepping`: machines up to which it ends its steps at every switch (located_step.py). Each costs a settlement,
    so those of many machines would cost more than the steps between."""
    first_step: float | None = None
    max_step: float = np.inf
    fixed_step: float | None = None
    """Take this step without error control. Time events are landed on; switches are located, but for `stepping`, which
    has them inside its steps then. Only at a jump of a law that is not known to hold a row it ends a step sooner."""
    real_time: bool = False
    """Of `stepping` with a `fixed_step`: steps end where multiples of it after the start do, and the work in each is
    bounded (stepping/frames.py). What was not done in time is counted (`Counters.overruns`)."""
    step_floor: float | None = None
    """Smallest step, and what several switches in a row must advance; None: what time can resolve (1e-18
    of the span at least) for steps, 1e-12 of the span for switches."""
    max_steps: int | None = None
    max_events: int | None = None
    max_wall: float | None = None
    max_passes: int | None = None
    """Passes of one settling before it counts as not settled; None: 100, and four for every machine."""
    dwell: float | None = None
    """A machine that toggles again and again within this time chatters. None: a hundredth of the accuracy, at most
    1e-6, of the span, and no longer than nothing moves by more than a tenth of its error weight."""
    on_chatter: Literal["warn", "hold", "stop"] = "warn"
    """warn: name it and go on; hold: freeze its zone for one dwell each time; stop: end the run."""

    @property
    def longest_dwell(self) -> float:
        """The dwell [s] that was given, or else the most that it may be."""
        if self.dwell is not None:
            return self.dwell
        share = MOST_DWELL if self.accuracy is None else min(MOST_DWELL, DWELL_SHARE * self.accuracy)
        return share * (self.stop - self.start)


class Status(IntEnum):
    """How a run ended (negative: inside the loop, returned to Python for service); numbers of codes.py."""

    FINISHED = codes.FINISHED
    PAUSED = codes.PAUSED
    BUFFER_FULL = codes.BUFFER_FULL
    REPLAN = codes.REPLAN
    RESTRICT = codes.RESTRICT
    REACTIVATE = codes.REACTIVATE
    STEP_FLOOR = codes.STEP_FLOOR
    NOT_FINITE = codes.NOT_FINITE
    NOT_SETTLED = codes.NOT_SETTLED
    INCONSISTENT = codes.INCONSISTENT
    SINGULAR = codes.SINGULAR_MATRIX
    CHATTER = codes.CHATTER
    MAX_STEPS = codes.MAX_STEPS
    MAX_EVENTS = codes.MAX_EVENTS
    MAX_WALL = codes.MAX_WALL
    INTERRUPTED = codes.INTERRUPTED
    REBOUND_RUBS = codes.REBOUND_RUBS
    ENDED = codes.ENDED
    GIVEN_APART = codes.GIVEN_APART

    @property
    def is_budget(self) -> bool:
        """True if a budget of the user ended the run, or the user did."""
        return self in (Status.MAX_STEPS, Status.MAX_EVENTS, Status.MAX_WALL, Status.INTERRUPTED)


class Block(NamedTuple):
    """What a slice of the run recorded, handed over when a buffer fills or a slice of time ends."""

    t: Floats
    """[k], not decreasing; repeats at an event, left and right value."""
    values: Floats
    """[k, n_outputs]."""
    side: NDArray[np.int8]
    """[k]: 0 an ordinary point, 1 just before an event, 2 just after it; `between` adds those of rows.py."""
    events: np.ndarray
    """Zone changes, dtype EVENT."""
    reached: float
    """The time the run has reached."""
    fraction: float
    """The same as a fraction of the span, for a progress display."""


class End(NamedTuple):
    """What `on_block` returns to end a run at a recorded time, since what follows means nothing."""

    t: float
    sentence: str
    culprits: tuple[str, ...] = ()


OnBlock = Callable[[Block], object]


@dataclass(frozen=True)
class Outcome:
    """How a run ended, and what it cost."""

    status: Status
    sentence: str
    """What happened, likely causes, what to try."""
    t: float
    """The last good time."""
    y: Floats
    """The unknowns there; of a run that `on_block` ended, where the engine had got to."""
    culprits: tuple[str, ...]
    """Unknowns or machines to look at first."""
    chattering: tuple[str, ...]
    """Machines that toggled faster than their dwell, whatever the reaction."""
    counters: Counters
    begun: Floats
    """[n]: the unknowns as they were settled at the start; zeros if they were not."""
    most_moved: float
    """The farthest, in error weights, that the end of a step was brought back to relations of positions."""
    lost: Floats
    """[n]: energy lost in impacts, J, by the row that held."""
    not_given_back: Floats
    """[n]: the fastest slip of a row that should rebound and had not yet, slow as it was; else not above zero."""
    joined: Floats
    """[n]: how many impulses a row that rebounds took together with others."""
    first_joined: Floats
    """[n]: when it took the first of them, s."""
    first_overrun: tuple[float, str] | None
    """Of a run in real time: when the first step overran, s, and what with."""
    wall: float
    """Seconds spent, all included."""
    loop_wall: float
    """Seconds spent inside the compiled loop, and on cutting out what moves."""
    loop_cpu: float
    """The same in seconds of processor time, which other programs on the machine do not disturb."""
    problem: Any = field(repr=False)
    """The instance that the run worked on, as it left it: zones, and what else the callbacks change."""
    blocks: tuple[Block, ...] = field(default=(), repr=False)
    """What was recorded, when no `on_block` took it."""

    @property
    def ok(self) -> bool:
        """True if the run reached its stop time."""
        return self.status == Status.FINISHED

    @property
    def times(self) -> Floats:
        """All recorded times [k]."""
        return np.concatenate([block.t for block in self.blocks])

    @property
    def values(self) -> Floats:
        """All recorded outputs [k, n_outputs]."""
        return np.concatenate([block.values for block in self.blocks])

    @property
    def sides(self) -> NDArray[np.int8]:
        """Side of each recorded row [k], see `Block.side`."""
        return np.concatenate([block.side for block in self.blocks])

    @property
    def events(self) -> np.ndarray:
        """All zone changes, dtype EVENT."""
        return np.concatenate([block.events for block in self.blocks])
