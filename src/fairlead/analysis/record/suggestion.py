"""What a signal name that does not exist may have meant."""

from __future__ import annotations

import re
from collections.abc import Sequence

from fairlead.errors import did_you_mean, listing


def suggest(pattern: str, names: Sequence[str]) -> tuple[str, str]:
    """The sentence "Did you mean ...?" for a name that no signal has, and what its component does give."""
    owner, _, last = pattern.rpartition(".")
    here = [name.rpartition(".")[2] for name in names if name.rpartition(".")[0] == owner]
    if owner and here:
        return did_you_mean(last, here).replace("mean ", f"mean {owner}."), f"{owner} gives {listing(here)}."
    if "*" in pattern:  # as it could have been written: every number of a list is a *
        names = sorted({re.sub(r"\[\d+\]", "[*]", name) for name in names})
    near = did_you_mean(pattern, names)
    if not near and owner:
        near = did_you_mean(owner, {name.rpartition(".")[0] for name in names}).replace("?", f".{last}?")
    return near, ""
