"""What happened in a run, in words: who changed zone, when first, how long; and how far the plotted signals went.

A verdict on rucking tells it of a hose. This tells it of every scene: stick-slip of a pad, a valve that opens, a
volume that cavitates, a rope that goes slack, a machine that changes its state.
"""

from __future__ import annotations

import itertools
import math
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from fairlead.report.measured import measured
from fairlead.report.page.sentence import Sentence
from fairlead.report.page.signals import families, first_panels
from fairlead.report.page.zones import meaning, starts
from fairlead.results.events import PIECE, lasting
from fairlead.results.plateau import ROUNDED as LAST_DIGITS
from fairlead.results.plateau import first_of
from fairlead.results.signal import family

if TYPE_CHECKING:
    from fairlead.results import Result, Signal

MOST_KINDS, MOST_EXTREMES, MOST_TOLD = 4, 4, 5
ALIKE = 3
"""So many parts whose names differ by their numbers alone are one kind."""
ROUNDED = 1e-6
"""A value so small, also beside the range of its signal, is told as zero."""
STEADY = 0.02
"""Spread of the times between two beginnings, by their mean, below which something repeats."""
MOVES = {"slide": ("forward", "backward"), "go slack": ("slack",)}
"""What contacts and ropes of a line are told to do; that they touch and stick is not news."""
BOTH_WAYS = ("forward", "backward")
RESTS = ("stuck", "between", "off")
"""What the zones of a contact mean besides that it slides: a part without any of them is no contact."""
DOES = {"slide": "slides", "go slack": "is slack"}


class Span(NamedTuple):
    """A part is in one zone, from when to when [s]."""

    begin: float
    end: float
    zone: str
    slides: bool = True
    """Whether it is a contact, of which `forward` and `backward` say that it slides; a valve is open either way."""

    @property
    def means(self) -> str:
        """What the zone means to a reader, if that is known."""
        return meaning(self.zone) if self.slides or self.zone not in BOTH_WAYS else ""


def happened(result: Result) -> Iterator[Sentence]:
    """One line of the verdict with a point for each kind of part that changed zone, and one for extremes."""
    roles = roles_of(result)
    points = [*((f"{name}{roles.get(name, '')}", text) for _, (name, text), _ in _kinds(result)), *_extremes(result)]
    if points:
        nothing = "" if result.events else "No part changed its zone."
        yield Sentence("What happened", "plain", nothing, points)


def instants(result: Result) -> list[tuple[str, float]]:
    """Times that a reader may want to go to, each with a word: when a kind of part first did something."""
    return [(label, t) for label, _, t in _kinds(result)]


def kinds_of(names: Sequence[str]) -> dict[str, str]:
    """By part its kind: the family of its name, or its name without numbers where at least three are alike."""
    alike: dict[str, set[str]] = defaultdict(set)
    own = {name: family(name)[0] for name in names}
    for kind in set(own.values()):
        alike[re.sub(r"\d+", "*", kind)].add(kind)
    return {name: star if len(alike[star := re.sub(r"\d+", "*", kind)]) >= ALIKE else kind
            for name, kind in own.items()}  # fmt: skip


def roles_of(result: Result) -> dict[str, str]:
    """What the kinds of part of a line are, for those who do not know their names."""
    found = {}
    for record in result.run.get("routes") or ():
        line, layers = record["line"], record["layers"]
        if len(layers) > 1:
            found[f"{line}.inner[*]"] = f" ({layers[1]} on {layers[0]})"
        found[f"{line}.outer[*]"] = " (line on its devices)"
        bend = " (what presses the contacts; it changes where a node reaches the next part of a bend)"
        found |= {f"{line}.{which}_load[*]": bend for which in ("inner", "outer")}
        found |= {f"{line}.{layer}[*]": f" (elements of the {layer})" for layer in layers}
    return found


