"""The bristle model: bonds between the surfaces that stretch, snap and form anew at random places, from a seed."""

import functools
import math

import numpy as np
from fairlead.components.friction.contact import drag, opposing
from fairlead.components.friction.curve import stays_in_place
from fairlead.components.friction.one_formula import OneFormula

from fairlead.component import Choice, Count, Law, Output, Parameter, State, derived, derived_wave, zone
from fairlead.component.piecewise import FAR, STRIDE, PiecewisePolynomial

MOST = 25
MOST_SITES = 100_000  # of a bond, to either side
LEAST_LEVEL, MOST_LEVEL = 0.25, 0.95  # mean force of sliding bonds over that of bonds about to snap
BEYOND = 10.0  # times the velocity of the curve: where its sliding level is read


def level_of(low, high):
    """Mean force over the largest one when new bonds are stretched by U(low, high) of what snaps them.

    From u to 1 over a way 1 - u a bond gives (1 - u^2)/2, so the mean is E[1 - u^2]/(2 E[1 - u]).
    """
    return (1 - (low**2 + low * high + high**2) / 3) / (2 - low - high)


def stretch_of(level):
    """The interval (low, high) of U that has a level: (0, rho) as published where there is one, from 1/2 to 2/3."""
    if level > 2 / 3:
        return 3 * level - 2, 1.0  # level_of(a, 1) = (2 + a)/3
    if level < 1 / 2:  # level_of(-a, 0) = (1 - a^2/3)/(2 + a), so a^2/3 + level a + 2 level - 1 = 0
        return (3 * level - math.sqrt(9 * level**2 - 12 * (2 * level - 1))) / 2, 0.0
    return 0.0, (3 * level - math.sqrt(9 * level**2 - 12 * (2 * level - 1))) / 2


def sites(number, p):
    """The places b where bond `number` takes hold, from -travel to +travel, as pieces z - b that overlap.

    Moving on, a bond at b snaps at b + presliding, and the next begins at b + presliding - u presliding. Moving back it
    snaps at b - presliding; the sites are fixed to the surface, so it then takes hold at the one before. Beyond the
    outermost there is none (not a number).
    """
    draw, (low, high) = np.random.default_rng([p.seed, number]), p.stretch
    steps = int(p.travel / (p.presliding * (1 - (low + high) / 2)) * 1.2) + 20  # more than the mean to get there
    ahead, behind = (np.cumsum(p.presliding * (1 - draw.uniform(low, high, steps))) for _ in range(2))
    ahead, behind = ahead[ahead <= p.travel], behind[behind <= p.travel]
    places = np.concatenate([-behind[::-1], [0.0], ahead])
    rows = np.zeros((len(places) + 2, STRIDE))
    rows[1:-1, 0], rows[1:-1, 1], rows[1:-1, 2] = places - p.presliding, places + p.presliding, places
    rows[1:-1, 4] = 1.0
    rows[0, :5] = -FAR, rows[1, 0], rows[1, 0], np.nan, np.nan
    rows[-1, :5] = rows[-2, 1], FAR, rows[-2, 1], np.nan, np.nan
    return PiecewisePolynomial(rows, begin=len(behind) + 1)


