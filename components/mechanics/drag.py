"""What a fluid takes from a body by its speed."""

from fairlead.component import Component, Law, Output, Parameter, Table, Translational, sqrt


class Drag(Component):
    """Resists the speed v of b relative to a:  drag = linear v + quadratic v |v| + points(v).

    Of a body with drag coefficient C_d and area A in a fluid of density rho the quadratic part is rho C_d A/2. |v| is
    rounded at rest over `rounding`, so that the drag is smooth there. Join `a` with a Ground for a fluid at rest.
    """

    a = Translational("the fluid, or a Ground")
    b = Translational("the body")
    linear = Parameter("N*s/m", "Drag per speed.", default=0.0, least=0)
    quadratic = Parameter("N*s^2/m^2", "Drag per speed squared.", default=0.0, least=0)
    points = Table("m/s", "N", "Table of speed and drag, added to the other two; for both signs of v.", default=None)
    rounding = Parameter("m/s", "Speed below which |v| is rounded.", default=1e-4, above=0)
    force = Output("N", "Drag, positive when b moves towards +x relative to a.")

    def law(p, a, b):
        """Everything taken is dissipated."""
        v = b.v - a.v
        measured = 0 if p.points is None else p.points(v)
        drag = p.linear * v + p.quadratic * v * sqrt(v**2 + p.rounding**2) + measured
        return Law(a=-drag, b=drag, force=drag, dissipated=drag * v)