def spans(result: Result) -> dict[str, list[Span]]:
    """The zones of every part that has some, one after the other; pieces of tables left out."""
    if not len(result.t):
        return {}
    first, last = float(result.t[0]), float(result.t[-1])
    found: dict[str, list[Span]] = {}
    contacts = _contacts(result)
    since = {name: (first, zone) for name, zone in starts(result.run).items()}
    for event in lasting(result.events, last - first):
        t, zone = since.get(event.component, (first, event.zone_from))
        found.setdefault(event.component, []).append(Span(t, event.t, zone, event.component in contacts))
        since[event.component] = (event.t, event.zone_to)
        last = max(last, event.t)
    for name, (t, zone) in since.items():
        found.setdefault(name, []).append(Span(t, last, zone, name in contacts))
    return {name: each for name, each in found.items() if not all(PIECE.fullmatch(one.zone) for one in each)}


def _contacts(result: Result) -> set[str]:
    """Parts that can stick or lift off; of what is told of old runs, all."""
    has = {one["family"]: one["zones"] for one in result.run.get("zones") or ()}
    names = {*starts(result.run), *(event.component for event in result.events)}
    return {name for name in names
            if any(meaning(zone) in RESTS for zone in has.get(family(name)[0], ("off",)))}  # fmt: skip


def _kinds(result: Result) -> list[tuple[str, tuple[str, str], float]]:
    """By kind of part a word for its first change, what it did, and when first; the busiest kinds come first."""
    known, moved = spans(result), {event.component for event in result.events}
    kind = kinds_of(list(known))
    grouped: dict[str, dict[str, list[Span]]] = defaultdict(dict)
    for name, each in known.items():
        grouped[kind[name]][name] = each
    told = []
    for name, parts in _telling(grouped, moved).items():
        said = _many(name, parts) if len(parts) > 1 else _one(name, next(iter(parts.values())))
        if said:
            told.append((sum(map(len, parts.values())), said))
    return [said for _, said in sorted(told, key=lambda one: -one[0])[:MOST_KINDS]]


def _telling(
    grouped: Mapping[str, Mapping[str, Sequence[Span]]], moved: set[str]
) -> dict[str, Mapping[str, Sequence[Span]]]:
    """Kinds that changed zone. Of single parts inside one component, the one with the most zones tells its story."""
    best: dict[str, tuple[int, int, str]] = {}
    found = {kind: parts for kind, parts in grouped.items() if moved & parts.keys()}
    for kind, parts in found.items():
        if len(parts) == 1 and "." in kind:
            each = next(iter(parts.values()))
            mine = (len({one.zone for one in each}), len(each), kind)
            best[kind.partition(".")[0]] = max(best.get(kind.partition(".")[0], mine), mine)
    return {kind: parts for kind, parts in found.items()
            if len(parts) > 1 or "." not in kind or best[kind.partition(".")[0]][2] == kind}  # fmt: skip


def _one(name: str, each: Sequence[Span]) -> tuple[str, tuple[str, str], float]:
    """What a single part did: all its zones where they are few, else how often and for how long it left the first."""
    first, label = each[1].begin, f"{name} {_does(each[1])}"
    if len(each) <= MOST_TOLD + 1:
        begun = f"{_word(each[0].zone).capitalize()} at first"
        rest = [f"{_word(one.zone)} from {_at(one.begin)}" for one in each[1:]]
        return label, (name, f"{begun}, {', '.join(rest)}."), first
    groups: dict[str, list[Span]] = defaultdict(list)
    for one in _joined(each):
        groups[_does(one)].append(one)
    whole = each[-1].end - each[0].begin or 1.0
    home = _does(each[0])
    told = [_often(does, found, whole) for does, found in groups.items() if does != home][:2]
    return label, (name, f"It {home} at first. {' '.join(told)}".strip()), first


def _joined(each: Sequence[Span]) -> list[Span]:
    """Spans in which a part does the same, joined: to slide forward and then backward is to slide."""
    found: list[Span] = []
    for one in each:
        if found and _does(found[-1]) == _does(one):
            found[-1] = found[-1]._replace(end=one.end)
        else:
            found.append(one)
    return found


def _often(does: str, found: Sequence[Span], whole: float) -> str:
    """How often, from when, for which share of the time; and the period of what repeats."""
    share = 100 * sum(one.end - one.begin for one in found) / whole
    longest = max(found, key=lambda one: one.end - one.begin)
    times = {1: "once", 2: "twice"}.get(len(found), f"{len(found)} times")
    apart = [b.begin - a.begin for a, b in itertools.pairwise(found[1:])]
    mean = sum(apart) / len(apart) if apart else 0.0
    if len(apart) > 1 and max(apart) - min(apart) <= STEADY * mean:
        more = f", then every {measured(mean, 's')}"
    elif len(found) > 1:
        more = f"; longest from {_at(longest.begin)} to {_at(longest.end)}"
    else:
        more = f" to {_at(found[0].end)}"
    return f"It {does} {times}, first from {_at(found[0].begin)}{more}; {share:.2g} % of the time."


