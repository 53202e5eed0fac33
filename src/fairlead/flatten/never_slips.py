"""Whether a row that holds can never be anything but held: its slip is zero for all motions of one rigid body.

    slip = sum of coefficient * speed of a port = (sum of coefficient * ratio) * speed of the body

Bodies that a gear, a rack or a lever ties move together, but not alike: a clutch across a gear of ratio 2 slips.
"""

from __future__ import annotations

import math

from fairlead.component.assembly import Instance, PortRef
from fairlead.component.declaration import Declaration
from fairlead.component.keys import key
from fairlead.component.values import parameter
from fairlead.flatten.flat_model import FlatModel, Group
from fairlead.flatten.kinematics import AGREES


def never_slips(flat: FlatModel, instance: Instance) -> tuple[Group, list[str]] | None:
    """The one body of a row that cannot slip, and its ports there; None where every row can."""
    path, known = instance.path, flat.places
    places = {port: known[path, port] for port in _mechanical(instance.type.declaration) if (path, port) in known}
    if len({place[0] for place in places.values()}) == len(places):
        return None
    if len({flat.node_of[PortRef(path, port)] for port in places}) < 2:
        return None  # ports that are joined with each other are told by themselves
    for terms in _rows(instance):
        groups = {places[port][0] for port in terms}
        adds = [coef * places[port][1] for port, coef in terms.items()]
        if len(groups) == 1 and len(adds) > 1 and abs(math.fsum(adds)) <= AGREES * sum(map(abs, adds)):
            return flat.groups[groups.pop()], list(terms)
    return None


def _mechanical(has: Declaration) -> list[str]:
    return [name for name, port in has.ports.items() if port.domain.mechanical]


def _rows(instance: Instance) -> list[dict[str, float]]:
    """Of every row that holds a slip: port -> coefficient of its speed, with the numbers of this instance."""
    from fairlead.component.trace import TraceError, trace  # needs SymPy; few scenes come here

    try:
        zones = trace(instance.variant).zones.values()
    except TraceError:  # told when the law is compiled
        return []
    rows = [row.rates for zone in zones for row in zone.holds.values() if row.gap is None]
    return [{key(speed).name: float(rate.xreplace({s: parameter(instance.values, key(s.name).number)
                                                   for s in rate.free_symbols}))
             for speed, rate in rates.items()} for rates in rows]  # fmt: skip
