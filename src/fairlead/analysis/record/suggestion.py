"""What a signal name that does not exist may have meant."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from fairlead.component.bundled import PACKAGE
from fairlead.errors import did_you_mean, listing

if TYPE_CHECKING:
    from fairlead.component.assembly import Assembly


def inside(assembly: Assembly, pattern: str) -> str:
    """What to do about the name of a state, an unknown or a parameter of a component, which are no signals; or ""."""
    owner, _, last = pattern.rpartition(".")
    values = assembly.entries.get(owner) or assembly.instances.get(owner)
    if values is None:
        return ""
    declared, kind = values.type.declaration, values.type.__name__
    sorts: dict[str, Mapping[str, object]] = {
        "state": declared.states, "discrete variable": declared.discrete, "unknown": declared.unknowns,
    }  # fmt: skip
    for sort, names in sorts.items():
        if last in names:
            a = "an" if sort == "unknown" else "a"
            own = "" if values.type.__module__.startswith(PACKAGE) else f": declare an Output in {kind}, and give it"
            return f"{last} is {a} {sort} of {kind}, which is no signal{own}."
    return f"{last} is a parameter of {kind}, which is no signal." if last in declared.parameters else ""


def suggest(pattern: str, names: Sequence[str]) -> tuple[str, str]:
    """The sentence "Did you mean ...?" for a name that no signal has, and what its component does give."""
    if pattern.lower() in ("all", "everything", "any"):
        return "", 'All signals are "*".'
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
