"""The sliding contact: one component for every treatment of friction."""

from fairlead.components.friction.curve import Curve, load_factor, mu, pace_of, temperature_factor

from fairlead.component import (
    Component,
    Effect,
    Family,
    Input,
    Law,
    Output,
    Parameter,
    Part,
    Translational,
    guard,
    shared,
    zone,
)  # fmt: skip

LIFT = 1e-6  # N, far below what presses a contact of any machine
SHARE = 1e-3  # of a normal force that is given, where that is less


class Contact(Family, Component, abstract=True):
    """Dry friction between two bodies, `a` the surface and `b` the body that slips on it.

    Slip is v = b.v - a.v; the friction T opposes it: force -T on b, +T on a. `method` chooses how
    sticking is treated, `curve` how sliding friction depends on speed, load and temperature.

    Source: docs/physics.md, 1 and 2, and the page of each treatment (docs/treatments). Limits: slip along one line, and
    no wear.
    """

    key = "method"
    default_word = "hold"
    pressed_by = "normal"
    offered = ("binding",)
    a = Translational("the surface")
    b = Translational("the body that slips on it")
    curve = Part(Curve, "Coefficient of friction over slip speed.")
    normal_force = Parameter("N", "Normal force, when the input `normal` is not connected.", default=None, least=0)
    viscous = Parameter("N*s/m", "Viscous friction beside the dry one, while sliding; none when not given.",
                        default=None, least=0)  # fmt: skip
    lift = Parameter(
        "N", "Normal force below which the contact is open; when not given 1 uN, or a thousandth of a normal_force "
        "that is below 1 mN.", default=LIFT, above=0,
    )  # fmt: skip
    load_dependence = Effect("The curve's load_exponent; off: friction in proportion to the normal force.")
    temperature_dependence = Effect("The curve's softening and shift; off: friction does not depend on temperature.")
    extent = Parameter(
        "1", "What shares the normal force: the curve's load_reference is that of 1 (a spot, or a metre of line).",
        default=1.0, above=0,
    )  # fmt: skip
    ambient = Parameter("K", "Temperature when the input is not connected.", default=293.15, above=0)
    normal = Input("N", "Normal force.", default="normal_force")
    temperature = Input("K", "Temperature of the surfaces.", default="ambient")
    slip = Output("m/s", "Slip speed of b over a.")
    friction = Output("N", "Friction T, positive when it opposes positive slip.", role="share")
    creep_rate = Output("m/s", "Slip speed while the contact should stick, else zero.", role="creep")

    def prepare(given):
        """The normal force below which the contact is open."""
        return with_lift(given)

    @shared
    def grip(p, normal, temperature):
        """The normal force that counts [N]: with the factors for load and temperature that the curve gives."""
        load = load_factor(p.curve, normal / p.extent, p.lift / p.extent) if p.load_dependence == "on" else 1
        warmth = temperature_factor(p.curve, temperature) if p.temperature_dependence == "on" else 1
        return normal * load * warmth

    @shared
    def pace(p, temperature):
        """What the slip speed is multiplied with before the curve is read."""
        return pace_of(p.curve, temperature) if p.temperature_dependence == "on" else 1

    @zone("off")
    def off(p, a, b):
        """No force passes."""
        return Law(a=0, b=0, slip=b.v - a.v)

    @guard("*", to="off", unit="N")
    def lifts(p, normal):
        """Nothing presses the surfaces together."""  # declared first: it decides before all others
        return p.lift - normal

    def breaks_away_at(p):
        """As the curve."""
        return p.curve.breakaway()

    def changes_over(p):
        """As the curve."""
        return p.curve.scale()

    def narrowest(p):
        """Slip speed [m/s] from which on friction is that of sliding; None when sticking needs no such band."""
        return None


def with_lift(given):
    """What a contact is given, with its `lift`: a constant force that presses is never meant as none."""
    own = small_lift(given["normal_force"] or LIFT / SHARE)
    return {**given, **own} if given["lift"] == LIFT else given


def small_lift(normal):
    """The `lift` to give a contact that no more than this presses [N]; none where the usual one will do."""
    return {"lift": SHARE * normal} if 0 < SHARE * normal < LIFT else {}


def sliding_friction(p, d, slip, grip, pace):
    """Friction [N] where the contact slides in direction d, +1 or -1: the curve, against the slip."""
    return d * grip * mu(p.curve, d * slip * pace, d) + drag(p, slip)


def drag(p, slip):
    """What viscous friction adds [N]; no term when the contact is not given any."""
    return 0 if p.viscous is None else p.viscous * slip


def opposing(slip, friction, **more):
    """The law of a friction that takes all its power out of the mechanism."""
    return Law(a=-friction, b=+friction, slip=slip, friction=friction, dissipated=friction * slip, **more)


class Sliding(Contact, abstract=True):
    """A contact with a zone for each direction of sliding."""

    @zone("forward", "backward")
    def sliding(p, a, b, grip, pace, direction):
        """The curve gives the force, against the slip."""
        slip = b.v - a.v
        return opposing(slip, sliding_friction(p, direction, slip, grip, pace), creep_rate=0)
