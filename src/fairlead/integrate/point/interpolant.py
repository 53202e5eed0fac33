"""The solution inside a step: y(s) for 0 <= s <= 1, from the dense output of the method.

y(s) = (1 - s) y0 + s (y1 + (1 - s)(D_0 + s (D_1 + s D_2)))
"""

from __future__ import annotations

from fairlead.integrate.memory.foreign import compiled, reals


@compiled
def interpolate(point, s, at_result):
    """Write y(s) = (1 - s) y0 + s (y1 + (1 - s)(D_0 + s (D_1 + s D_2)))."""
    n = point.n
    y, y_end, D, result = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_D, 3 * n), reals(at_result, n)
    rest = 1.0 - s
    for k in range(n):
        inner = D[k] + s * (D[n + k] + s * D[2 * n + k])
        result[k] = rest * y[k] + s * (y_end[k] + rest * inner)


@compiled
def interpolate_one(point, s, k):
    """y_k(s), as `interpolate` writes it."""
    n = point.n
    D = reals(point.at_D, 3 * n)
    inner = D[k] + s * (D[n + k] + s * D[2 * n + k])
    return (1.0 - s) * reals(point.at_y, n)[k] + s * (reals(point.at_y_end, n)[k] + (1.0 - s) * inner)
