"""How a line lies on a drum: layers, wraps, and the radius over what is wound on."""

from __future__ import annotations

import math
from dataclasses import dataclass

from fairlead.component.piecewise import PiecewisePolynomial, constant, linear_table

NESTED = math.sqrt(3) / 2  # rise of a layer that lies in the grooves of the one below, in diameters
MOST_LAYERS = 200


@dataclass(frozen=True)
class Layers:
    """A drum of `radius` and `width` that takes a line of `diameter`; `height` is the depth of its flanges."""

    radius: float
    diameter: float
    width: float
    nested: bool = True
    height: float | None = None

    @property
    def wraps(self) -> int:
        """Whole turns of one layer."""
        return int(self.width / self.diameter + 1e-9)

    @property
    def rise(self) -> float:
        """How much higher a layer lies than the one below [m]."""
        return self.diameter * (NESTED if self.nested else 1.0)

    def layer_radius(self, layer: int) -> float:
        """Radius of the middle of the line in a layer, from 0 [m]."""
        return self.radius + self.diameter / 2 + layer * self.rise

    def layer_length(self, layer: int) -> float:
        """Line in one full layer [m]."""
        return 2 * math.pi * self.layer_radius(layer) * self.wraps

    @property
    def most(self) -> int:
        """How many layers fit below the edge of the flange."""
        if self.height is None:
            return MOST_LAYERS
        layers = (self.height - self.diameter) / self.rise + 1e-9
        return int(min(layers, MOST_LAYERS - 1)) + 1 if self.height >= self.diameter else 0

    @property
    def capacity(self) -> float:
        """Line that fits on the drum [m]."""
        return sum(map(self.layer_length, range(self.most))) if self.wraps else 0.0

    def filled(self, length: float) -> tuple[int, float]:
        """The layer in which a length of line ends, and how much lies in it [m]."""
        layer = 0
        while length > self.layer_length(layer) and layer < MOST_LAYERS:
            length -= self.layer_length(layer)
            layer += 1
        return layer, length

    def radius_at(self, length: float) -> float:
        """Radius at which the line comes off when so much is wound on [m]."""
        return self.layer_radius(self.filled(max(length, 0.0))[0])

    def turns(self, length: float) -> float:
        """Turns of the drum that a length of line takes."""
        layer, rest = self.filled(max(length, 0.0))
        return layer * self.wraps + rest / (2 * math.pi * self.layer_radius(layer))

    def over_angle(self, wound: float, crossover: float) -> PiecewisePolynomial:
        """Radius over the angle paid out since so much was wound on [m over rad].

        Steps from layer to layer are straight lines over the angle `crossover` round the end of a layer, so that
        the radius has a slope everywhere.
        """
        now = self.turns(wound)
        last = min(self.filled(wound)[0] + 2, MOST_LAYERS)
        half, x, y = crossover / 2, [], []
        for border in range(last, 0, -1):
            angle = 2 * math.pi * (now - border * self.wraps)  # paid out when layer `border` is just empty
            x += [angle - half, angle + half]
            y += [self.layer_radius(border), self.layer_radius(border - 1)]
        return linear_table(x, y) if x else constant(self.layer_radius(0))
