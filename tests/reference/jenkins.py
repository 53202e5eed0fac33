"""A spring and a contact in series (Jenkins' element), driven to and fro: the play operator, in closed form.

The node between them follows the drive at a distance of at most d = F/k, and rests while the distance is less
(Krasnosel'skii, Pokrovskii 1989; Iwan, J. Appl. Mech. 33:893, 1966): from one turn of the drive to the next

    x = max(x_at_turn, h - d)  as h rises,      x = min(x_at_turn, h + d)  as h falls,      force = k (h - x)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def turns_of_sine(pace: float, stop: float) -> Floats:
    """The instants from 0 to `stop` between which sin(pace t) does not turn."""
    inner = (np.arange(int(stop * pace / np.pi) + 2) + 0.5) * np.pi / pace
    return np.array([0.0, *inner[inner < stop], stop])


def force(t: Floats, drive: Floats, at_turns: Floats, turns: Floats, stiffness: float, limit: float) -> Floats:
    """Force of the element at times t, where the drive is `drive`; it turns at `turns`, where it is `at_turns`."""
    node, found = at_turns[0], np.full_like(t, np.nan)
    for begin, end, before, after in zip(turns[:-1], turns[1:], at_turns[:-1], at_turns[1:], strict=True):
        here, sense = (t >= begin - 1e-12) & (t <= end + 1e-12), np.sign(after - before)
        follow = sense * np.maximum(sense * node, sense * drive[here] - limit / stiffness)
        found[here] = stiffness * (drive[here] - follow)
        node = sense * max(sense * node, sense * after - limit / stiffness)
    return found
