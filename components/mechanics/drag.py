"""What a fluid takes from a body by its speed."""

from fairlead.component import Component, Law, Output, Parameter, Table, Translational, sqrt


class Drag(Component):
    """Resists the speed v of b relative to a:  drag = linear v + quadratic v |v| + points(v).

    Of a body with drag coefficient C_d and area A in a fluid of density rho the quadratic part is rho C_d A/2. |v| is
    rounded at rest over `rounding`, so that the drag is smooth there. Points have the sign of v, beyond their ends too:
    for a body that moves both ways give both sides. Join `a` with a Ground for a fluid at rest.

    Source: the drag equation, e.g. Hoerner 1965, Fluid-Dynamic Drag. Limits: no mass of fluid is moved along; C_d does
    not depend on speed, unless points say so.
    """

    a = Translational("the fluid, or a Ground")
    b = Translational("the body")
    linear = Parameter("N*s/m", "Drag per speed.", default=0.0, least=0)
    quadratic = Parameter("N*s^2/m^2", "Drag per speed squared.", default=0.0, least=0)
    points = Table("m/s", "N", "Table of speed and drag, added to the other two; for both signs of v.", default=None)
    rounding = Parameter("m/s", "Speed below which |v| is rounded.", default=1e-4, above=0)
    force = Output("N", "Drag, positive when b moves towards +x relative to a.")

    def check(p):
        """Measured drag brakes, at every point and beyond the ends."""
        wrong = None if p.points is None else drives(p.points)
        if wrong is not None:
            speed, force = wrong
            yield (
                "points", f"at {speed:.4g} m/s the drag is {force:.4g} N, which drives the body on",
                "Drag has the sign of the speed. Give points on both sides of rest, as far as the speed goes; beyond "
                "the ends a table stays constant unless it says beyond: line.",
            )  # fmt: skip

    def law(p, a, b):
        """Everything taken is dissipated."""
        v = b.v - a.v
        measured = 0 if p.points is None else p.points(v)
        drag = p.linear * v + p.quadratic * v * sqrt(v**2 + p.rounding**2) + measured
        return Law(a=-drag, b=drag, force=drag, dissipated=drag * v)


def drives(table):
    """A speed and the force there that has the other sign, of a table of force over speed; None where there is none."""
    speeds = table.borders
    for way, edge, (end, slope) in ((-1, speeds[0], table.terms[0, :2]), (1, speeds[-1], table.terms[-1, :2])):
        changes_sign = way * (edge - end / slope) if slope < 0 else 0.0
        speeds = [*speeds, float(way * (1 + max(0.0, way * edge, changes_sign)))]
    return next(((v, table(v)) for v in speeds if v * table(v) < 0), None)
