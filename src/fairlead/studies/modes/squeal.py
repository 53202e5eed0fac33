"""Where does it squeal? Patterns in which up to k contacts change between holding and sliding, the least damped first.

A contact that starts to slide is linearised where it stands: its friction has the slope over speed at the speed it has
there, which is 0 for one that held.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import FairleadError
from fairlead.studies.modes.linear import SingularError, equations, linear
from fairlead.studies.modes.pattern import Known
from fairlead.studies.modes.spectrum import Mode, modes_of

Integers = NDArray[np.int64]
MOST_PATTERNS = 5000


@dataclass(frozen=True)
class Pattern:
    """Zones, what changed in them against the first pattern, and the mode with the least damping.

    `mode` is None where there is no mode but rest, or `sentence` says why there is none.
    """

    changes: tuple[str, ...]
    zones: Integers
    mode: Mode | None
    sentence: str = ""

    @property
    def damping(self) -> float:
        """Of the least damped mode; infinite where there is none."""
        return math.inf if self.mode is None else self.mode.damping


def ranked(known: Known, zones: Integers, most: int) -> list[Pattern]:
    """All patterns of up to `most` changed contacts. Raises FairleadError for too many."""
    contacts = known.contacts
    count = sum(math.comb(len(contacts), k) for k in range(most + 1))
    if count > MOST_PATTERNS:
        raise FairleadError(f"{len(contacts)} contacts, up to {most} of them changed, make {count} patterns; "
                            f"{MOST_PATTERNS} are taken.\n    Ask for fewer.")  # fmt: skip
    made = [_pattern(known, zones, changed) for k in range(most + 1) for changed in itertools.combinations(contacts, k)]
    return sorted(made, key=lambda one: one.damping)


def _pattern(known: Known, zones: Integers, changed: tuple[int, ...]) -> Pattern:
    made, words = zones.copy(), []
    for machine in changed:
        ways = [zone for zone in (known.held(machine), known.sliding(machine)) if zone is not None]
        made[machine] = ways[1] if zones[machine] == ways[0] else ways[0]
        zone = known.instance.zone_names(machine)[int(made[machine])]
        words.append(f"{known.instance.machine_names[machine]} {zone}")
    try:
        modes, _ = modes_of(linear(equations(known.instance, known.t, known.y, made)))
    except SingularError as error:
        return Pattern(tuple(words), made, None, str(error))
    return Pattern(tuple(words), made, min(modes, key=lambda one: one.damping, default=None))
