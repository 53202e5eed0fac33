"""Maxwell slip, generalised: springs side by side that stick, and slip one after the other."""

from fairlead.components.friction.bristles import STILL, STRAIGHTEN
from fairlead.components.friction.contact import Contact, drag
from fairlead.components.friction.curve import mu, stays_in_place

from fairlead.component import Law, Output, Parameter, State, Zones, derived, guard, tanh, zone

ELEMENTS = 4
SHARPNESS = 20.0  # of the speed at which the count of creep ends, beside 1


class MaxwellSlip(Contact):
    """T = N sum k_i z_i + viscous v over four springs, i = 1 to 4: those that stick z_i' = v, those that slip as below.

    stuck        no spring slips                  z_i' = v
    forward_m    springs 1 to m slip, v > 0       z_i' = (+y_i S(v) - z_i)/lag for i <= m,  z_i' = v for the others
    backward_m   the same the other way           z_i' = (-y_i S(v) - z_i)/lag
    off          N = 0                            no force, the springs straighten

    Spring i begins to slip where |z_i| = y_i S(v), with S(v) = mu(v)/mu_s and y_i = presliding (i/4)^shape. It sticks
    again when the slip turns round. Each spring bears a quarter of the force: k_i = mu_s/(4 y_i).

    With one coefficient at all speeds the force from the start is V(x) = N sum min(k_i |x|, mu_s/4). After a turn at
    (x_0, T_0) it is T_0 -+ 2 V((x - x_0)/2) (Masing). An inner loop closes and is forgotten, at any load. So nothing
    drifts when it is shaken below break-away. On a falling curve friction in sliding lags by `lag`.

    Limits: while stuck the only damping is that of the loops. Springs let go in the order of their y_i. If friction
    falls fast with speed, a stiff spring may reach its limit earlier, and waits. While friction rises again it gives
    back energy.

    Source: Al-Bender, Lampaert, Swevers (2005), The generalized Maxwell-slip model, IEEE Trans. Automatic Control 50,
    1883, DOI 10.1109/TAC.2005.858676. It differs in two points: the number of springs is free there and four here; the
    rate of a slipping spring is that there times S(v), with C = N mu_s/lag, so that a curve may reach zero.
    """

    exempt = {
        "dissipates": "Springs that slip follow the curve in time, not with the slip, and give back energy while it "
        "rises (Al-Bender, Lampaert, Swevers 2005, equation of the slipping element)."
    }
    asked_with = {"stick_speed": 0.01}  # springs bent at random give way at 100 m/s, of which creep is told to rounding
    sticks_below, preslides, gives_by = "stick_speed", "presliding", "stiffness"
    presliding = Parameter("m", "Deflection at which the last spring begins to slip.", default=2e-5, above=0)
    shape = Parameter("1", "How the springs are spread: y_i = presliding (i/4)^shape.", default=1.0, above=0, most=10)
    lag = Parameter("s", "Time in which slipping springs follow the curve.", default=1e-3, above=0)
    stick_speed = Parameter("m/s", "Slip below it counts as sticking, in the report of creep.", default=1e-4, above=0)
    z1 = State("m", "Deflection of the spring that slips first.", nominal="presliding")
    z2 = State("m", "Deflection of the second.", nominal="presliding")
    z3 = State("m", "Deflection of the third.", nominal="presliding")
    z4 = State("m", "Deflection of the spring that slips last.", nominal="presliding")
    deflection = Output("m", "Mean deflection of the springs.")
    slipping = Output("1", "Number of springs that slip.")
    zones = Zones(
        "stuck", "forward_1", "forward_2", "forward_3", "forward_4",
        "backward_1", "backward_2", "backward_3", "backward_4", "off",
        forward=["forward_1", "forward_2", "forward_3", "forward_4"],
        backward=["backward_1", "backward_2", "backward_3", "backward_4"],
    )  # fmt: skip

    @derived
    def stiffness(p):
        """Stiffness of all springs over normal force, while all stick [1/m]."""
        return sum(stiffness(p, i) for i in range(1, ELEMENTS + 1))

    @zone("stuck")
    def stuck(p, a, b, z1, z2, z3, z4, grip):
        """All springs move with the slip, and give it back."""
        slip = b.v - a.v
        return pulled(p, a, b, (z1, z2, z3, z4), (slip,) * ELEMENTS, grip, slipping=0)

    @zone(*zones.forward, *zones.backward)
    def slips(p, a, b, z1, z2, z3, z4, grip, direction, zone):
        """The first few slip, each towards its share of the curve; the others move with the slip."""
        slip, slipping, bent = b.v - a.v, int(zone[-1]), (z1, z2, z3, z4)
        level = direction * level_at(p, direction * slip, direction)
        rates = [(yields_at(p, i) * level - bent[i - 1]) / p.lag if i <= slipping else slip
                 for i in range(1, ELEMENTS + 1)]  # fmt: skip
        return pulled(p, a, b, bent, rates, grip, slipping)

    @zone("off")
    def off(p, a, b, z1, z2, z3, z4):
        """No force passes; the springs straighten."""
        bent = (z1, z2, z3, z4)
        return Law(a=0, b=0, **{f"z{i}": -z / STRAIGHTEN for i, z in enumerate(bent, 1)}, slip=b.v - a.v,
                   deflection=sum(bent) / ELEMENTS)  # fmt: skip

    @guard("off", to="stuck", unit="N")
    def lands(p, normal):
        """Pressed again."""
        return normal - 2 * p.lift

    @guard(*zones.forward, *zones.backward, to="stuck", unit="m/s")
    def turns(p, a, b, direction):
        """The slip has changed its direction."""
        return -direction * (b.v - a.v) - STILL

    @guard("stuck", to="forward_1", unit="m/s", mirrored="first_slips_backward")
    def first_slips_forward(p, a, b, z1, direction):
        """The first spring is at its limit, and slips on."""
        slip = b.v - a.v
        return direction * slip - STILL, beyond(p, 1, z1, abs(slip), direction)

    @guard("forward_1", to="forward_2", unit="1", mirrored="second_slips_backward")
    def second_slips_forward(p, a, b, z2, direction):
        """The second spring is at its limit."""
        return beyond(p, 2, z2, direction * (b.v - a.v), direction)

    @guard("forward_2", to="forward_3", unit="1", mirrored="third_slips_backward")
    def third_slips_forward(p, a, b, z3, direction):
        """The third spring is at its limit."""
        return beyond(p, 3, z3, direction * (b.v - a.v), direction)

    @guard("forward_3", to="forward_4", unit="1", mirrored="last_slips_backward")
    def last_slips_forward(p, a, b, z4, direction):
        """The last spring is at its limit: the contact slides."""
        return beyond(p, 4, z4, direction * (b.v - a.v), direction)

    def breaks_away_at(p):
        """As sliding begins: a stiction above the curve is not seen."""
        return p.curve.coefficient(0)

    def check(p):
        """Springs without friction have no stiffness; the curve stays where it is."""
        yield from stays_in_place(p)
        if p.curve.breakaway() <= 0:
            yield "curve", "the coefficient at rest is zero", "Leave the contact out, or give it some friction."


