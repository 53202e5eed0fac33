"""Friction that first rises with speed and then falls: the curve of plastics on metal."""

import math

from fairlead.components.friction.curve import Curve

from fairlead.component import Parameter, derived, exp


class Hump(Curve):
    """mu(v) = coulomb + (D + c v) exp(-v/v0),  D = stiction - coulomb.

    v0 and c are found so that the maximum is exactly `peak` at `peak_velocity`: with
    r = D/(peak - coulomb) < 1 and the Lambert function,  u = -W(-r/e),  v0 = peak_velocity/(1 - u),
    c = D/(v0 - peak_velocity); for D = 0,  v0 = peak_velocity,  c = (peak - coulomb) e/peak_velocity.

    Shape after Fig. 3 of Tomlinson, Cooke and Cosserat (2003), DOI 10.1177/095965180321700207.
    """

    level = "coulomb"
    stiction = Parameter("1", "Coefficient at rest.", least=0, usual=(0, 2))
    peak = Parameter("1", "Largest coefficient.", above=0, usual=(0, 2))
    peak_velocity = Parameter("m/s", "Slip speed of the largest coefficient.", above=0)
    coulomb = Parameter("1", "Coefficient at high speed.", least=0, usual=(0, 2))

    @derived
    def decay(p):
        """The speed v0 [m/s]."""
        from scipy.special import lambertw

        r = (p.stiction - p.coulomb) / (p.peak - p.coulomb)
        return p.peak_velocity / (1 + float(lambertw(-r / math.e).real)) if r != 0 else p.peak_velocity

    @derived
    def slope(p):
        """The coefficient c [s/m]."""
        drop = p.stiction - p.coulomb
        return drop / (p.decay - p.peak_velocity) if drop != 0 else (p.peak - p.coulomb) * math.e / p.peak_velocity

    def coefficient(p, v):
        """Rises to the peak, then falls to the level at high speed."""
        return p.coulomb + (p.stiction - p.coulomb + p.slope * v) * exp(-v / p.decay)

    def scale(p):
        """The speed of the peak."""
        return p.peak_velocity

    def check(p):
        """The peak is the highest of the three levels."""
        yield from Curve.check(p)
        if p.peak <= max(p.stiction, p.coulomb):
            yield (
                "peak",
                f"peak {p.peak:g} is not above stiction {p.stiction:g} and coulomb {p.coulomb:g}",
                "Raise peak.",
            )
