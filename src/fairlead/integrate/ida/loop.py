"""The `ida` engine: steps by SUNDIALS IDA (variable-order BDF), all the rest as in `rodas`.

    TRY      h, order = IDA                        one internal step; zones, M frozen since the last settlement
             guards are IDA's root functions; the trigger rule judges its step (crossing.py)
    RECORD, ARRIVE, SETTLE                         the compiled loop of `rodas`, which is entered for no step

IDA is started afresh after every settlement, at order one, because a switch invalidates the history of a
multistep method. So it costs some ten steps per switch where a one-step method costs one or two: it is
here as an independent check, by the family of methods the technique was first published with, not for
speed. Differences from `rodas`, numbered:

1. Weights. IDA takes the root mean square over the unknowns; weights are divided by sqrt(n), which makes
   its norm at least the largest weighted error (controller.py, choice 1). It knows absolute_i plus one
   relative part; where unknowns differ in it, or have a cap, weights are frozen at a restart and IDA is
   restarted when one of them is to become four times smaller. None is below LEAST_WEIGHT of its value.
2. Recording inside a step is by the cubic through the values and rates of both ends, which is as exact
   as the method up to its order three.
3. Quadratures have their weights like all unknowns: IDA leaves uncorrected what weighs nothing, and the
   energy of the belt closed to 0.9 instead of 4e-4.
4. IDA does not tell its rejected steps; they are not counted.
5. fixed_step, method and theta belong to the other engines.
6. Positions are not brought back to what a row that holds knows of them: a step goes on from the history of those
   before. So it has no relations of positions. A body that leaves a stop which moves as given, which it is off by the
   error of the run, ends the run: with zones that do not settle, or by meeting that stop again and again.
7. IDA chooses its steps. Only the first after a restart is given: by |y''| alone, as the method begins at order one,
   and in the mean of choice 1. What the settlement chose (arrival.first_step) is not read.

Source of the method: Hindmarsh et al., ACM TOMS 31:363, 2005, DOI 10.1145/1089014.1089020; the Python
package is scikit-sundae.
"""

from __future__ import annotations

import numpy as np

import fairlead.integrate.machine_code as machine_code
from fairlead.integrate.ida.solver import Refused, Solver
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.problem import Floats, Instance, Run, Status
from fairlead.integrate.rodas.engine import RODAS

CAUTION = 0.1
"""Weights given to IDA, in weights of the problem. It steps to the limit of its error, and restarts often: with 1
(order 3, accuracy 1e-3) the belt ended 6 mm off after 49 cycles and the sandwich switched 471 times in 2 s
instead of 77; with 0.1 it was 0.8 mm and 81 times, for 1.5 times the steps."""
MANY_MACHINES = 10
"""From here on the order is at most three. Between two switches of a chain it hardly ever passes that, so that the
cap costs nothing, and BDF of order four and five amplify motion without damping: the single bend made 1058
switches in 2 s with them, 948 without, 897 by rodas."""
RELAXED = 4.0
"""IDA is restarted when a frozen weight has become this many times too large."""
START_ERROR = 0.1
"""Error of the first step after a restart, in weights: it is of order one and has no estimate to correct it."""
RETREAT = 1e-3
"""After a failure IDA is started again from the last good point, with this share of the step that failed."""
RETRIED = 0.5
"""A step that is cut at a switch where it does not satisfy the equations is taken again with this share of it."""
GROWTH_STRIDE = 0.2
"""Step in times 1/w where a slip grows by e^(w t) from nothing (growth.py). A long one damps what grows: the contact
rests where its forces balance until they have left it by far. At 1/w the matrix of order one is singular."""
GROWTH_SEEN = 1e-2
"""Bend of the motion over such a step, in weights, from which on IDA sees by itself how long it may be."""
MET_AGAIN = 20
"""Times a stop that moves as given is kept as it is for a dwell, since it was met and left faster than that, until the
run ends: positions off by its error cross the stop without end."""
LEAST_WEIGHT = 100 * float(np.finfo(np.float64).eps)
"""A weight given to IDA over its value, at least. Below `eps` IDA refuses (IDA_TOO_MUCH_ACC), however short the step,
and near that its error is rounding. Energies and positions have absolute weights: at accuracy 1e-6, 1e8 J or 1000 km
are there."""
LEAST_STEP = 1e-14
"""First step of a restart over the span, at least."""