def yields_at(p, i):
    """Deflection [m] at which spring i slips where friction is that from rest."""
    return p.presliding * (i / ELEMENTS) ** p.shape


def stiffness(p, i):
    """Stiffness of spring i over normal force [1/m]."""
    return p.curve.breakaway() / (ELEMENTS * yields_at(p, i))


def level_at(p, speed, d):
    """S: friction at a slip speed in direction d over that from rest."""
    return mu(p.curve, speed, d) / p.curve.breakaway()


def beyond(p, i, z, speed, d):
    """How far spring i is, in direction d, beyond its limit at a slip speed; over `presliding`."""
    return (d * z - yields_at(p, i) * level_at(p, speed, d)) / p.presliding


def pulled(p, a, b, bent, rates, grip, slipping):
    """The law of springs bent by z_i that grow at z_i'.

    T = N sum k_i z_i + viscous v;  stored N sum k_i z_i^2/2;  lost N sum k_i z_i (v - z_i') + viscous v^2.
    """
    slip, stiff = b.v - a.v, [grip * stiffness(p, i) for i in range(1, ELEMENTS + 1)]
    friction = sum(k * z for k, z in zip(stiff, bent, strict=True)) + drag(p, slip)
    lost = sum(k * z * (slip - rate) for k, z, rate in zip(stiff, bent, rates, strict=True)) + drag(p, slip) * slip
    given_up = sum(slip - rate for rate in rates) / ELEMENTS
    creeping = given_up * (1 - tanh(SHARPNESS * ((slip / p.stick_speed) ** 2 - 1))) / 2
    return Law(a=-friction, b=+friction, **{f"z{i}": rate for i, rate in enumerate(rates, 1)}, slip=slip,
               friction=friction, deflection=sum(bent) / ELEMENTS, slipping=slipping, creep_rate=creeping,
               stored=sum(k * z**2 for k, z in zip(stiff, bent, strict=True)) / 2, dissipated=lost)  # fmt: skip
