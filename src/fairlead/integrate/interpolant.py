"""The solution inside a step: y(theta) for 0 <= theta <= 1, from the dense output of the method."""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, reals


@compiled
def prepare_interpolant(m):
    """D_r = sum_i H_ri K_i, once for an accepted step."""
    n, stages = m.n, m.stages
    D, K, H = reals(m.at_D, 3 * n), reals(m.at_K, stages * n), reals(m.at_H, 3 * stages)
    for r in range(3):
        D[r * n : (r + 1) * n] = 0.0
        for i in range(stages):
            factor = H[r * stages + i]
            if factor != 0.0:
                for k in range(n):
                    D[r * n + k] += factor * K[i * n + k]


@compiled
def interpolate(m, theta, at_result):
    """Write y(theta) = (1 - theta) y0 + theta (y1 + (1 - theta)(D_0 + theta (D_1 + theta D_2)))."""
    n = m.n
    y, y_end, D, result = reals(m.at_y, n), reals(m.at_y_end, n), reals(m.at_D, 3 * n), reals(at_result, n)
    rest = 1.0 - theta
    for k in range(n):
        inner = D[k] + theta * (D[n + k] + theta * D[2 * n + k])
        result[k] = rest * y[k] + theta * (y_end[k] + rest * inner)
