"""Where a stepped run was: to go back to it here, and as bytes in another process.

    state = run.save()
    text = pickle.dumps(state)          becomes Elsewhere, which holds no code and no address
    other.restore(pickle.loads(text))   a run of the same model, made by the same fairlead with the same settings

A saved state is the memory of a run. What lies where in it follows from the model and from the plan of its equations,
so both are compared before it is taken, byte by byte. What controllers in plain Python know is pickled by itself, and
read where the model is, whose libraries have their classes.
"""

from __future__ import annotations

import dataclasses
import hashlib
import importlib.metadata
import pickle
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

import numpy as np

from fairlead.analysis.cost.kept_runs import code_digest
from fairlead.component.dependencies import dependencies
from fairlead.component.numbers import numbers
from fairlead.errors import NoCopyError, UsageError, listing, shown
from fairlead.integrate.parts import SubsystemState
from fairlead.integrate.prepare import planned
from fairlead.integrate.problem import Status
from fairlead.integrate.underway import Saved, Underway
from fairlead.system.compiled.opened import opened
from fairlead.tuning import Tunable

if TYPE_CHECKING:
    from fairlead.integrate.memory.arena import State as Arena
    from fairlead.integrate.problem import OnBlock, Run
    from fairlead.system.compiled.opened import FreeInput
    from fairlead.system.compiled.system import System

OF_BLOCK = ("parameters", "in_index", "in_coef", "in_offset", "machines", "table_base", "sig_index", "flow_index",
            "flow_coef", "ledger_index")  # fmt: skip
FOLLOWS = "most_located"
"""A setting that nobody gives: it follows from the engine."""
FREE = ("start", "stop", "max_wall", "max_steps", "max_events")
"""Settings in which a run may differ from that of a state: they are in its memory, or bound one call only."""


class Standing(NamedTuple):
    """With which values of tunable parameters a run goes on: in the System with its inputs open."""

    going: Underway
    tunable: Tunable | None
    own: System


@dataclasses.dataclass(frozen=True, eq=False)
class Maker:
    """What a run was made with."""

    of: System
    asked: Run
    inputs: Mapping[str, FreeInput]
    """Those that are set from outside, by name."""
    tunable: Tunable | None
    """Before any of them was set."""

    def settings(self) -> dict[str, str]:
        """What must be alike in two runs that share a state, by name, in words."""
        known = {one.name: getattr(self.asked, one.name) for one in dataclasses.fields(self.asked)}
        told = {name: f"run.{name} = {value}" for name, value in known.items() if name not in FREE}
        return told | {"inputs": f"inputs {listing(self.inputs, 100) or 'none'}"}

    def told(self) -> dict[str, str]:
        """What the model is, as far as two can be told apart by it: parts and numbers by name, in words."""
        netlist = self.of.flat.assembly.netlist
        found = {"name": f"the model {shown(netlist.name)}"}
        for name, entry in netlist.components.items():
            found[f"{name}: "] = f"{shown(name)}: {shown(entry.type)}"
        for name, (value, unit) in numbers(netlist, self.of.flat.assembly.entries).items():
            found[name] = f"{shown(name)} = {value:.9g} {unit if unit != '1' else ''}".rstrip()
        return found

    def digest(self) -> str:
        """Of the equations: laws, parts, numbers of the model."""
        return _digest(_of_system(self.of))

    def standing(self, way: Way, take: OnBlock) -> Standing:
        """A run with the values of a way, at its start."""
        tunable = self.valued(way.values)
        own = opened(tunable.model.system, list(self.inputs.values()))
        begin = dataclasses.replace(own, initial=way.initial)
        going = Underway(begin, dataclasses.replace(self.asked, start=way.start, stop=way.stop), take)
        return Standing(going, tunable, own)

    def valued(self, values: Mapping[str, str]) -> Tunable:
        """The model with values that were set since the run was made."""
        assert self.tunable is not None, "a run without a model is not pickled"
        return self.tunable._replace(model=self.tunable.model.with_values(values)) if values else self.tunable

    def changed(self, tunable: Tunable) -> dict[str, str]:
        """Values of parameters that were set since the run was made, as texts."""
        assert self.tunable is not None
        before, now = self.tunable.model.overrides, tunable.model.overrides
        return {name: str(text) for name, text in now.items() if before.get(name) != text}


