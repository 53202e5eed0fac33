"""Karnopp's law: below a small slip speed a contact counts as stuck, and its slip is taken to be zero."""

from fairlead.components.friction.curve import mu_s
from fairlead.components.friction.rigid import Rigid, settled

from fairlead.component import Law, Parameter, Zones, guard, hold, zone


class Karnopp(Rigid):
    """Inside the band |v| < band the contact carries what is applied, up to F_s = N mu_s; outside it slides.

    stuck      |v| < band, |af| <= F_s      slip = 0, T = af
    breaking   |v| < band, |af| >  F_s      T = +-F_s
    forward    v >= band                    T = +N mu(v) + viscous v       backward the same the other way
    off        N = 0                        T = 0

    Karnopp computes the applied force af from the neighbours, by hand for every topology. Here the force that keeps
    the slip at zero is an unknown, and the engine solves for it, whatever else is stuck.

    When the slip enters the band, an impulse that conserves momentum sets it to zero, as Karnopp does with his
    velocity. The energy m band^2/2 is not accounted for. The contact holds without creep up to F_s. Compared with
    exact hold it stops early, by about m band/T seconds. It breaks away with F_s, and has that instead
    of the curve until the slip is out of the band.

    Limits: the band must stay well below the slowest speed that matters, because everything slower is stuck. If
    nothing can stop the slip inside the band, as in a slider whose crank passes its dead centre, the run ends: take
    another method.

    Source: Karnopp (1985), Computer simulation of stick-slip friction in mechanical dynamic systems, ASME J. Dyn. Sys.
    Meas. Control 107, 100, DOI 10.1115/1.3140698.
    """

    sticks_below = "band"
    band = Parameter("m/s", "Slip speed below which the contact counts as stuck.", default=1e-4, above=0)
    zones = Zones(
        "stuck", "breaking_forward", "breaking_backward", "forward", "backward", "off",
        forward=["forward", "breaking_forward"], backward=["backward", "breaking_backward"],
        latched=["breaking_forward", "breaking_backward"],
    )  # fmt: skip

    @zone("stuck")
    def stuck(p, a, b, force):
        """The force is what keeps the slip at zero."""
        slip = b.v - a.v
        return Law(a=-force, b=+force, force=hold(slip, within=p.band), slip=slip, friction=force, creep_rate=slip,
                   bound=1, dissipated=force * slip)  # fmt: skip

    @zone("breaking_forward", "breaking_backward")
    def breaking(p, a, b, force, grip, direction):
        """More is applied than stiction: friction stays at its limit until the slip leaves the band."""
        return settled(b.v - a.v, force, direction * grip * mu_s(p.curve, direction))

    @guard("stuck", "breaking_forward", "breaking_backward", to="forward", unit="m/s", mirrored="leaves_backward")
    def leaves_forward(p, a, b, direction):
        """The slip is out of the band."""
        return direction * (b.v - a.v) - p.band

    @guard("stuck", to="breaking_forward", unit="N", mirrored="breaks_backward")
    def breaks_forward(p, force, grip, direction):
        """The force needed is more than stiction."""
        return direction * force - grip * mu_s(p.curve, direction)

    @guard("breaking_forward", to="stuck", unit="m/s", mirrored="gives_up_backward")
    def gives_up_forward(p, a, b, direction):
        """The slip has come back to zero."""
        return -direction * (b.v - a.v)

    @guard("forward", to="stuck", unit="m/s", mirrored="enters_backward")
    def enters_forward(p, a, b, direction):
        """The slip enters the band; if the load is too much, it leaves `stuck` at once."""
        return 0.99 * p.band - direction * (b.v - a.v)

    @guard("off", to="stuck", unit="N")
    def lands(p, normal):
        """Pressed again; if it slips, it leaves `stuck` at once."""
        return normal - 2 * p.lift

    def narrowest(p):
        """The band."""
        return p.band
