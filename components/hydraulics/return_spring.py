"""What pulls the rod of a cylinder in, beside oil: a spring, and the air."""

from fairlead.component import Component, Law, Output, Parameter, Translational


class ReturnSpring(Component):
    """What pulls a rod in:  force = preload + stiffness travel + area air,  travel = rod.x - body.x."""

    body, rod = Translational("the barrel"), Translational("the rod")
    preload = Parameter("N", "Force of the spring on a rod that is in.", least=0)
    stiffness = Parameter("N/m", "Stiffness of the spring.", least=0)
    area = Parameter("m^2", "Area on which the air presses.", least=0)
    air = Parameter("Pa", "Pressure of the air.", least=0)
    force = Output("N", "Force that pulls the rod in.")

    def law(p, body, rod):
        """A spring and the air."""
        travel = rod.x - body.x
        always = p.preload + p.area * p.air
        force = always + p.stiffness * travel
        return Law(rod=force, body=-force, force=force, stored=always * travel + p.stiffness * travel**2 / 2)
