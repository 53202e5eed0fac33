"""A model with other values: what it shares with the one it comes from, and what is made again.

    renew(old, new)      gives `new` its stages, and says in `new.rebuilt` if it shares none of them

What is found first, serves:

1. the assembly and the graph of `old`, with the children made again that have other values (component/again.py);
   not where a motion begins at another time
2. the structure of `old`: netlist to flat model are made again, and agree with it (flatten/same_wiring.py)
3. nothing: all stages are made again
"""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol

from fairlead.analysis.statics.start_profile import laid_under_statics
from fairlead.component.again import again
from fairlead.component.assembly import Assembly
from fairlead.component.registry import known_types
from fairlead.flatten.collection import collected_later
from fairlead.flatten.flat_model import FlatModel
from fairlead.flatten.flatten import begins_otherwise
from fairlead.flatten.same_wiring import difference
from fairlead.netlist.netlist import Netlist
from fairlead.system.assembly.algebraic_nodes import without_damping
from fairlead.system.compile import energy_counted
from fairlead.system.compiled.system import System
from fairlead.system.numbering.contact_cycles import weighed
from fairlead.system.refresh import refreshed


class Stages(Protocol):
    """A `simulate.Model`: its stages, each made when first asked for unless it was given."""

    libraries: tuple[str, ...]
    netlist: Netlist
    assembly: Assembly
    flattened: FlatModel
    flat: FlatModel
    system: System
    rebuilt: str


@collected_later
def renew(old: Stages, new: Stages) -> None:
    """Make the stages of `new`, of one netlist with `old` but for its values. Raises ModelError as they do."""
    system = old.system
    other = begins_otherwise(old.flattened, new.netlist.run.start)
    made = None if other else again(old.assembly, old.flattened.instances, new.netlist, known_types(new.libraries))
    if made is not None:
        instances = tuple(made.instances.values())
        new.assembly, new.flattened = made, replace(old.flattened, assembly=made, instances=instances)
        new.flat = laid_under_statics(new.flattened)
    why = difference(old.flat, new.flat) or _ledger(old.flat, new.flat) or _by_values(system, new.flat)
    if why:
        new.rebuilt = f"All stages were made anew: {why}."
        new.system  # noqa: B018 - what a start contradicts is told here, as where the structure is shared
    else:
        new.system = refreshed(system, new.flat)


def _by_values(system: System, flat: FlatModel) -> str:
    """What else is left of it: values that the plans of a System follow, and not its numbers alone.

    Such are the ratio of a lever about which contacts share a load, and a damping that is zero at a node without mass.
    """
    about = {pair.path for pair in system.numbering.circles}
    structures = {i.path: block.kernel.structure for block in system.blocks for i in block.instances}
    for was, now in zip(system.flat.instances, flat.instances, strict=True) if about else ():
        if was.path in about and weighed(was, structures[was.path]) != weighed(now, structures[was.path]):
            return f"{was.path} shares otherwise what is held about it"
    before, after = (without_damping(one, structures) for one in (system.flat, flat))
    return next((f"{path} has {'no damping' if (path, at) in after else 'damping'} now, at a node without mass"
                 for path, at in sorted(before ^ after)), "")  # fmt: skip


def _ledger(one: FlatModel, other: FlatModel) -> str:
    """What is left of the structure: whether energy is counted."""
    counted = energy_counted(other)
    return "" if energy_counted(one) == counted else f"energy is {'counted' if counted else 'not counted'} now"
