"""A spring with a measured characteristic."""

from fairlead.component import Component, Law, Output, Parameter, Table, Translational, derived_wave
from fairlead.component.piecewise import Sine
from fairlead.component.values import Wave


class TableSpring(Component):
    """tension = points(stretch) + damping d(stretch)/dt,  stretch = b.x - a.x - free_length.

    The energy stored is the integral of the table from no stretch. Beyond its ends a table keeps its last tension,
    unless it says `beyond: line`.

    The tension is positive when stretched. Source: as measured. Limits: the same curve for loading and unloading;
    hysteresis is that of the damping.
    """

    transmits = True  # in steady motion its ends move alike
    a = Translational("one end")
    b = Translational("the other end")
    points = Table("m", "N", "Stretch and tension.")
    damping = Parameter("N*s/m", "Tension per rate of stretch.", default=0.0, least=0)
    free_length = Parameter("m", "Distance of the ends at no stretch.", default=0.0)
    tension = Output("N", "Tension.")
    stretch = Output("m", "Stretch.")

    @derived_wave
    def energy(p):
        """Integral of the table [J] over the stretch."""
        return Wave(p.points.integral(0.0), Sine())

    def law(p, a, b):
        """The table stores, the damper dissipates."""
        stretch, rate = b.x - a.x - p.free_length, b.v - a.v
        tension = p.points(stretch) + p.damping * rate
        return Law(a=-tension, b=tension, tension=tension, stretch=stretch, stored=p.energy(stretch),
                   dissipated=p.damping * rate**2)  # fmt: skip
