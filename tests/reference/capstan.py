"""A rope round a bend: tension grows by exp(mu theta), whatever the radius.

A piece d(theta) of rope under tension T presses on the guide with T d(theta). If it slides, friction mu T
d(theta) opposes it, so dT/d(theta) = mu T and T_pull = T_hold exp(mu theta). The radius does not appear:
a smaller bend presses harder on less length. At rest any ratio between exp(-mu theta) and exp(mu theta)
is possible; which one there is depends on history.

Cut into n straight elements of the angle d = theta/n each node carries the mean tension of its two
neighbours, T_{i+1} - T_i = mu d (T_i + T_{i+1})/2, so every node multiplies the tension by (1 + mu
d/2)/(1 - mu d/2): the trapezoid rule for dT/d(theta) = mu T. Its logarithm is mu d + (mu d)^3/12 + ...,
hence the relative error n (mu d)^3/12, falling with the square of the element length; and the rule exists
only while mu d < 2.

Source: Euler (1762) and Eytelwein (1808); physics section 8 item 9.
"""

import numpy as np


def tension_ratio(friction: float, angle: float) -> float:
    """T_pull/T_hold [-] of a rope sliding over the wrap `angle` [rad] with coefficient `friction` [-]."""
    return float(np.exp(friction * angle))


def discrete_tension_ratio(friction: float, angle: float, nodes: int) -> float:
    """The same ratio [-] on `nodes` nodes, each with the mean of its neighbours' tensions.

    Raises ValueError when mu d >= 2: then no positive tension balances a node.
    """
    half = 0.5 * friction * angle / nodes
    if half >= 1.0:
        raise ValueError("an element turns too much for this friction: mu d(theta) must stay below 2")
    return float(((1.0 + half) / (1.0 - half)) ** nodes)


def discrete_error(friction: float, angle: float, nodes: int) -> float:
    """Leading term n (mu d)^3/12 [-] of the relative error of the discrete ratio."""
    return nodes * (friction * angle / nodes) ** 3 / 12.0


def tension_along(hold: float, friction: float, angle: np.ndarray) -> np.ndarray:
    """Tension [N] at each `angle` [rad] from the held end, sliding towards larger angles."""
    return hold * np.exp(friction * np.asarray(angle, dtype=float))
