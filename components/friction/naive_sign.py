"""The naive law of the textbook: friction is the sign of the slip. It fails where it should stick, and says so."""

from fairlead.components.friction.contact import drag, opposing
from fairlead.components.friction.curve import mu
from fairlead.components.friction.one_formula import OneFormula

from fairlead.component import Parameter, sqrt, tanh, zone


class NaiveSign(OneFormula):
    """T = N mu(|v|) sgn(v) + viscous v, evaluated inside the step, sgn(0) = 0.

    on    N > 0
    off   N = 0

    When the slip comes to zero, the force jumps inside a step. An implicit method then looks for a slip at which the
    block is in balance. The only such slip is zero, and there the law gives no force. So every step that reaches zero
    is rejected. The step size falls until the shortest step or a budget ends the run, with the name of this contact.

    A law must be smooth, so the sign is written as tanh(v/width)^3 with a width at rounding level. It is flat at zero
    like sgn. With tanh alone the slope at rest would be so steep that a block at rest never comes loose.

    Use `hold` to stick exactly, `binding` for many contacts, `tanh` with a width that can be resolved.

    Source: textbook; Karnopp (1985), DOI 10.1115/1.3140698, removes this difficulty.
    """

    width = Parameter("m/s", "Slip speed over which the sign changes; not to be resolved.", default=1e-15, above=0)
    advice = (
        "method naive_sign lets the sign of the slip jump inside a step, which no step size follows; use method hold, "
        "or binding where many contacts stick."
    )
    can_hold = False
    budget = {"max_steps": 100_000}

    @zone("on")
    def on(p, a, b, grip, pace):
        """The sign of the slip, as written in every textbook."""
        slip = b.v - a.v
        speed = sqrt(slip**2 + p.width**2)
        sign = tanh(slip / p.width) ** 3
        return opposing(slip, grip * mu(p.curve, speed * pace, sign) * sign + drag(p, slip), creep_rate=0)
