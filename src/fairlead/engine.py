"""The engine of a run: which one it is and why, what that cannot do with this model, and its settings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from fairlead.analysis.record.remedy import budget
from fairlead.analysis.remarks.light_rebounds import light_rebounds
from fairlead.analysis.remarks.overlaps import overlaps
from fairlead.analysis.treatments.stepping_table import (
    INSIDE,
    beside_contacts,
    beyond,
    few,
    handling,
    most_located,
    refusal,
    remark,
)
from fairlead.choice import choose
from fairlead.errors import Fault, ModelError
from fairlead.integrate import Run
from fairlead.netlist.netlist import Netlist
from fairlead.netlist.settings import RunSettings
from fairlead.system.compiled.named_parts import kept_positions, least_friction_left
from fairlead.system.numbering.loops import loop_remarks

if TYPE_CHECKING:
    from fairlead.system.compiled.system import System

Engine = Literal["rodas", "stepping", "ida"]


def engine_of(settings: RunSettings, system: System) -> tuple[Engine, str]:
    """The engine of a run and why, as run.json tells them."""
    if settings.engine != "auto":
        return settings.engine, "chosen by run.engine"
    if settings.real_time is not None:
        return "stepping", "auto: it has steps of one length (run.real_time)"
    if (reason := beyond(system, settings)) is not None:
        return "rodas", f"auto: {reason}"
    contacts = int(np.count_nonzero(system.holder >= 0))
    smooth = system.linear and least_friction_left(system) >= 1 - settings.accuracy  # of order one at a larger jump
    engine, reason = choose(contacts, smooth, settings.accuracy)
    if engine == "stepping" and ((found := handling(system, settings)).way != INSIDE or found.of.auto):
        return "rodas", f"auto: it locates every switch, and {found.why}"
    if engine == "stepping" and (other := beside_contacts(system)) is not None:
        return "rodas", f"auto: it locates every switch, and {other}"
    return engine, reason


def engine_remarks(settings: RunSettings, system: System) -> list[Fault]:
    """What the engine asked for cannot do well, and stops that begin passed. Raises ModelError if it refuses."""
    if (fault := refused(settings, system)) is not None:
        raise ModelError([fault])
    return [*loop_remarks(system.flat), *remark(system, settings), *overlaps(system), *light_rebounds(system)]


def refused(settings: RunSettings, system: System) -> Fault | None:
    """Why the engine that `run.engine` asks for does not run this model, None where it does."""
    if settings.engine == "ida" and (kept := kept_positions(system)):
        what = f"run.engine: ida does not bring positions back to what {few(kept)} keeps after every step"
        return Fault(None, f"{what}, so they would drift.", "Take run.engine: rodas (or auto).")
    return refusal(system, settings)


def engine_settings(netlist: Netlist, settings: RunSettings, system: System, patterns: list[str], *,
                    between: bool = True, chosen: Engine | None = None) -> Run:  # fmt: skip
    """The settings of a run as the engine takes them; `between`: with what happens between the rows of a grid.

    `chosen` is what `engine_of` says, if that is known.
    """
    method = "rodas5p" if settings.method == "auto" else settings.method
    types = [instance.type for instance in system.flat.instances]
    engine = chosen or engine_of(settings, system)[0]
    located = {"most_located": most_located(system, settings)} if engine == "stepping" else {}
    step = settings.real_time if engine == "stepping" else None  # `cost` tries other engines too
    return Run(
        stop=settings.stop, start=settings.start, every=netlist.record.every, method=method,
        accuracy=settings.accuracy, record=patterns,
        between=between or netlist.record.every is None,  # the curve of a step goes through its rows inside
        engine=engine, **located, fixed_step=step, real_time=step is not None,
        first_step=settings.first_step, max_step=settings.max_step or np.inf, step_floor=settings.step_floor,
        max_steps=budget(types, "max_steps", settings.max_steps),
        max_events=budget(types, "max_events", settings.max_events), max_wall=settings.max_wall,
        dwell=settings.dwell, on_chatter=settings.chatter,
    )  # fmt: skip
