"""One element of hose: the outer layer of a line, which may be compressed."""

from fairlead.component import Component, Law, Output, Parameter, Translational


class Hose(Component):
    """Elastic element with damping, in tension or compression.

    tension = (stretch) EA/length + damping * rate,   stretch = b.x - a.x - length
    """

    a = Translational("inboard end")
    b = Translational("outboard end")
    axial_stiffness = Parameter("N", "EA, tension per strain.", above=0)
    length = Parameter("m", "Length without tension.", above=0)
    damping = Parameter("N*s/m", "Tension per speed of separation.", default=0.0, least=0)
    tension = Output("N", "Tension; negative when compressed.")

    def law(p, a, b):
        """Stiffness and damping side by side."""
        stretch, rate = b.x - a.x - p.length, b.v - a.v
        elastic = p.axial_stiffness / p.length * stretch
        tension = elastic + p.damping * rate
        return Law(
            a=-tension, b=+tension, tension=tension, stored=elastic * stretch / 2, dissipated=p.damping * rate**2
        )
