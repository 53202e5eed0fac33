"""What keeps the tension of a rope from a ship that heaves: a sheave that moves, a compensator, and a stopper."""

from math import pi

from fairlead.components.friction.contact import Contact
from fairlead.components.hydraulics.accumulator import Accumulator
from fairlead.components.hydraulics.single_acting import SingleActingCylinder
from fairlead.components.mechanics.mass import Mass
from fairlead.components.rotation.rubbing import METHODS
from fairlead.components.signals.limits import Limiter
from fairlead.components.web.roller import Idler
from fairlead.components.web.span import WebAccumulator

from fairlead.component import (
    Choice,
    Component,
    Composite,
    Effect,
    Expansion,
    Input,
    Law,
    Output,
    Parameter,
    Translational,
)  # fmt: skip


class MovingSheave(Composite):
    """A sheave whose place moves, in a loop of rope:  force on place = share (tension_in + tension_out), drawn back.

    Either side of the loop has the way  length + share place.x : share is 1 where both sides are along the motion, and
    the cosine of the angle to it elsewhere. The rope turns the sheave, which has an inertia and a bearing; with the
    effect `traction` on it slips beyond Euler's ratio. `place` needs a mass, that of the sheave and what carries it.

    Source: docs/physics.md, 4.9. Limits: sides keep their direction; the rope has no weight.
    """

    a = Translational("rim of the roller or drum behind")
    b = Translational("rim of the roller ahead")
    place = Translational("the axle, which lengthens the loop as x grows")
    share = Parameter("1", "Way of either side for the way of the place.", default=1.0, above=0, most=1)
    length = Parameter("m", "Length of either side, with place.x = 0.", above=0)
    stiffness = Parameter("N", "EA of the rope.", above=0, usual=(10, 1e9))
    damping = Parameter("N*s", "Tension per rate of strain; none when not given.", default=None, above=0)
    tension = Parameter("N", "Tension at the start.", default=0.0, least=0, physics=False)
    radius = Parameter("m", "Radius of the sheave, to the middle of the rope.", above=0, usual=(1e-3, 5))
    moment = Parameter("kg*m^2", "Moment of inertia of the sheave.", above=0)
    rubbing = Parameter("N*m", "Dry torque of the bearing.", default=None, above=0)
    mu = Parameter("1", "Coefficient of friction of rope on sheave, with traction on.", default=0.3, above=0)
    wrap = Parameter("rad", "Angle that the rope wraps, with traction on.", default=pi, least=0, usual=(0, 7))
    rope_mass = Parameter(
        "kg", "Of the rope on the sheave, with traction on; needed if the rope has damping.", default=None, above=0
    )
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    traction = Effect("The rope slips on the sheave.", "off")
    before = Input("1", "Strain of the rope behind the loop.", default=0.0)
    after = Input("1", "Strain of the rope ahead of it.", default=0.0)
    tension_in = Output("N", "Tension of the side behind.")
    tension_out = Output("N", "Tension of the side ahead.")
    strain_in = Output("1", "Strain of the side behind.")
    strain_out = Output("1", "Strain of the side ahead.")

    def check(p):
        """The rope on the sheave has one speed."""
        if p.traction == "on" and p.damping is not None and p.rope_mass is None:
            what = "traction is on and the rope has damping, so what it slips at on the sheave depends on its own speed"
            yield "damping", what, "Give rope_mass, the mass of the rope on the sheave, or leave damping out."

    def expand(p, scene):
        """Two sides and a roller between them."""
        viscous = {} if p.damping is None else {"damping": p.damping}
        side = {"length": p.length, "stiffness": p.stiffness, "tension": p.tension, "strands": p.share, **viscous}
        given = {name: getattr(p, name) for name in ("radius", "moment", "mu", "wrap", "traction")}
        given |= {name: getattr(p, name) for name in ("rubbing", "method") if getattr(p, name) is not None}
        given |= {} if p.rope_mass is None else {"web_mass": p.rope_mass}
        children = {
            "inward": scene.make(WebAccumulator, **side),
            "outward": scene.make(WebAccumulator, **side),
            "sheave": scene.make(Idler, **given),
        }
        joins = [
            ("inward.b", "sheave.web"), ("sheave.web", "outward.a"), ("inward.carriage", "outward.carriage"),
            ("inward.strain", "outward.before"), ("outward.strain", "inward.after"),
            ("inward.elastic", "sheave.behind"), ("outward.elastic", "sheave.ahead"),
        ]  # fmt: skip
        told = {
            "before": "inward.before", "after": "outward.after", "tension_in": "inward.tension",
            "tension_out": "outward.tension", "strain_in": "inward.strain", "strain_out": "outward.strain",
        }  # fmt: skip
        return Expansion(children, joins, {"a": "inward.a", "b": "outward.b", "place": "inward.carriage"}, told)


class ActiveForce(Component):
    """A second cylinder beside the passive one, which gives the force that a signal says."""

    body, rod = Translational("the barrel"), Translational("the rod")
    command = Input("N", "Force, positive outwards.", signed=True)
    power = Output("W", "Power given.")

    def law(p, body, rod, command):
        """All power given is supplied."""
        power = command * (rod.v - body.v)
        return Law(rod=-command, body=command, power=power, supplied=power)


