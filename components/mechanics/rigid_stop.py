"""A stop that does not give."""

from fairlead.component import Component, Law, Output, Parameter, Translational, Unknown, Zones, guard, hold, zone

APART = 1e-6  # m; beyond what a run leaves between bodies that touch


class RigidStop(Component):
    """Keeps b from coming nearer to a than `length`:  b.x - a.x >= length.

    free       b.x - a.x > length     force = 0
    touching   b.v = a.v              force = whatever holds, force >= 0

    The force pushes b forward and a back. When the ends meet, an impulse removes the speed at which they meet, and
    gives back the share `restitution` of it (`docs/integrator.md`, Impacts).

    With a negative length and its ends exchanged it is a rope that cannot stretch: RigidStop from b to a of length -L
    keeps b.x - a.x <= L.

    One side may move as given, as a shaker does. The body that touches it is then put back to it after every step, and
    leaves when the given motion falls away from it. `ida` does not do this, so zones do not settle there.

    Limits: a stop that gives under load, and oscillates, is an EndStop. At a node without inertia nothing is given
    back.

    Source: Moreau 1988; Acary and Brogliato 2008, Numerical Methods for Nonsmooth Dynamical Systems.
    """

    exempt = {"settles": "bodies pulled apart within each other, which no run comes to: docs/integrator.md, Impacts"}
    a = Translational("the one behind")
    b = Translational("the one in front")
    length = Parameter("m", "Least distance of b from a.", default=0.0)
    restitution = Parameter(
        "1", "Share of the speed at which they meet with which they part.", default=0.0, least=0, most=1
    )
    push = Unknown("N", "Force that keeps them apart.")
    force = Output("N", "Force that keeps them apart, never negative.")
    gap = Output("m", "b.x - a.x - length.")
    zones = Zones("free", "touching")

    @zone("free")
    def apart(p, a, b, push):
        """Nothing touches."""
        return Law(a=0, b=0, push=push, force=0, gap=b.x - a.x - p.length)

    @zone("touching")
    def together(p, a, b, push):
        """One speed."""
        return Law(
            a=push, b=-push, push=hold(b.v - a.v, restitution=p.restitution), force=push, gap=b.x - a.x - p.length
        )

    @guard("free", to="touching", unit="m")
    def meets(p, a, b):
        """The gap is closed."""
        return a.x + p.length - b.x

    @guard("touching", to="free", unit="m")
    def apart_again(p, a, b):
        """They are apart by more than rounding of their places: a start, or a step that was too rough."""
        return b.x - a.x - p.length - APART

    @guard("touching", to="free", unit="N")
    def parts(p, push):
        """It would have to pull."""
        return -push
