"""What the rigid treatments have in common: friction is an unknown, so that it can be whatever holds."""

from fairlead.components.friction.contact import Contact, sliding_friction

from fairlead.component import Law, Output, Unknown, zone


class Rigid(Contact, abstract=True):
    """A contact whose friction is an algebraic unknown: in sliding that of the curve, in sticking what holds."""

    force = Unknown("N", "Friction T.")
    bound = Output("1", "1 while the contact sticks.")

    @zone("forward", "backward")
    def sliding(p, a, b, force, grip, pace, direction):
        """The curve gives the force, against the slip."""
        slip = b.v - a.v
        return settled(slip, force, sliding_friction(p, direction, slip, grip, pace))

    @zone("off")
    def off(p, a, b, force):
        """No force passes."""
        return Law(a=0, b=0, force=force, slip=b.v - a.v)


def settled(slip, force, friction):
    """The law of a zone in which the unknown `force` equals a known friction."""
    return Law(a=-force, b=+force, force=force - friction, slip=slip, friction=force, dissipated=force * slip)
