"""Where a station of a route stands in the netlist."""

from __future__ import annotations

from fairlead.analysis.statics.laid_route import LaidRoute
from fairlead.errors import Location


def where(route: LaidRoute, name: str) -> Location:
    """Where a device stands in the netlist; the route itself when it was not written there."""
    number = next(one.number for one in route.route.line.placed if one.name == name)
    entry = route.flat.assembly.netlist.components.get(route.route.path)
    listed = entry.parameters.get("stations") if entry is not None else None
    items = listed.content if listed is not None and isinstance(listed.content, list) else []
    return items[number].where if number < len(items) else route.route.where
