"""The zones of a run for the page: rows of spans, and what a zone means to a reader.

A row is a contact or another part that changes zone. Parts whose zones are the pieces of a table (`curvature 3`,
`force 1`) are innards: they have rows, but below all others and folded away.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from fairlead.report.page.packing import packed_numbers
from fairlead.results.events import PIECE
from fairlead.results.signal import family

if TYPE_CHECKING:
    from fairlead.results import Result

MOST_CHANGES = 250_000
"""Zone changes on a page; of more, the parts that change most often are left out, with a sentence."""
MEANS = {
    "stuck": ("held", "stuck", "plateau", "bound", "sticking", "locked"),
    "forward": ("forward", "slide_forward", "break_forward", "sliding", "slipping"),
    "backward": ("backward", "slide_backward", "break_backward"),
    "between": ("transit", "presliding", "closing"),
    "off": ("off", "free", "stored", "edge", "open", "apart"),
    "slack": ("slack", "loose"),
    "ruck": ("beyond", "rucking"),
    "sound": ("sound", "taut", "within", "full", "closed"),
}
"""What the words of the library mean to a reader, for colours; a zone of another name has a colour of its own."""


def meaning(zone: str) -> str:
    """`stuck`, `forward`, ... or "" for a word that is not known."""
    return next((means for means, words in MEANS.items() if zone in words), "")


def zone_data(result: Result) -> dict[str, Any]:
    """Zone names with their meaning; rows by family: start zone, times and zones of changes."""
    spans, start = _changes(result), starts(result.run)
    rows = {name: start.get(name, spans[name][0][1] if name in spans else "") for name in {**start, **spans}}
    kept, left_out = _few_enough(spans)
    words = {word: k for k, word in enumerate(dict.fromkeys(_words(rows, spans)))}
    grouped: dict[str, list[tuple[int, str]]] = defaultdict(list)
    for name in rows:
        if name in kept or name not in spans:
            one, number = family(name)
            grouped[one].append((-1 if number is None else number, name))
    has = {one["family"]: one["zones"] for one in result.run.get("zones") or ()}
    return {
        "words": [{"name": word, "means": meaning(word)} for word in words],
        "families": [_family(one, sorted(each), rows, spans, words, has.get(one)) for one, each in grouped.items()],
        "left_out": left_out,
    }  # fmt: skip


def _changes(result: Result) -> dict[str, list[tuple[float, str, str]]]:
    """Time, zone before and zone after of every change, by part."""
    found: dict[str, list[tuple[float, str, str]]] = defaultdict(list)
    for event in result.events:
        found[event.component].append((event.t, event.zone_from, event.zone_to))
    return dict(found)


def starts(run: Mapping[str, Any]) -> dict[str, str]:
    """The zone at the start, by part."""
    found: dict[str, str] = {}
    for one in run.get("zones") or ():
        for number, first in zip(one["elements"], one["start"], strict=True):
            name = one["family"] if number is None else one["family"].replace("[*]", f"[{number}]")
            found.setdefault(name, one["zones"][first])  # of several tables of a part, the first
    return found


def _words(rows: Mapping[str, str], spans: Mapping[str, list[tuple[float, str, str]]]) -> list[str]:
    return [*rows.values(), *(change[2] for each in spans.values() for change in each)]


def _few_enough(spans: Mapping[str, list[Any]]) -> tuple[set[str], int]:
    total, kept = 0, set()
    for name, each in sorted(spans.items(), key=lambda item: len(item[1])):
        total += len(each)
        if total > MOST_CHANGES:
            break
        kept.add(name)
    return kept, len(spans) - len(kept)


def _family(
    name: str, members: list[tuple[int, str]], rows: Mapping[str, str],
    spans: Mapping[str, list[tuple[float, str, str]]], words: Mapping[str, int], has: list[str] | None,
) -> dict[str, Any]:  # fmt: skip
    changes = [(t, words[after]) for _, one in members for t, _, after in spans.get(one, ())]
    seen = Counter(after for _, one in members for _, _, after in spans.get(one, ()))
    zones = has or [*seen, *(rows[one] for _, one in members)]
    return {
        "name": name, "elements": [number for number, _ in members], "start": [words[rows[one]] for _, one in members],
        "counts": [len(spans.get(one, ())) for _, one in members],
        "t": packed_numbers(np.array([t for t, _ in changes]), "<f8"),
        "to": packed_numbers(np.array([zone for _, zone in changes]), "<u2"),
        "inner": all(PIECE.fullmatch(zone) for zone in zones if zone), "zones": list(dict.fromkeys(zones)),
    }  # fmt: skip
