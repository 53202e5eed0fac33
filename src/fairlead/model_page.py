"""How a model shows itself in a notebook: what it is, what it is made of, how it runs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from html import escape

from fairlead.netlist.netlist import Netlist

MOST_TYPES = 12
LONGEST = 400


def as_html(netlist: Netlist) -> str:
    """A small table, with every text escaped."""
    rows = "".join(f"<tr>{_cell('th', name)}{_cell('td', value)}</tr>" for name, value in _facts(netlist))
    return f"<table><caption><b>{_text(netlist.name)}</b></caption>{rows}</table>"


def _facts(netlist: Netlist) -> Iterator[tuple[str, str]]:
    if netlist.description:
        yield "about", netlist.description
    yield "netlist", str(netlist.path)
    types = Counter(one.type for one in netlist.components.values()).most_common()
    named = ", ".join(f"{count} {name}" if count > 1 else name for name, count in types[:MOST_TYPES])
    more = f" and {len(types) - MOST_TYPES} more types" if len(types) > MOST_TYPES else ""
    yield "components", f"{len(netlist.components)}: {named}{more}"
    run = netlist.run
    yield "run", f"{run.start:g} ... {run.stop:g} s, accuracy {run.accuracy:g}, engine {run.engine}"


def _cell(tag: str, text: str) -> str:
    return f'<{tag} style="text-align:left">{_text(text)}</{tag}>'


def _text(text: str) -> str:
    return escape(text if len(text) <= LONGEST else f"{text[: LONGEST - 3]}...")
