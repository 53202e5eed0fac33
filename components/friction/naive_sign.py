"""The naive law of the textbook: friction is the sign of the slip. It fails where it should stick, and says so."""

from fairlead.components.friction.contact import Contact

from fairlead.component import Law, Parameter, Zones, guard, sqrt, tanh, zone


class NaiveSign(Contact):
    """T = N mu(|v|) sgn(v) + viscous v, evaluated inside the step, sgn(0) = 0.

    on    N > 0
    off   N = 0

    When the slip comes to zero the force jumps inside a step. An implicit method then looks for a slip at which
    the block is in balance; there is none but zero itself, where the law says no force at all. So every step that
    reaches zero is rejected, and the step size falls until the floor or a budget ends the run with this contact's
    name. A law here must be smooth; the sign is written as tanh(v/width)^3 with a width at rounding level, flat at
    zero like sgn. (Written with tanh alone the slope at rest is enormous, and a block at rest never comes loose.)
    Use `hold` to stick exactly, `binding` for many contacts, `tanh` with a width that can be resolved.
    Source: the difficulty is that of Karnopp (1985), DOI 10.1115/1.3140698, who begins with this law.
    """

    width = Parameter("m/s", "Slip speed over which the sign changes; not to be resolved.", default=1e-15, above=0)
    advice = "The sign of the slip jumps inside a step; use method hold, or binding where many contacts stick."
    zones = Zones("on", "off")

    @zone("on")
    def on(p, a, b, normal):
        """The sign of the slip, as written in every textbook."""
        slip = b.v - a.v
        speed = sqrt(slip**2 + p.width**2)
        friction = normal * p.curve.coefficient(speed) * tanh(slip / p.width) ** 3 + p.viscous * slip
        return Law(a=-friction, b=+friction, slip=slip, friction=friction, creep_rate=0, dissipated=friction * slip)

    @zone("off")
    def off(p, a, b):
        """No force passes."""
        return Law(a=0, b=0, slip=b.v - a.v)

    @guard("on", to="off", unit="N")
    def lifts(p, normal):
        """Nothing presses any more."""
        return p.lift - normal

    @guard("off", to="on", unit="N")
    def lands(p, normal):
        """Pressed again."""
        return normal - 2 * p.lift