def _many(name: str, parts: Mapping[str, Sequence[Span]]) -> tuple[str, tuple[str, str], float] | None:
    """How many of alike parts moved, at most at once, and which was first."""
    said, instant = [], []
    zones = {one.zone: one.means for each in parts.values() for one in each}
    moves = any(means in of for means in zones.values() for of in MOVES.values())
    news = [] if moves else [zone for zone, means in zones.items() if not means and not PIECE.fullmatch(zone)]
    kinds = {**{does: lambda one, of=of: one.means in of for does, of in MOVES.items()},
             **{zone: lambda one, own=zone: one.zone == own for zone in news}}  # fmt: skip
    for does, fits in kinds.items():
        found = [(one, part) for part, each in parts.items() for one in each if fits(one) and one.end > one.begin]
        if not found:
            continue
        first, who = min(found, key=lambda one: one[0].begin)
        most, when = _at_once([one for one, _ in found])
        count = len({part for _, part in found})
        do = does if does in MOVES else f"are {_word(does)}"
        some = f"{f'All {count}' if count == len(parts) else f'{count} of {len(parts)}'} {do} at some time"
        said.append(f"{some}, at most {most} at once (at {_at(when)}); first {who} at {_at(first.begin)}.")
        instant.append((when, does))
    if not said:
        return None
    return f"{name}: most {instant[0][1]}", (name, " ".join(said[:2])), instant[0][0]


def _at_once(found: Sequence[Span]) -> tuple[int, float]:
    """At most how many spans hold at once, and since when."""
    changes = sorted([(one.begin, 1) for one in found] + [(one.end, -1) for one in found])
    now, most, when = 0, 0, changes[0][0]
    for k, (t, step) in enumerate(changes):
        now += step
        if now > most and (k + 1 == len(changes) or changes[k + 1][0] > t):
            most, when = now, t
    return most, when


def _does(one: Span) -> str:
    for does, means in MOVES.items():
        if one.means in means:
            return DOES[does]
    return "sticks" if one.means == "stuck" else f"is {_word(one.zone)}"


def _word(zone: str) -> str:
    return zone.replace("_", " ")


def _at(t: float) -> str:
    return measured(t, "s")


def _extremes(result: Result) -> Iterator[tuple[str, str]]:
    """How far the signals go that are drawn first: the first of each plot, then the second of each."""
    known, panels = families(result), [panel["families"] for panel in first_panels(result)]
    turns = itertools.chain.from_iterable(itertools.zip_longest(*panels))
    told = 0
    for name in dict.fromkeys(one for one in turns if one is not None):
        text = _reach(result, known[name])
        if text and told < MOST_EXTREMES:
            told += 1
            yield name, text


def _reach(result: Result, members: Sequence[Signal]) -> str:
    """The lowest and the highest value of alike signals, when, and in which; "" where none has a value."""
    unit = members[0].unit
    each = [(family(one.name)[1], result.extremes(one.name)) for one in members]
    each = [(number, found) for number, found in each if math.isfinite(found.lowest + found.highest)]
    if not each:
        return ""
    low = each[first_of([one.lowest for _, one in each], least=True)]
    high = each[first_of([one.highest for _, one in each], least=False)]
    least, most = low[1].lowest, high[1].highest
    size = ROUNDED * min(max(abs(least), abs(most)), 1.0)
    if most - least <= LAST_DIGITS * max(abs(most), abs(least)):
        return f"It is {measured(least, unit)} all the time."
    ends = (("lowest", least, low[1].t_lowest, low[0]), ("highest", most, high[1].t_highest, high[0]))
    said = [f"{word} {measured(value if abs(value) > size else 0.0, unit)} at {_at(t)}"
            f"{f' in element {number}' if len(members) > 1 else ''}" for word, value, t, number in ends]  # fmt: skip
    return f"L{', '.join(said)[1:]}."
