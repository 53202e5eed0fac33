"""The rule of Illinois, by which a bracket round a zero closes from both ends (Dowell, Jarratt, BIT 11:168, 1971).

The next point is where the secant through both ends is zero. Of a value that is curved one end would stay for ever: one
that stays a second time counts half, a third time a quarter. The values themselves are the business of who searches.
"""

from __future__ import annotations

from fairlead.integrate.memory.foreign import compiled

LEFT, RIGHT = -1, 1
"""Which end of the bracket moved."""


@compiled
def shares_of_ends(left, right, last, moved):
    """Shares to which the values at both ends count, after `moved` has become a new point as `last` did before."""
    if moved == RIGHT:
        return (0.5 * left if last == RIGHT else 1.0), 1.0
    return 1.0, (0.5 * right if last == LEFT else 1.0)
