"""At a point and inside a step: the error norm and the next step, the interpolant, quadratures."""
