"""How much y'' bends, in weights, beyond what rounding makes of it.

y'' = (J y' + f_t)/M is a difference of large numbers where laws are stiff, and y' = f/M is one before it. A force
of stiffness k between bodies at y is rounded by eps k y, so

    rounding of y'     eps |J| |y| / M
    rounding of y''    |J| (rounding of y') / M

Line that is bound to its drum shows 1000 m/s^3 of this while it goes along. A step size that follows from it would
hang on the order of sums, and be too short besides. What is no larger than its rounding counts as zero, and of what
is larger the rest.
"""

from __future__ import annotations

from fairlead.integrate.controller import weighted_norm
from fairlead.integrate.foreign import compiled, indices, reals
from fairlead.integrate.meters import inertia_of

ROUNDED = 1e-15
"""Share by which a force is rounded: four to five units in the last place, for those of the terms it is a sum of."""


@compiled
def bend_beyond_rounding(m):
    """Weighted norm of y'' of the differential unknowns, less rounding; J and M are those of the point."""
    n = m.n
    y, curvature, differential = reals(m.at_y, n), reals(m.at_curvature, n), indices(m.at_differential, n)
    once, twice, u = reals(m.at_v, n), reals(m.at_x, n), reals(m.at_u, n)
    for k in range(n):
        u[k] = ROUNDED * abs(y[k])
    through_jacobian(m, m.at_u, m.at_v)
    for k in range(n):
        once[k] = once[k] / inertia_of(m, k) if differential[k] == 1 else 0.0
    through_jacobian(m, m.at_v, m.at_x)
    for k in range(n):
        u[k] = 0.0
        if differential[k] == 1 and curvature[k] != 0.0:
            u[k] = max(abs(curvature[k]) - twice[k] / inertia_of(m, k), 0.0)
            if not u[k] >= 0.0:
                u[k] = curvature[k]
    return weighted_norm(m, m.at_u)


@compiled
def through_jacobian(m, at_from, at_to):
    """Set to = |J| from."""
    starts, rows = indices(m.at_jacobian_starts, m.n + 1), indices(m.at_jacobian_rows, m.n_jacobian)
    slopes, given, to = reals(m.at_jacobian, m.n_jacobian), reals(at_from, m.n), reals(at_to, m.n)
    to[:] = 0.0
    for k in range(m.n):
        if given[k] != 0.0:
            for p in range(starts[k], starts[k + 1]):
                to[rows[p]] += abs(slopes[p]) * given[k]
