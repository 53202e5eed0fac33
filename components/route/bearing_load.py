"""What a wheel's bearing carries: the loads of all nodes on the wheel together."""

from fairlead.component import Component, Input, Law, Output, Parameter, Summing


class BearingLoad(Component):
    """Sum of what every node tells the port `sum`, times a share.

    load = share * sum       0 = sum - (what all nodes tell)
    """

    exempt = {"energy": "A sum of signals is no power."}
    sum = Summing("what the nodes tell")
    share = Parameter("1", "Load of the bearing over the sum of the loads.", default=1.0, above=0)
    load = Output("N", "Load of the bearing.")

    def law(p, sum):
        """The port takes in its own value, so that all that flows into it is the sum."""
        return Law(sum=sum.total, load=p.share * sum.total)


class Told(Component):
    """Tells a sum a signal: of all at one port, the values are added."""

    exempt = {"energy": "A sum of signals is no power."}
    sum = Summing("the sum")
    value = Input("N", "Value that is added.")

    def law(p, value):
        """A flow into the sum."""
        return Law(sum=-value)
