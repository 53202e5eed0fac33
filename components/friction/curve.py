"""How the friction coefficient depends on the slip speed: the family of sliding curves."""

from fairlead.component.base import Family


class Curve(Family, abstract=True):
    """A sliding curve: `coefficient(p, v)` for slip speed v >= 0, and `breakaway(p)` from rest.

    In a netlist a bare number is a constant coefficient; a map names the curve:
    `{curve: stribeck, stiction: 0.5, coulomb: 0.4, velocity: 20 mm/s}`.
    """

    key = "curve"
    default_word = "coulomb"
    bare = ("coulomb", "coulomb")

    def breakaway(p):
        """Coefficient that slipping must overcome to begin."""
        return p.stiction

    def scale(p):
        """Smallest speed [m/s] over which the curve changes; None when it does not."""
        return None
