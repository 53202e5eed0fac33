"""A belt round two pulleys, that creeps and slips on them."""

from math import exp, pi

from fairlead.components.friction.contact import Contact
from fairlead.components.rotation.rack import Rack
from fairlead.components.rotation.rubbing import METHODS

from fairlead.component import (
    Choice,
    Component,
    Composite,
    Expansion,
    Law,
    Output,
    Parameter,
    Rotational,
    Translational,
    sqrt,
)  # fmt: skip

ROUND_OFF = 1e-6  # of the tension at rest


class BeltSpans(Component):
    """The two free spans of a belt between its places on two pulleys, each stretched by `tension` at rest.

    upper = tension + pull/2,  lower = tension - pull/2,  pull = stiffness s + damping ds/dt,  s = a.x - b.x.
    `grip` is the largest difference of tensions that a wrap holds:  (least tension - mass v^2) (exp(mu wrap) - 1).
    """

    a, b = Translational("belt on the first pulley"), Translational("belt on the second pulley")
    stiffness = Parameter("N/m", "Stiffness of both spans together.", above=0)
    damping = Parameter("N*s/m", "Damping of both spans together.", least=0)
    tension = Parameter("N", "Tension of each span at rest.", above=0)
    mass = Parameter("kg/m", "Mass of the belt per length.", least=0)
    ratio = Parameter("1", "exp(mu wrap) of the pulley that slips.", above=1)
    round_off = Parameter("N", "Tension over which corners are rounded off.", above=0)
    upper = Output("N", "Tension of the upper span.")
    lower = Output("N", "Tension of the lower span.")
    grip = Output("N", "Largest difference of tensions.")

    def law(p, a, b):
        """What one span gains the other loses, since the centres stand."""
        stretch, rate = a.x - b.x, a.v - b.v
        pull = p.stiffness * stretch + p.damping * rate
        spare = p.tension - (sqrt(pull**2 + p.round_off**2) - p.round_off) / 2 - p.mass * a.v**2
        least = (spare + sqrt(spare**2 + p.round_off**2)) / 2  # never negative
        return Law(
            a=pull, b=-pull, upper=p.tension + pull / 2, lower=p.tension - pull / 2, grip=(p.ratio - 1) * least,
            stored=p.stiffness * stretch**2 / 2, dissipated=p.damping * rate**2,
        )  # fmt: skip


class BeltDrive(Composite):
    """A flat belt, V-belt or cord by which pulley a drives pulley b:  torque_b = radius_b (upper - lower).

    The belt sticks to a pulley up to the capstan's ratio of tensions, and slips beyond:

        (T_1 - m v^2)/(T_2 - m v^2) = exp(mu wrap)

    So a pulley at rest slips at the torque  2 tension radius tanh(mu wrap/2). Both pulleys have the same two tensions.
    The belt therefore slips only on the pulley with the smaller wrap (on b if the wraps are equal). For a V-belt, mu
    is that of its flanks over the sine of half the groove's angle. `stiffness` is E A (1/l + 1/l) of the two free
    spans.

    Source: Euler's formula with the centrifugal term, e.g. Shigley's Mechanical Engineering Design, flexible elements.

    Limits: the mass of the belt counts only in m v^2. Its elastic creep below slip is left out. The centres stand, so
    the sum of the tensions is constant. A toothed belt or a chain does not slip: take a Gear and a TorsionSpring for
    it.
    """

    a = Rotational("driving pulley")
    b = Rotational("driven pulley")
    radius_a = Parameter("m", "Radius of the driving pulley, to the middle of the belt.", above=0, usual=(1e-3, 10))
    radius_b = Parameter("m", "Radius of the driven pulley.", above=0, usual=(1e-3, 10))
    tension = Parameter("N", "Tension of each span at rest.", above=0)
    mu = Parameter("1", "Coefficient of friction of belt on pulley.", above=0, usual=(0.01, 5))
    wrap_a = Parameter("rad", "Angle that the belt wraps on the driving pulley.", default=pi, above=0)
    wrap_b = Parameter("rad", "Angle on the driven pulley.", default=pi, above=0)
    stiffness = Parameter("N/m", "Stiffness of both free spans together.", default=1e6, above=0)
    damping = Parameter("N*s/m", "Damping of both free spans together.", default=100.0, least=0)
    mass = Parameter("kg/m", "Mass of the belt per length.", default=0.0, least=0)
    round_off = Parameter(
        "N", "Tension over which corners are rounded off; a millionth of `tension` when not given.", default=None,
        above=0,
    )
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    upper = Output("N", "Tension of the span that a pulls tight when it drives forward.")
    lower = Output("N", "Tension of the other span.")
    slip = Output("m/s", "Slip speed where the belt slips, positive when a runs ahead.")

    def expand(p, scene):
        """Two rims, the spans between, and friction on the pulley that slips first."""
        word = {} if p.method is None else {"method": p.method}
        round_off = ROUND_OFF * p.tension if p.round_off is None else p.round_off
        children = {
            "spans": scene.make(
                BeltSpans, stiffness=p.stiffness, damping=p.damping, tension=p.tension, mass=p.mass,
                ratio=exp(p.mu * min(p.wrap_a, p.wrap_b)), round_off=round_off,
            ),
            "wrap": scene.make(Contact, curve=1.0, **word),
            "rim_a": scene.make(Rack, radius=p.radius_a),
            "rim_b": scene.make(Rack, radius=p.radius_b),
        }  # fmt: skip
        joins = [("spans.grip", "wrap.normal")]
        if p.wrap_a < p.wrap_b:
            joins += [("rim_a.rack", "wrap.b"), ("wrap.a", "spans.a"), ("spans.b", "rim_b.rack")]
        else:
            joins += [("rim_a.rack", "spans.a"), ("spans.b", "wrap.b"), ("wrap.a", "rim_b.rack")]
        shown = {"upper": "spans.upper", "lower": "spans.lower", "slip": "wrap.slip"}
        return Expansion(children, joins, {"a": "rim_a.pinion", "b": "rim_b.pinion"}, shown)
