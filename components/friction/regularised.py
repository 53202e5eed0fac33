"""The regularised laws: the sign of the slip is replaced by a smooth function of it. Foils for the others."""

import math

from fairlead.components.friction.contact import drag, opposing
from fairlead.components.friction.curve import mu
from fairlead.components.friction.one_formula import OneFormula

from fairlead.component import Parameter, atan, pi, sqrt, tanh, zone

MOST_COUNTED = 0.999  # share of the sliding level up to which slip counts as creep
SHARPNESS = 20.0  # of the end of that count, beside 1; at 99 % of the level it is complete for every shape here


class Regularised(OneFormula, abstract=True):
    """T = N mu(u) s(v/creep) + viscous v,  u = sqrt(v^2 + creep^2),  with a shape s of slope about 1 at zero.

    u is |v|, rounded off at the creep speed. A curve with `backward` points goes over from one direction to the other
    with s:  mu(u) = (1 + s)/2 mu_forward(u) + (1 - s)/2 mu_backward(u). There is no stiction: the largest force is
    about N mu at a few times the creep speed, and a break-away coefficient above the curve is not seen. Under a
    load af below it the contact slips for ever, at creep * s^-1(af/(N mu)); that is its creep.
    The slope N mu/creep at zero slip makes the equations stiff; an explicit method needs h < 2 m creep/(N mu).
    """

    sticks_below, creeps, never_sticks = "creep", True, True
    creep = Parameter("m/s", "Speed over which the sign changes.", default=1e-4, above=0)

    @zone("on")
    def on(p, a, b, grip, pace):
        """One formula for all speeds; slip counts as creep while friction is below 99.9 % of its level."""
        slip = b.v - a.v
        speed = sqrt(slip**2 + p.creep**2)
        share = p.shape(slip / p.creep)
        friction = grip * mu(p.curve, speed * pace, share) * share + drag(p, slip)
        beyond = (slip / (p.creep * p.reach())) ** 2 - 1
        creeping = slip * (1 - tanh(SHARPNESS * beyond)) / 2
        return opposing(slip, friction, creep_rate=creeping)

    def breaks_away_at(p):
        """As sliding begins: a stiction above the curve is not seen."""
        return p.curve.coefficient(0)

    def reach(p):
        """Slip over creep at which the shape is 99.9 % of its level."""
        return p.inverse(MOST_COUNTED)

    def narrowest(p):
        """Where friction is 99 % of its level."""
        return p.creep * p.inverse(0.99)


class Smooth(Regularised):
    """T = N mu(u) tanh(v/creep) + viscous v,  u = sqrt(v^2 + creep^2).

    It never sticks: under load af it slips at creep*atanh(af/(N mu)). The curve is read at u, |v| rounded off.

    Limits: creep grows without bound near stiction (2.6 creep at 99 % of it). Nothing distinguishes sticking from
    sliding. A curve with `backward` points goes over from one direction to the other with s = tanh(v/creep):
    mu(u) = (1 + s)/2 mu_forward(u) + (1 - s)/2 mu_backward(u).

    Source: Andersson, Söderberg, Björklund (2007), Friction models for sliding dry, boundary and mixed lubricated
    contacts, Tribology International 40, 580.
    """

    word = "tanh"

    def shape(p, u):
        """Hyperbolic tangent; 76 % at the creep speed."""
        return tanh(u)

    def inverse(p, share):
        """The u with shape(u) = share."""
        return math.atanh(share)


class Arctan(Regularised):
    """T = N mu(u) (2/pi) atan(v/creep) + viscous v,  u = sqrt(v^2 + creep^2); it creeps at creep*tan(pi/2 af/(N mu)).

    Limits: it is the slowest to reach its level: 94 % at ten times the creep speed, 99 % at 64 times. Of the smooth
    laws it needs the smallest creep for the same error, which makes the equations stiffer. A curve with `backward`
    points goes over as with tanh, with s = (2/pi) atan(v/creep). So sliding forward has a part of the backward curve,
    3 % at ten times the creep speed and 0.3 % at a hundred times.

    Source: Mostaghel and Davis (1997), Representations of Coulomb friction for dynamic analysis, Earthquake
    Engineering and Structural Dynamics 26, 541 (citation not checked).
    """

    def shape(p, u):
        """Inverse tangent."""
        return 2 / pi * atan(u)

    def inverse(p, share):
        """The u with shape(u) = share."""
        return math.tan(pi / 2 * share)


class Root(Regularised):
    """T = N mu(u) v/u + viscous v,  u = sqrt(v^2 + creep^2); it creeps at creep*q/sqrt(1 - q^2), q = af/(N mu).

    It has no transcendental function, so it is the cheapest of the smooth laws.

    Limits: as tanh, but it approaches its level like 1 - (creep/v)^2/2, not exponentially: 99 % at seven times the
    creep speed. A curve with `backward` points goes over as with tanh, with s = v/u.

    Source: as for arctan.
    """

    def shape(p, u):
        """Algebraic sigmoid."""
        return u / sqrt(1 + u**2)

    def inverse(p, share):
        """The u with shape(u) = share."""
        return share / (1 - share**2) ** 0.5
