"""Which parameter a figure hangs on: indices from the points that `--saltelli` and `--morris` make.

Sobol's first order S_i is the share of the variance that parameter i explains alone, total order T_i that which it
takes part in, by the estimators that Saltelli et al. recommend
(2010, 10.1016/j.cpc.2009.09.018, table 2 b and f),

    S_i = E[f_B (f_ABi - f_A)] / V      T_i = E[(f_A - f_ABi)^2] / (2 V)

of f less its mean, with 95 % intervals by bootstrap. Morris: mean size mu* and spread sigma of elementary effects over
the range (SALib).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fairlead.cases.row import FINISHED
from fairlead.errors import UsageError
from fairlead.studies.pictures.rows import Rows
from fairlead.studies.sweeps.sampling import EDGE_OF_MORRIS, LEVELS, MISSING

RESAMPLES, SEED, ENDS = 200, 0, (2.5, 97.5)


@dataclass(frozen=True)
class Index:
    """Of one parameter: `first` and `total` of Sobol with their 95 % intervals, or mu* and sigma of Morris."""

    parameter: str
    first: float
    total: float
    first_interval: tuple[float, float]
    total_interval: tuple[float, float]


def kind_of(rows: Rows) -> str:
    """`saltelli` or `morris`, "" for another design."""
    sample = rows.heading["design"].get("sample") or {}
    alone = len(rows.heading["parameters"]) == len(sample.get("over", ()))
    return sample["kind"] if alone and sample.get("kind") in ("saltelli", "morris") else ""


def sobol_indices(rows: Rows, figure: str) -> list[Index]:
    """Indices in the order of the parameters. Raises UsageError for rows that are missing or did not finish."""
    names = rows.heading["design"]["sample"]["over"]
    values = _values(rows, figure).reshape(len(names) + 2, -1)
    rng, n = np.random.default_rng(SEED), values.shape[1]
    first, total = _jansen(values)
    again = [_jansen(values[:, rng.integers(0, n, n)]) for _ in range(RESAMPLES)]
    ends = np.percentile(np.array(again), ENDS, axis=0)
    return [Index(name, float(first[k]), float(total[k]), tuple(ends[:, 0, k].tolist()), tuple(ends[:, 1, k].tolist()))
            for k, name in enumerate(names)]  # fmt: skip


def _jansen(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    values = values - values[:2].mean()
    a, b, mixed = values[0], values[1], values[2:]
    variance = np.concatenate([a, b]).var()
    if variance == 0:
        return np.zeros(len(mixed)), np.zeros(len(mixed))
    first = (b * (mixed - a)).mean(axis=1) / variance
    total = ((a - mixed) ** 2).mean(axis=1) / (2 * variance)
    return first, total


def morris_indices(rows: Rows, figure: str) -> list[Index]:
    """mu* (as `total`) with its interval and sigma (as `first`) of each parameter. Raises UsageError."""
    try:
        from SALib.analyze import morris
    except ImportError:
        raise UsageError(MISSING) from None
    from fairlead.studies.sweeps.sampling import points

    sample = rows.heading["design"]["sample"]
    names = sample["over"]
    shares = points("morris", sample["samples"], names, sample["seed"], {})
    problem = {"num_vars": len(names), "names": names, "bounds": [[0.0, 1.0]] * len(names)}
    found = morris.analyze(problem, shares, _values(rows, figure), num_levels=LEVELS, seed=SEED)
    made, whole = [], 1.0 - 2.0 * EDGE_OF_MORRIS  # SALib takes the effects as of steps over the whole range
    for k, name in enumerate(names):
        size, spread, half = (float(found[word][k]) / whole for word in ("mu_star", "sigma", "mu_star_conf"))
        made.append(Index(name, spread, size, (np.nan, np.nan), (size - half, size + half)))
    return made


def _values(rows: Rows, figure: str) -> np.ndarray:
    frame = rows.frame
    lacking = rows.heading["total"] - int(((frame["status"] == FINISHED) & frame[figure].notna()).sum())
    if lacking:
        raise UsageError(f"Indices need every case; {lacking} of {rows.heading['total']} have no {figure}.")
    return frame[figure].to_numpy()
