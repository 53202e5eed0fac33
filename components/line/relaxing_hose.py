"""An element of hose that stiffens when it is strained fast, and relaxes."""

from fairlead.components.line.hose_element import Hose, damped

from fairlead.component import Law, Output, Parameter, State


class RelaxingHose(Hose):
    """A standard linear solid: beside the spring one more, in series with a damper (Zener).

    tension = k stretch + damping rate + branch        k = EA/length
    d(branch)/dt = k_1 rate - branch/relaxation         k_1 = branch_stiffness/length

    Strained slowly it has the stiffness EA, strained fast EA + branch_stiffness.
    """

    branch_stiffness = Parameter("N", "EA that relaxes, tension per strain.", above=0)
    relaxation = Parameter("s", "Time in which it relaxes.", above=0)
    branch = State("N", "Tension that relaxes.", start=0.0, nominal=100.0)
    relaxing = Output("N", "The part of the tension that relaxes.")

    def law(p, a, b, branch):
        """What the damper of the branch takes is lost; its spring stores."""
        stretch, rate = b.x - a.x - p.length, b.v - a.v
        elastic, lossy, k = p.axial_stiffness / p.length * stretch, damped(p, rate), p.branch_stiffness / p.length
        tension = elastic + lossy + branch
        return Law(a=-tension, b=+tension, tension=tension, branch=k * rate - branch / p.relaxation, relaxing=branch,
                   strain=stretch / p.length, stored=elastic * stretch / 2 + branch**2 / (2 * k),
                   dissipated=lossy * rate + branch**2 / (k * p.relaxation))  # fmt: skip
