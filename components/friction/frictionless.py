"""What stands where a part would have a contact whose friction is zero by its parameters: no zone, no unknown."""

from collections.abc import Mapping

from fairlead.components.friction.contact import Contact

from fairlead.component import Component, Input, Law, Output, Translational


class Frictionless(Component):
    """Two bodies that pass each other freely; `a` and `b` as of a Contact."""

    a = Translational("the surface")
    b = Translational("the body that slips on it")
    normal = Input("N", "Normal force, of no effect.", default=0.0)
    temperature = Input("K", "Temperature of the surfaces, of no effect.", default=293.15)
    slip = Output("m/s", "Slip speed of b over a.")
    friction = Output("N", "Friction, which is zero.")
    creep_rate = Output("m/s", "Slip speed while the contact should stick, which it never does.")

    def law(p, a, b):
        """No force passes."""
        return Law(a=0, b=0, slip=b.v - a.v, friction=0, creep_rate=0)


def contact_of(scene, curve, viscous=None, **given):
    """A contact with this curve; Frictionless where the curve is zero and nothing viscous is beside it."""
    if never_rubs(curve) and not viscous:
        return scene.make(Frictionless)
    drag = {} if viscous is None else {"viscous": viscous}
    return scene.make(Contact, curve=curve, **drag, **given)


def never_rubs(curve):
    """Whether a curve, a number, a map or a Curve, is a coefficient of zero at all speeds."""
    if isinstance(curve, float | int):
        return curve == 0
    written = isinstance(curve, Mapping)
    word, given = (curve["curve"], curve) if written else (curve.type.word, curve.given)
    return word == "coulomb" and not (given["coulomb"] or given.get("stiction") or given.get("backward"))
