"""A lever on a pivot that may move."""

from fairlead.component import Component, Law, Output, Parameter, Translational, Unknown, hold


class Lever(Component):
    """A rigid lever without mass, for small angles:  b.v - pivot.v = -ratio (a.v - pivot.v).

    `ratio` is the arm of b over that of a, for arms on both sides of the pivot; negative, for both on one side. The
    forces on a and b are in the inverse ratio, and the pivot takes the two. Join the pivot with a Ground for a lever in
    a bearing that stands. Limits: the arms stay square to the motion; what turns far is a Crank, or a relation of
    positions.

    Source: the law of the lever (Archimedes).
    """

    a = Translational("one end")
    b = Translational("the other end")
    pivot = Translational("the bearing")
    ratio = Parameter("1", "Arm of b over arm of a; not zero.")
    carried = Unknown("N", "Force given to b.")
    force = Output("N", "Force given to b, positive forward.")

    def law(p, a, b, pivot, carried):
        """One relation of speeds, and the forces that keep it without work."""
        relation = b.v + p.ratio * a.v - (1 + p.ratio) * pivot.v
        return Law(
            b=-carried, a=-p.ratio * carried, pivot=(1 + p.ratio) * carried, carried=hold(relation), force=carried,
            dissipated=0,
        )  # fmt: skip

    def check(p):
        """A ratio of zero would hold b to the pivot for ever."""
        if p.ratio == 0:
            yield "ratio", "ratio is zero", "Take a RigidLink from b to the pivot instead."
