"""The tension that is wanted of a winder, which falls as its roll grows."""

from fairlead.component import Choice, Component, Input, Law, Output, Parameter, sqrt

NOTHING = 1e-6  # of the core: so small a roll there is not, and its radius may be divided by


class TaperTension(Component):
    """Demanded tension at a roll over its radius, and the torque for it:  torque = wanted radius.

    hyperbolic    wanted = tension (1 - taper (1 - core_radius/radius))
    linear        wanted = tension (1 - taper (radius - core_radius)/(full_radius - core_radius))

    Source: D. R. Roisum, The Mechanics of Winding, TAPPI Press 1994. With taper 1 the hyperbolic one keeps the torque;
    with 0 both keep the tension. Limits: the torque has no share for the inertia of the roll or for friction.
    """

    asked_with = {"core_radius": 0.1, "full_radius": 0.9}
    tension = Parameter("N", "Tension at the core.", least=0)
    taper = Parameter("1", "Share by which the tension falls.", default=0.0, least=0, most=1)
    core_radius = Parameter("m", "Radius at which it begins to fall.", above=0)
    full_radius = Parameter("m", "Radius of a full roll, for a linear taper.", default=None, above=0)
    shape = Choice(("hyperbolic", "linear"), "How it falls.", default="hyperbolic")
    radius = Input("m", "Radius of the roll.")
    wanted = Output("N", "Tension wanted.")
    torque = Output("N*m", "The same as a torque on the roll.")

    def check(p):
        """A linear taper goes from one radius to a larger one."""
        if p.shape == "linear" and p.full_radius is None:
            yield "full_radius", "shape is linear without full_radius", "Give the radius at which the taper ends."
        if p.full_radius is not None and p.full_radius <= p.core_radius:
            what = f"full_radius {p.full_radius:g} m is not above core_radius = {p.core_radius:g} m"
            yield "full_radius", what, "A full roll is larger than its core."

    def law(p, radius):
        """A share of the tension at the core."""
        if p.shape == "linear":
            falls = (radius - p.core_radius) / (p.full_radius - p.core_radius)
        else:
            falls = 1 - p.core_radius / sqrt(radius**2 + (NOTHING * p.core_radius) ** 2)
        wanted = p.tension * (1 - p.taper * falls)
        return Law(wanted=wanted, torque=wanted * radius)
