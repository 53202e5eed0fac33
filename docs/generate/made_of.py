"""What a component without a law of its own is made of, as its example shows it."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import fairlead
from generate.tables import table


def made_of(
    name: str, example: Path | None, pages: Mapping[str, Any], methods: Mapping[Any, str], laws: Callable[..., Any]
) -> Iterator[str]:
    """A sentence, the parts with links to their pages, and the laws of those that have no page.

    `pages` are the types with a page, `methods` the words of treatments by class, `laws(name, kind)` lines about one.
    """
    yield from ("## Zones and equations", "")
    parts = _parts(str(example), name) if example else {}
    if not parts:
        yield from (f"`{name}` has no zones and equations of its own; what it does is in the text above.", "")
        return
    yield from (f"`{name}` has no zones and equations of its own. In the example below it is made of these parts:", "")
    yield from table(("part", "type"), ((f"`{part}`", _link(kind, pages, methods)) for part, kind in parts.items()))
    for kind in dict.fromkeys(parts.values()):
        if kind.__name__ not in pages and kind not in methods:
            yield from (f"### `{kind.__name__}`", "", *laws(kind.__name__, kind))


@functools.cache
def _parts(example: str, name: str) -> dict[str, Any]:
    """Parts of the first component of that type, by their name in it; elements of a line once."""
    model = fairlead.load(example)
    own = next((one.name for one in model.netlist.components.values() if one.type == name), None)
    found: dict[str, Any] = {}
    for instance in model.flat.instances:
        if own is not None and instance.path.startswith(f"{own}."):
            found.setdefault(re.sub(r"\[\d+\]", "[*]", instance.path.removeprefix(f"{own}.")), instance.type)
    return found


def _link(kind: Any, pages: Mapping[str, Any], methods: Mapping[Any, str]) -> str:
    if kind in methods:
        return f"[Contact, `method: {methods[kind]}`](../../treatments/{methods[kind]}.md)"
    known = kind.__name__ in pages
    return f"[{kind.__name__}]({kind.__name__}.md)" if known else f"`{kind.__name__}`, below"
