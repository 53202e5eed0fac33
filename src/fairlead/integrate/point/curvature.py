"""The size of y'', in weights, beyond what rounding makes of it.

y'' = (J y' + f_t)/M is a difference of large numbers where laws are stiff, and y' = f/M is one before it. A force
of stiffness k between bodies at y is rounded by eps k y, so

    rounding of y'     eps |J| |y| / M
    rounding of y''    |J| (rounding of y') / M

Line that is bound to its drum shows 1000 m/s^3 of this while it goes along. A step size that follows from it would
hang on the order of sums, and be too short besides. What is no larger than its rounding counts as zero, and of what
is larger the rest.
"""

from __future__ import annotations

from fairlead.integrate.linear.products import inertia_of, sizes_through_jacobian
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.controller import weighted_norm

FORCE_ROUNDING = 1e-15
"""Share by which a force is rounded: four to five units in the last place, for those of the terms it is a sum of."""


@compiled
def curvature_beyond_rounding(point, matrices):
    """Weighted norm of y'' of the differential unknowns, less rounding; J and M are those of the point."""
    n = point.n
    y, curvature, differential = reals(point.at_y, n), reals(point.at_curvature, n), indices(point.at_differential, n)
    of_y, of_slope, of_curvature = reals(point.at_u, n), reals(point.at_v, n), reals(point.at_x, n)
    for k in range(n):
        of_y[k] = FORCE_ROUNDING * abs(y[k])
    sizes_through_jacobian(matrices, point.at_u, point.at_v)
    for k in range(n):
        of_slope[k] = of_slope[k] / inertia_of(matrices, k) if differential[k] == 1 else 0.0
    sizes_through_jacobian(matrices, point.at_v, point.at_x)
    beyond = of_y
    for k in range(n):
        beyond[k] = 0.0
        if differential[k] == 1 and curvature[k] != 0.0:
            beyond[k] = max(abs(curvature[k]) - of_curvature[k] / inertia_of(matrices, k), 0.0)
            if not beyond[k] >= 0.0:
                beyond[k] = curvature[k]
    return weighted_norm(point, point.at_u)