class Bristle(OneFormula):
    """T = s0/n sum (z - b_i) + viscous v over n bonds, s0 = F_s/presliding, z the slip since the start.

    on    bond i snaps where |z - b_i| = presliding, and holds anew stretched by U(0, rho) presliding in the direction
          of slip; each bond has zones of its own
    off   N = 0, the bonds go on without force

    Bonds that start together snap together, at F_s = N mu_s. Later they are out of step, and friction is a noise about
    F_c with F_c/F_s = (1 - rho^2/3)/(2 - rho). rho follows from the curve: from its coefficient from rest and its
    level at ten times its velocity. Above F_c/F_s = 2/3 new bonds begin at U(a, 1), with F_c/F_s = (2 + a)/3. Above
    F_c/F_s = 0.95 stiction is raised to F_c/0.95. Otherwise friction does not depend on speed. It holds any load
    below F_s without creep.

    Limits: it is made to look at, not to use. Every bond switches at every 0.8 presliding of slip or less, some 80 000
    times a second in all at 0.05 m/s. The sites reach over `travel` to either side. The work that stretches bonds
    counts as dissipated at once, since snapping loses it without a power; unloading gives some of it back. The sites
    are the same for both directions of slip, so a curve with `backward` is refused.

    Source: Haessig and Friedland (1991), On the modeling and simulation of friction, ASME J. Dyn. Sys. Meas. Control
    113, 354 (citation not checked). There the sites are drawn as slip goes on; here they are drawn before.
    """

    exempt = {
        "odd": "The sites ahead are not the mirror image of those behind: they are random (Haessig, Friedland 1991).",
        "dissipates": "Bonds are springs, and their energy counts as dissipated when it goes in, so it comes out of "
        "that (Haessig, Friedland 1991: the energy is lost when a bond snaps).",
    }
    preslides, gives_by = "presliding", "ratio"
    asked_with = {"bonds": "5", "presliding": 0.5, "travel": 2.0}  # random sizes would mean thousands of sites
    advice = "method bristle has no sites beyond `travel` of slip; give it more if the slip went there."
    presliding = Parameter("m", "Stretch at which a bond snaps.", default=2e-5, above=0)
    travel = Parameter("m", "Slip to either side of the start that has sites.", default=5e-3, above=0)
    bonds = Choice(("5", str(MOST)), "Number of bonds.", default=str(MOST))
    seed = Count("Seed of the random numbers; the same gives the same sites.", default=1, least=0)
    moved = State("m", "Slip since the start.", nominal="presliding")
    deflection = Output("m", "Mean stretch of the bonds.")
    slid = Output("m", "Slip since the start.")

    @derived
    def level(p):
        """F_c/F_s."""
        sliding = p.curve.coefficient(BEYOND * (p.curve.scale() or 0.0))
        return min(sliding / max(p.curve.breakaway(), 1e-300), MOST_LEVEL)

    @derived
    def stretch(p):
        """Interval of U, in units of presliding."""
        return stretch_of(p.level)

    @derived
    def ratio(p):
        """Stiffness of all bonds over normal force, s0/N [1/m]."""
        sliding = p.curve.coefficient(BEYOND * (p.curve.scale() or 0.0))
        return max(p.curve.breakaway(), sliding / MOST_LEVEL) / p.presliding

    vars().update({f"_sites_{k}": derived_wave(functools.partial(sites, k)) for k in range(MOST)})

    @zone("on")
    def on(p, a, b, moved, grip):
        """All bonds pull."""
        slip, mean = b.v - a.v, mean_stretch(p, moved)
        pull = grip * p.ratio * mean + drag(p, slip)
        return opposing(slip, pull, moved=slip, deflection=mean, slid=moved, creep_rate=0)

    @zone("off")
    def off(p, a, b, moved):
        """No force passes."""
        slip = b.v - a.v
        return Law(a=0, b=0, moved=slip, slip=slip, deflection=mean_stretch(p, moved), slid=moved)

    def check(p):
        """There must be bonds, and a level that they can have; the curve stays, the same both ways."""
        yield from stays_in_place(p)
        if p.curve.backward is not None:
            yield (
                "curve", "backward points are given, and the sites of method bristle are the same both ways",
                "Leave them out, or use another method: all others have both directions.",
            )  # fmt: skip
        if p.travel > MOST_SITES * p.presliding:
            what = f"{p.travel:g} m of travel have {p.travel / p.presliding:.2g} sites a bond; at most {MOST_SITES}"
            yield "travel", what, f"Give at most {MOST_SITES * p.presliding:g} m."
        if p.curve.breakaway() <= 0:
            yield "curve", "the coefficient at rest is zero", "Leave the contact out, or give it some friction."
        elif p.level < LEAST_LEVEL:
            what = f"friction falls to {p.level:.2g} of stiction in sliding, which bonds cannot"
            yield "curve", what, f"They can have {LEAST_LEVEL} and more."


def mean_stretch(p, moved):
    """Mean of z - b over the bonds [m]."""
    bonds = range(int(p.bonds))
    return sum(getattr(p, f"_sites_{k}")(moved) for k in bonds) / len(bonds)
