"""Friction of a gear train that grows with the torques on both of its sides."""

from fairlead.components.friction.frictionless import contact_of
from fairlead.components.mechanics.slide_friction import PRESSED
from fairlead.components.rotation.rack import Rack
from fairlead.components.rotation.rubbing import METHODS, LeverArm
from fairlead.components.rotation.shaft_friction import ARM, Turning

from fairlead.component import Choice, Component, Composite, Expansion, Input, Law, Output, Parameter, Rotational, sqrt


class ToothLoad(Component):
    """Friction level of teeth under load, signal in and out.

    level = dry + sqrt((by_motor * motor - by_load * load)^2 + round_off^2) - round_off
    """

    exempt = {"units": "A torque is handed to a contact at a radius of 1 m, as the force there (docs/drives.md)."}
    dry = Parameter("N*m", "Level without load.", least=0)
    by_motor = Parameter("1", "Share of the motor's torque.", least=0)
    by_load = Parameter("1", "Share of the load's torque.", least=0)
    round_off = Parameter("N*m", "Torque over which the corner at no load is rounded off.", above=0)
    motor = Input("N*m", "Torque of the motor.", signed=True)
    load = Input("N*m", "Torque of the load, positive when it turns the shaft forward.", signed=True)
    level = Output("N", "Friction level at a radius of 1 m.")
    pressed = Output("N*m", "The level, with a sharp corner.", rounded_by="round_off")

    def law(p, motor, load):
        """Motor and load that pull against each other press the teeth."""
        pressed = p.by_motor * motor - p.by_load * load
        level = p.dry + sqrt(pressed**2 + p.round_off**2) - p.round_off
        return Law(level=level, pressed=p.dry + abs(pressed))


class LoadedFriction(Composite):
    """Dry friction of a gear train between two shafts, which depends on the torques on both sides.

        level = dry + |by_motor * motor - by_load * load|
        friction while turning = level (1 + (excess) exp(-(w/speed)^2)) + viscous w

    The torques of motor and load count with the sign with which they turn the shaft forward. So a motor that holds a
    load presses the teeth with both torques. If the two shares differ, driving a load takes another torque than being
    driven by it. Join `a` with a Housing. With both shares zero it is a `ShaftFriction`.

    Source: the directional load-dependent friction of servo actuators (Duclusaud, Passault, Padois, Ly 2024, models
    M3 to M5, arXiv:2410.08650).

    Limits: the torque of the motor is that before its own inertia takes a part.
    """

    a, b = Rotational("one shaft, or a Housing"), Rotational("the other shaft")
    dry = Parameter("N*m", "Level without load.", least=0)
    by_motor = Parameter("1", "Share of the motor's torque.", default=0.0, least=0, usual=(0, 1))
    by_load = Parameter("1", "Share of the load's torque.", default=0.0, least=0, usual=(0, 1))
    excess = Parameter("1", "Break-away over sliding, less one.", default=0.0, least=0)
    speed = Parameter("rad/s", "Speed over which break-away falls to sliding.", default=1.0, above=0)
    viscous = Parameter("N*m*s/rad", "Torque that grows with speed, beside the dry one.", default=0.0, least=0)
    round_off = Parameter("N*m", "Torque over which the corner at no load is rounded off.", default=1e-4, above=0)
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    motor = Input("N*m", "Torque of the motor.", 0.0, signed=True)
    load = Input("N*m", "Torque of the load, positive when it turns the shaft forward.", 0.0, signed=True)
    torque = Output("N*m", "Friction torque, positive when it opposes positive slip.")
    slip = Output("rad/s", "Speed of b over a.")
    level = Output("N", "Friction level at a radius of 1 m.")

    def expand(p, scene):
        """A contact at a lever arm of one metre, pressed with the level, which a viscous part alone does not need."""
        word = {} if p.method is None else {"method": p.method}
        curve = {"curve": "stribeck", "stiction": 1 + p.excess, "coulomb": 1.0, "velocity": p.speed * ARM}
        pressed, rubs = {"lift": 1e-9}, p.dry or p.by_motor or p.by_load
        if not rubs:
            curve, pressed = 0.0, {"normal_force": PRESSED}
        children = {
            "teeth": scene.make(ToothLoad, dry=p.dry, by_motor=p.by_motor, by_load=p.by_load, round_off=p.round_off),
            "contact": contact_of(scene, curve, p.viscous / ARM**2, **pressed, **word),
            "lever": scene.make(LeverArm, radius=ARM),
            "turning": scene.make(Turning, radius=ARM),
            "rim_a": scene.make(Rack, radius=ARM),
            "rim_b": scene.make(Rack, radius=ARM),
        }
        joins = [
            ("rim_a.rack", "contact.a"), ("rim_b.rack", "contact.b"), ("contact.friction", "lever.friction"),
            ("contact.slip", "turning.slip"), *([("teeth.level", "contact.normal")] if rubs else []),
        ]  # fmt: skip
        shown = {"torque": "lever.torque", "slip": "turning.speed", "motor": "teeth.motor", "load": "teeth.load",
                 "level": "teeth.level"}  # fmt: skip
        return Expansion(children, joins, {"a": "rim_a.pinion", "b": "rim_b.pinion"}, shown)