@dataclasses.dataclass(frozen=True, eq=False)
class State:
    """Where a run was, for `Stepping.restore`."""

    t: float
    """The time that the run had reached [s]."""
    saved: Saved
    maker: Maker
    next: Standing
    now: Standing

    def __copy__(self) -> State:
        return self

    def __deepcopy__(self, memo: object) -> State:
        """Nothing changes a state, and what it stands on is shared by all runs of a model."""
        return self

    def __reduce__(self) -> tuple[type[Elsewhere], tuple[Any, ...]]:
        """As it goes to another process. Raises NoCopyError where something in it cannot be."""
        return Elsewhere, tuple(_elsewhere(self))

    def __repr__(self) -> str:
        return f"<State of {_name(self.maker)} at t = {self.t:.9g} s>"


class Way(NamedTuple):
    """How a run began of which a state is: values set until then, unknowns and span of its beginning."""

    values: dict[str, str]
    initial: np.ndarray
    start: float
    stop: float


class Elsewhere(NamedTuple):
    """A state that was pickled, of which every fairlead can tell whose it is. `Stepping.restore` takes it."""

    t: float
    name: str
    fairlead: tuple[str, str]
    """Version, and a digest of its code."""
    kept: bytes
    """`Kept`, which only the same fairlead can read."""

    def __repr__(self) -> str:
        return f"<State of {shown(self.name)} at t = {self.t:.9g} s, from another process>"


class Kept(NamedTuple):
    """The memory of a run as plain numbers, and what it fits."""

    settings: dict[str, str]
    told: dict[str, str]
    model: str
    plan: str
    arena: Arena
    own: dict[str, Any]
    status: Status
    replanned_at: int
    knows: tuple[bytes, ...]
    """What each controller in plain Python knows."""
    now: Way
    next: dict[str, str]
    """Values that were set last, which hold from the next `advance` on."""
    goes_over: bool
    """Whether they are others than those of `now`, and not only written otherwise."""


def brought_back(state: Elsewhere, maker: Maker, take: OnBlock) -> State:
    """The state as one of this process. Raises UsageError, with what does not fit."""
    if state.fairlead != _fairlead():
        version = f"fairlead {state.fairlead[0]}" if state.fairlead[0] != _fairlead()[0] else "other code of fairlead"
        _refuse(f"it was saved by {version}, in which a run has another memory", "Run the model again to that time.")
    kept: Kept = pickle.loads(state.kept)  # who unpickled the state has trusted it
    if maker.tunable is None or kept.model != maker.digest():
        _refuse(_other_model(kept.told, maker.told()), "Load the netlist, values and libraries that it was saved with.")
    _alike(kept.settings, maker.settings())
    now = maker.standing(kept.now, take)
    if kept.plan != _plan(now.going):
        _refuse("this machine works its equations out in another order", "Run the model again to that time.")
    following = now._replace(tunable=maker.valued(kept.next))
    if kept.goes_over:
        following = maker.standing(kept.now._replace(values=kept.next), take)
    active = SubsystemState(kept.arena, _read(kept.knows, now.going), None, kept.own, None)
    return State(state.t, Saved(active, kept.status, kept.replanned_at), maker, following, now)


def fitting(state: State, maker: Maker) -> None:
    """Raise UsageError where a state of this process is of another model, or of a run with other settings."""
    if state.maker.of is not maker.of:
        _refuse(_other_model(state.maker.told(), maker.told()), "Take what `save` of a run of this model gave.")
    _alike(state.maker.settings(), maker.settings())


MOST_TOLD = 4
"""Differences of two models that are told."""


def _other_model(was: Mapping[str, str], here: Mapping[str, str]) -> str:
    """In what the model of a state differs from that of this run."""
    names = [name for name in {**was, **here} if was.get(name) != here.get(name)]
    names = [name for name in names if f"{name.partition('.')[0]}: " not in names]  # a part that is another one
    if not names:
        return "it is of a model that was loaded apart from this one, or with other tables or libraries"
    sides = [listing((side.get(name, f"no {name.rstrip(': ')}") for name in names), MOST_TOLD) for side in (was, here)]
    return f"it was saved with {sides[0]}; this run has {sides[1]}"


