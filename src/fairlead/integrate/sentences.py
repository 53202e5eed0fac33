"""What a run that ended says: what happened, likely causes, what to try."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fairlead.integrate.memory import Memory
from fairlead.integrate.protocol import Block, Problem, Run, Status


def culprits_of(status: Status, memory: Memory, problem: Problem, blocks: Sequence[Block]) -> tuple[str, ...]:
    """Unknowns or machines to look at first."""
    return ()


def sentence_of(status: Status, memory: Memory, problem: Problem, run: Run, culprits: tuple[str, ...]) -> str:
    """One paragraph about the end of the run."""
    return status.name
