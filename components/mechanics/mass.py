"""A rigid mass."""

from fairlead.component import Component, Law, Output, Parameter, Translational


class Mass(Component):
    """A mass that moves along a line:  force = mass * a.

    The force is positive along +x. Source: Newton's second law. Limits: it has no size and no weight; a ForceSource
    gives the weight.
    """

    flange = Translational("the mass itself")
    mass = Parameter("kg", "Mass.", above=0)
    position = Parameter("m", "Position at the start.", default=None, physics=False)
    velocity = Parameter("m/s", "Velocity at the start.", default=None, physics=False)
    x = Output("m", "Position.")
    v = Output("m/s", "Velocity.")

    def law(p, flange):
        """Inertia is not a flow of this law but an entry of the mass matrix, see `inertia`."""
        return Law(flange=0, x=flange.x, v=flange.v, stored=p.mass * flange.v**2 / 2)

    def inertia(p):
        """Mass at the flange [kg]."""
        return {"flange": p.mass}

    def start(p):
        """Position and velocity at the start, where given."""
        return {"flange": (p.position, p.velocity)}
