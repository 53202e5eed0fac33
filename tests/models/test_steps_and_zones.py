"""What the engine does with the zones of a model, watched from outside.

The claim behind everything else: within a step the zones stand still. The callbacks of a compiled model
are wrapped, so that every evaluation and every switch leaves a note; then the notes are read.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

import fairlead
from fairlead.integrate import Outcome, Run, integrate

WHOLE, POINTER, NUMBER = ctypes.c_int64, ctypes.c_void_p, ctypes.c_double
KINDS = {
    "rhs": ctypes.CFUNCTYPE(None, POINTER, NUMBER, POINTER, POINTER),
    "jacobian": ctypes.CFUNCTYPE(None, POINTER, NUMBER, POINTER, POINTER, POINTER),
    "guards": ctypes.CFUNCTYPE(None, POINTER, NUMBER, POINTER, POINTER),
    "outputs": ctypes.CFUNCTYPE(None, POINTER, NUMBER, POINTER, POINTER),
    "switch": ctypes.CFUNCTYPE(WHOLE, POINTER, NUMBER, POINTER, POINTER, WHOLE),
    "at_time": ctypes.CFUNCTYPE(WHOLE, POINTER, NUMBER, POINTER),
}
MAY_SWITCH = ("switch", "at_time")
BEFORE = 1  # side of a recorded row, see integrate.problem.Block


@dataclass
class Watched:
    """A compiled model whose callbacks take notes: (callback, t, zones on entering, zones on leaving)."""

    system: Any
    notes: list[tuple[str, float, bytes, bytes]] = field(default_factory=list)
    at_rows: list[np.ndarray] = field(default_factory=list)  # all guards, at every recorded row

    def instance(self, *run: Any) -> Watched:
        """Take notes of this run."""
        self.system = self.system.instance(*run)
        self.made = {name: self._wrap(name, kind) for name, kind in KINDS.items()}  # kept alive
        wrapped = {name: ctypes.cast(made, POINTER).value for name, made in self.made.items()}
        self.callbacks = {**self.system.callbacks, **wrapped}
        return self

    def __getattr__(self, name: str) -> Any:
        return getattr(self.system, name)

    def _wrap(self, name: str, kind: Any) -> Any:
        inner, zones = kind(self.system.callbacks[name]), self.system.zones
        guards = KINDS["guards"](self.system.callbacks["guards"])
        values = np.zeros(len(self.system.guard_machine))

        def wrapper(context: Any, t: float, *rest: Any) -> Any:
            before = zones.tobytes()
            answer = inner(context, t, *rest)
            self.notes.append((name, t, before, zones.tobytes()))
            if name == "outputs":
                guards(context, t, rest[0], values.ctypes.data)
                self.at_rows.append(values.copy())
            return answer

        return kind(wrapper)


SCENES = {
    "belt": {"run.stop": "3 s"},
    "block_and_spring": {"run.stop": "3 s"},
    "sandwich": {"run.stop": "2 s", "run.accuracy": "1e-4"},
}


@pytest.fixture(scope="module", params=SCENES)
def watched(request: pytest.FixtureRequest) -> tuple[Watched, Outcome]:
    """A bundled model, run with every accepted step recorded, and the notes taken meanwhile."""
    model = fairlead.load(request.param, set=SCENES[request.param])
    watching = Watched(model.system)
    outcome = integrate(watching, Run(stop=model.netlist.run.stop))
    assert outcome.ok, outcome.sentence
    assert outcome.counters.switches > 3
    return watching, outcome


def test_only_a_switch_changes_zones(watched) -> None:
    watching, _ = watched
    for name, _, before, after in watching.notes:
        assert name in MAY_SWITCH or before == after


def test_zones_change_between_calls_at_switches_only(watched) -> None:
    """The engine itself writes no zones either, but to take back what a settlement tried."""
    watching, _ = watched
    last = watching.notes[0][3]
    for name, _, before, after in watching.notes[1:]:
        assert before == last, name
        last = after


def test_switches_happen_at_accepted_points_only(watched) -> None:
    """And at no other time: their times are those of rows recorded twice, or the start."""
    watching, outcome = watched
    ends_of_steps = {*outcome.times[outcome.sides == BEFORE].tolist(), 0.0}
    switched = {t for name, t, before, after in watching.notes if name in MAY_SWITCH and before != after}
    assert switched
    assert switched <= ends_of_steps


def test_every_change_of_a_zone_is_in_the_log(watched) -> None:
    """With its machine, zones and time, in order; tables that move to their next piece are no switches."""
    watching, outcome = watched
    changes = []
    for name, t, *patterns in watching.notes:
        if name == "switch":
            before, after = (np.frombuffer(pattern, dtype=np.int64) for pattern in patterns)
            changes += [(t, int(k), int(before[k]), int(after[k])) for k in np.flatnonzero(before != after)]
    logged = [(float(e["t"]), int(e["machine"]), int(e["before"]), int(e["after"])) for e in outcome.events]
    assert changes == [row for row in logged if row[2] != row[3]]


def test_no_guard_has_risen_at_an_accepted_point(watched) -> None:
    """After settling, and at the end of every step that no event ended."""
    watching, outcome = watched
    guards = np.array(watching.at_rows)
    assert len(guards) == len(outcome.times)
    settled = outcome.sides != BEFORE
    assert (guards[settled] <= watching.guard_tolerance).all()


def test_at_the_left_of_an_event_the_guard_that_fired_has_just_risen(watched) -> None:
    """Located on the interpolant of the step, to the tolerance of the guard: neither early nor late."""
    watching, outcome = watched
    guards, tolerance = np.array(watching.at_rows), watching.guard_tolerance
    rows = {t: k for k, t in enumerate(outcome.times) if outcome.sides[k] == BEFORE}
    for event in outcome.events:
        if event["t"] > 0 and event["guard"] >= 0 and event["position"] == 0:
            # `breaks` guards rise with the load, at most some 1e4 N/s; time is located to some 1e-12 s.
            assert abs(guards[rows[event["t"]], event["guard"]]) <= 10 * tolerance[event["guard"]] + 1e-7
