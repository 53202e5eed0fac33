"""The smooth law: the sign of the slip is replaced by a hyperbolic tangent. A foil for the others."""

from fairlead.components.friction.contact import Contact

from fairlead.component import Law, Parameter, Zones, guard, sqrt, tanh, zone


class Smooth(Contact):
    """T = N mu(|v|) tanh(v/creep) + viscous v; it never sticks: under load af it slips at creep*atanh(af/(N mu)).

    No zone tells sticking from sliding here; what counts as creep fades out where tanh comes close to 1.
    """

    word = "tanh"
    creep = Parameter("m/s", "Speed over which the sign changes.", default=1e-4, above=0)
    zones = Zones("on", "off")

    @zone("on")
    def on(p, a, b, normal):
        """One formula for all speeds; |v| is rounded off at the creep speed."""
        slip = b.v - a.v
        speed = sqrt(slip**2 + p.creep**2)
        friction = normal * p.curve.coefficient(speed) * tanh(slip / p.creep) + p.viscous * slip
        creeping = slip * (1 - tanh(slip / p.creep) ** 8)
        return Law(
            a=-friction, b=+friction, slip=slip, friction=friction, creep_rate=creeping, dissipated=friction * slip
        )

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
