"""What Python knows of a method of integration; what it does in the loop is in loop.py (Method).

A method of one's own is one file: compiled functions, `METHOD = method_of(OneStep(take, prepare_interpolant))` or a
`Method` of its own, and an `Engine` that names the file. `Run(stop=..., engine=that)` integrates with it: events,
holds, settlements, records and budgets are those of all methods. What `prepare_interpolant` leaves is the D of
point/interpolant.py. What the method remembers of earlier steps it keeps in the arena, in the room for the stages of a
tableau (`method.at_K`), as tests/integrate/bdf2.py does. Steps go with error^-error_exponent, 1/(order of the error +
1): unless `numbers` sets that, it is of the tableau of `rodas` (`Run.method`). A `Method` may choose the length of the
next step itself, and say by which leading error its first step is bounded.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

Advance = Callable[[int, int], int]
"""advance(address of the structs, attempts) -> status: the loop, at work on the memory of a run."""


def nothing_beside(run: Any, problem: Any) -> Mapping[str, float]:
    """No settings but those of all methods."""
    return {}


@dataclass(frozen=True)
class Engine:
    """A method of integration."""

    name: str
    module: str
    """Where `METHOD` is; imported only to compile the loop."""
    sources: tuple[str, ...] = ()
    """What its compiled code is made of beside that of every loop: rooms of this folder, or files by full path."""
    numbers: Callable[[Any, Any], Mapping[str, float]] = nothing_beside
    """numbers(run, instance): single values of the memory that it wants otherwise, by name."""
    loop: Callable[[Any, Any, Any], Advance] | None = None
    """loop(instance, run, memory): what advances a run, for one whose steps are made outside of the compiled loop."""
    plans_contacts: bool = False
    """Knows who holds what and who hands its load to whom (neighbours.py)."""
    works_on_parts: bool = False
    """Keeps nothing of earlier steps but what parts.py carries over."""
    keeps_relations: bool = False
    """Relations of positions are kept."""
    chooses_steps: bool = False
    """Cannot be given a fixed step."""
    not_saved: str = ""
    """Why a run cannot be copied; empty if it can."""
