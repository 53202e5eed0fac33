"""Exact hold: while the contact sticks its force is an unknown and the slip is zero."""

from fairlead.components.friction.curve import mu_s
from fairlead.components.friction.rigid import Rigid

from fairlead.component import Law, Parameter, Zones, guard, hold, zone


class Hold(Rigid):
    """Set-valued friction: what a contact takes that names no method, and the reference for every other treatment.

    held:      slip = 0, T = whatever holds, |T| <= N mu_s
    forward:   T = +N mu(v) + viscous v          backward: T = -N mu(-v) + viscous v
    off:       T = 0, the surfaces are apart

    Sliding ends when the slip reaches zero. The contact is then tried as held. It lets go again, in the direction of
    its force, if that force is above the limit. A contact that holds does not creep.

    Limits: every contact has one algebraic unknown. Contacts side by side share what the laws leave open by the least
    sum of squares. A contact between two prescribed motions is refused. Every switch is located, so many switches take
    many steps.

    Source: set-valued friction after Moreau (1988); stuck and sliding as zones with the stuck force as an unknown:
    Otter, Elmqvist, Mattsson (1999), as in the Modelica Standard Library.
    """

    word = "hold"
    exact = True
    sticks_below = "stick_speed"
    stick_speed = Parameter("m/s", "A contact that lands with less slip than this sticks.", default=1e-6, above=0)
    zones = Zones("held", "forward", "backward", "off", forward=["forward"], backward=["backward"])

    @zone("held")
    def held(p, a, b, force):
        """The force is what keeps the slip at zero."""
        slip = b.v - a.v
        return Law(a=-force, b=+force, force=hold(slip, within=p.stick_speed), slip=slip, friction=force,
                   creep_rate=slip, bound=1, dissipated=force * slip)  # fmt: skip

    @guard("held", to="forward", unit="m/s", mirrored="torn_backward")
    def torn_forward(p, a, b, direction):
        """It slips from the start, or a jump of a prescribed speed tears it loose: friction gives no impulse."""
        return direction * (b.v - a.v) - p.stick_speed

    @guard("held", to="forward", unit="N", mirrored="breaks_backward")
    def breaks_forward(p, force, grip, direction):
        """The force needed is more than stiction."""
        return direction * force - grip * mu_s(p.curve, direction)

    @guard("forward", to="held", unit="m/s", mirrored="stops_backward")
    def stops_forward(p, a, b, direction):
        """The slip has come to zero."""
        return -direction * (b.v - a.v)

    @guard("off", to="forward", unit="1", mirrored="lands_backward")
    def lands_forward(p, a, b, normal, direction):
        """Pressed again while slipping."""
        return (normal - 2 * p.lift) / p.lift, (direction * (b.v - a.v) - p.stick_speed) / p.stick_speed

    @guard("off", to="held", unit="1")
    def lands_still(p, a, b, normal):
        """Pressed again without slip."""
        return (normal - 2 * p.lift) / p.lift, 1 - abs(b.v - a.v) / p.stick_speed
