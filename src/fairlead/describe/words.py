"""The words that netlists write instead of a type, such as `hold` after `method`: whose they are, and their pages.

    heads("hold", types)        the families that know the word: {"Contact": ...}
    page("hold", types)         what it is, what it takes, how its zones are called
"""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping
from typing import Any

from fairlead.component.base import Declared
from fairlead.component.scene import is_head
from fairlead.describe.catalogue import zone_names
from fairlead.describe.columns import columns, heading, paragraph
from fairlead.describe.interface import parameter_rows
from fairlead.describe.specimen import families_of


def heads(word: str, types: Mapping[str, type[Declared]]) -> dict[str, Any]:
    """The families with a member of that word, by name: those a netlist names, and those of their parameters."""
    offered = [kind for kind in types.values() if is_head(kind)]
    offered += [family for kind in types.values() for family in families_of(kind)]
    found = {family.__name__: family for family in offered if word in family.members}
    return dict(sorted(found.items()))


def page(word: str, types: Mapping[str, type[Declared]]) -> Iterator[str]:
    """What a word stands for, in every family that knows it."""
    for name, family in heads(word, types).items():
        member = family.members[word]
        yield f"{word}    {family.key} of {name}" if name in types else f"{word}    {family.key}"
        yield from paragraph(inspect.getdoc(member))
        if member.declaration.parameters:
            yield from heading("parameters")
            yield from parameter_rows(member.declaration.parameters)
        if names := zone_names(member):
            yield from heading("zones")
            yield from columns([(", ".join(names),)])
        yield ""
