"""A line that starts under the tensions of statics instead of one tension all along: `profile: statics`.

Elements are cut for the tension that statics gives at their middle when the line is about to slide the way it first
moves, both layers with one strain. So a run begins near its steady state, and what it shows of the start is the start
and not the making of its tensions.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fairlead.analysis.statics.joined import joined
from fairlead.analysis.statics.laid_route import LaidRoute, laid_routes
from fairlead.analysis.statics.schedule import LOOKS, STILL
from fairlead.analysis.statics.solution import state
from fairlead.analysis.statics.states import State
from fairlead.component.assembly import Instance, with_other
from fairlead.errors import Fault, ModelError
from fairlead.flatten.flat_model import FlatModel


def laid_under_statics(flat: FlatModel) -> FlatModel:
    """The model with the elements of such lines cut anew. Raises ModelError where no reference moves the line."""
    lines = [laid for laid in joined(laid_routes(flat)) if laid.says.begins_sliding]
    if not lines:
        return flat
    made: dict[str, Instance] = {}
    for laid in lines:
        made |= _cut(laid, about_to_slide(laid))
    flat.assembly.instances.update(made)
    return replace(flat, instances=tuple(made.get(each.path, each) for each in flat.instances))


def about_to_slide(laid: LaidRoute) -> State:
    """The line at the start, with all friction against the direction in which its reference first moves it."""
    schedule = laid.schedule()
    begin = laid.flat.assembly.netlist.run.start
    if schedule is not None:
        for t in np.linspace(schedule.begin, schedule.end, LOOKS):
            if abs(schedule.speed(float(t))) > STILL:
                return state(laid, begin, STILL if schedule.speed(float(t)) > 0 else -STILL, 0.0)
    what = f"{laid.line.path} is to begin as statics has it: no reference tells which way the line will move."
    raise ModelError([Fault(laid.line.where, what, "Drive it with a speed, or let it begin under one tension.")])


def _cut(laid: LaidRoute, found: State) -> dict[str, Instance]:
    """The elements of a line, each without tension as long as it must be to have that of statics at the start."""
    mesh, says, made = laid.says.mesh, laid.says, {}
    for k, length in enumerate(mesh.lengths):
        tension = found.tension(min(says.start + (mesh.places[k] + mesh.places[k + 1]) / 2, found.ends[1]))
        if np.isnan(tension):  # on the drum, wound on with what the winch keeps
            tension = found.passages[0].inboard if found.passages else says.tension
        free = length / (1 + max(tension, 0.0) / laid.stiffness)
        for layer in says.layers:
            old = laid.flat.assembly.instances[f"{laid.line.path}.{layer}[{k}]"]
            made[old.path] = with_other(old, length=free)
    return made
