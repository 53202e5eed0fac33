"""Random routes: ropes hauled through bends, straights and gaps in any order."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hypothesis import strategies as st

from tests.hard.drawing import many
from tests.hard.play import Play
from tests.hard.registry import case
from tests.reference.capstan import discrete_tension_ratio

ELEMENT, HOLD = 0.1, 100.0


@dataclass(frozen=True)
class Way:
    """Bends of (degrees, radius in dm, percent of friction), gaps between in dm; hauled in or paid out."""

    drawn: tuple[tuple[int, int, int], ...]
    gap: int
    inboard: bool
    jerk: bool

    @property
    def bends(self) -> list[tuple[int, int, int]]:
        """As many of those drawn as multiply the tension by exp(2) at most, exp(1/2) after a jerk.

        Beyond, the waves of the start are larger than the tension behind the bends, and snap for seconds.
        """
        kept, wrap, most = [], 0.0, 0.5 if self.jerk else 2.0
        for angle, radius, percent in self.drawn:
            wrap += math.radians(angle) * percent / 100
            if wrap > most:
                break
            kept.append((angle, radius, percent))
        return kept

    @property
    def length(self) -> float:
        """Of the route [m]."""
        return 1 + sum(math.radians(a) * r / 10 + self.gap / 10 for a, r, _ in self.bends)

    def netlist(self) -> str:
        """The scene: 2 s, at 0.2 m/s, started within 0.5 s or within 10 ms."""
        stations = ["      - {type: Straight, length: 1 m}"]
        for angle, radius, percent in self.bends:
            stations.append(
                f"      - {{type: Bend, angle: {angle} deg, radius: {radius / 10} m, friction: {percent / 100}}}"
            )
            stations.append(f"      - {{type: Straight, length: {self.gap / 10} m}}")
        speed = -0.2 if self.inboard else 0.2
        over = "10 ms" if self.jerk else "0.5 s"
        return f"""
components:
  rope: {{type: Cable, length: {self.length + 1.5:.3f} m, element: {ELEMENT} m, start: 0 m, tension: {HOLD} N,
         mass: 0.5 kg/m, stiffness: 1 MN}}
  route:
    type: Route
    stations:
{chr(10).join(stations)}
  haul: {{type: MotionSource, velocity: {{ramp: {{to: {speed} m/s, over: {over}}}}}}}
  weight: {{type: ForceSource, force: {HOLD} N}}
connections: [[rope.path, route.path], [haul.flange, rope.inboard], [weight.flange, rope.outboard]]
friction: {{method: hold}}
run: {{stop: 2 s, accuracy: 1e-4}}
record: {{every: 10 ms, signals: ["rope.line[*].tension", haul.force]}}
"""

    def ratio(self) -> tuple[float, float]:
        """What the route multiplies the tension by: exactly, and as a mesh of its elements has it."""
        exact, meshed = 1.0, 1.0
        for angle, radius, percent in self.bends:
            wrap, mu = math.radians(angle), percent / 100
            nodes = max(wrap * radius / 10 / ELEMENT, 1.0)
            exact *= math.exp(mu * wrap)
            meshed *= discrete_tension_ratio(mu, wrap, max(int(nodes), 1))
        return exact, meshed


bends = st.tuples(st.integers(2, 12).map(lambda k: 15 * k), st.integers(6, 20), st.integers(5, 60))
ways = st.builds(
    Way,
    drawn=st.lists(bends, min_size=1, max_size=5).map(tuple),
    gap=st.integers(1, 20), inboard=st.booleans(), jerk=st.booleans(),
)  # fmt: skip


def is_a_capstan(play: Play, way: Way) -> None:
    """Sliding steadily, the haul has the tension of the weight times the product over the bends."""
    result = play.run(way.netlist())
    exact, meshed = way.ratio()
    force = -result["haul.force"][result.t > 1.0].mean()
    low, high = sorted((HOLD * exact, HOLD * meshed))
    if not way.inboard:
        low, high = sorted((HOLD / exact, HOLD / meshed))
    # Waves from the start still run to and fro; over a second they swing about the mean.
    told = f"the haul pulls {force:.1f} N, must be {low:.1f} to {high:.1f} N"
    play.check(low * 0.97 <= force <= high * 1.03, told)
    least = min(result[name].min() for name in result.match("rope.line[*].tension"))
    play.check(least > -1e-6, f"a rope pushes with {-least:.2g} N")


@case(
    {"10": {"examples": 10}},
    engines=("rodas", "stepping", "ida"),
    cost="slow",
    treatments=("hold", "binding"),
    budget=120.0,
)
@case({"100": {"examples": 100}}, engines=("rodas",), cost="slow", treatments=("hold", "binding"), budget=400.0)
def random_routes(play: Play, examples: int) -> None:
    """A rope under 100 N hauled in or paid out at 0.2 m/s round one to five bends of any angle, radius and friction,
    with gaps between, begun gently or with a jerk of 20 m/s^2; drawn from a fixed seed.

    Oracle: in steady sliding the haul pulls 100 N times the product of exp(mu angle) over the bends, or its inverse, up
    to what the mesh makes of it and 3 %; a rope never pushes.
    """
    many(play, ways, is_a_capstan, examples)
