"""What the laws with a bristle have in common: one average deflection z, and the numbers that go with it."""

from fairlead.components.friction.contact import Contact, drag
from fairlead.components.friction.curve import mu, stays_in_place

from fairlead.component import Law, Output, Parameter, State, derived, guard, tanh, zone

STILL = 1e-9  # m/s; a slip must reverse by this before the law takes notice, or rounding would switch it at rest
STRAIGHTEN = 1e-3  # s; time in which the bristles of an open contact straighten
SHARPNESS = 20.0  # of the speed at which the count of creep ends, beside 1


class Bristles(Contact, abstract=True):
    """A contact whose friction is the force of bent bristles, of stiffness s0 and mean deflection z.

    `presliding` is the deflection at break-away, so s0 = N mu_s/presliding grows with the normal force, and the
    displacement before sliding does not depend on it. A change of the normal force changes the energy in bent
    bristles without work; the ledger of the run then has a gap. No zone tells sticking from sliding here: what is
    reported as creep is slip slower than `stick_speed`, less what the bristles will give back.
    """

    sticks_below, preslides, gives_by = "stick_speed", "presliding", "ratio"
    presliding = Parameter("m", "Deflection at which the contact breaks away.", default=2e-5, above=0)
    stick_speed = Parameter("m/s", "Slip below it counts as sticking, in the report of creep.", default=1e-4, above=0)
    z = State("m", "Deflection of the bristles.", nominal="presliding")
    deflection = Output("m", "Deflection of the bristles.")

    @derived
    def ratio(p):
        """Stiffness of the bristles over normal force, s0/N [1/m]."""
        return p.curve.breakaway() / p.presliding

    @zone("off")
    def off(p, a, b, z):
        """No force passes; the bristles straighten."""
        return Law(a=0, b=0, z=-z / STRAIGHTEN, slip=b.v - a.v, deflection=z)

    def breaks_away_at(p):
        """As sliding begins: a stiction above the curve is not seen."""
        return p.curve.coefficient(0)

    def check(p):
        """Bristles without friction have no stiffness; the curve stays where it is."""
        yield from stays_in_place(p)
        if p.curve.breakaway() <= 0:
            yield "curve", "the coefficient at rest is zero", "Leave the contact out, or give it some friction."


class OneWay(Bristles, abstract=True):
    """Bristles with a zone for each direction of slip, in which |v| is smooth."""

    @guard("off", to="forward", unit="N")
    def lands(p, normal):
        """Pressed again; the direction is found at once."""
        return normal - 2 * p.lift

    @guard("forward", to="backward", unit="m/s", mirrored="reverses_forward")
    def reverses_backward(p, a, b, direction):
        """The slip has changed its direction."""
        return -direction * (b.v - a.v) - STILL




def sliding_deflection(p, speed, d):
    """Deflection [m] of the bristles in steady sliding at a slip speed in direction d: N mu(v)/s0."""
    return mu(p.curve, speed, d) / p.ratio


def bent(p, a, b, z, grip, rate, damping):
    """The law of bristles bent by z, growing at `rate` = z'.

    T = s0 (z + damping z') + viscous v;  stored s0 z^2/2.  Of the power T v, what bends the bristles is stored.
    """
    slip, stiffness = b.v - a.v, grip * p.ratio
    friction = stiffness * (z + damping * rate) + drag(p, slip)
    creeping = (slip - rate) * (1 - tanh(SHARPNESS * ((slip / p.stick_speed) ** 2 - 1))) / 2
    lost = stiffness * z * (slip - rate) + stiffness * damping * rate * slip + drag(p, slip) * slip
    return Law(a=-friction, b=+friction, z=rate, slip=slip, friction=friction, deflection=z, creep_rate=creeping,
               stored=stiffness * z**2 / 2, dissipated=lost)  # fmt: skip
