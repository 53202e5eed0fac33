"""Whether two compiled systems are the same equations, so that a switch between them is no switch of this scene."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from fairlead.system.kernels import Kernel, write_source


def same(one: Any, other: Any) -> bool:
    """True when two Systems have equal unknowns, parameters and wiring, and kernels that compute the same."""
    if one.n != other.n or len(one.blocks) != len(other.blocks) or one.unknown_names != other.unknown_names:
        return False
    if not np.array_equal(one.initial, other.initial) or not np.array_equal(one.absolute, other.absolute):
        return False
    return all(_alike(mine, its) for mine, its in zip(one.blocks, other.blocks, strict=True))


def _alike(mine: Any, its: Any) -> bool:
    arrays = ("parameters", "in_index", "in_coef", "in_offset", "flow_index", "sig_index", "table_base")
    if any(not np.array_equal(getattr(mine, name), getattr(its, name)) for name in arrays):
        return False
    return _same_law(mine.kernel, its.kernel)


def _same_law(mine: Kernel, its: Kernel) -> bool:
    """Two variants of a class may come out as the same text: an effect that none of its given parameters enters."""
    if mine.variant == its.variant:
        return True
    if mine.variant.type is not its.variant.type or asdict(mine.structure) != asdict(its.structure):
        return False
    return write_source(mine.variant)[0] == write_source(its.variant)[0]
