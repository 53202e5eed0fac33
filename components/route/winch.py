"""A winch drum: the inboard end of a route, on which the line is stored."""

from __future__ import annotations

import math

from fairlead.components.rotation.inertia import Inertia
from fairlead.components.rotation.rack import Rack
from fairlead.components.route.drum import Drum
from fairlead.components.route.drum_layers import Layers
from fairlead.components.route.station import Machinery, Station

from fairlead.component import Choice, Parameter


class Winch(Station):
    """A drum that takes up the line at `start`; what is inboard of it is stored, and locked to the drum.

        line speed = R w       moment dw/dt = torque at the shaft + R (tension of the line at the drum)

    Line on the drum moves with it, so that its strain stays as it was wound on, and comes off with it. The drum takes
    hold of a node over `edge` (0.1 m); the bond is viscous, and lets the last node before the edge creep under the
    difference of the tensions on both sides: 1 kN over `lock` is 1 um/s. An inboard end that lies on the drum is
    fastened to it (when the drum has no layers).

    `layers: off`  the radius does not change; `route.<name>.rim` is a flange that moves with the line, where a
                   speed or a tension may be given. `on` takes `width` and the diameter of the line and grows the
                   radius by layers: R_j = radius + d/2 + (j - 1) d (nested: times sqrt(3)/2), with a change from
                   one to the next over `crossover`. `filled` is what is on the drum at the start beside the line
                   of the model; it has no mass, so add its inertia to `moment`. The radius is that of the line's
                   middle in the first layer when layers are off.
    """

    word = "Winch"
    radius = Parameter(
        "m", "Radius of the drum; of the middle of the line when it has no layers.", above=0, usual=(5e-3, 200)
    )
    moment = Parameter("kg*m^2", "Inertia of drum and drive at the shaft, without the line.", default=100.0, above=0)
    layers = Choice(("off", "on"), "Whether the radius grows with what is wound on.", default="off")
    width = Parameter("m", "Width between the flanges of the drum.", default=0.8, above=0)
    height = Parameter("m", "Depth from the flange's edge to the drum; no limit when not given.", default=None, above=0)
    packing = Choice(("nested", "stacked"), "How one layer lies on the other.", default="nested")
    crossover = Parameter("rad", "Angle over which a layer changes to the next.", default=math.pi / 2, above=0)
    lay = Parameter("rad/m", "Twist that winding gives the line, per length; for a line with torsion.", default=0.0)
    filled = Parameter("m", "Line on the drum beside that of the model.", default=0.0, least=0)
    lock = Parameter("N*s/m", "Bond of a stored node with the drum.", default=1e9, above=0)
    line_diameter = Parameter("m", "Diameter that a layer takes; that of the line by default.", default=None, above=0)

    def extent(p):
        """It takes no length of the route."""
        return 0.0

    def span(p, start):
        """All that is inboard of it."""
        return -math.inf, start

    def stores(p):
        """What is inboard of it."""
        return True

    def leaves_at(p, stored, diameter):
        """The radius, which grows by layers if they are on."""
        return p.radius if p.layers == "off" else p.wound(diameter).radius_at(p.filled + stored)

    def layer_at(p, stored, diameter):
        """The layer that the line leaves, from 1, if layers are on."""
        return None if p.layers == "off" else p.wound(diameter).filled(p.filled + stored)[0] + 1

    def wound(p, diameter):
        """Layers of a line of this diameter [m] on the drum."""
        return Layers(p.radius, p.line_diameter or diameter, p.width, p.packing == "nested", p.height)

    def takes(p, diameter):
        """What its flanges hold beside what is `filled`, if they are told and layers are on."""
        limited = p.layers == "on" and p.height is not None
        return p.wound(diameter).capacity - p.filled if limited else math.inf

    def machinery(p, scene):
        """Drum with a rim, or with a radius that follows its angle."""
        drum = scene.make(Inertia, moment=p.moment)
        shown = {"speed": "drum.speed", "angle": "drum.angle"}
        if p.layers == "off":
            children = {"drum": drum, "rim": scene.make(Rack, radius=p.radius)}
            ports = {"shaft": "drum.shaft", "rim": "rim.rack"}
            return Machinery(children, (("drum.shaft", "rim.pinion"),), ports, shown, "rim.rack")
        children = {"drum": drum, "layers": scene.make(Drum, radius=constant_radius(p))}
        ports = {"shaft": "drum.shaft"}
        joins = (("drum.shaft", "layers.shaft"),)
        return Machinery(children, joins, ports, shown | {"radius": "layers.radius_now"}, "layers.shaft")


def constant_radius(p):
    """The radius of the bare drum; the line replaces it when laid."""
    from fairlead.component.piecewise import constant

    return constant(p.radius)
