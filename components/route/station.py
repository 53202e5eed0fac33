"""Devices along a route: the family of stations."""

from fairlead.component import Parameter
from fairlead.component.base import Family


class Station(Family, abstract=True):
    """A device on [start, start + extent()] of the route; what it does, its members say.

    The window rises from 0 to 1 over the edge length round each border. With the edge a whole multiple of
    the element the sum of the windows over a travelling line is constant; the default is one element.
    """

    key = "type"
    start = Parameter("m", "Where the device begins.")
    edge = Parameter("m", "Length over which it takes hold; one element when not given.", default=None, above=0)

    def extent(p):
        """Length of the device along the route [m]."""
        raise NotImplementedError

    def bend_radius(p):
        """Radius of the route inside [m]; None when straight."""
        return None