class HeaveCompensator(Composite):
    """A cylinder on a gas-loaded accumulator; the force on its rod hardly depends on the position.

        force = area (pressure - air) + command,   pressure (gas)^n = constant,   gas grows by area travel

    The passive stiffness is n area^2 pressure/gas: the less gas, the stiffer. Join the rod with the place of a
    MovingSheave, whose loop then has force/2 in each side, or with the line itself (a tensioner).

    active      on: a second cylinder adds the force that the signal `command` says, up to `most`; off: passive

    Source: docs/physics.md, 5.5; heave compensation, e.g. Woodacre, Bauer, Irani, Ocean Engineering 104 (2015), 140.

    Limits: oil and gas are those of a SingleActingCylinder and an Accumulator. The active cylinder is ideal except for
    its limit.
    """

    body = Translational("the barrel, on the ship")
    rod = Translational("the rod")
    bore_diameter = Parameter("m", "Bore of the passive cylinder.", above=0, usual=(0.01, 2))
    stroke = Parameter("m", "Travel of the rod from in to out.", above=0)
    pressure = Parameter("Pa", "Pressure of oil and gas at the start.", above=0, physics=False)
    gas_volume = Parameter("m^3", "Volume of the gas at its precharge.", above=0)
    precharge = Parameter("Pa", "Pressure of the gas without oil.", above=0)
    exponent = Parameter("1", "n, polytropic exponent.", default=1.2, above=1, most=2)
    neck = Parameter("m", "Diameter of the way between oil and gas.", default=0.06, above=0)
    mass = Parameter("kg", "Mass of rod and piston.", above=0)
    position = Parameter("m", "Position of the rod at the start.", default=None, physics=False)
    most = Parameter("N", "Largest active force.", default=1e5, above=0)
    active = Effect("A second cylinder that follows a signal.", "off")
    command = Input("N", "Active force asked for, positive outwards.", default=0.0, signed=True)
    travel = Output("m", "rod.x - body.x.")
    level = Output("Pa", "Pressure of the gas.", name="gas_pressure")
    gas = Output("m^3", "Volume of the gas.")

    def check(p):
        """There is oil in the accumulator."""
        if p.pressure <= p.precharge:
            what = f"pressure {p.pressure:g} Pa is not above precharge = {p.precharge:g} Pa"
            yield "pressure", what, "The gas must carry the rod: raise the pressure or lower the precharge."

    def expand(p, scene):
        """Cylinder, gas and rod; the second cylinder where wanted."""
        begins = {} if p.position is None else {"position": p.position}
        children = {
            "cylinder": scene.make(SingleActingCylinder, bore_diameter=p.bore_diameter, stroke=p.stroke,
                                   dead_volume=1e-3, pressure=p.pressure, port_diameter=p.neck),
            "gas": scene.make(Accumulator, volume=p.gas_volume, precharge=p.precharge, pressure=p.pressure,
                              exponent=p.exponent, neck=p.neck),
            "piston": scene.make(Mass, mass=p.mass, **begins),
            "limit": scene.make(Limiter, low=-p.most, high=p.most),
        }  # fmt: skip
        joins = [("cylinder.a", "gas.port"), ("cylinder.rod", "piston.flange")]
        if p.active == "on":
            children["added"] = scene.make(ActiveForce)
            joins += [
                ("added.rod", "piston.flange"),
                ("added.body", "cylinder.body"),
                ("limit.signal", "added.command"),
            ]
        told = {"command": "limit.value", "travel": "cylinder.travel", "gas_pressure": "gas.pressure",
                "gas": "gas.gas"}  # fmt: skip
        return Expansion(children, joins, {"body": "cylinder.body", "rod": "piston.flange"}, told)


class Jaws(Component):
    """What the jaws of a stopper hold:  grip = engaged capacity, signal in and out; engaged from 0 to 1."""

    capacity = Parameter("N", "Force up to which they hold.", above=0)
    engaged = Input("1", "1 closes the jaws, 0 opens them.", default=1.0)
    grip = Output("N", "Force up to which they hold now.")

    def law(p, engaged):
        """In proportion."""
        return Law(grip=p.capacity * engaged)


class Stopper(Composite):
    """Holds a rope or chain on deck up to `capacity` while `engaged`, and lets it slide beyond.

    The rope sticks to the jaws as in any dry contact; opened, they leave it alone. Limits: the jaws do not tighten by
    the pull of the rope itself; a shark jaw that can only break has a capacity above what the rope bears.

    Source: docs/physics.md, 2.1 (a contact that holds up to a force).
    """

    body = Translational("the deck")
    rope = Translational("the rope or chain")
    capacity = Parameter("N", "Force up to which it holds.", above=0)
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    engaged = Input("1", "1 closes the jaws, 0 opens them.", default=1.0)
    force = Output("N", "Force on the rope, positive when it opposes positive slip.")
    slip = Output("m/s", "Speed of the rope over the deck.")

    def expand(p, scene):
        """A contact whose normal force is what the jaws hold."""
        word = {} if p.method is None else {"method": p.method}
        children = {
            "jaws": scene.make(Jaws, capacity=p.capacity),
            "contact": scene.make(Contact, curve=1.0, **word),
        }
        told = {"engaged": "jaws.engaged", "force": "contact.friction", "slip": "contact.slip"}
        joins = [("jaws.grip", "contact.normal")]
        return Expansion(children, joins, {"body": "contact.a", "rope": "contact.b"}, told)
