"""Modes of a model at an instant: what is asked, and what is handed back.

fairlead.modes(model, zones={"clutch": "held"})
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fairlead.arguments import Arguments, keywords_told
from fairlead.errors import Fault, Location, ModelError, shown
from fairlead.quantities import quotient
from fairlead.studies.modes.linear import equations, linear
from fairlead.studies.modes.pattern import Known
from fairlead.studies.modes.response import range_of, response, spaced
from fairlead.studies.modes.signals import Point, of_input, seen
from fairlead.studies.modes.spectrum import modes_of
from fairlead.studies.modes.squeal import ranked
from fairlead.studies.modes.table import Modes

if TYPE_CHECKING:
    from fairlead.model import Model

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
SAMPLED = "Controllers that take samples are held: modes are those between two samples."


@keywords_told
def modes(
    model: Model, at: float | str | None = None, zones: Mapping[str, str] | None = None, *, acting: str = "",
    out: str = "", frequencies: tuple[float | str, float | str] | None = None, change: int = 0,
) -> Modes:  # fmt: skip
    """Linearise a model and tell its modes: frequency, damping, and which component takes part.

    `at` is the instant, a time or a text with its unit, to which the model is run, at most `run.stop`; None: its
    settled start. `zones` freezes parts in zones by name or pattern, `{"pad": "held", "c*": "sliding"}`; others stay
    in those they are in.
    `acting` (a part, a port or a free signal input) and `out` (a signal) ask for the response between both, over
    `frequencies` [Hz]. `change` asks for all patterns in which up to so many contacts change between holding and
    sliding.

    Raises ModelError with every mistake in what is asked, SteppingError where the run fails before the instant, and
    FairleadError where the equations are singular in these zones.
    """
    asked = Arguments("modes")
    asked.model(model)
    time = None if at is None else asked.quantity("at", at, "s")
    span = None if frequencies is None else _span(asked, frequencies)
    if zones is not None:
        asked.map_of("zones", zones, '{"pad": "held"}', str, "is not the name of a zone")
    asked.text("acting", acting, '"block"')
    asked.text("out", out, '"block.x"')
    asked.whole("change", change, 0)
    if frequencies is not None and not (acting or out):
        asked.alone("frequencies", frequencies, 'A response needs acting="block" and out="block.x" as well.')
    asked.refuse()
    if faults := _outside(model, time):
        raise ModelError(faults)
    run = model.start()
    if time is not None and time > run.t:
        run.advance(time)
    t, y, instance = run.standing()
    known, faults = Known(instance, t, y), [*_missing(acting, out)]
    frozen = known.asked(zones or {}, faults)
    point = Point(instance, t, y, frozen, instance.absolute)
    row = seen(point, out, faults) if out else None
    column = of_input(point, acting, row, faults) if acting else None
    if faults:
        raise ModelError(faults)
    made = linear(equations(instance, t, y, frozen))
    found, zeros = modes_of(made)
    answer = None
    if row is not None and column is not None:
        answer = response(made, column, row, quotient(row.unit, column.unit), spaced(*(span or range_of(found))))
    several = {instance.machine_names[k]: instance.zone_names(k)[int(frozen[k])] for k in known.several}
    return Modes(
        model.netlist.name, t, several, known.in_words(frozen), tuple(found), zeros.count, made.held, answer,
        tuple(ranked(known, frozen, change)) if change else (), (SAMPLED,) if instance.samples else (), made, zeros,
    )  # fmt: skip


def _outside(model: Model, time: float | None) -> list[Fault]:
    """An instant that the run of the netlist does not reach."""
    start, stop = model.netlist.run.start, model.netlist.run.stop
    if time is None or start <= time <= stop:
        return []
    if time < start:
        return [Fault(Location("at"), f"{time:g} s is before the start of the run at {start:g} s")]
    way_out = f'Give an earlier instant, or let the run go on to it: run.stop = "{time:g} s".'
    return [Fault(Location("at"), f"{time:g} s is beyond the end of the run, run.stop = {stop:g} s.", way_out)]


def _missing(acting: str, out: str) -> list[Fault]:
    if bool(acting) == bool(out):
        return []
    here, there = ("in", "out") if acting else ("out", "in")
    return [Fault(Location(here), f"{shown(acting or out)} is given, and no {there}", "A response needs both.")]


def _span(asked: Arguments, given: tuple[float | str, float | str]) -> tuple[float, float] | None:
    if isinstance(given, str) or not hasattr(given, "__len__") or len(given) != 2:
        asked.pair("frequencies", given, "(0.1, 100)")
        return None
    low, high = (asked.above_zero("frequencies", one, "Hz") for one in given)
    if not asked.faults and not low < high:
        asked.pair("frequencies", given, "(0.1, 100)")
    return low, high
