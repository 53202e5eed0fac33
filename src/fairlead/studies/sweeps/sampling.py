"""Points in the unit cube for samples, one row each, by seed.

Latin hypercubes and Sobol's sequence (scrambled) are those of scipy.stats.qmc. Monte Carlo has independent points, or
such with rank correlations of a Gaussian copula: u = Phi(L z), with L L' the matrix of correlations r of z that give
the rank correlation rho, r = 2 sin(pi rho / 6) (Kruskal 1958). Saltelli's points are A, B and A with one column of B
each, for Sobol's indices (Saltelli et al. 2010, 10.1016/j.cpc.2009.09.018); Morris' are trajectories (SALib).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import UsageError

Floats = NDArray[np.float64]
KINDS = ("latin_hypercube", "sobol", "monte_carlo", "saltelli", "morris")
LEVELS = 4  # of Morris' grid, as he proposes (Technometrics 33, 1991)
EDGE = 1e-12  # a share of 0 or 1 may be infinite in a distribution without ends


def points(
    kind: str, samples: int, names: Sequence[str], seed: int, correlations: Mapping[tuple[str, str], float]
) -> Floats:
    """[rows, names] in (0, 1). Raises UsageError for correlations that cannot be, or what is not installed."""
    d = len(names)
    from scipy.stats import qmc

    if kind == "latin_hypercube":
        found = qmc.LatinHypercube(d, rng=np.random.default_rng(seed)).random(samples)
    elif kind == "sobol":
        found = _sobol(samples, d, seed)
    elif kind == "saltelli":
        both = _sobol(samples, 2 * d, seed)
        a, b = both[:, :d], both[:, d:]
        mixed = [np.where(np.arange(d) == j, b, a) for j in range(d)]
        found = np.concatenate([a, b, *mixed])
    elif kind == "morris":
        found = _morris(samples, names, seed)
    else:
        z = np.random.default_rng(seed).standard_normal((samples, d)) @ _factor(names, correlations).T
        from scipy.special import ndtr

        found = ndtr(z)
    return np.clip(found, EDGE, 1 - EDGE)


def _sobol(samples: int, d: int, seed: int) -> Floats:
    """A power of two has the balance that the sequence is taken for; of other numbers the first so many points."""
    from scipy.stats import qmc

    power = math.ceil(math.log2(max(samples, 2)))
    found: Floats = qmc.Sobol(d, rng=np.random.default_rng(seed)).random_base2(power)[:samples]
    return found


def _morris(trajectories: int, names: Sequence[str], seed: int) -> Floats:
    try:
        from SALib.sample import morris
    except ImportError:
        raise UsageError(MISSING) from None
    problem = {"num_vars": len(names), "names": list(names), "bounds": [[0.0, 1.0]] * len(names)}
    found: Floats = morris.sample(problem, trajectories, num_levels=LEVELS, seed=seed)
    return EDGE_OF_MORRIS + (1 - 2 * EDGE_OF_MORRIS) * found


EDGE_OF_MORRIS = 0.005
"""Morris' grid touches 0 and 1, where a distribution without ends has no value."""
MISSING = "Morris' points need SALib, which is not installed.\n    Install it: pip install 'fairlead[sweep]'"


def _factor(names: Sequence[str], correlations: Mapping[tuple[str, str], float]) -> Floats:
    matrix = np.eye(len(names))
    for (one, other), rank in correlations.items():
        i, j = names.index(one), names.index(other)
        matrix[i, j] = matrix[j, i] = 2 * math.sin(math.pi * rank / 6)
    try:
        return np.asarray(np.linalg.cholesky(matrix), dtype=np.float64)
    except np.linalg.LinAlgError:
        told = ", ".join(f"{one}~{other}={r:g}" for (one, other), r in correlations.items())
        raise UsageError(
            f"No parameters have all these correlations at once: {told}.\n    Make some smaller."
        ) from None
