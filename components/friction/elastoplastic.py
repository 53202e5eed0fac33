"""The elastoplastic law: LuGre bristles that are purely elastic up to a part of their break-away deflection."""

from fairlead.components.friction.bristles import STILL, Bristles, bent, sliding_deflection

from fairlead.component import Parameter, Zones, guard, pi, sin, zone

MARGIN = 0.01  # relative, to either side of full plasticity; there the blend differs from 1 by less than 1 %


class Elastoplastic(Bristles):
    """z' = v (1 - alpha sgn(v) z/z_s),  T = s0 z + s1 z' + viscous v,  z_s(v) = N mu(v)/s0 the sliding deflection.

    elastic   |z| < elastic_share z_s, or unloading    alpha = 0: all slip is given back
    blend     loading, up to about z_s                 alpha = (1 + sin(pi (z/z_s - m)/w))/2,
                                                       m = (1 + elastic_share)/2,  w = 1 - elastic_share
    forward, backward   loading, at z_s and above      alpha = 1: LuGre
    off       N = 0                                    no force, the bristles straighten

    It holds loads below elastic_share F_s without any drift, shaken or not. LuGre and Dahl drift when shaken.

    It differs from the source in two points. The elastic limit follows z_s(v), so that it stays below z_s on any
    curve. Full plasticity begins 1 % above z_s and ends 1 % below it, because steady sliding sits on that border.

    Limits: it has more zones than LuGre, and a switch at every reversal under load. It is not passive for any s1 (see
    LuGre).

    Source: Dupont, Hayward, Armstrong, Altpeter (2002), Single state elastoplastic friction models, IEEE Trans.
    Automatic Control 47, 787, DOI 10.1109/TAC.2002.1000274.
    """

    exempt = {
        "dissipates": "Its damping is that of LuGre, which is passive only under a condition on s1: Barabanov and "
        "Ortega (2000), IEEE Trans. Automatic Control 45, 830."
    }
    relaxation = Parameter("s", "Damping over stiffness of the bristles, s1/s0.", default=2e-3, least=0)
    elastic_share = Parameter(
        "1", "Part of the sliding deflection that is purely elastic.", default=0.7, above=0, below=1
    )
    zones = Zones(
        "elastic", "blend_forward", "blend_backward", "forward", "backward", "off",
        forward=["forward", "blend_forward"], backward=["backward", "blend_backward"],
    )  # fmt: skip

    @zone("elastic")
    def elastic(p, a, b, z, grip):
        """A spring with a damper; nothing of the slip is lost."""
        return bent(p, a, b, z, grip, b.v - a.v, damping=p.relaxation)

    @zone("blend_forward", "blend_backward")
    def blends(p, a, b, z, grip, direction):
        """Plastic in part."""
        d, slip = direction, b.v - a.v
        share = z / sliding_deflection(p, d * slip, d)
        middle, width = (1 + p.elastic_share) / 2, 1 - p.elastic_share
        alpha = (1 + sin(pi * (d * share - middle) / width)) / 2
        return bent(p, a, b, z, grip, slip * (1 - alpha * d * share), damping=p.relaxation)

    @zone("forward", "backward")
    def slides(p, a, b, z, grip, direction):
        """Fully plastic."""
        d, slip = direction, b.v - a.v
        share = z / sliding_deflection(p, d * slip, d)
        return bent(p, a, b, z, grip, slip * (1 - d * share), damping=p.relaxation)

    @guard("off", to="elastic", unit="N")
    def lands(p, normal):
        """Pressed again."""
        return normal - 2 * p.lift

    @guard("elastic", to="blend_forward", unit="m/s", mirrored="yields_backward")
    def yields_forward(p, a, b, z, direction):
        """Loaded forward beyond the elastic part."""
        return direction * (b.v - a.v) - STILL, _beyond(p, abs(b.v - a.v), z, direction, p.elastic_share)

    @guard("blend_forward", "blend_backward", "forward", "backward", to="elastic", unit="m/s")
    def unloads(p, a, b, direction):
        """The slip has changed its direction."""
        return -direction * (b.v - a.v) - STILL

    @guard("blend_forward", "blend_backward", "forward", "backward", to="elastic", unit="1")
    def recovers(p, a, b, z, direction):
        """The sliding deflection has grown away from the bristles, or they have straightened."""
        return -_beyond(p, direction * (b.v - a.v), z, direction, 0.99 * p.elastic_share)

    @guard("blend_forward", to="forward", unit="1", mirrored="slides_backward")
    def slides_forward(p, a, b, z, direction):
        """Bent beyond the sliding deflection."""
        return _beyond(p, direction * (b.v - a.v), z, direction, 1 + MARGIN)

    @guard("forward", to="blend_forward", unit="1", mirrored="lags_backward")
    def lags_forward(p, a, b, z, direction):
        """Bent less than the sliding deflection."""
        return -_beyond(p, direction * (b.v - a.v), z, direction, 1 - MARGIN)




def _beyond(p, speed, z, d, share):
    """How far z is, in direction d, beyond a share of the sliding deflection at a slip speed; over `presliding`.

    Only `elastic` has slip of either sign; elsewhere the speed is that at which the law reads the curve.
    """
    return (d * z - share * sliding_deflection(p, speed, d)) / p.presliding
