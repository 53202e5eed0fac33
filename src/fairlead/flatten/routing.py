"""Lines laid along routes: every node of a line gets its contacts with the devices it may meet."""

from __future__ import annotations

from fairlead.component.along import OfLine, OfRoute
from fairlead.component.assembly import Assembly
from fairlead.component.scene import TooManyParts
from fairlead.errors import Fault


def lay(assembly: Assembly) -> list[Fault]:
    """Add to the assembly the contacts of every line with its route; returns what does not fit."""
    faults: list[Fault] = []
    for one, two, where in assembly.routings:
        ends = {path: assembly.lines[path] for path in (one, two)}
        lines = [end for end in ends.values() if isinstance(end.line, OfLine)]
        routes = [end for end in ends.values() if isinstance(end.line, OfRoute)]
        if len(lines) != 1 or len(routes) != 1:
            faults.append(
                Fault(
                    where, f"{one}.path -- {two}.path joins no line with a route.", "Join an ArrayModule with a Route."
                )
            )
            continue
        if {one, two} & assembly.stand_ins:  # how they fit each other cannot be told
            for path in (one, two):
                assembly.excuse(inner for inner in assembly.instances if inner.startswith(f"{path}."))
            continue
        try:
            faults += lines[0].line.lay(assembly, lines[0], routes[0])
        except TooManyParts:
            faults += TooManyParts(where, f"{one}.path -- {two}.path").faults
    return faults
