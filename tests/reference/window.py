"""The trapezoid window: how much of a device a travelling node feels, and why the sum never changes.

A device stands on [s_a, s_b]; nodes travel through it. If a node were either in or out, the number of
nodes inside, and with it the force, would jump by one element again and again. So a node enters
gradually, over an edge e,

    W(s) = ramp((s - s_a)/e) ramp((s_b - s)/e),          ramp(q) = clip(q + 1/2, 0, 1).

W is the box [s_a, s_b] smeared by a box of width e. Nodes stand at a pitch l; if e is a whole number of
pitches, every point of the device is covered by exactly e/l smeared nodes at any time, so the sum of
l W(s_i) is s_b - s_a for every phase of the chain: a partition of unity. With e = l, W is simply the share
of the element that lies inside the device. Any other edge lets the sum, and the tension, ripple at the
frequency with which elements pass.

Source: the partition-of-unity property of B-splines (box convolved with box); physics sections 4.0 and 8
item 33. Valid for s_b - s_a >= e.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray


def ramp(q: ArrayLike) -> NDArray[np.float64]:
    """clip(q + 1/2, 0, 1) [-]."""
    return np.clip(np.asarray(q, dtype=float) + 0.5, 0.0, 1.0)


def weight(position: ArrayLike, start: float, end: float, edge: float) -> NDArray[np.float64]:
    """W [-] at each `position` [m] of a device on [start, end] [m] with the given `edge` [m]."""
    s = np.asarray(position, dtype=float)
    return ramp((s - start) / edge) * ramp((end - s) / edge)


def window_sum(start: float, end: float, edge: float, pitch: float, phase: float) -> float:
    """Sum of pitch * W over an endless chain of nodes at `phase` + i `pitch` [m]."""
    first = np.floor((start - edge - phase) / pitch)
    last = np.ceil((end + edge - phase) / pitch)
    nodes = phase + pitch * np.arange(first, last + 1)
    return float(pitch * weight(nodes, start, end, edge).sum())


def exact_sum(start: float, end: float) -> float:
    """What the sum is when `edge` is a whole number of pitches [m]: the length of the device."""
    return end - start
