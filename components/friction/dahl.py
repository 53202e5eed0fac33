"""Dahl's law: friction is a stress that grows with displacement and saturates."""

from fairlead.components.friction.bristles import OneWay, bent, sliding_deflection

from fairlead.component import Zones, zone


class Dahl(OneWay):
    """z' = v - |v| z/z_s,  T = s0 z + viscous v,  with the deflection while sliding z_s(v) = N mu(v)/s0.

    forward   v > 0     |v| = +v
    backward  v < 0     |v| = -v
    off       N = 0     no force, the bristles straighten

    With one coefficient at all speeds this is dT/dx = s0 (1 - sgn(v) T/F_c), Dahl's law with exponent 1, at any speed.
    From T_0 friction follows T = F_c - (F_c - T_0) exp(-s0 x/F_c). Reversal closes a hysteresis loop.

    Limits: it has no stiction peak of its own, and no damping of the bristles. So a block on it rings at sqrt(s0/m).
    It holds any load below F_c without steady creep. Shaken under load it drifts, because any slip is partly plastic.

    Source: Dahl (1968), A solid friction model, Aerospace Corporation TOR-0158(3107-18)-1; (1976), Solid friction
    damping of mechanical vibrations, AIAA Journal 14, 1675, DOI 10.2514/3.61511. Other exponents are not offered.
    """

    zones = Zones("forward", "backward", "off", forward=["forward"], backward=["backward"])

    @zone("forward", "backward")
    def bends(p, a, b, z, grip, direction):
        """The bristles bend with the slip, less and less as they near their sliding deflection."""
        d, slip = direction, b.v - a.v
        share = z / sliding_deflection(p, d * slip, d)
        return bent(p, a, b, z, grip, slip * (1 - d * share), damping=0)
