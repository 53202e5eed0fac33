"""What `stepping` can do, by classes of scenes: the one declaration that checks, runs, `auto` and the docs go by.

A class is found by facts of the compiled system: what laws declare, and what was traced of them. No name decides.

    INSIDE     switches happen inside steps: the cost does not depend on how many contacts switch in one
    LANDED     every step ends at the first switch in it, as those of `rodas` do (integrate/stepping/located_step.py)
    REFUSED    the run does not begin, and names the part and the engine to take

Up to `Run.most_located` machines (contacts, stops, tables: all that has zones) every scene is LANDED, since few
switches cost little. Why a class is where it is: docs/stepping.md, which shows this table.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Literal, NamedTuple

import numpy as np

from fairlead.component.base import Component, Family
from fairlead.component.keys import PORT, key
from fairlead.errors import Fault, Location
from fairlead.kernels.break_away import least_left
from fairlead.netlist.settings import RunSettings
from fairlead.system.compiled.named_parts import (
    at_nodes_without_inertia,
    between_mass_and_none,
    kept_positions,
    rigid_stops,
)
from fairlead.system.compiled.system import System
from fairlead.system.numbering.contact_cycles import moved_apart
from fairlead.system.numbering.unknowns import Unknown
from fairlead.system.timed_limits import latches_on_means, switched_limits, timed_limits, timed_rows

Way = Literal["inside", "landed", "refused"]
INSIDE: Way = "inside"
LANDED: Way = "landed"
REFUSED: Way = "refused"
FEW = 40
"""Machines up to which steps end at every switch, as `Run.most_located` has it."""
EVERY_SWITCH = 2**31
"""Of `Run.most_located`: whatever there is."""
OF_NODES = ("V", "A", "Pa", "m^3/s", "W")
"""Units of what a node that stores nothing has, or passes on, outside mechanics; contacts and lines are mechanics."""
WAY_OUT = "Take run.engine: rodas (or auto)."


class Class(NamedTuple):
    """A class of scenes."""

    scenes: str
    """Whose they are, for the page."""
    way: Way
    """How a scene of more than FEW machines is run."""
    why: str
    """A clause; `{}` stands for the names of the parts."""
    parts: Callable[[System, RunSettings], Iterable[str]]
    """Paths of the parts that make a scene one of this class; none if it is not."""
    way_out: str = WAY_OUT
    change: str = ""
    """What would have a scene that is refused taken."""
    auto: str = ""
    """Why `auto` takes `rodas` for what is refused, or runs inside steps less exactly."""


def _bending(system: System, settings: RunSettings) -> Iterator[str]:
    """Contacts that stick and hold nothing: their laws creep or bend, and turn within a slip of nearly nothing."""
    for block in system.blocks:
        kind = block.kernel.variant.type
        contact = issubclass(kind, Family) and issubclass(kind, Component) and not kind.answers.never_sticks
        if contact and not block.kernel.structure.holds and len(block.kernel.structure.zones) > 1:
            yield from (one.path for one in block.instances)


def _falling(system: System, settings: RunSettings) -> Iterator[str]:
    """Contacts whose friction falls with a jump as they let go."""
    for block in system.blocks:
        structure = block.kernel.structure
        if structure.holds and structure.shares_left:
            for one in block.instances:
                if least_left(structure.shares_left, one.values) < 1.0 - settings.accuracy:
                    yield one.path


def _timed(system: System, settings: RunSettings) -> Iterable[str]:
    """Contacts whose limit follows something given in time."""
    return timed_limits(system, settings.start, settings.stop)


def _swung(system: System, settings: RunSettings) -> Iterable[str]:
    """Contacts whose limit follows something given in time that turns often."""
    return timed_limits(system, settings.start, settings.stop, turning=True)


def _switched(system: System, settings: RunSettings) -> Iterable[str]:
    """Contacts whose limit follows a part that only tells signals and has zones."""
    return switched_limits(system)


def _latched(system: System, settings: RunSettings) -> Iterator[str]:
    """Contacts that break away into a zone of its own, which lasts until they slip faster than they stick."""
    for block in system.blocks:
        kind = block.kernel.variant.type
        if block.kernel.structure.holds and issubclass(kind, Component) and kind.declaration.zones.latched:
            yield from (one.path for one in block.instances)


def _tripped(system: System, settings: RunSettings) -> Iterator[str]:
    """Parts that hold nothing and stay for good in a zone to which several values lead that all must have risen."""
    for block in system.blocks:
        s = block.kernel.structure
        ways = list(s.guards.values())
        ends = [not any(guard["name"] for guard in of_zone) for of_zone in ways]
        if not s.holds and any(g["values"] > 1 and ends[g["to"]] for of_zone in ways for g in of_zone):
            yield from (one.path for one in block.instances)


def _carried(system: System, settings: RunSettings) -> Iterator[str]:
    """Nodes without inertia that feel a motion given in time."""
    return (unknown.name for unknown in _balancing(system, settings) if unknown.kind == "rate")


def _followed_at_once(system: System, settings: RunSettings) -> Iterator[str]:
    """Voltages, pressures and the like that balance what is given in time, and have no rate and no inertia."""
    return (unknown.name for unknown in _balancing(system, settings) if unknown.unit in OF_NODES)


def _balancing(system: System, settings: RunSettings) -> Iterator[Unknown]:
    """Unknowns without a rate that no contact holds, whose balance reads something given in time that varies."""
    free = ~system.differential & (system.holder < 0) & ~system.quadrature
    if free.any():
        at_once = free & timed_rows(system, settings.start, settings.stop)
        yield from (system.numbering.unknowns[k] for k in np.flatnonzero(at_once))


def _apart(system: System, settings: RunSettings) -> Iterable[str]:
    """Contacts whose friction falls, in a ring that holds bodies to motions that are given and are not the same.

    With friction that does not fall there is one solution, which the active set of a step finds.
    """
    ring = moved_apart(system.numbering.circles, system.numbering.share)
    return sorted(set(ring).intersection(_falling(system, settings))) if ring else ()


def _any(system: System, settings: RunSettings) -> Iterable[str]:
    """Asks nothing: the class of what is in no other."""
    return ()


TABLE: tuple[Class, ...] = (
    Class("contacts and gears that hold nodes without inertia, whose forces do not tell their speed", REFUSED,
          "stepping does not take what holds nodes without inertia between springs or at gears ({}): it knows the mean "
          "over a step of their speeds, and no jumps", lambda system, _: at_nodes_without_inertia(system),
          "Give the node an inertia, or take run.engine: rodas (or auto, or ida).", "Give the node an inertia",
          "a contact or a gear holds a node without inertia, whose forces do not tell its speed"),
    Class("contacts between a node with mass and one without", REFUSED,
          "stepping does not hold contacts between a node with mass and one without ({}): of the latter it knows the "
          "mean over a step", lambda system, _: between_mass_and_none(system),
          "Give that node a mass, or take run.engine: rodas (or auto).", "Give that node a mass",
          "a contact holds between a node with mass and one without"),
    Class("relations of positions (`hold_position`)", REFUSED,
          "stepping does not bring positions back to what {} keeps after every step, so they would drift",
          lambda system, _: kept_positions(system), auto="it keeps relations of positions"),
    Class("rigid stops", REFUSED,
          "stepping rounds switches to its steps, and a rigid stop ({}) is met at an instant, with an impulse",
          lambda system, _: rigid_stops(system),
          "Take run.engine: rodas (or auto, or ida), or a stop that gives (EndStop, Tether).",
          "Take a stop that gives (EndStop, Tether)",
          "it locates the instants at which rigid stops are met"),
    Class("voltages, pressures and the like of nodes that store nothing, beside a quantity given in time", LANDED,
          "{} balances a quantity in time at once, and stepping knows it as its means over steps where it ends none at "
          "a switch", _followed_at_once),
    Class("nodes without inertia that feel a motion given in time", LANDED,
          "the speed of {} follows a motion given in time at once", _carried),
    Class("limits of friction given in time that turn ten times and more", LANDED,
          "the force limit of {} varies in time, so that it may be passed and kept again inside a step", _swung),
    Class("limits of friction that follow a signal which switches (a relay, a state machine)", LANDED,
          "the force limit of {} jumps with a signal that switches, at an instant inside a step", _switched),
    Class("contacts that creep or bend at rest and have zones (binding)", LANDED,
          "the laws of {} turn within a slip of nearly nothing", _bending),
    Class("relays, state machines and the like that read forces or what else has no rate", LANDED,
          "{} reads what has no rate, of which stepping knows means over steps",
          lambda system, _: latches_on_means(system)),
    Class("contacts with a zone of their own from break-away until they slip faster than a speed (karnopp)", LANDED,
          "{} have a zone that lasts for a moment after they break away", _latched),
    Class("parts that hold nothing and trip for good where several values have risen at once", LANDED,
          "{} trips where several values have risen at once, which may be for a moment inside a step", _tripped),
    Class("friction that falls as a contact lets go, of contacts that hold a body to motions that are given and move "
          "apart", LANDED, "which of {} lets go is decided where what they hold to moves apart", _apart),
    Class("limits of friction given in time that turn less often", INSIDE,
          "the force limit of {} varies in time, and stepping reads it in the middle of its steps", _timed,
          auto="it locates every switch, and a force limit varies in time"),
    Class("friction that falls as a contact lets go", INSIDE,
          "stepping tells to a step when the friction of {} falls, and where others fall in the same step, which "
          "load each other, its impulses to that of one contact", _falling),
    Class("everything else: contacts that hold at one level, limits that follow the motion, nodes without mass, "
          "ropes and stops that give, motions that are given", INSIDE, "", _any),
)  # fmt: skip
"""The first class that has parts in a scene decides."""


class Handling(NamedTuple):
    """How `stepping` runs a scene: the way, and the class and the parts that decide."""

    way: Way
    of: Class
    parts: tuple[str, ...]

    @property
    def why(self) -> str:
        """The clause of the class with the names of the parts."""
        return self.of.why.format(few(self.parts))


def handling(system: System, settings: RunSettings) -> Handling:
    """By the table."""
    for one in TABLE:
        if parts := tuple(one.parts(system, settings)):
            way: Way = LANDED if one.way == INSIDE and len(system.zones) <= FEW else one.way
            return Handling(way, one, parts)
    return Handling(LANDED if len(system.zones) <= FEW else INSIDE, TABLE[-1], ())


def beyond(system: System, settings: RunSettings) -> str | None:
    """Why `auto` does not even ask for `stepping`."""
    refused = (one for one in TABLE if one.way == REFUSED)
    return next((one.auto for one in refused if any(True for _ in one.parts(system, settings))), None)


def beside_contacts(system: System) -> str | None:
    """Why `auto` leaves to `rodas` what has switches inside the steps of `stepping`: what else there is in the scene.

    Of a scene of bodies, contacts and springs the cost at equal error was measured (fairlead/choice.py), of others not.
    """
    if system.numbering.circles:
        return "contacts close circles"
    if any(unknown.kind == "potential" for unknown in system.numbering.unknowns):
        return "not all of the scene is mechanics"
    for block in system.blocks:
        s = block.kernel.structure
        tells = not any(key(target).kind == PORT for target in s.targets)
        if tells and (len(s.zones) > 1 or s.targets):
            return f"{block.instances[0].path} tells signals, and has zones or states"
    return None


def refusal(system: System, settings: RunSettings) -> Fault | None:
    """Why `stepping`, asked for by name, does not run this scene; None where it does."""
    if settings.engine != "stepping" and settings.real_time is None:
        return None
    found = handling(system, settings)
    if found.way != REFUSED:
        return None
    if settings.real_time is None:
        return Fault(_where(system, found.parts), f"run.engine: {found.why}.", found.of.way_out)
    leave = f"{found.of.change}, or leave run.real_time out" if found.of.change else "Leave run.real_time out"
    way_out = f"{leave}: only stepping has steps of one length."
    return Fault(_where(system, found.parts), f"run.real_time: {found.why}.", way_out)


def remark(system: System, settings: RunSettings) -> Iterator[Fault]:
    """What `stepping`, asked for by name, does not do as exactly as its accuracy says."""
    if settings.engine != "stepping" and settings.real_time is None:
        return
    found = handling(system, settings)
    if settings.real_time is not None:  # no step ends at a switch
        if found.parts:
            way_out = "Compare with a run without run.real_time, and with one of half the step."
            what = f"run.real_time: switches are inside steps, and {found.why}."
            yield Fault(_where(system, found.parts), what, way_out)
        return
    if found.way == INSIDE and found.parts:
        yield Fault(_where(system, found.parts), f"run.engine: {found.why}.", found.of.way_out)
    if means := list(_followed_at_once(system, settings)):
        what = f"laws that read what follows a quantity in time at once ({few(means)}) get its means over steps"
        yield Fault(_where(system, [means[0].rpartition(".")[0].rpartition(".")[0]]), f"run.engine: {what}.", WAY_OUT)


def most_located(system: System, settings: RunSettings) -> int:
    """Of `Run`: machines up to which steps end at every switch."""
    return EVERY_SWITCH if handling(system, settings).way == LANDED else FEW


def page() -> str:
    """The table as Markdown."""
    words = {INSIDE: "yes, inside steps", LANDED: "yes, steps end at every switch", REFUSED: "refused"}
    rows = [f"| {one.scenes} | {words[LANDED if one.way == INSIDE else one.way]} | {words[one.way]} |" for one in TABLE]
    return "\n".join([f"| scenes with | up to {FEW} machines | more |", "|---|---|---|", *rows])


def few(names: Sequence[str]) -> str:
    """Three of them, and how many follow."""
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def _where(system: System, parts: Sequence[str]) -> Location | None:
    return next((one.where for one in system.flat.instances if one.path == parts[0]), None)
