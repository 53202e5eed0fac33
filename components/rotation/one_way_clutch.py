"""A clutch that carries one way: a freewheel, a sprag clutch, a backstop."""

from fairlead.component import Component, Law, Output, Rotational, Unknown, Zones, guard, hold, zone


class OneWayClutch(Component):
    """Lets b run ahead of a, and takes b along when a would overtake it.

    free       b.speed > a.speed     torque = 0
    driving    b.speed = a.speed     torque = whatever holds, torque >= 0

    The torque turns b forward and a back. With a at a Housing it is a backstop: b turns forward only. Where a catches
    up with b at once, an impulse brings both to one speed and what it takes is booked as lost (`docs/integrator.md`,
    Impacts). Limits: no windup and no drag of the free clutch; put a TorsionSpring in series, a ShaftFriction beside.

    Source: OneWayClutch of the Modelica Standard Library, with an impulse; docs/integrator.md, Impacts.
    """

    exempt = {"odd": "It carries one way."}
    a = Rotational("driving shaft")
    b = Rotational("driven shaft")
    carried = Unknown("N*m", "Torque that takes b along.")
    torque = Output("N*m", "Torque carried from a to b, never negative.")
    slip = Output("rad/s", "Speed of b over a, never negative.")
    zones = Zones("free", "driving")

    @zone("free")
    def overrunning(p, a, b, carried):
        """Nothing is carried."""
        return Law(a=0, b=0, carried=carried, torque=0, slip=b.speed - a.speed)

    @zone("driving")
    def together(p, a, b, carried):
        """One speed."""
        return Law(a=carried, b=-carried, carried=hold(b.speed - a.speed), torque=carried, slip=b.speed - a.speed)

    @guard("free", to="driving", unit="rad/s")
    def catches_up(p, a, b):
        """It would overtake b."""
        return a.speed - b.speed

    @guard("driving", to="free", unit="N*m")
    def overruns(p, carried):
        """It would have to hold b back."""
        return -carried
