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

from fairlead.integrate.linear.products import sizes_through_jacobian
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.controller import weighted_norm
from fairlead.integrate.point.meters import inertia_of

ROUNDED = 1e-15
"""Share by which a force is rounded: four to five units in the last place, for those of the terms it is a sum of."""


@compiled
def bend_beyond_rounding(point, matrices):
    """Weighted norm of y'' of the differential unknowns, less rounding; J and M are those of the point."""
    n = point.n
    y, curvature, differential = reals(point.at_y, n), reals(point.at_curvature, n), indices(point.at_differential, n)
    once, twice, u = reals(point.at_v, n), reals(point.at_x, n), reals(point.at_u, n)
    for k in range(n):
        u[k] = ROUNDED * abs(y[k])
    sizes_through_jacobian(matrices, point.at_u, point.at_v)
    for k in range(n):
        once[k] = once[k] / inertia_of(matrices, k) if differential[k] == 1 else 0.0
    sizes_through_jacobian(matrices, point.at_v, point.at_x)
    for k in range(n):
        u[k] = 0.0
        if differential[k] == 1 and curvature[k] != 0.0:
            u[k] = max(abs(curvature[k]) - twice[k] / inertia_of(matrices, k), 0.0)
            if not u[k] >= 0.0:
                u[k] = curvature[k]
    return weighted_norm(point, point.at_u)
