"""What a contact has done so far: how far it has slipped, and the work of friction."""

from fairlead.component import Component, Input, Law, Output, State, sqrt

CREEP = 1e-5  # m/s; slower slip is hardly counted: sqrt(v^2 + CREEP^2) - CREEP


class Meter(Component):
    """Scuffing length and friction work of a contact.

    d(scuffed)/dt = |slip|      d(work)/dt = friction slip
    """

    slipped = State("m", "Length slipped, in either direction.", nominal=0.01)
    worked = State("J", "Work of friction.", nominal=1.0)
    slip = Input("m/s", "Slip speed of the contact.", default=0.0)
    friction = Input("N", "Friction of the contact.", default=0.0)
    scuffed = Output("m", "Length slipped, in either direction.")
    work = Output("J", "Work of friction.", role="share")

    def law(p, slip, friction, slipped, worked):
        """Two integrals."""
        rate = sqrt(slip**2 + CREEP**2) - CREEP
        return Law(slipped=rate, worked=friction * slip, scuffed=slipped, work=worked)
