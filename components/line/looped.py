"""Elements of a line that runs through the loop of a tensioner.

With H the step at the tensioner's place, smooth over an element, a node at x has run S(x) = x + 2 y H(x) of line's
way. An element from a to b is stretched by S(b) - S(a) - length; over all elements the loop counts exactly 2 y,
wherever the nodes are. The forces follow from the work of the tension T:

    on the nodes  T (1 + 2 y H'(x)),      on the carriage  2 T (H(b.x) - H(a.x)), which draws the loop in
"""

from fairlead.components.line.core_element import PLAY
from fairlead.components.line.hose_element import Hose, damped

from fairlead.component import Law, Output, Table, Translational, Zones, guard, zone
from fairlead.component.piecewise import PiecewisePolynomial, pieces


def step(place: float, edge: float) -> PiecewisePolynomial:
    """From 0 to 1 over `edge` round a place, with a slope that is nowhere steep: 3 u^2 - 2 u^3."""
    left, right = place - edge / 2, place + edge / 2
    return pieces([left, right], [[0.0], [0.0, 0.0, 3 / edge**2, -2 / edge**3], [1.0]])


class LoopedHose(Hose):
    """Elastic element with a loop of 2 y in it when it spans the place of the tensioner."""

    carriage = Translational("the carriage of the tensioner, at y")
    behind = Table("m", "1", "The step, as the inboard node sees it.")
    ahead = Table("m", "1", "The step, as the outboard node sees it.")

    def law(p, a, b, carriage):
        """As an element, along its way."""
        return along(p, a, b, carriage)


class LoopedCore(LoopedHose):
    """The same, which cannot push."""

    compressible = 1.0  # loose at any length
    slack = Output("1", "1 while slack.")
    zones = Zones("taut", "loose")

    @zone("taut")
    def taut(p, a, b, carriage):
        """Carries load."""
        return along(p, a, b, carriage)

    @zone("loose")
    def loose(p, a, b, carriage):
        """Carries nothing."""
        way, _ = stretch(p, a, b, carriage)
        return Law(a=0, b=0, carriage=0, tension=0, slack=1, strain=way / p.length)

    @guard("taut", to="loose", unit="N")
    def shortens(p, a, b, carriage):
        """Shorter than without tension."""
        return -p.axial_stiffness / p.length * stretch(p, a, b, carriage)[0]

    @guard("taut", to="loose", unit="N")
    def would_push(p, a, b, carriage):
        """Closing so fast that the damping would push."""
        if p.line_damping == "off":
            return None
        way, rate = stretch(p, a, b, carriage)
        return -(p.axial_stiffness / p.length * way + damped(p, rate))

    @guard("loose", to="taut", unit="N")
    def tightens(p, a, b, carriage):
        """Stretched, and the tension would be positive."""
        way, rate = stretch(p, a, b, carriage)
        elastic = p.axial_stiffness * (way / p.length - PLAY)
        return (elastic, elastic + damped(p, rate)) if p.line_damping == "on" else elastic


def stretch(p, a, b, carriage):
    """Stretch [m] and its rate [m/s] along the way through the loop."""
    step_a, step_b = p.behind(a.x), p.ahead(b.x)
    way = b.x - a.x + 2 * carriage.x * (step_b - step_a) - p.length
    rate = b.v * (1 + 2 * carriage.x * p.ahead.rate(b.x)) - a.v * (1 + 2 * carriage.x * p.behind.rate(a.x))
    return way, rate + 2 * carriage.v * (step_b - step_a)


def along(p, a, b, carriage):
    """The law of an element whose stretch counts the loop."""
    way, rate = stretch(p, a, b, carriage)
    elastic, lossy = p.axial_stiffness / p.length * way, damped(p, rate)
    tension = elastic + lossy
    grows_a, grows_b = (1 + 2 * carriage.x * table.rate(x) for table, x in ((p.behind, a.x), (p.ahead, b.x)))
    drawn = 2 * tension * (p.ahead(b.x) - p.behind(a.x))
    return Law(a=-tension * grows_a, b=tension * grows_b, carriage=drawn, tension=tension, strain=way / p.length,
               stored=elastic * way / 2, dissipated=lossy * rate)  # fmt: skip
