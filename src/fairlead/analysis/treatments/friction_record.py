"""What a run keeps of how its friction is treated, and who chose that; and the sentence of the closing table."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from pathlib import PurePath
from typing import Any

from fairlead.analysis.treatments.treatments import contacts, creep_of, head_of
from fairlead.errors import Location
from fairlead.netlist.netlist import Netlist, Value

NO_FILE = ("--set", "set")
"""What values of the command line, and of `load(set=...)` and `with_values`, are said to stand in."""


def friction_record(flat: Any) -> dict[str, Any] | None:
    """Contacts by treatment, who chose it, and the smallest creep [m/s] of those that creep; None without contacts."""
    model = _Scene(flat)
    found = contacts(model)
    if not found:
        return None
    words = Counter(one.type.word for one in found)
    heads = {head_of(one.type) for one in found}
    creeps = {one.type.word for one in found if one.type.answers.creeps}
    return {
        "contacts": dict(words.most_common()), "by": _chooser(flat.assembly.netlist, {head.key for head in heads}),
        "default": all(words.keys() == {head.default_word} for head in heads),
        "exact": all(one.type.answers.exact for one in found), "creep": creep_of(model) if creeps else None,
    }  # fmt: skip


class _Scene:
    """A flat model as a Model shows it."""

    def __init__(self, flat: Any) -> None:
        self.flat, self.netlist = flat, flat.assembly.netlist


def _chooser(netlist: Netlist, keys: set[str]) -> str:
    """Where the treatment is written: a place in a file, the command line; "" where nobody chose."""
    found = [value for key in keys if (value := netlist.friction.get(key)) is not None]
    found += [value for entry in netlist.components.values() for key in keys
              if (value := entry.parameters.get(key)) is not None and isinstance(value.content, str)]  # fmt: skip
    places = dict.fromkeys(_place(netlist, value) for value in found)
    return ", ".join(list(places)[:2]) + (" and other places" if len(places) > 2 else "")


def _place(netlist: Netlist, value: Value) -> str:
    """Of a value that is a scene parameter, where that was given."""
    named = re.fullmatch(r"\{(\w+)\}", value.written or "")
    given = netlist.parameters.get(named[1]) if named else None
    where: Location = (given if given is not None else value).where
    return where.file if where.file in NO_FILE else f"{PurePath(where.file).name}:{where.line}"


def sentence(found: Mapping[str, Any] | None) -> str:
    """The treatment, what it does to a contact that sticks, and who chose it; "" where nothing is known of it."""
    if not found:
        return ""
    words = found["contacts"]
    named = next(iter(words)) if len(words) == 1 else ", ".join(f"{word} ({count})" for word, count in words.items())
    does = "stuck contacts do not move" if found["exact"] else ""
    if found.get("creep") is not None:
        does = f"stuck contacts creep, by {found['creep']:.3g} m/s at their limit"
    told = f"{named}: {does}" if does else named
    if not found["by"]:
        return f"{told}. The default: nobody chose another"
    default = "The default, which is also" if found["default"] else "Not the default:"
    return f"{told}. {default} the choice of {found['by']}"
