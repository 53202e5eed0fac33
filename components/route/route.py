"""A guidance route: devices in order along a path coordinate."""

from fairlead.components.mechanics.ground import Ground
from fairlead.components.route.placing import misplaced, place
from fairlead.components.route.route_line import STANDING, RouteLine
from fairlead.components.route.station import Station

from fairlead.component import Composite, Expansion, Path, Stations


class Route(Composite):
    """Devices along a route; s = 0 at its inboard end, growing outboard, pay-out positive.

        stations:
          - {type: Winch, radius: 0.65 m}
          - {type: Straight, length: 2 m}
          - {name: bend, type: Bend, angle: 90 deg, radius: 1 m, friction: 0.35}
          - {type: Deployer, start: 5 m, length: 1.5 m, friction: 0.6, clamp: 1500 N/m}
          - {type: Sea, start: 10 m, speed: 4 m/s, tail: 150 N}

    A device without `start` begins where the one before it ends. Between devices the line spans freely.

    Nodes of a line travel along the route. A node is in a device by the share of its piece of line that lies in it. So
    the shares that two neighbouring devices have of a node sum to one. The moving parts of a device have ports below
    its name: `route.deployer.belt`, `route.winch.shaft`.

    Source: docs/physics.md, 4. Limits: the route is a way of arcs and straight pieces that does not move; only drives
    and rollers of devices do.
    """

    path = Path("the line that runs along it")
    stations = Stations(Station, "Devices in the order of the route.")

    def check(p):
        """In order, without overlap, each with a name of its own."""
        yield from misplaced(p.stations)

    def expand(p, scene):
        """The fixed surface that all standing devices share, and what moves; contacts come with the line."""
        line = RouteLine(place(p.stations), scene)
        children, joins, ports, outputs = {}, [], {}, {}
        if any(surface.flange == STANDING for surface in line.surfaces):
            children["surface"] = scene.make(Ground)
        for one in line.placed:
            made = line.machinery.get(one.name)
            if made is None:
                continue
            children |= {f"{one.name}.{child}": values for child, values in made.children.items()}
            joins += [tuple(f"{one.name}.{end}" for end in ends) for ends in made.joins]
            ports |= {f"{one.name}.{outer}": f"{one.name}.{inner}" for outer, inner in made.ports.items()}
            outputs |= {f"{one.name}.{outer}": f"{one.name}.{inner}" for outer, inner in made.outputs.items()}
        return Expansion(children, joins, ports, outputs, line=line)
