"""What a law says of an unknown that holds: a relative speed, or a relation of positions, that stays zero."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Hold:
    """The demand that a relative speed stays zero; the engine writes the row (see `docs/integrator.md`)."""

    slip: Any
    within: Any = None
    restitution: Any = None


@dataclass(frozen=True)
class HoldPosition:
    """The demand that a relation of positions stays zero; the engine writes the row and puts its force on the ports."""

    gap: Any


def hold(slip: Any, within: Any = None, restitution: Any = None) -> Any:
    """Law of an algebraic unknown in a zone that holds: keep `slip` [m/s or rad/s] at zero.

    When the zone is entered with some slip, an impulse brings it to zero: without limit (a rigid link), or
    only a slip of at most `within`. A contact has such a limit: friction is finite, and gives no impulse.
    What takes any impulse, and may let go, may give back: `restitution`, a number or a parameter from 0 to 1, is
    the share of the slip with which it parts again (`docs/integrator.md`, Impacts).
    """
    return Hold(slip, within, restitution)


def hold_position(gap: Any) -> Any:
    """Law of an algebraic unknown that keeps `gap` at zero: a smooth function of positions of ports and parameters.

    The ratio of the speeds may move, as that of a crank. The unknown is the force that keeps it:
    every port takes in  -unknown * d(gap)/d(its position)  without being told, so the constraint does no work.
    """
    return HoldPosition(gap)
