"""Binding friction: stuck surfaces are bound by a very high viscous coefficient.

After Tomlinson, Cooke and Cosserat (2003), Proc. IMechE Part I 217, 139, DOI 10.1177/095965180321700207.
The sign change of the sliding force is replaced by a steep line through zero slip, in force only while
the applied force is below stiction; so the force never jumps when the slip changes sign, and many
contacts stay cheap. The price is creep: a stuck contact under load af slips at about creep * af/F_s.
"""

from fairlead.components.friction.binding_law import (
    BACKWARD,
    BOUND,
    FORWARD,
    IN_CONTACT,
    applied_force,
    border,
    friction_in,
    rest,
)  # fmt: skip
from fairlead.components.friction.contact import opposing
from fairlead.components.friction.creeping import Creeping, with_creep
from fairlead.components.friction.curve import mu, mu_s

from fairlead.component import Choice, Input, Output, Parameter, Zones, derived, guard, zone

# Share of the end of the plateau at which a ramp leads back to it. A contact that creeps just below F_s stands at that
# end, and the slip is known to its tolerance only: with less than the tolerance between the two ways it goes to and
# fro (a bend of 119 contacts: 3068 switches instead of 964). Capped, friction jumps by a hundredth at most there;
# printed, the force of the ramp is another, and the zones have no memory.
BACK = {"on": 0.99, "off": 0.999999}
LATCH = (
    "The latch keeps the force of sliding while the slip is still creeping the other way; what that gives is less than "
    "F_s times the creep (docs/physics.md 1.10)."
)
FORMS = {
    "robust": {"cap": "on", "latch": "on", "hysteresis": 0.1, "applied_force": "reduced"},
    "literal": {"cap": "off", "latch": "off", "hysteresis": 0.0, "applied_force": "aggregate"},
}


