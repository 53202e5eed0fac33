"""Laws for which `stepping` is not made, told when it is asked for by name; `auto` takes `rodas` for them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from fairlead.component.base import Component, Family
from fairlead.errors import Fault
from fairlead.system.break_away import least_left
from fairlead.system.system import System

WAY_OUT = "Take run.engine: rodas (or auto)."


def beside_its_laws(system: System, accuracy: float) -> Iterator[Fault]:
    """Contacts that creep or bend at rest, and contacts whose friction falls as they let go."""
    bending, falling = [], []
    for block in system.blocks:
        kind = block.kernel.variant.type
        if not (issubclass(kind, Family) and issubclass(kind, Component)) or kind.answers.never_sticks:
            continue
        structure = block.kernel.structure
        if not structure.holds:
            bending += block.instances
        elif structure.shares_left:
            shares = structure.shares_left
            falling += [one for one in block.instances if least_left(shares, one.values) < 1.0 - accuracy]
    if bending:
        what = (
            f"run.engine: stepping is made for contacts that hold exactly, and the laws of "
            f"{few([one.path for one in bending])} turn inside its steps: an error there may not follow the accuracy."
        )
        yield Fault(bending[0].where, what, WAY_OUT)
    if falling:
        what = (
            f"run.engine: stepping rounds the instants at which contacts let go to its steps, and the friction of "
            f"{few([one.path for one in falling])} falls there: what moves right after may be of order one in the step."
        )
        yield Fault(falling[0].where, what, WAY_OUT)


def few(names: Sequence[str]) -> str:
    """Three of them, and how many follow."""
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")
