"""The solution inside a step: y(theta) for 0 <= theta <= 1, from the dense output of the method.

y(theta) = (1 - theta) y0 + theta (y1 + (1 - theta)(D_0 + theta (D_1 + theta D_2)))
"""

from __future__ import annotations

from fairlead.integrate.memory.foreign import compiled, reals


@compiled
def interpolate(point, theta, at_result):
    """Write y(theta) = (1 - theta) y0 + theta (y1 + (1 - theta)(D_0 + theta (D_1 + theta D_2)))."""
    n = point.n
    y, y_end, D, result = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_D, 3 * n), reals(at_result, n)
    rest = 1.0 - theta
    for k in range(n):
        inner = D[k] + theta * (D[n + k] + theta * D[2 * n + k])
        result[k] = rest * y[k] + theta * (y_end[k] + rest * inner)
