"""Who left the range in which its tables have values: a piece that is no number is in force there."""

from __future__ import annotations

import numpy as np

from fairlead.component.piecewise import STRIDE, TERMS
from fairlead.system.compiled.system import Instance


def beyond_their_tables(system: Instance) -> list[str]:
    """Paths of the components with a table in a piece that is no number: they left the range in which it has values."""
    found = []
    for block in system.blocks:
        s = block.kernel.structure
        machines = block.machines[:, s.machines - len(s.tables) :]
        rows = block.table_base + STRIDE * system.zones[machines]
        beyond = np.isnan(system.memory["tables"][rows + TERMS]).any(axis=1) if len(s.tables) else []
        found += [block.instances[i].path for i in np.flatnonzero(beyond)]
    return found
