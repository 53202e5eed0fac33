"""Parts of a System by what they do, by name: for the choice of an engine, for remarks and for messages."""

from __future__ import annotations

import numpy as np

from fairlead.kernels.break_away import least_left
from fairlead.system.arrays.switching import met_slots
from fairlead.system.assembly.algebraic_nodes import rows_without_rates
from fairlead.system.compiled.system import System


def rigid_stops(system: System) -> list[str]:
    """What is met at a place and then takes any impulse."""
    return [i.path for block in system.blocks if met_slots(block.kernel.structure) for i in block.instances]


def kept_positions(system: System) -> list[str]:
    """What keeps a relation of positions."""
    return [i.path for block in system.blocks if block.kernel.structure.positions for i in block.instances]


def undeclared(system: System) -> list[str]:
    """What passes power and says nothing of its energy."""
    return [i.path for block in system.blocks if block.kernel.structure.silent for i in block.instances]


def between_mass_and_none(system: System) -> list[str]:
    """Contacts that hold a node with inertia to one without: their rows are not in M."""
    in_mass = np.zeros(system.n, dtype=bool)
    in_mass[system.mass_pattern.rows] = True
    return sorted({system.machine_names[m] for m in system.holder[(system.holder >= 0) & ~in_mass]})


def at_nodes_without_inertia(system: System) -> list[str]:
    """What holds nodes whose balances have their rates beside them (algebraic_nodes.py)."""
    rows, found = rows_without_rates(system.blocks, system.numbering), []
    for block in system.blocks:
        s = block.kernel.structure
        for unknown in s.holds:
            own = block.flow_index[:, s.targets.index(f"own:{unknown}")]
            found += [i.path for i, row in zip(block.instances, own, strict=True) if row in rows]
    return found


def least_friction_left(system: System) -> float:
    """The least share of friction that a contact is left with when it lets go; 1 where none falls with a jump."""
    found = (
        least_left(block.kernel.structure.shares_left, values)
        for block in system.blocks if block.kernel.structure.shares_left
        for values in {id(instance.values): instance.values for instance in block.instances}.values()
    )  # fmt: skip
    return min(found, default=1.0)
