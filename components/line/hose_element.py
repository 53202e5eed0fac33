"""One element of hose: the outer layer of a line, which may be compressed."""

from fairlead.component import Component, Effect, Law, Output, Parameter, Translational


class Hose(Component):
    """Elastic element with damping, in tension or compression.

    tension = (stretch) EA/length + damping * rate,   stretch = b.x - a.x - length
    """

    a = Translational("inboard end")
    b = Translational("outboard end")
    axial_stiffness = Parameter("N", "EA, tension per strain.", above=0)
    length = Parameter("m", "Length without tension.", above=0)
    damping = Parameter("N*s/m", "Tension per speed of separation.", default=0.0, least=0)
    line_damping = Effect("Damping of the element; off: none.")
    tension = Output("N", "Tension; negative when compressed.")
    strain = Output("1", "Stretch over length; at -1 its ends are at one place.", role="strain")

    def law(p, a, b):
        """Stiffness and damping side by side."""
        stretch, rate = b.x - a.x - p.length, b.v - a.v
        elastic = p.axial_stiffness / p.length * stretch
        lossy = damped(p, rate)
        tension = elastic + lossy
        return Law(a=-tension, b=+tension, tension=tension, strain=stretch / p.length, stored=elastic * stretch / 2,
                   dissipated=lossy * rate)  # fmt: skip


def damped(p, rate):
    """What the damper of an element adds to its tension [N]; no term when damping is off."""
    return p.damping * rate if p.line_damping == "on" else 0