class SundialsLoop:
    """Like the compiled loops: called with the address of the struct and a number of steps, returns a status."""

    def __init__(self, problem: Instance, run: Run, memory: Memory) -> None:
        """Nothing is started yet; raises UsageError when scikit-sundae is missing."""
        self.memory, self.run = memory, run
        self.met = memory.array["guard_machine"][memory.array["met_guard"]] if memory.number["n_moves"] > 0 else []
        memory.number["n_moves"] = 0
        self.go_on = machine_code.compiled_loop(RODAS)
        self.kernels = machine_code.compiled_sundials()
        self.max_step = min(float(memory.number["max_step"]), run.stop - run.start)
        self.least_step = run.step_floor or 0.0
        self.max_order = 3 if len(problem.zones) >= MANY_MACHINES else 5
        self.solver = Solver(memory, self.kernels)
        self.weights = Weights(problem)
        self.fresh = False
        """IDA was started at the point and has made no step since."""
        self.started_with, self.last_step = 0.0, 0.0
        self.slope_before = np.zeros(0)

    def __call__(self, address: int, attempts: int) -> int:
        """Run on for at most `attempts` steps."""
        number = self.memory.number
        while True:
            status = self.go_on(address, 0)
            if status != Status.PAUSED or attempts <= 0:
                return status
            if len(self.met) and self.meets_again():
                return Status.CHATTER
            attempts -= 1
            if number["steps"] >= number["max_steps"]:
                return Status.MAX_STEPS
            if number["total_events"] >= number["max_events"]:
                return Status.MAX_EVENTS
            ended = self.attempt(address)
            if ended is not None:
                return ended

    def meets_again(self) -> bool:
        """True if a stop is met and left without end; it is the culprit then."""
        number, often = self.memory.number, self.memory.array["chatters"][self.met]
        if often.max() < MET_AGAIN:
            return False
        number["culprit"] = self.met[int(often.argmax())]
        return True

    def attempt(self, address: int) -> Status | None:
        """One step of IDA, judged; or the status that ends the run."""
        number, array = self.memory.number, self.memory.array
        number["t_land"] = min(number["stop"], number["t_next"], number["t_release"])
        # A settlement leaves last_error at zero: the last step says nothing about the next.
        if number["last_error"] == 0.0 or not self.solver.running:
            self.restart(self.first_step())
        elif self.weights.outgrown(array["y"]) or self.has_grown():
            self.restart(self.last_step)
        self.slope_before = array["slope"].copy() if number["growth"] > 0.0 else self.slope_before
        try:
            step = self.solver.step(float(number["t_land"]))
        except Refused as refused:
            return self.failed(address, singular=True) if refused.status == Status.SINGULAR else refused.status
        if step is None:
            return self.failed(address)
        self.fresh = False
        self.last_step = step.t - float(number["t"])
        at = [each.ctypes.data for each in (step.y, step.rate, step.rooted)]
        if self.kernels["judge_step"](address, step.t, *at, len(step.rooted), self.floor):
            self.take_again()
        return None

    def restart(self, first_step: float) -> None:
        """Start IDA at the point, with weights of the point."""
        array, number = self.memory.array, self.memory.number
        algebraic = array["differential"] == 0
        array["slope"][algebraic] = array["curvature"][algebraic]
        relative, absolute = self.weights.freeze(array["y"])
        longest = min(self.max_step, float(number["swing_step"]))
        longest = min(longest, GROWTH_STRIDE / number["growth"]) if number["growth"] > 0.0 else longest
        self.solver.start(
            float(number["t"]), array["y"], array["slope"], rtol=relative, atol=absolute,
            first_step=min(first_step, longest), max_step=longest, min_step=self.least_step, max_order=self.max_order,
        )  # fmt: skip
        number["last_error"] = 1.0
        self.fresh, self.started_with = True, first_step

    def has_grown(self) -> bool:
        """True if what grew from nothing is seen by now, or never will be; it is forgotten then."""
        number, array = self.memory.number, self.memory.array
        if number["growth"] == 0.0:
            return False
        change = np.where(array["differential"] == 1, array["slope"] - self.slope_before, 0.0) * self.last_step
        if number["t"] < number["t_growth"] and np.max(np.abs(change) / self.weights.at(array["y"])) < GROWTH_SEEN:
            return False
        number["growth"] = 0.0
        return True

    def first_step(self) -> float:
        """The first step: its error h^2/2 |y''| is START_ERROR, or what the run says at its start."""
        number, array = self.memory.number, self.memory.array
        rest = float(number["t_land"] - number["t"])
        if number["steps"] == 0 and self.run.first_step is not None:
            return min(self.run.first_step, rest)
        weight = self.weights.at(array["y"])
        differential = array["differential"] == 1
        curvature = np.where(differential, array["curvature"], 0.0) / weight
        size = float(np.sqrt(np.sum(curvature * curvature)))
        h = np.sqrt(2.0 * START_ERROR / size) if size > 0.0 else rest
        least = max(LEAST_STEP * (self.run.stop - self.run.start), 4e-15 * abs(number["t"]))
        return float(min(max(min(h, 0.1 * (self.run.stop - self.run.start)), least), rest))

    def take_again(self) -> None:
        """A step missed what happens shortly before a switch: start again at the point with a part of it."""
        self.restart(max(RETRIED * self.last_step, self.floor))

    @property
    def floor(self) -> float:
        """The shortest step at the point."""
        span = self.run.stop - self.run.start
        return max(LEAST_STEP * span, 4e-15 * abs(float(self.memory.number["t"])), self.least_step)

    def failed(self, address: int, *, singular: bool = False) -> Status | None:
        """IDA made no step: start it again from here with a much shorter one, until there is none.

        A `singular` matrix too: IDA asks at points far ahead, where friction that rises towards rest, mirrored
        beyond it, may not be finite, or may grow by just what the step would have it.
        """
        number = self.memory.number
        tried = self.started_with if self.fresh else self.last_step
        if tried > self.floor:
            self.restart(max(RETREAT * tried, self.floor))
            return None
        number["h"] = self.floor
        return Status.SINGULAR if singular else Status(self.kernels["find_culprit"](address))


