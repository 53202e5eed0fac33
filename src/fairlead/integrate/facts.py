"""What a problem knows of itself beside its equations, and what holds of one that knows nothing (`Plain`).

The engines are right without; with these facts they are quicker, and find what happens at one instant.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]


class Facts(Protocol):
    """Of n unknowns, ng guards and nz machines."""

    @property
    def stiff(self) -> Booleans:
        """[n]: differential unknowns that may follow what drives them within a step.

        `rodas` looks at them inside its steps too, as it does at algebraic ones and those with a cap.
        """

    @property
    def bodies(self) -> Booleans:
        """[n]: speeds of bodies, whose rates jump with every contact that is caught or let go.

        Inside its steps `stepping` judges the positions that they lead to in their place. A pressure or a signal of
        which a law keeps the integral is no such speed.
        """

    @property
    def gauge(self) -> Booleans:
        """[n]: unknowns of which one may be chosen at will: their values do not count as errors."""

    @property
    def summed(self) -> Booleans:
        """[n]: algebraic unknowns that are sums and drive nothing: an error of theirs is not larger in what flows."""

    @property
    def guard_inertia(self) -> Floats:
        """[ng]: for a guard on the slip of a contact that may hold, the inertia that resists its force; 0 for others.

        Live memory if the callbacks write to it. Settling then knows which of two wrong zones is the more so, a force
        beyond its limit or an acceleration against the friction (settling.py).
        """

    @property
    def kink_guard(self) -> Integers:
        """[ng]: 1 for guards at which f is continuous and only its slope jumps, as between two pieces of a table.

        `stepping` goes over such a kink by an implicit step where a law that is stiff bends there.
        """

    @property
    def least_guard(self) -> Integers:
        """[ng]: 1 for guards that are the least of several values, of which the part remembers that all had risen."""

    @property
    def blow_guard(self) -> Integers:
        """[ng]: 1 for guards that an impulse asks with the speeds before (impulse_zones.py), 0 for others.

        Of parts that only tell signals, and those that lead to the next piece of a table.
        """

    @property
    def latch_guard(self) -> Integers:
        """[ng]: 1 for guards of parts that only tell signals, and that remember that one fired, as a relay does.

        They wait until all others are in their zones: what they read is only tried until then (`latches_wait`).
        """

    @property
    def met_guard(self) -> Integers:
        """Guards of places at which a stop is met that takes any impulse: known to rounding (violators.py)."""

    @property
    def takes_impulse(self) -> Integers:
        """[n]: 0 for a row that never holds, 1 for one that takes no impulse but rounding, 2 for one that takes any.

        3 for a relation of positions, which takes any, and never meets what it keeps.
        """

    @property
    def held_too_much(self) -> Sequence[str]:
        """Names of machines that all together hold more than there is to hold, and how they share is not known."""

    @property
    def pressing(self) -> Integers:
        """[k, 2]: rows that hold for ever whose force other laws read through signals, as the friction of a screw does.

        With each the sign, 1 or -1, of the force by which a rigid part answers a push that nothing else answers.
        """

    @property
    def rebound(self) -> Floats:
        """[n]: the coefficient of restitution with which a row takes impulses, 0 for none (rebound.py)."""

    @property
    def moves(self) -> Integers:
        """[k, 3]: every position, its speed and its acceleration (-1: no unknown), if relations of positions are kept.

        Else none. Where the acceleration is an unknown, M has the mass in the row of the speed, and f mass times it.
        If none is, rows that hold speeds alone, as that of a stop on a shaker, know in `gap` what positions should be.
        """

    @property
    def balanced(self) -> Integers:
        """[k, 2]: position and (algebraic) speed of nodes without inertia whose row may be  0 = g + tau dg/dt.

        Where it is, `gap` gives tau g in the row of the speed, else zero (balance.py).
        """

    @property
    def ledger(self) -> tuple[int, int]:
        """Unknowns in which what is dissipated and what is supplied adds up, -1 for none (impulse_changes.py)."""

    @property
    def linear(self) -> bool:
        """True if f is linear as long as the zones are frozen: one solve a step for `stepping`."""

    @property
    def holder(self) -> Integers:
        """[n]: the machine that decides whether a row holds, -1 for none."""

    @property
    def limit_guard(self) -> Integers:
        """[ng]: 1 for guards that bound the force of their own contact while that holds.

        For `stepping`, fronts of slipping are then expected, not found one contact at a time.
        """

    @property
    def machine_kind(self) -> Integers:
        """[nz]: equal for machines that follow the same laws; what is learnt of one is a guess for the others."""

    @property
    def beyond_row(self) -> Integers:
        """Machines whose switch changes more rows of J and M than the one they hold: these are evaluated then."""

    @property
    def circle(self) -> Integers:
        """[n]: the circles of contacts that share what they hold have numbers from 1; that of the row, 0 for none."""

    @property
    def grows_with_slip(self) -> Integers:
        """[n]: for a row of a circle, 1 where its force would grow with its slip, were it a spring, -1 where fall.

        0 for other rows.
        """

    @property
    def falls(self) -> Integers:
        """[nz]: 1 for a contact whose friction falls with a jump as it lets go: the order may matter (release.py)."""

    @property
    def mean(self) -> Floats:
        """[5] or [0]: live memory that f and the guards read where motions are given in time, empty where none are.

        Times t0 and t1, weights w0 and w1: while their sum is above zero, positions and speeds that are given count
        with w0 x(t0) + w1 x(t1) + (1 - w0 - w1) x(t), and the last is 1 where that is another number than x(t).
        """

    @property
    def samples(self) -> bool:
        """True if `at_time` takes samples of the unknowns: they are then made consistent before."""

    @property
    def n_swings(self) -> int:
        """How many angles `swings` tells: of sines that only guards read, which no error of a step knows."""

    @property
    def longest_step(self) -> float:
        """Longest step [s]: what swings in time alone shows in no unknown while all rests."""


class WithSubsystem(Protocol):
    """What a problem at work knows besides."""

    @property
    def subsystem(self) -> Any:
        """What tells what moves and cuts it out as a problem of its own that records for all (parts.py); None: nothing.

        possible            whether that may be asked
        moving(t, y, margin, most, part)   .kept [n], .machines, .sure (it needs no proof by the run so far); None if
                            that is not worth while beside the part in force (or None)
        looked              what the last look found: all that it remembers
        part(t, y, that)    .problem, .unknowns, .machines, .guards (places in the whole), .boundary (1 for machines
                            of the part whose change sets more in motion), .sure; or None. prolong(t, y) puts into
                            the y of the whole what follows from the part, carry(v) into such a vector the slopes of
                            what is carried; placed(piece, whole) is the part at work in other memory
        """


class Plain:
    """A problem that knows nothing of the kind; every machine is of a kind of its own, whatever its name."""

    initial: Floats
    guard_machine: Integers
    zones: Integers
    linear = samples = False
    n_swings = 0
    longest_step = np.inf
    ledger = (-1, -1)
    held_too_much: Sequence[str] = ()
    subsystem = None

    @property
    def mean(self) -> Floats:
        """No motion is given."""
        return np.zeros(0)

    @property
    def stiff(self) -> Booleans:
        """None is."""
        return np.zeros(len(self.initial), dtype=bool)

    @property
    def bodies(self) -> Booleans:
        """Every unknown that another is the integral of."""
        return np.ones(len(self.initial), dtype=bool)

    @property
    def gauge(self) -> Booleans:
        """None is."""
        return np.zeros(len(self.initial), dtype=bool)

    @property
    def summed(self) -> Booleans:
        """None is."""
        return np.zeros(len(self.initial), dtype=bool)

    @property
    def guard_inertia(self) -> Floats:
        """None is known."""
        return np.zeros(len(self.guard_machine))

    @property
    def kink_guard(self) -> Integers:
        """None is."""
        return np.zeros(len(self.guard_machine), dtype=np.int64)

    @property
    def least_guard(self) -> Integers:
        """None is known to be."""
        return np.zeros(len(self.guard_machine), dtype=np.int64)

    @property
    def blow_guard(self) -> Integers:
        """None is of such."""
        return np.zeros(len(self.guard_machine), dtype=np.int64)

    @property
    def latch_guard(self) -> Integers:
        """None is known to."""
        return np.zeros(len(self.guard_machine), dtype=np.int64)

    @property
    def met_guard(self) -> Integers:
        """None is known."""
        return np.zeros(0, dtype=np.int64)

    @property
    def takes_impulse(self) -> Integers:
        """No row does."""
        return np.zeros(len(self.initial), dtype=np.int64)

    @property
    def pressing(self) -> Integers:
        """No force is read."""
        return np.zeros((0, 2), dtype=np.int64)

    @property
    def rebound(self) -> Floats:
        """No row does."""
        return np.zeros(len(self.initial))

    @property
    def moves(self) -> Integers:
        """None are kept."""
        return np.zeros((0, 3), dtype=np.int64)

    @property
    def balanced(self) -> Integers:
        """None are."""
        return np.zeros((0, 2), dtype=np.int64)

    @property
    def holder(self) -> Integers:
        """No machine is known to."""
        return np.full(len(self.initial), -1, dtype=np.int64)

    @property
    def limit_guard(self) -> Integers:
        """None is known."""
        return np.zeros(len(self.guard_machine), dtype=np.int64)

    @property
    def machine_kind(self) -> Integers:
        """What is learnt of one says nothing about others, which is safe."""
        return np.arange(len(self.zones), dtype=np.int64)

    @property
    def beyond_row(self) -> Integers:
        """None."""
        return np.zeros(0, dtype=np.int64)

    @property
    def circle(self) -> Integers:
        """None lies in one."""
        return np.zeros(len(self.initial), dtype=np.int64)

    @property
    def grows_with_slip(self) -> Integers:
        """None lies in a circle."""
        return np.zeros(len(self.initial), dtype=np.int64)

    @property
    def falls(self) -> Integers:
        """None is known to."""
        return np.zeros(len(self.zones), dtype=np.int64)
