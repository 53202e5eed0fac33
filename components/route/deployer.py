"""A deployer: two driven belts that clamp the line."""

from fairlead.components.friction.curve import Curve
from fairlead.components.rotation.inertia import Inertia
from fairlead.components.rotation.rack import Rack
from fairlead.components.route.clamp import Clamp
from fairlead.components.route.station import Machinery, Station

from fairlead.component import Parameter, Part, Waveform


class Deployer(Station):
    """Two belts (or rows of wheels) along a length, each pressed on the line with a load q per length.

    The belts carry up to 2 mu q length of the line's force, beyond that they slip. The clamp squeezes the
    bulkheads too, so the core can carry load inside the deployer: up to 2 mu_bulkhead q length.

        route.<name>.belt     the belts, moving along the route        (a MotionSource prescribes their speed)
        route.<name>.shaft    the shaft of the drive wheel             (belt speed = wheel_radius * speed)
        route.<name>.clamp    clamp load per belt [N/m], an input added to the parameter `clamp`
    """

    word = "Deployer"
    length = Parameter("m", "Length over which the belts hold the line.", above=0)
    friction = Part(Curve, "Friction of the belts on the line.")
    clamp = Waveform("N/m", "Clamp load of each belt, per length.", default=0.0)
    wheel_radius = Parameter("m", "Radius of the wheel that drives the belts.", default=0.25, above=0)
    moment = Parameter("kg*m^2", "Inertia of belts and wheels, at the drive wheel.", default=8.0, above=0)

    def extent(p):
        """The length."""
        return p.length

    def rubs(p):
        """The belts."""
        return p.friction

    def lever(p):
        """The radius of the drive wheel."""
        return p.wheel_radius

    def machinery(p, scene):
        """Wheel, belts and clamp."""
        children = {
            "wheel": scene.make(Inertia, moment=p.moment),
            "belts": scene.make(Rack, radius=p.wheel_radius),
            "clamps": scene.make(Clamp, load=p.clamp),
        }
        ports = {"shaft": "wheel.shaft", "belt": "belts.rack", "clamp": "clamps.added"}
        shown = {"speed": "wheel.speed", "pressing": "clamps.pressing"}
        clamp = {"clamp": "clamps.pressing", "load": p.clamp, "added": "clamps.added"}
        return Machinery(children, (("wheel.shaft", "belts.pinion"),), ports, shown, "belts.rack", **clamp)