class Weights:
    """Error weights of a problem in the form that IDA takes."""

    def __init__(self, problem: Instance) -> None:
        """Choose the form: one relative tolerance for all, or weights that are frozen at restarts."""
        self.absolute = np.asarray(problem.absolute, dtype=np.float64)
        self.relative = np.asarray(problem.relative, dtype=np.float64)
        self.cap = np.asarray(problem.cap, dtype=np.float64)
        self.live = bool(np.ptp(self.relative) == 0.0 and np.isinf(self.cap).all())
        self.share = CAUTION / np.sqrt(len(self.absolute))
        self.frozen = self.absolute

    def at(self, y: Floats) -> Floats:
        """Weights [n] at y."""
        size = np.abs(y)
        return np.maximum(np.minimum(self.absolute + self.relative * size, self.cap), LEAST_WEIGHT / self.share * size)

    def freeze(self, y: Floats) -> tuple[float, Floats]:
        """The relative and the absolute tolerances to start IDA with at y."""
        self.frozen = self.at(y)
        if self.live:
            return float(self.relative[0]) * self.share, self.absolute * self.share
        return 0.0, self.frozen * self.share

    def outgrown(self, y: Floats) -> bool:
        """True if a frozen weight is much larger than it would be chosen at y."""
        return not self.live and bool(np.any(RELAXED * self.at(y) < self.frozen))
