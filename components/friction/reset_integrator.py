"""The reset integrator: slip is integrated into a deflection, and the integration stops at the break-away one."""

from fairlead.components.friction.bristles import STILL, Bristles
from fairlead.components.friction.contact import opposing, sliding_friction
from fairlead.components.friction.curve import mu_s

from fairlead.component import Law, Parameter, Zones, guard, zone


class ResetIntegrator(Bristles):
    """T = s0 z + s1 v while |z| < presliding, then T = +-N mu(|v|); plus viscous v while sliding.

    spring    |z| < presliding, or slipping back    z' = v,  T = s0 z + s1 v
    forward   z >= presliding, v > 0                z' = 0,  T = +N mu(v) + viscous v
    backward  z <= -presliding, v < 0               the same the other way
    off       N = 0                                 no force, the spring straightens

    The force jumps from F_s = N mu_s to the curve when the contact breaks away, and back when it sticks. The source
    writes s0 = (1 + a) F_c/p0 for the spring and F_c while sliding. The contact holds any load up to F_s on a spring,
    with no creep and no drift.

    Limits: while stuck a block rings at sqrt(s0/m) unless s1 damps it. Every time it sticks, it bounces on that
    spring.

    Source: Haessig and Friedland (1991), On the modeling and simulation of friction, ASME J. Dyn. Sys. Meas. Control
    113, 354 (citation not checked).
    """

    relaxation = Parameter("s", "Damping over stiffness of the spring, s1/s0.", default=2e-3, least=0)
    zones = Zones("spring", "forward", "backward", "off", forward=["forward"], backward=["backward"])

    @zone("spring")
    def spring(p, a, b, z, grip):
        """A spring with a damper."""
        slip, stiffness = b.v - a.v, grip * p.ratio
        friction = stiffness * (z + p.relaxation * slip)
        return Law(a=-friction, b=+friction, z=slip, slip=slip, friction=friction, deflection=z, creep_rate=0,
                   stored=stiffness * z**2 / 2, dissipated=stiffness * p.relaxation * slip**2)  # fmt: skip

    @zone("forward", "backward")
    def slides(p, a, b, z, grip, pace, direction):
        """The curve gives the force; the spring stays as it is."""
        slip = b.v - a.v
        stored = grip * p.ratio * z**2 / 2
        return opposing(slip, sliding_friction(p, direction, slip, grip, pace), z=0, deflection=z, stored=stored)

    def breaks_away_at(p):
        """As the curve."""
        return p.curve.breakaway()

    @guard("off", to="spring", unit="N")
    def lands(p, normal):
        """Pressed again."""
        return normal - 2 * p.lift

    @guard("spring", to="forward", unit="1")
    def breaks_forward(p, a, b, z):
        """The spring is at its end, and slips on."""
        return z / p.presliding - 1, (b.v - a.v) / STILL - 1

    @guard("spring", to="backward", unit="1")
    def breaks_backward(p, a, b, z):
        """The same the other way, where the coefficient from rest may be another."""
        return -z / (mu_s(p.curve, -1) / p.ratio) - 1, (a.v - b.v) / STILL - 1

    @guard("forward", to="spring", unit="m/s", mirrored="catches_backward")
    def catches_forward(p, a, b, direction):
        """The slip has changed its direction."""
        return -direction * (b.v - a.v) - STILL
