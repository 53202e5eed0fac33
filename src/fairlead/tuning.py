"""Parameters that change while a run is stepped from outside: which may, and how the run goes on with another value.

    tunable = Tunable.of(model, ["pad.normal_force", "mu"])
    changed = tunable.with_value("mu", 0.4, begun=True)
    going = gone_on(going, old, new, t, span, begun=True)

A parameter may change many numbers: those of derived parameters, of bodies, of plans. So the model is made anew with
the value, as `with_values` makes it, and the run begins once more where it is, with the unknowns, zones, samples and
inputs that it has. Nothing that was worked out of the old value remains. The integrator finds its step size again.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from fairlead.arguments import told_of
from fairlead.component.keys import PARAMETER, key
from fairlead.component.numbers import numbers
from fairlead.errors import Fault, ModelError, UsageError, did_you_mean, listing, shown
from fairlead.integrate.underway import Underway
from fairlead.outer import Variable, find_tunable
from fairlead.system.arrays.blocks import Block
from fairlead.system.arrays.working import discrete, offsets
from fairlead.system.compiled.named_parts import rigid_stops
from fairlead.system.compiled.system import Instance, System

if TYPE_CHECKING:
    from fairlead.component.assembly import Assembly
    from fairlead.component.assembly import Instance as Part
    from fairlead.netlist.netlist import Netlist


class Model(Protocol):
    """A `simulate.Model`: its stages, and the way to one with other values."""

    @property
    def netlist(self) -> Netlist:
        """As it is written."""

    @property
    def assembly(self) -> Assembly:
        """Its components."""

    @property
    def system(self) -> System:
        """Compiled."""

    @property
    def overrides(self) -> Mapping[str, str]:
        """Values that were given from outside."""

    @property
    def rebuilt(self) -> str:
        """Why it shares no structure with the one it was made from."""

    def with_values(self, values: Mapping[str, float | str] | None = None, /) -> Model:
        """The same with other values."""


SAME_PLACE = 1e-9  # m or rad, or of the place; less is rounding of pieces
BY_SIGNAL = "Drive it by a signal (VelocityActuator, SpeedActuator), or begin another run with the value."
A_STOP_THAT_GIVES = "Take a stop that gives (EndStop, ElasticGap, Tether), or begin another run with the value."
KEPT = ("zones", "sample_count", "sample_start", "set_due", "set_values")
"""What a run goes on with beside its unknowns, of the arrays that callbacks write to; the others follow from these."""


class Tunable(NamedTuple):
    """A model, and parameters of it that can be set while it runs: by outer name, the name inside."""

    model: Model
    inside: Mapping[str, str]

    @classmethod
    def of(cls, model: Model, names: Iterable[str]) -> Tunable:
        """Those of the `interface` block, and `names` of parameters of the scene or of a component.

        Raises ModelError for others.
        """
        known = {name: outer.of for name, outer in model.netlist.interface.tunable.items()}
        known |= {str(name): str(name) for name in names if str(name) not in known}
        if faults := [fault for name in known.values() if (fault := _unknown(model, name)) is not None]:
            raise ModelError(faults)
        return cls(model, known)

    @property
    def names(self) -> tuple[str, ...]:
        """What can be set."""
        return tuple(self.inside)

    @property
    def variables(self) -> tuple[Variable, ...]:
        """Those that are numbers, with unit and start."""
        more = [name for name in self.inside if name not in self.model.netlist.interface.tunable]
        return find_tunable(self.model.netlist, self.model.assembly.entries, more)[0]

    def with_value(self, name: str, value: float | str, *, begun: bool, t: float) -> Tunable:
        """The same with another value at t. Raises ModelError for one that does not fit, UsageError as `refuse`."""
        inside = self.inside[name]
        with told_of("set", "Model.with_values", {inside: name}):
            changed = self.model.with_values({inside: value})
        refuse(inside, self.model, changed, begun=begun)
        if begun and (found := moved_at_once(self.model.system, changed.system, t)):
            raise UsageError(f"set: {inside} {found}")
        return self._replace(model=changed)


def _unknown(model: Model, name: str) -> Fault | None:
    """What is wrong with the name of a parameter."""
    owner, _, rest = name.partition(".")
    components = model.netlist.components
    if rest and owner in components:
        allowed = [f"{owner}.{one}" for one in model.assembly.entries[owner].type.declaration.parameters]
        fits = f"{owner}.{rest.partition('.')[0]}" in allowed
    else:
        allowed = [*model.netlist.parameters, *(f"{one}.NAME" for one in components)]
        fits = not rest and owner in model.netlist.parameters
    if fits:
        return None
    what = f"tunable: there is no parameter {shown(name)}. {did_you_mean(name, allowed)}".rstrip()
    return Fault(None, what, f"There are {listing(allowed)}.")


def refuse(name: str, old: Model, new: Model, *, begun: bool) -> None:
    """Raise UsageError for a change that a run cannot go on with, or that changes nothing any more."""
    one, two = old.system, new.system
    why = ""
    if new.rebuilt:
        why = f"the structure depends on it ({new.rebuilt.partition(': ')[2].removesuffix('.')})"
    elif not np.array_equal(one.memory["sample_period"], two.memory["sample_period"]):
        why = "it is the time between two samples"
    elif one.working.size != two.working.size:
        why = "its tables are of another length"
    if why:
        raise UsageError(f"set: {name} cannot change while a run goes on: {why}. Begin another run with it.")
    if _written(name, old) == _written(name, new) or differs(one, two):
        return
    if np.array_equal(one.initial, two.initial):
        raise UsageError(f"set: nothing follows {name}: another value stands where it is read. Set that.")
    if begun:
        raise UsageError(f"set: {name} says how a run begins, and changes nothing now. Begin another run with it.")


def moved_at_once(one: System, two: System, t: float) -> str:
    """Why a run cannot go over from one System to the other at t: something that moves as given is elsewhere there."""
    for a, b in zip(one.flat.instances, two.flat.instances, strict=True):
        if wave := a.type.answers.moves_as:
            was, now = float(getattr(a.values, wave)(t)), float(getattr(b.values, wave)(t))
            if abs(now - was) > SAME_PLACE * max(1.0, abs(was)):
                place = f"{a.path} from {was:.6g} to {now:.6g} at once"
                return f"would move {place}: its place follows from what is given since the start. {BY_SIGNAL}"
    met = set(rigid_stops(one))
    for a, b in zip(one.flat.instances, two.flat.instances, strict=True):
        if a.path in met and (changed := [name for name in _places(a) if a.values.path(name) != b.values.path(name)]):
            return f"would move what {a.path} stops at once ({changed[0]}). {A_STOP_THAT_GIVES}"
    return ""


def _places(part: Part) -> list[str]:
    """Parameters that are lengths or angles."""
    return [name for name, one in part.type.declaration.parameters.items() if one.unit in ("m", "rad")]


def _written(name: str, model: Model) -> object:
    """What a parameter is in a model: its number, or what stands there."""
    known = numbers(model.netlist, model.assembly.entries)
    if name in known:
        return known[name]
    owner, _, rest = name.partition(".")
    entry = model.assembly.entries.get(owner)
    return str(entry.given.get(rest)) if entry is not None else str(model.netlist.parameters[owner].content)


def differs(one: System, two: System) -> bool:
    """Whether any number of the equations is another one."""
    same = all(
        np.array_equal(a.parameters[:, ~discrete_columns(a)], b.parameters[:, ~discrete_columns(b)])
        and np.array_equal(a.in_offset, b.in_offset) and np.array_equal(a.in_coef, b.in_coef)
        and np.array_equal(a.flow_coef, b.flow_coef)
        for a, b in zip(one.blocks, two.blocks, strict=True)
    )  # fmt: skip
    masses = [[group.mass for group in system.flat.groups] for system in (one, two)]
    return not same or masses[0] != masses[1] or not _same_tables(one, two)


def discrete_columns(block: Block) -> np.ndarray:
    """[parameters of the kernel]: whether it is a discrete variable, which lies among them."""
    return np.array([key(f"{PARAMETER}:{name}").is_discrete for name in block.kernel.structure.parameters], dtype=bool)


def _same_tables(one: System, two: System) -> bool:
    return np.array_equal(one.tables.vector(), two.tables.vector())


def gone_on(going: Underway, old: System, new: System, t: float, span: float, *, begun: bool) -> Underway:
    """The run of the System `new` from where that of `old` is, which stays as it is, with `span` as its length [s]."""
    memory, was = going.active.memory, going.active.problem
    begin = replace(new, initial=memory.array["y"].copy()) if begun else new
    made = Underway(begin, replace(going.run, start=t, stop=t + span) if begun else going.run, going.take)
    now: Instance = made.active.problem  # type: ignore[assignment]
    for name in KEPT if begun else ("set_due", "set_values"):
        now.memory[name][...] = was.memory[name]  # type: ignore[attr-defined]
    for k, (before, after) in enumerate(zip(old.blocks, new.blocks, strict=True)):
        at_work, here = now.blocks[k], was.blocks[k]  # type: ignore[attr-defined]
        if offsets(k) in new.working.places:
            kept = before.in_offset == after.in_offset
            at_work.in_offset[kept] = here.in_offset[kept]
        if discrete(k) in new.working.places and begun:
            variables = discrete_columns(after)
            at_work.parameters[:, variables] = here.parameters[:, variables]
    if begun and not _same_tables(old, new):
        for table in new.timed_tables:
            now.zones[table.machine] = table.polynomial.piece_at(t)
    now.remind(was.remembered())
    return made
