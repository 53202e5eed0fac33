"""Springs that stiffen, for `line_search.py`: laws that a Newton move overshoots."""

from fairlead.component import Component, Law, Parameter, Translational, exp, sqrt


class CubicSpring(Component):
    """tension = stiffness s (1 + (s/doubling)^2), s = b.x - a.x."""

    a, b = Translational("one end"), Translational("the other end")
    stiffness = Parameter("N/m", "Without load.", above=0)
    doubling = Parameter("m", "Stretch at which it is twice as stiff as a chord.", above=0)

    def law(p, a, b):
        """The cube of the stretch wins."""
        s = b.x - a.x
        tension = p.stiffness * s * (1 + (s / p.doubling) ** 2)
        return Law(a=-tension, b=tension)


class StrandedRope(Component):
    """Strands come to bear one after another:  tension = force (exp(s/scale) - 1), s = b.x - a.x."""

    a, b = Translational("one end"), Translational("the other end")
    force = Parameter("N", "Scale of the tension.", above=0)
    scale = Parameter("m", "Stretch over which it rises by a factor of e.", above=0)

    def law(p, a, b):
        """Steeper the tighter it is."""
        tension = p.force * (exp((b.x - a.x) / p.scale) - 1)
        return Law(a=-tension, b=tension)


class CrossCord(Component):
    """A cord across the way stiffens by its geometry:  force = 2 T x/l,  T = tension + stiffness (l/length - 1)."""

    a, b = Translational("the middle between its ends"), Translational("its own middle")
    tension = Parameter("N", "When straight.", least=0)
    stiffness = Parameter("N", "EA.", above=0)
    length = Parameter("m", "Half its length when straight.", above=0)

    def law(p, a, b):
        """Two halves of the length l = sqrt(length^2 + x^2)."""
        x = b.x - a.x
        long = sqrt(p.length**2 + x**2)
        force = 2 * (p.tension + p.stiffness * (long / p.length - 1)) * x / long
        return Law(a=-force, b=force)
