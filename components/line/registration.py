"""Where the core lies inside the hose."""

from fairlead.component import Component, Law, Output, Parameter, Translational


class Registration(Component):
    """De-registration of a node: how far the core has moved in the hose since the start.

    d = (core.x - hose.x) - initial
    """

    hose = Translational("the hose")
    core = Translational("the core")
    initial = Parameter("m", "core.x - hose.x at the start.", default=0.0)
    d = Output("m", "De-registration, positive when the core is further outboard.")

    def law(p, hose, core):
        """Takes no force."""
        return Law(hose=0, core=0, d=core.x - hose.x - p.initial)
