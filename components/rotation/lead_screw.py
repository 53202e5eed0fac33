"""Screws: a thread between a shaft and a nut, or between a worm and its wheel, that rubs on its flanks."""

from fairlead.components.friction.contact import small_lift
from fairlead.components.friction.curve import Curve
from fairlead.components.friction.frictionless import contact_of
from fairlead.components.rotation.rack import Rack
from fairlead.components.rotation.rubbing import METHODS
from fairlead.components.sensors.force_sensor import ForceSensor

from fairlead.component import (
    Choice,
    Component,
    Composite,
    Expansion,
    Input,
    Law,
    Output,
    Parameter,
    Part,
    Rotational,
    Translational,
    atan,
    cos,
    pi,
    sin,
    sqrt,
)  # fmt: skip


class Flank(Component):
    """What screw and nut do along the flank of their thread, at whose two sides friction acts.

    rim = radius cos(slope) screw,  ledge = -sin(slope) nut: the slip along the flank is that of rim over ledge.
    """

    screw, nut = Rotational("the screw"), Translational("the nut")
    rim, ledge = Translational("the flank of the screw"), Translational("the flank of the nut")
    radius = Parameter("m", "Mean radius of the thread.", above=0)
    slope = Parameter("rad", "Lead angle of the thread.", above=0)

    def law(p):
        """Nothing is added; the motion of one is that of the other."""
        return Law()

    def ties(p):
        """(a, b, ratio, offset):  b = ratio * a + offset."""
        return ("screw", "rim", p.radius * cos(p.slope), 0.0), ("nut", "ledge", -sin(p.slope), 0.0)


class FlankLoad(Component):
    """Normal force on the flanks of a thread, from the axial force that they carry, signal in and out."""

    slope = Parameter("rad", "Lead angle of the thread.", above=0)
    half_angle = Parameter("rad", "Half angle of the thread in its normal section; zero for a square thread.", least=0)
    preload = Parameter("N", "Axial force between the halves of a preloaded nut.", least=0)
    round_off = Parameter("N", "Axial force over which the corner at no load is rounded off.", above=0)
    axial = Input("N", "Axial part of the force that presses them.", signed=True)
    normal = Output("N", "Normal force.")
    pressed = Output("N", "Axial force that presses them, with a sharp corner.", rounded_by="round_off")

    def law(p, axial):
        """The flank leans by its slope and by half the angle of the thread."""
        pressed = p.preload + sqrt(axial**2 + p.round_off**2) - p.round_off
        return Law(normal=pressed / (cos(p.slope) * cos(p.half_angle)), pressed=p.preload + abs(axial))


class Screw(Composite, abstract=True):
    """What a lead screw and a worm have in common: a thread with friction on its flanks."""

    radius = Parameter("m", "Mean radius of the thread.", above=0, usual=(1e-4, 1))
    lead = Parameter("m", "Travel of the nut for one turn of the screw.", above=0, usual=(1e-5, 1))
    curve = Part(Curve, "Coefficient of friction of the flanks over slip speed.")
    half_angle = Parameter(
        "rad", "Half angle of the thread in its normal section; zero: square.", default=0.0, least=0, below=1.5
    )
    preload = Parameter("N", "Axial force between the halves of a preloaded nut.", default=0.0, least=0)
    round_off = Parameter("N", "Axial force over which the corner at no load is rounded off.", default=1e-3, above=0)
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    slip = Output("m/s", "Slip speed along the flanks.")
    friction = Output("N", "Friction along the flanks, positive when it opposes positive slip.")
    normal = Output("N", "Normal force of the flanks.")


def thread(p, scene):
    """Children and joints of a thread: a rack without loss, what it carries, and the friction along its flank."""
    slope = atan(p.lead / (2 * pi * p.radius))
    word = {} if p.method is None else {"method": p.method}
    children = {
        "thread": scene.make(Rack, radius=p.lead / (2 * pi)),
        "pressed": scene.make(ForceSensor),
        "load": scene.make(FlankLoad, slope=slope, half_angle=p.half_angle, preload=p.preload, round_off=p.round_off),
        "flank": scene.make(Flank, radius=p.radius, slope=slope),
        "contact": contact_of(scene, p.curve, **small_lift(p.round_off), **word),
    }
    joins = [
        ("thread.rack", "pressed.a"), ("pressed.tension", "load.axial"), ("load.normal", "contact.normal"),
        ("flank.screw", "thread.pinion"), ("flank.nut", "pressed.b"), ("flank.ledge", "contact.a"),
        ("flank.rim", "contact.b"),
    ]  # fmt: skip
    shown = {"slip": "contact.slip", "friction": "contact.friction", "normal": "load.normal"}
    return children, joins, shown


class LeadScrew(Screw):
    """A screw and a nut that cannot turn:  nut.v = lead/(2 pi) screw.speed, with friction on the flanks.

    With r the radius, tan s = lead/(2 pi r) and m = mu/cos(half_angle), a load W on the nut needs the torque

        W r (tan s + m)/(1 - m tan s)        to raise it
        W r (m - tan s)/(1 + m tan s)        to let it down

    If m is above tan s the screw locks itself: a load cannot turn it. `preload` adds friction without load, as in a
    ball nut.

    Source: square and angular threads, e.g. Shigley's Mechanical Engineering Design, power screws.

    Limits: there is no play (put a Backlash on the shaft) and no give. The collar that takes the thrust is a Bearing
    of its own. A mass m' at the nut of a screw that locks itself does not follow the shaft down, if it is above

        J/r^2 (1 + m tan s)/(tan s (m - tan s))        J: moment of inertia of the shaft

    It is pushed down at once then, or the screw jams: no motion of rigid parts exists, and a run ends. In that case
    give the load a SpringDamper, and the nut a Mass of its own below that.
    """

    screw = Rotational("the screw")
    nut = Translational("the nut")

    def expand(p, scene):
        """A thread between the two."""
        children, joins, shown = thread(p, scene)
        return Expansion(children, joins, {"screw": "thread.pinion", "nut": "pressed.b"}, shown)


class Worm(Screw):
    """A worm and its wheel:  wheel.speed = lead/(2 pi wheel_radius) worm.speed, with friction on the flanks.

    The worm is a screw, and the rim of the wheel is its nut (see LeadScrew). It locks itself if mu/cos(half_angle) is
    above the slope of the thread. `lead` is the number of threads times pi times the module. `half_angle` is the
    pressure angle.

    Limits: those of LeadScrew. The load of a worm that locks itself does not follow it down, if the inertia at the
    wheel is too large for that at the worm (m' is moment/wheel_radius^2). Give the load a TorsionSpring, and the wheel
    an Inertia of its own.

    Source: Shigley's Mechanical Engineering Design, worm gears.
    """

    worm = Rotational("the worm")
    wheel = Rotational("the wheel")
    wheel_radius = Parameter("m", "Pitch radius of the wheel.", above=0, usual=(1e-3, 10))

    def expand(p, scene):
        """A thread between the worm and the rim of the wheel."""
        children, joins, shown = thread(p, scene)
        children["rim"] = scene.make(Rack, radius=p.wheel_radius)
        joins.append(("pressed.b", "rim.rack"))
        return Expansion(children, joins, {"worm": "thread.pinion", "wheel": "rim.pinion"}, shown)