def _alike(was: Mapping[str, str], here: Mapping[str, str]) -> None:
    """Raise UsageError where a state was saved with other settings than this run has."""
    unlike = [name for name in here if was.get(name) != here[name]]
    if unlike:
        named = [name for name in unlike if name != FOLLOWS] or unlike
        one, two = (listing(told.get(name, "") for name in named) for told in (was, here))
        _refuse(f"it was saved with {one}; this run has {two}", "Start the run as that one was.")


def _refuse(why: str, way_out: str) -> NoReturn:
    raise UsageError(f"restore: this state does not fit here: {why}. {way_out}")


def _elsewhere(state: State) -> Elsewhere:
    maker, active, now = state.maker, state.saved.active, state.now
    if maker.tunable is None or state.next.tunable is None or now.tunable is None or active.part is not None:
        raise NoCopyError("This state is of a run without its model, and cannot be pickled. Take one of model.start().")
    run = now.going.run
    initial = now.going.problem.initial.copy()
    way = Way(maker.changed(now.tunable), initial, run.start, run.stop)
    kept = Kept(
        maker.settings(), maker.told(), maker.digest(), _plan(now.going), active.whole, active.own, state.saved.status,
        state.saved.replanned_at, tuple(_written(active.remembered, now.going)), way, maker.changed(state.next.tunable),
        state.next.own is not now.own,
    )  # fmt: skip
    return Elsewhere(state.t, _name(maker), _fairlead(), pickle.dumps(kept))


def _written(remembered: Sequence[Any], going: Underway) -> Iterator[bytes]:
    """What controllers know, each as bytes: the attributes of its object, which is made again where it arrives."""
    for controller, (of, failure, at) in zip(going.active.whole_problem.controllers, remembered, strict=True):  # type: ignore[attr-defined]
        try:
            yield pickle.dumps((None if of is None else vars(of), failure, at))
        except Exception as error:  # whatever a user's class raises
            what = f"{controller.instance.path} knows something that cannot be pickled ({shown(str(error))})"
            advice = "save() and restore() work within one process."
            raise NoCopyError(f"This state cannot be pickled: {what}.\n    {advice}") from error


def _read(knows: Sequence[bytes], going: Underway) -> list[Any]:
    found = []
    for controller, text in zip(going.active.whole_problem.controllers, knows, strict=True):  # type: ignore[attr-defined]
        attributes, failure, at = pickle.loads(text)
        of = None
        if attributes is not None:
            kind = controller.instance.type
            of = kind.__new__(kind)
            vars(of).update(attributes)
        found.append((of, failure, at))
    return found


def _name(maker: Maker) -> str:
    return maker.of.flat.assembly.netlist.name


def _fairlead() -> tuple[str, str]:
    return importlib.metadata.version("fairlead"), code_digest()


def _of_system(system: System) -> Iterator[bytes]:
    """Everything of a model that its memory and its equations follow from."""
    yield repr((system.n, system.machine_names, [one.name for one in system.signals])).encode()
    for block in system.blocks:
        yield repr([one.path for one in block.instances]).encode()
        yield dependencies(block.kernel.variant).encode()
        for name in OF_BLOCK:
            yield np.ascontiguousarray(getattr(block, name)).tobytes()
    yield system.tables.vector().tobytes()
    yield repr([group.mass for group in system.flat.groups]).encode()
    for array in (system.zones, system.initial):
        yield np.ascontiguousarray(array).tobytes()


def _plan(going: Underway) -> str:
    """A digest of what runs of a problem share: patterns, pivots, sizes."""
    plan = planned(going.problem, going.engine.plans_contacts)
    arrays = (part for name in sorted(plan.given) for part in (name.encode(), plan.given[name].tobytes()))
    return _digest([repr((sorted(plan.lengths.items()), sorted(plan.numbers.items()))).encode(), *arrays])


def _digest(parts: Iterator[bytes] | list[bytes]) -> str:
    state = hashlib.sha256()
    for part in parts:
        state.update(len(part).to_bytes(8, "little") + part)
    return state.hexdigest()
