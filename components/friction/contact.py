"""The sliding contact: one component for every treatment of friction."""

from fairlead.components.friction.curve import Curve

from fairlead.component import Component, Family, Input, Output, Parameter, Part, Translational


class Contact(Family, Component, abstract=True):
    """Dry friction between two bodies, `a` the surface and `b` the body that slips on it.

    Slip is v = b.v - a.v; the friction T opposes it: force -T on b, +T on a. `method` chooses how
    sticking is treated, `curve` how sliding friction depends on speed.
    """

    key = "method"
    default_word = "binding"
    a = Translational("the surface")
    b = Translational("the body that slips on it")
    curve = Part(Curve, "Coefficient of friction over slip speed.")
    normal_force = Parameter("N", "Normal force, when the input `normal` is not connected.", default=None, least=0)
    viscous = Parameter("N*s/m", "Viscous friction beside the dry one, while sliding.", default=0.0, least=0)
    lift = Parameter("N", "Normal force below which the contact is open.", default=1e-6, above=0)
    normal = Input("N", "Normal force.", default="normal_force")
    slip = Output("m/s", "Slip speed of b over a.")
    friction = Output("N", "Friction T, positive when it opposes positive slip.")
    creep_rate = Output("m/s", "Slip speed while the contact should stick, else zero.")