class Binding(Creeping):
    """T = S(v) + f v: a sliding part S and a viscous part f that is very large while the contact binds.

    plateau   |v| <= v_m, |af| <= F_s        f = F_s/creep,  S = N mu(v_n) v/v_n
    ramp      v_m < |v| < v_n, |af| <= F_s   f falls linearly to nothing
    slide     |v| >= v_n                     T = +-N mu(|v|)
    transit   |v| < v_n, |af| > F_s          T = S
    break     broke away (latch)             T = +-N mu(v_n) until |v| >= v_n
    off       N = 0                          T = 0

    The applied force af is the force that the contact would have to carry to hold, af = T + M a_rel. `form: robust`
    limits the bound force to F_s, latches a break-away, and binds again only below (1 - hysteresis) F_s. `form:
    literal` does none of this, as printed in the source. You can set each of the three by itself. With `face` the
    viscous part falls with the load too, from (1 - face) F_s to nothing at F_s. Then the creep grows just below F_s,
    before the break-away.

    Limits: it creeps by 0.8 creep af/F_s, leaks load at that rate, and slides only from v_n = 4 creep on. The
    equations are stiff, 1.25 F_s/(m creep). The printed form chatters in chains, and if a drive is slower than v_n.

    Source: Tomlinson, Cooke, Cosserat (2003), Proc. IMechE Part I 217, 139, DOI 10.1177/095965180321700207.
    """

    word = "binding"
    exempt = {
        "dissipates break_forward": LATCH,
        "dissipates break_backward": LATCH,
    }
    form = Choice(("robust", "literal"), "The repaired law or the printed one.", default="robust")
    plateau_width = Parameter("1", "v_m over creep.", default=2.0, above=0)
    ramp_width = Parameter("1", "v_n over creep.", default=4.0, above=0)
    cap = Choice(("on", "off"), "Limit the bound force to F_s.", default=None)
    latch = Choice(("on", "off"), "Keep the full sliding force from break-away on.", default=None)
    hysteresis = Parameter("1", "Bind only below (1 - hysteresis) F_s.", default=None, least=0, below=1)
    applied_force = Choice(("aggregate", "reduced", "naive"), "Which mass the applied force counts.", default=None)
    face = Parameter(
        "1", "Part of F_s over which f falls as the load nears F_s; it ends steeply when absent.", default=None,
        above=0, below=1,
    )  # fmt: skip
    partner_mass_a = Parameter("kg", "Mass that joins a while a's other contact is bound.", default=0.0, least=0)
    partner_mass_b = Parameter("kg", "Mass that joins b while b's other contact is bound.", default=0.0, least=0)
    bound_a = Input("1", "1 while the other contact of a is bound.", default=0.0)
    bound_b = Input("1", "1 while the other contact of b is bound.", default=0.0)
    bound = Output("1", "1 while the contact is bound.")
    zones = Zones(*IN_CONTACT, "off", forward=FORWARD, backward=BACKWARD, latched=["break_forward", "break_backward"])

    def prepare(given):
        """What is not set by itself follows from the form."""
        chosen = FORMS[given["form"]]
        return with_creep(Binding, {**given, **{n: value for n, value in chosen.items() if given[n] is None}})

    def slope(given, creep):
        """g0/N, the slope while bound over the normal force [s/m]."""
        v_n, curve = given["ramp_width"] * creep, given["curve"]
        return mu_s(curve, +1) / creep + mu(curve, v_n, +1) / v_n

    def check(p):
        """The ramp begins before it ends."""
        yield from Creeping.check(p)
        if p.plateau_width >= p.ramp_width:
            yield (
                "ramp_width",
                f"ramp_width {p.ramp_width:g} is not above plateau_width {p.plateau_width:g}",
                "Raise it.",
            )

    @derived
    def v_m(p):
        """Slip speed where the ramp begins [m/s]."""
        return p.plateau_width * p.creep

    @derived
    def v_n(p):
        """Slip speed where binding ends [m/s]."""
        return p.ramp_width * p.creep

    @derived
    def mu_n(p):
        """Sliding coefficient at v_n."""
        return mu(p.curve, p.v_n, +1)

    @derived
    def mu_n_backward(p):
        """The same for backward slip."""
        return mu(p.curve, p.v_n, -1)

    @derived
    def mu_s(p):
        """Coefficient of stiction."""
        return mu_s(p.curve, +1)

    @derived
    def mu_s_backward(p):
        """The same for backward slip."""
        return mu_s(p.curve, -1)

    @derived
    def border(p):
        """Slip speed where the plateau ends [m/s]: at v_m, or where the cap is reached if that comes first."""
        return plateau_end(p, p.mu_s, p.mu_n)

    @derived
    def border_backward(p):
        """The same for backward slip."""
        return plateau_end(p, p.mu_s_backward, p.mu_n_backward)

    @zone(*IN_CONTACT)
    def touching(p, a, b, grip, zone):
        """The force of the zone; what counts as creep is the slip on the plateau, where the contact sticks."""
        slip, bound = b.v - a.v, 1 if zone in BOUND else 0
        creep = slip if zone == "plateau" else 0
        return opposing(slip, friction_in(p, zone, slip, grip), bound=bound, creep_rate=creep)

    @guard("plateau", "ramp_forward", to="break_forward", unit="N", mirrored="breaks_backward")
    def breaks_forward(p, a, b, grip, bound_a, bound_b, zone, direction):
        """The applied force passes stiction."""
        load = direction * applied_force(p, zone, a, b, grip, bound_a, bound_b)
        return load - grip * rest(p, direction) if p.latch == "on" else -1

    @guard(*BOUND, to="transit", unit="N")
    def lets_go(p, a, b, grip, bound_a, bound_b, zone):
        """Without the latch the contact goes through zero slip instead.

        With it a ramp needs no way out: capped, it only leads back to the plateau, which breaks away in the
        direction of the load.
        """
        return -_spare(p, zone, a, b, grip, bound_a, bound_b, hysteresis=0) if p.latch == "off" else -1

    @guard("plateau", to="ramp_forward", unit="m/s", mirrored="climbs_backward")
    def climbs_forward(p, a, b, direction):
        """The plateau ends."""
        return direction * (b.v - a.v) - border(p, direction)

    @guard("ramp_forward", "ramp_backward", to="plateau", unit="m/s")
    def settles(p, a, b, direction):
        """Back on the plateau, somewhat below its end."""
        return BACK[p.cap] * border(p, direction) - direction * (b.v - a.v)

    @guard(
        "ramp_forward", "transit", "break_forward", "break_backward", to="slide_forward", unit="m/s",
        mirrored="slides_backward",
    )  # fmt: skip
    def slides_forward(p, a, b, direction):
        """Fast enough to slide."""
        return direction * (b.v - a.v) - p.v_n

    @guard("slide_forward", to="ramp_forward", unit="m/s", mirrored="caught_backward")
    def caught_forward(p, a, b, grip, bound_a, bound_b, zone, direction):
        """Slow, and the load is one the contact can hold."""
        return p.v_n - direction * (b.v - a.v), _spare(p, zone, a, b, grip, bound_a, bound_b)

    @guard("slide_forward", "slide_backward", to="transit", unit="m/s")
    def reverses(p, a, b, grip, bound_a, bound_b, zone, direction):
        """Slow, and driven on through zero slip."""
        slow = p.v_n - direction * (b.v - a.v)
        return slow, -_spare(p, zone, a, b, grip, bound_a, bound_b)

    @guard("transit", to="plateau", unit="m/s")
    def binds(p, a, b, grip, bound_a, bound_b, zone):
        """Almost no slip, and a load the contact can hold."""
        slip = b.v - a.v
        slow = (border(p, +1) - slip, border(p, -1) + slip)
        return *slow, _spare(p, zone, a, b, grip, bound_a, bound_b)

    @guard("transit", to="ramp_forward", unit="m/s", mirrored="binds_backward")
    def binds_forward(p, a, b, grip, bound_a, bound_b, zone, direction):
        """A load the contact can hold, above the plateau."""
        return direction * (b.v - a.v) - border(p, direction), _spare(p, zone, a, b, grip, bound_a, bound_b)

    @guard("break_forward", "break_backward", to="plateau", unit="m/s")
    def gives_up(p, a, b, grip, bound_a, bound_b, zone, direction):
        """The break-away came to nothing."""
        slow = border(p, direction) / 2 - direction * (b.v - a.v)
        return slow, _spare(p, zone, a, b, grip, bound_a, bound_b)

    @guard("break_forward", "break_backward", to="transit", unit="N")
    def turns(p, a, b, grip, bound_a, bound_b, zone, direction):
        """Driven hard the other way."""
        d = direction
        return -d * applied_force(p, zone, a, b, grip, bound_a, bound_b) - grip * rest(p, -d)

    @guard("off", to="slide_forward", unit="m/s", mirrored="lands_backward")
    def lands_forward(p, a, b, normal, direction):
        """Pressed again while slipping."""
        return normal - 2 * p.lift, direction * (b.v - a.v) - p.v_n

    @guard("off", to="transit", unit="m/s")
    def lands(p, a, b, normal):
        """Pressed again, slow."""
        return normal - 2 * p.lift, p.v_n - abs(b.v - a.v)

    def narrowest(p):
        """The end of the ramp."""
        return p.v_n

    def numbers(p, normal):
        """What follows from the creep, as `fairlead friction` tells it."""
        return ("f_m", normal * p.mu_s / p.creep, "N*s/m"), ("v_m", p.v_m, "m/s"), ("v_n", p.v_n, "m/s")


def plateau_end(p, mu_s, mu_n):
    """Slip speed where the plateau ends [m/s] in the direction that has these coefficients."""
    if mu_s == 0 or (p.cap == "off" and p.face is None):
        return p.v_m
    end = mu_s / (mu_s / p.creep + mu_n / p.v_n) * (1 if p.face is None else 1 - p.face)
    return min(p.v_m, end)


def _spare(p, zone, a, b, grip, bound_a, bound_b, hysteresis=None):
    """How far the applied force is below what binds again, (1 - hysteresis) F_s - |af| [N]; the less of both ways."""
    share = 1 - (p.hysteresis if hysteresis is None else hysteresis)
    applied = applied_force(p, zone, a, b, grip, bound_a, bound_b)
    if p.curve.backward is None:
        return share * grip * p.mu_s - abs(applied)
    forward, backward = share * grip * rest(p, +1) - applied, share * grip * rest(p, -1) + applied
    return (forward + backward - abs(forward - backward)) / 2
