"""A tensiometer: tells the tension of the line where it stands, to a controller or an interlock."""

from fairlead.components.route.bearing_load import BearingLoad
from fairlead.components.route.station import Machinery, Station

from fairlead.component import Parameter


class Tensiometer(Station):
    """Reads the tension of the line, hose and core together, as a mean over its length; it takes no force.

    The reading follows the line without a step as nodes pass, for what is counted of each sums to the length. It is
    right while line lies all along it: where there is none, that part of the length reads zero.

        route.<name>.tension    an output, for the input of a controller
    """

    word = "Tensiometer"
    length = Parameter("m", "Length over which it reads.", default=0.5, above=0)

    def extent(p):
        """The length."""
        return p.length

    def reads(p):
        """Share of the mean that a metre of line counts [1/m]."""
        return 1 / p.length

    def machinery(p, scene):
        """The sum of what all nodes tell."""
        return Machinery({"sum": scene.make(BearingLoad)}, outputs={"tension": "sum.load"}, total="sum.sum")
