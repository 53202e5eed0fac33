"""Refuses settings that ask for more rows, steps or samples than anybody can want: a slip of a unit.

A run has no bound of its own on its steps: it ends at `run.stop`, at a budget of the netlist, or when it is
interrupted, and keeps what was computed. What it cannot do with less is counted here.
"""

from __future__ import annotations

from collections.abc import Iterator

from fairlead.component.assembly import Instance
from fairlead.errors import Fault, Location
from fairlead.flatten.flat_model import FlatModel
from fairlead.netlist.netlist import Netlist
from fairlead.netlist.settings import RunSettings

MOST_ROWS = 20_000_000  # at one signal 320 MB; more fills the disk
MOST_STEPS = 1_000_000_000  # at a microsecond each, of the smallest models, a quarter of an hour


def unreasonable(netlist: Netlist, settings: RunSettings, flat: FlatModel) -> list[Fault]:
    """Counts that can only be a slip of a unit, each with its number."""
    span = settings.stop - settings.start
    found = []
    every, most = netlist.record.every, settings.max_step
    if every is not None and span / every > MOST_ROWS:
        what = f"record.every = {every:g} s makes {span / every:.3g} rows in {span:g} s."
        way_out = _way_out(MOST_ROWS, "rows", "record less often")
        found.append(Fault(_written(netlist, "record", "every"), what, way_out))
    if most is not None and span / most > MOST_STEPS:
        what = f"run.max_step = {most:g} s makes at least {span / most:.3g} steps in {span:g} s."
        way_out = _way_out(MOST_STEPS, "steps", "allow longer ones")
        found.append(Fault(_written(netlist, "run", "max_step"), what, way_out))
    for instance, period in _sampled(flat):
        if span / period > MOST_STEPS:
            what = f"{instance.path} is sampled every {period:g} s, {span / period:.3g} times in {span:g} s."
            found.append(Fault(instance.where, what, _way_out(MOST_STEPS, "samples", "sample less often")))
    return found


def _sampled(flat: FlatModel) -> Iterator[tuple[Instance, float]]:
    for instance in flat.instances:
        for name in instance.type.declaration.periods:
            yield instance, instance.values.path(name)


def _written(netlist: Netlist, block: str, key: str) -> Location:
    """Where a setting is written, else the netlist."""
    value = netlist.written[block].get(key)
    return value.where if value is not None else Location(str(netlist.path))


def _way_out(most: int, of: str, less: str) -> str:
    return f"At most {most} {of}; {less}, or stop earlier."
