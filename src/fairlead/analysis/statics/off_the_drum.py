"""The speed of a line that a drum with layers gives: its radius follows what is wound, so the angle it has turned."""

from __future__ import annotations

import numpy as np

from fairlead.analysis.statics.schedule import LOOKS
from fairlead.component.piecewise import PiecewisePolynomial, linear_table
from fairlead.component.values import Wave
from fairlead.component.wave import times


def line_speed(drum: Wave, radius: PiecewisePolynomial, begin: float, end: float) -> Wave:
    """Speed of the line [m/s] from that of a drum [rad/s], whose radius [m] is known over the angle paid out [rad].

    The radius is taken over time in straight lines, between its corners, those of the speed, and 2000 looks. So is a
    speed of a degree above two: times the radius its way could not be written in pieces.
    """
    corners = [t for t in drum.borders if begin < t < end]
    looks = np.union1d(np.linspace(begin, end, LOOKS), corners)
    if drum.polynomial.rows[:, 6:].any():
        drum = Wave(linear_table(looks.tolist(), [drum(float(t)) for t in looks]))
    angle = drum.integral(begin)
    turned = np.array([angle(float(t)) for t in looks])
    at = np.union1d(looks, [t for border in radius.rows[1:, 0] for t in _crossings(looks, turned, float(border))])
    wound = np.array([radius(angle(float(t))) for t in at])
    changes = np.diff(wound) != 0.0
    kept = np.flatnonzero(np.concatenate([[True], changes]) | np.concatenate([changes, [True]]))
    return times(drum, Wave(linear_table(at[kept].tolist(), wound[kept].tolist())))


def _crossings(t: np.ndarray, x: np.ndarray, level: float) -> list[float]:
    """Where x, straight between its values at t, goes through a level."""
    k = np.flatnonzero((x[:-1] - level) * (x[1:] - level) < 0.0)
    return (t[k] + (t[k + 1] - t[k]) * (level - x[k]) / (x[k + 1] - x[k])).tolist()
