"""Rows of two runs of which one leaves out what is carried along: their events, and so their other rows, differ."""

import numpy as np


def on_the_grid(result, name):
    """Values [k] of a signal where no event was."""
    grid = np.flatnonzero(np.isclose(result.t / 0.05, np.round(result.t / 0.05), atol=1e-7))
    first = np.unique(np.round(result.t[grid] / 0.05), return_index=True)[1]
    return np.asarray(result[name])[grid[first]]
