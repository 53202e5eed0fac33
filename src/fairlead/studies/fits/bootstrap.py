"""The bootstrap of a fit: what z would have been, had the residuals come in another order.

Blocks of residuals are drawn anew within each group (Kuensch, Ann. Statist. 17:1217, 1989), round in a circle, so that
noise may hang together over a block. From the solution one Gauss-Newton step is taken for each draw. How long blocks
must be, the residuals themselves say: with R(k) their covariance at lag k,

    length = (3/2 G^2/g^2 n)^(1/3)    g = sum of R(k),   G = sum of |k| R(k)

summed to twice the lag from which on R is none (Politis, White, Econom. Rev. 23:53, 2004; corrected by Patton, Politis,
White, 28:372, 2009). Features have no order: they are drawn one by one.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fairlead.studies.fits.known import Spread

Floats = NDArray[np.float64]
DRAWS = 400
FEW = 40
"""Residuals up to which whole draws have either sign: there are too few ways to draw them."""
SIGNIFICANT = 2.0
"""Of a correlation, in sqrt(log10(n)/n), as in the paper."""


def changes_of_z(spread: Spread, lengths: list[int], seed: int) -> Floats:
    """Changes of z by the bootstrap, shape (DRAWS, parameters); `lengths` of blocks, by group."""
    chance = np.random.default_rng(seed)
    made = np.empty((DRAWS, len(spread.gain)))
    taken = np.empty_like(spread.draw)
    for draw in range(DRAWS):
        for one, length in zip(spread.groups, lengths, strict=True):
            size = len(one.at)
            firsts = chance.integers(0, size, -(-size // length))
            taken[one.at] = spread.draw[one.at[((firsts[:, None] + np.arange(length)) % size).ravel()[:size]]]
        sign = chance.choice([-1.0, 1.0]) if len(taken) < FEW else 1.0
        made[draw] = spread.gain @ (sign * taken)
    return made


def block_lengths(spread: Spread) -> list[int]:
    """How many residuals are drawn together, by group."""
    return [block_length(spread.draw[one.at]) if one.in_order else 1 for one in spread.groups]


def block_length(series: Floats) -> int:
    """For residuals at successive times: 1 where they are not correlated, at most a third of them."""
    n, away = len(series), series - series.mean()
    if n < 3 or not away.any():
        return 1
    run = max(5, math.ceil(math.sqrt(math.log10(n))))
    most = min(math.ceil(math.sqrt(n)) + run, n - 1)
    covariance = np.array([away[: n - k] @ away[k:] for k in range(most + 1)]) / n
    little = np.abs(covariance[1:]) < SIGNIFICANT * math.sqrt(math.log10(n) / n) * covariance[0]
    quiet = (k for k in range(len(little)) if little[k : k + run].all())
    lags = min(2 * max(next(quiet, most), 1), most)
    k = np.arange(1, lags + 1)
    window = np.minimum(1.0, 2.0 * (1.0 - k / lags)) * covariance[1 : lags + 1]
    whole, moment = covariance[0] + 2.0 * window.sum(), 2.0 * (k * window).sum()
    longest = math.ceil(min(3.0 * math.sqrt(n), n / 3))
    if whole <= 0.0:
        return longest if moment > 0.0 else 1
    return int(np.clip(round((1.5 * (moment / whole) ** 2 * n) ** (1 / 3)), 1, longest))
