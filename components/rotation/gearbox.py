"""A gearbox with losses and play."""

from fairlead.components.rotation.backlash import Backlash
from fairlead.components.rotation.gear import Gear
from fairlead.components.rotation.rubbing import Brake
from fairlead.components.rotation.torque_sensor import TorqueSensor

from fairlead.component import Component, Composite, Effect, Expansion, Input, Law, Output, Parameter, Rotational, sqrt


class LoadLoss(Component):
    """Friction torque of teeth under load:  loss = (1 - efficiency) * |torque carried|, signal in and out."""

    exempt = {"units": "A torque is handed to a contact at a radius of 1 m, as the force there (docs/drives.md)."}
    efficiency = Parameter("1", "Share of the torque that arrives when a drives b.", above=0, most=1)
    round_off = Parameter("N*m", "Torque over which the corner at no load is rounded off.", above=0)
    carried = Input("N*m", "Torque carried.", signed=True)
    loss = Output("N", "Friction at a radius of 1 m.")
    pressed = Output("N*m", "The torque carried.", rounded_by="round_off")

    def law(p, carried):
        """In proportion to the load."""
        size = sqrt(carried**2 + p.round_off**2) - p.round_off
        return Law(loss=(1 - p.efficiency) * size, pressed=carried)


class Gearbox(Composite):
    """b turns `ratio` times as often as a with a share of its torque:  torque_b = efficiency * torque_a/ratio.

    The loss is dry friction on shaft b that follows the torque carried, (1 - efficiency)|torque_a/ratio|: so it
    sticks, and while b drives a the share that arrives is 1/(2 - efficiency). With `backlash` the teeth have a gap
    and give way. Without both it is a `Gear`: a rigid ratio that costs nothing.

    Source: docs/physics.md, 5.6. Limits: one efficiency at every speed and torque; see LossyGear for both ways.
    """

    a = Rotational("driving shaft")
    b = Rotational("driven shaft")
    ratio = Parameter("1", "Turns of b for one turn of a; not zero. 1/30 slows down.")
    efficiency = Parameter("1", "Share of the torque that arrives at b when a drives.", default=0.95, above=0, most=1)
    play = Parameter("rad", "Angle by which b can turn while a stands still.", default=1e-3, least=0)
    stiffness = Parameter("N*m/rad", "Stiffness of the teeth, at shaft b.", default=1e7, above=0)
    damping = Parameter("s/rad", "Share of their torque that is added per speed of approach.", default=10.0, least=0)
    round_off = Parameter("N*m", "Torque over which the corner of the loss at no load is rounded off.", default=1e-3,
                          above=0)  # fmt: skip
    backlash = Effect("The teeth have a gap and give way.", "off")
    gear_friction = Effect("Teeth lose torque in proportion to the load.")
    torque = Output("N*m", "Torque carried to b, before losses.")
    loss = Output("N*m", "Friction torque on b.")

    def check(p):
        """A ratio of zero would hold b for ever."""
        if p.ratio == 0:
            yield "ratio", "ratio is zero", "Hold a shaft with a prescribed motion instead."

    def expand(p, scene):
        """A rigid gear, then what carries the torque to b, then its friction."""
        children = {"gear": scene.make(Gear, ratio=p.ratio)}
        if p.backlash == "on":
            children["teeth"] = scene.make(Backlash, stiffness=p.stiffness, damping=p.damping, play=p.play)
        elif p.gear_friction == "on":
            children["teeth"] = scene.make(TorqueSensor)
        else:
            return Expansion(children, [], {"a": "gear.a", "b": "gear.b"})
        joins, shown = [("gear.b", "teeth.a")], {"torque": "teeth.torque"}
        if p.gear_friction == "on":
            children["loss"] = scene.make(LoadLoss, efficiency=p.efficiency, round_off=p.round_off)
            children["rubbing"] = scene.make(Brake, radius=1.0, curve=1.0 if p.efficiency < 1 else 0.0,
                                             normal_force=p.round_off)  # fmt: skip
            joins += [("teeth.torque", "loss.carried"), ("loss.loss", "rubbing.normal"), ("rubbing.shaft", "teeth.b")]
            shown["loss"] = "rubbing.torque"
        return Expansion(children, joins, {"a": "gear.a", "b": "teeth.b"}, shown)
