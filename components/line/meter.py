"""What a contact has done so far: how far it has slipped, and the work of friction."""

from fairlead.component import Component, Input, Law, State, sqrt

CREEP = 1e-5  # m/s; slower slip is hardly counted: sqrt(v^2 + CREEP^2) - CREEP


class Meter(Component):
    """Scuffing length and friction work of a contact.

    d(scuffed)/dt = |slip|      d(work)/dt = friction slip
    """

    scuffed = State("m", "Length slipped, in either direction.", nominal=0.01)
    work = State("J", "Work of friction.", nominal=1.0)
    slip = Input("m/s", "Slip speed of the contact.")
    friction = Input("N", "Friction of the contact.")

    def law(p, slip, friction):
        """Two integrals."""
        return Law(scuffed=sqrt(slip**2 + CREEP**2) - CREEP, work=friction * slip)
