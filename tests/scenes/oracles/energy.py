"""Energy: what is stored at the end is what was there, and came in, less what friction and impacts took.

It sees forces that do work nobody books, losses that are booked twice, impacts that gain, states carried over an
event wrongly. It cannot see a law that is wrong and booked as it is (a friction of twice the coefficient closes), nor
a wrong choice between two motions that both keep energy.
"""

from __future__ import annotations

import numpy as np

from tests.scenes.observed import Observed

PER_ACCURACY = 10.0
NOMINAL = 0.1  # J; 10 N times 10 mm, the sizes that the accuracy of a run refers to


def energy(run: Observed) -> str:
    """What is wrong with the energy; nothing if it adds up to ten accuracies of what passed."""
    booked = run.energy
    if booked.get("closure") is None:
        return "" if booked.get("supplied") is not None else "the run tells no energy"
    missing = abs(booked["stored_change"] + booked["dissipated"] - booked["supplied"])
    passed = missing / booked["closure"] if booked["closure"] > 0 else 0.0
    allowed = PER_ACCURACY * run.accuracy * max(passed, NOMINAL)
    if missing > allowed:
        return f"energy: {missing:.2g} J of {passed:.2g} J are missing, allowed {allowed:.2g} J"
    back = -float(np.diff(run.columns["energy.dissipated"]).min(initial=0.0))
    return f"energy: friction gave {back:.2g} J back" if back > allowed else ""
