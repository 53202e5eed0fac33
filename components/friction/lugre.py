"""The LuGre law: bristles with damping, and a sliding curve that gives stiction and the Stribeck effect."""

from fairlead.components.friction.bristles import OneWay, bent, sliding_deflection

from fairlead.component import Parameter, Zones, zone


class LuGre(OneWay):
    """z' = v - s0 |v| z/(N mu(v)),  T = s0 z + s1 z' + viscous v,  s0 = N mu_s/presliding,  s1 = relaxation s0.

    forward   v > 0     |v| = +v
    backward  v < 0     |v| = -v
    off       N = 0     no force, the bristles straighten

    One equation gives stiction, presliding displacement, frictional lag, and a break-away force that falls with the
    rate of loading. A block at rest under a steady load below F_s stays, after a presliding displacement of
    -presliding*ln(1 - load/F_s).

    Limits: shaken under load it drifts (Dupont and others 2002; use elastoplastic). With constant s1 it is passive
    only if s1 is small enough (Barabanov and Ortega 2000). Usual values are larger, so `dissipated` may go below zero
    for a moment. The equations are stiff: rates are sqrt(s0/m), and |v|/presliding while sliding.

    Source: Canudas de Wit, Olsson, Astrom, Lischinsky (1995), A new model for control of systems with friction, IEEE
    Trans. Automatic Control 40, 419, DOI 10.1109/9.376053.
    """

    word = "lugre"
    exempt = {
        "dissipates": "With constant s1 it is passive only under a condition on s1 and on the ratio of stiction to "
        "Coulomb friction: Barabanov and Ortega (2000), IEEE Trans. Automatic Control 45, 830, DOI 10.1109/9.847131."
    }
    relaxation = Parameter("s", "Damping over stiffness of the bristles, s1/s0.", default=2e-3, least=0)
    zones = Zones("forward", "backward", "off", forward=["forward"], backward=["backward"])

    @zone("forward", "backward")
    def bends(p, a, b, z, grip, direction):
        """The bristles bend with the slip and slip off as they near their sliding deflection."""
        d, slip = direction, b.v - a.v
        share = z / sliding_deflection(p, d * slip, d)
        return bent(p, a, b, z, grip, slip * (1 - d * share), damping=p.relaxation)
