"""Remarks on contacts whose way of sticking is too wide for the scene: for its drives, or for their curve.

A treatment that creeps, or takes a band of slip for rest, gives the friction of sliding only above some slip speed
(`narrowest` of its class). That speed must lie well below the speeds that matter (docs/physics.md 1.5): a tenth of
the speed over which the curve changes, and a tenth of the slowest speed at which a source drives anything.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from fairlead.component.assembly import Instance
from fairlead.component.values import Values, Wave, polynomial
from fairlead.errors import Fault
from fairlead.flatten.flat_model import FlatModel

SHARE = 0.1  # of a speed that matters; physics 1.5 advises 0.02 to 0.1
STILL = 1e-12  # m/s; a drive slower than this stands


class Scale(NamedTuple):
    """A speed that matters [m/s], and what it is."""

    speed: float
    name: str


def too_wide(flat: FlatModel) -> list[Fault]:
    """One remark for every kind of contact that is too wide, with the numbers and the widest that would do."""
    drive = slowest_drive(flat.instances)
    found: dict[int, list[Instance]] = {}
    for instance in flat.instances:
        if instance.type.answers.narrowest is not None:
            found.setdefault(id(instance.values), []).append(instance)
    return [fault for alike in found.values() for fault in _remarks(alike, drive)]


def slowest_drive(instances: Iterable[Instance]) -> Scale | None:
    """The slowest steady speed, other than rest, that a prescribed motion has."""
    scales = [
        Scale(speed, f"the slowest drive ({instance.path})")
        for instance in instances
        if instance.type.answers.moves_as
        for speed in _steady_speeds(getattr(instance.values, instance.type.answers.moves_as))
    ]
    return min(scales, default=None)


def _steady_speeds(motion: Wave) -> Iterator[float]:
    """Slopes of the straight pieces of a motion in time; one with a sine stands still now and then."""
    if motion.is_swinging:
        return
    for row in polynomial(motion).rows:
        if not row[5:].any() and abs(row[4]) > STILL:
            yield abs(float(row[4]))


def _remarks(alike: list[Instance], drive: Scale | None) -> Iterator[Fault]:
    first = alike[0]
    values: Values = first.values
    says = first.type.answers
    width = says.narrowest(values) if says.narrowest is not None else None
    scale, own = says.changes_over(values) if says.changes_over is not None else None, says.sticks_below
    if width is None or not own:
        return
    scales = [Scale(scale, "the curve's velocity")] if scale else []
    scales += [drive] if drive is not None else []
    path = first.path + (f" and {len(alike) - 1} more like it" if len(alike) > 1 else "")
    for speed, name in scales:
        if width > SHARE * speed * (1 + 1e-9):
            given: float = values.path(own)
            most = given * SHARE * speed / width
            what = (
                f"{path}: friction is that of sliding only from {1e3 * width:.3g} mm/s on "
                f"({own} = {1e3 * given:.3g} mm/s), more than a tenth of {name}, {1e3 * speed:.3g} mm/s."
            )
            worse = "" if width < speed else " As it is, the contact may never come to slide."
            yield Fault(first.where, what, f"A {own} of at most {1e3 * most:.2g} mm/s would do.{worse}")
