"""Lines joined end to end, such as a lead-in cable and an array, each on a route of its own.

Where everything outboard of the joint only follows, the line inboard of it moves the other, and that one pulls at it
with what its own statics says; the other way round where everything inboard only follows. Where both sides hold,
nothing tells the tension of the joint, and both are taken to hold there.
"""

from __future__ import annotations

from dataclasses import replace

from fairlead.analysis.statics.laid_route import LaidRoute
from fairlead.analysis.statics.machines import Machine

Joints = dict[str, str]
"""By the path of a line, that of the line at its outboard end."""


def joined(routes: list[LaidRoute]) -> list[LaidRoute]:
    """The same routes, each knowing which line pulls at its ends and which one moves it."""
    known = {one.line.path: one for one in routes}
    outward = {a.line.path: b.line.path for a in routes for b in routes if a is not b and _meet(a, b)}
    if not outward:
        return routes
    inward = {b: a for a, b in outward.items()}
    return [_with_neighbours(known, outward, inward, path) for path in known]


def _meet(one: LaidRoute, other: LaidRoute) -> bool:
    """Whether the outboard end of one is the inboard end of the other, with nothing else that acts there."""
    if other.winch is not None or any(_acts(made) for made in (one.outboard, other.inboard)):
        return False
    first, second = (one.flat.place(made.port) for made in (one.outboard, other.inboard))
    return first[:2] == second[:2]


def _acts(made: Machine) -> bool:
    return made.drives or bool(made.efforts) or made.tension is not None


def _with_neighbours(known: dict[str, LaidRoute], outward: Joints, inward: Joints, path: str) -> LaidRoute:
    found = known[path]
    if (other := outward.get(path)) is not None:
        if _follows(known, outward, other, out=True):
            found = replace(found, outboard=_without(found.outboard, other),
                            beyond=_pulling(known, outward, other, out=True))  # fmt: skip
        else:
            found = replace(found, outboard=_holding(found.outboard, other))
    if (other := inward.get(path)) is not None:
        if not _follows(known, outward, path, out=True) and _follows(known, inward, other, out=False):
            found = replace(found, inboard=_without(found.inboard, other),
                            before=_pulling(known, inward, other, out=False))  # fmt: skip
        else:
            found = replace(found, inboard=_holding(found.inboard, other))
    if not list(_own_drivers(found)):
        movers = [one for one in (*_along(inward, path), *_along(outward, path)) if list(_own_drivers(known[one]))]
        found = replace(found, moved_by=known[movers[0]] if movers else None)
    return found


def _pulling(known: dict[str, LaidRoute], joints: Joints, path: str, *, out: bool) -> LaidRoute:
    """A line that follows, as it pulls at the one before it: held at the joint, pulled at by the next."""
    found, other = known[path], joints.get(path)
    further = None if other is None else _pulling(known, joints, other, out=out)
    if out:
        return replace(found, inboard=_holding(found.inboard, ""), beyond=further)
    return replace(found, outboard=_holding(found.outboard, ""), before=further)


def _follows(known: dict[str, LaidRoute], joints: Joints, path: str, *, out: bool) -> bool:
    """Whether nothing on a line, or on those behind it, holds."""
    one = known[path]
    drives = (one.outboard if out else one.inboard).drives or any(each.machine.drives for each in one.devices
                                                                  if each.machine is not None)  # fmt: skip
    return not drives and (path not in joints or _follows(known, joints, joints[path], out=out))


def _own_drivers(route: LaidRoute) -> list[Machine]:
    return [made for _, made in route.drivers() if made.speed is not None]


def _along(joints: Joints, path: str) -> list[str]:
    found = []
    while (path := joints.get(path, "")) and path not in found:
        found.append(path)
    return found


def _without(made: Machine, line: str) -> Machine:
    """An end of which what the other line does is counted."""
    return replace(made, left_out=tuple(one for one in made.left_out if not one.startswith(f"{line}.")))


def _holding(made: Machine, line: str) -> Machine:
    """An end that the other line holds with whatever comes."""
    return replace(_without(made, line), unknown=True, by=line)
