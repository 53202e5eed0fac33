"""The saturated line: the sign of the slip is replaced by a straight line between two levels."""

from fairlead.components.friction.contact import Sliding, drag, opposing
from fairlead.components.friction.creeping import Creeping, with_creep
from fairlead.components.friction.curve import mu

from fairlead.component import Zones, guard, zone


class Saturation(Sliding, Creeping):
    """T = N mu(creep) v/creep + viscous v on the line, +-N mu(|v|) + viscous v outside it.

    line      |v| < creep
    forward   v >= creep          backward   v <= -creep
    off       N = 0

    This is the simplest regularisation. Its two corners are borders of zones, so no step crosses one. A block under
    load af < N mu(creep) creeps at creep*af/(N mu(creep)), which is less than with tanh. The creep is exactly linear,
    so a loaded spring k leaks as exp(-k creep/(N mu) t).

    Limits: on the line a curve with `backward` points goes over from one direction to the other in proportion to the
    slip, and T is not straight there. It has no stiction and no memory. It is binding friction without the plateau:
    use binding if stiction matters.

    Source: textbook; Pennestri and others (2016), Nonlinear Dynamics 83, 1785, DOI 10.1007/s11071-015-2485-3, compare
    laws of this kind.
    """

    zones = Zones("line", "forward", "backward", "off", forward=["forward"], backward=["backward"])

    def prepare(given):
        """The creep, which a leak may stand for."""
        return with_creep(Saturation, given)

    def slope(given, creep):
        """Slope of the line over the normal force [s/m]."""
        return mu(given["curve"], creep, +1) / creep

    @zone("line")
    def line(p, a, b, grip):
        """Proportional to slip; all of it is creep."""
        slip = b.v - a.v
        slope = grip * mu(p.curve, p.creep, slip / p.creep) / p.creep
        return opposing(slip, slope * slip + drag(p, slip), creep_rate=slip)

    @guard("off", to="line", unit="N")
    def lands(p, normal):
        """Pressed again."""
        return normal - 2 * p.lift

    @guard("line", to="forward", unit="m/s", mirrored="leaves_backward")
    def leaves_forward(p, a, b, direction):
        """The line ends."""
        return direction * (b.v - a.v) - p.creep

    @guard("forward", to="line", unit="m/s", mirrored="slows_backward")
    def slows_forward(p, a, b, direction):
        """Slow again."""
        return p.creep - direction * (b.v - a.v)

    def breaks_away_at(p):
        """As sliding begins: a stiction above the curve is not seen."""
        return p.curve.coefficient(0)

    def narrowest(p):
        """The end of the line."""
        return p.creep
