"""What a machine takes from its shaft by its speed: a fan, a pump, a propeller, a mill."""

from fairlead.component import Component, Law, Output, Parameter, Rotational, Table, sqrt


class ShaftLoad(Component):
    """A load that brakes a shaft by its speed w:  torque = linear w + quadratic w |w| + points(w).

    Of a fan or propeller whose power is P at w the quadratic part is P/w^3. |w| is rounded at rest over `rounding`, so
    that the torque is smooth there. `points` tell a measured load, both ways of turning or by its sign what drives.
    Limits: what resists at rest is dry friction, a ShaftFriction.

    Source: the affinity laws of fans and pumps.
    """

    shaft = Rotational("the loaded shaft")
    linear = Parameter("N*m*s/rad", "Torque per speed.", default=0.0, least=0)
    quadratic = Parameter("N*m*s^2/rad^2", "Torque per speed squared.", default=0.0, least=0)
    points = Table("rad/s", "N*m", "Speed and torque that brakes at it.", default=None)
    rounding = Parameter("rad/s", "Speed below which |w| is rounded.", default=1e-3, above=0)
    torque = Output("N*m", "Torque that brakes the shaft.")
    power = Output("W", "Power taken.")

    def law(p, shaft):
        """Everything taken is dissipated."""
        w = shaft.speed
        measured = 0 if p.points is None else p.points(w)
        torque = p.linear * w + p.quadratic * w * sqrt(w**2 + p.rounding**2) + measured
        return Law(shaft=torque, torque=torque, power=torque * w, dissipated=torque * w)
