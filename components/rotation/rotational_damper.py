"""A viscous damper between two shafts."""

from fairlead.component import Component, Law, Output, Parameter, Rotational


class RotationalDamper(Component):
    """Viscous torque:  torque = damping * (b.speed - a.speed). Joined with a Housing it is the drag of a bearing.

    Positive torque turns b back. Source: Newton's law of viscosity. Limits: in proportion at any speed; a ShaftLoad has
    other laws.
    """

    a = Rotational("one shaft")
    b = Rotational("the other shaft")
    damping = Parameter("N*m*s/rad", "Torque per difference of speeds.", least=0)
    torque = Output("N*m", "Torque that slows b.")

    def law(p, a, b):
        """All the power that goes in is dissipated."""
        slip = b.speed - a.speed
        torque = p.damping * slip
        return Law(a=-torque, b=torque, torque=torque, dissipated=torque * slip)
