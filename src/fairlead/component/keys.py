"""Keys: what a symbol of a traced law stands for. The text is the symbol's name, and what machine code is stored with.

    port:a:v           of the port a: x position or potential, v rate, a acceleration, A prescribed one, R reaction,
                       U acceleration as an unknown (or the prescribed one)
    own:force          a state or unknown of the component's own
    in:normal          an input; in:normal:rate how fast it changes
    p:stiffness        a parameter, also of a part (p:curve.coulomb); p:#held a discrete variable
    p:velocity:omega   what a quantity in time swings with
    T:curve:0          of the table `curve`, the piece in force: 0 where it begins, k its coefficient number k - 1
    t                  time
    rate:a             of what a kernel adds up: the rate of what the port a takes in

Names are those of Python and dots, so a colon always parts. Nothing else takes a key apart.
"""

from __future__ import annotations

import functools
from typing import NamedTuple

PORT, OWN, INPUT, PARAMETER, TABLE, TIME, RATE = "port", "own", "in", "p", "T", "t", "rate"
TAU = "@tau"
"""A kernel reads it as a parameter that no component gives: the time constant of hold rows, a setting of the run."""


def rate_of(output: str) -> str:
    """The name of the signal that tells how fast an output changes."""
    return f"{output}@{RATE}"


class Key(NamedTuple):
    """A key in its parts; `part` is empty where nothing is asked of the name."""

    kind: str
    name: str = ""
    part: str = ""

    @property
    def is_speed(self) -> bool:
        """True for the rate of a port."""
        return self.kind == PORT and self.part == "v"

    @property
    def is_late(self) -> bool:
        """True for what is known only after the forces: an acceleration or a reaction."""
        return self.kind == PORT and self.part in ("a", "R")

    @property
    def is_discrete(self) -> bool:
        """True for a variable that changes at sample times."""
        return self.kind == PARAMETER and self.name[0] == "#"

    @property
    def is_fixed(self) -> bool:
        """True for what does not change within a run."""
        return self.kind == PARAMETER and not self.is_discrete

    @property
    def number(self) -> str:
        """A parameter as a kernel lists it: without its kind."""
        return f"{self.name}:{self.part}" if self.part else self.name


@functools.cache
def key(text: str) -> Key:
    """The parts of a key, or of the name of a symbol."""
    kind, _, rest = text.partition(":")
    name, _, part = rest.partition(":")
    return Key(kind, name, part)
