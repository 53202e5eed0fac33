"""Elements of hose that are watched for rucking: compressed beyond a limit, and softer there if wanted."""

from fairlead.components.line.hose_element import Hose, damped

from fairlead.component import Law, Output, Parameter, State, Zones, derived, guard, zone

SLOW = 1e-3  # s; makes a force of a speed where a guard compares the two: stiffness times this


class WatchedHose(Hose):
    """An elastic element that tells when it is compressed beyond the limit, and for how long.

    sound         tension above -limit
    compressed    below; the log of zones has the times
    """

    limit = Parameter("N", "Compression beyond which the hose is taken to ruck.", above=0)
    compressed = Output("1", "1 while compressed beyond the limit.")
    zones = Zones("sound", "beyond")

    @zone("sound", "beyond")
    def law(p, a, b, zone):
        """The same stiffness on both sides of the limit."""
        stretch, rate = b.x - a.x - p.length, b.v - a.v
        elastic, lossy = p.axial_stiffness / p.length * stretch, damped(p, rate)
        tension = elastic + lossy
        return Law(a=-tension, b=+tension, tension=tension, compressed=1 if zone == "beyond" else 0,
                   strain=stretch / p.length, stored=elastic * stretch / 2, dissipated=lossy * rate)  # fmt: skip

    @guard("sound", to="beyond", unit="N")
    def gives_in(p, a, b):
        """Compressed to the limit."""
        return -p.limit - p.axial_stiffness / p.length * (b.x - a.x - p.length)

    @guard("beyond", to="sound", unit="N")
    def recovers(p, a, b):
        """Back above it."""
        return p.limit + p.axial_stiffness / p.length * (b.x - a.x - p.length)


class RuckingHose(Hose):
    """An element that buckles into rucks when it is compressed beyond the limit.

    sound      tension = k (stretch - folded) + damping * rate,  above -limit
    rucking    the same, d(folded)/dt = (1 - softening) * rate: while it is compressed the stiffness is softening * k
    drawn      the same, folded stays: along the elastic line from the lowest point, below -limit

    With hardening = k softening/(1 - softening), it rucks further when the elastic tension falls to where it was
    before, -limit + hardening * folded. Folds stay: a hose that is pulled straight is shorter than before.
    """

    limit = Parameter("N", "Compression beyond which the hose rucks.", above=0)
    softening = Parameter("1", "Stiffness while rucking over that before.", default=0.05, above=0, below=1)
    folded = State("m", "Length that has gone into rucks, negative.", nominal=0.01)
    compressed = Output("1", "1 while compressed beyond the limit.")
    zones = Zones("sound", "rucking", "drawn")

    @derived
    def hardening(p):
        """Growth of the limit with what is folded [N/m]."""
        return p.axial_stiffness / p.length * p.softening / (1 - p.softening)

    @zone("sound", "rucking", "drawn")
    def law(p, a, b, folded, zone):
        """What is folded is no stretch; folding takes work."""
        rate, elastic = b.v - a.v, _elastic(p, a, b, folded)
        folding = (1 - p.softening) * rate if zone == "rucking" else 0
        lossy = damped(p, rate)
        tension = elastic + lossy
        return Law(a=-tension, b=+tension, folded=folding, tension=tension, compressed=0 if zone == "sound" else 1,
                   strain=(b.x - a.x) / p.length - 1, stored=elastic**2 * p.length / p.axial_stiffness / 2,
                   dissipated=lossy * rate + elastic * folding)  # fmt: skip

    @guard("sound", to="drawn", unit="N")
    def gives_in(p, a, b, folded):
        """Compressed to the limit."""
        return -p.limit - _elastic(p, a, b, folded)

    @guard("drawn", to="rucking", unit="N")
    def folds(p, a, b, folded):
        """Compressed further than ever before, and shortening."""
        return -p.limit + p.hardening * folded - _elastic(p, a, b, folded), -_speed(p, a, b)

    @guard("rucking", to="drawn", unit="N")
    def is_drawn_out(p, a, b):
        """Lengthening again."""
        return _speed(p, a, b)

    @guard("drawn", "rucking", to="sound", unit="N")
    def recovers(p, a, b, folded):
        """Back above the limit."""
        return p.limit + _elastic(p, a, b, folded)


def _elastic(p, a, b, folded):
    return p.axial_stiffness / p.length * (b.x - a.x - p.length - folded)


def _speed(p, a, b):
    """Speed of lengthening, as a force."""
    return SLOW * p.axial_stiffness / p.length * (b.v - a.v)
