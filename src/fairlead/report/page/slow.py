"""What made a run slow: who changed zone how often, what steps were for, and the profile if there is one."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from fairlead.report.page.happened import kinds_of, roles_of
from fairlead.report.page.zones import meaning
from fairlead.results.signal import family

if TYPE_CHECKING:
    from fairlead.results import Result

MOST_ROWS = 12
STANDS_OUT = 0.1
"""Share of all zone changes below which one contact is not what made a run slow."""
CHANGES = {
    "stick": ("stuck",), "slide": ("forward", "backward"), "touch": ("off",), "ruck": ("ruck",), "go slack": ("slack",),
}  # fmt: skip
"""What a part begins or ceases to do, by what its zones mean."""
SLIDING = {"forward", "backward"}
"""Of a contact; a valve may be open forward, but it neither sticks nor parts."""
FEW = 0.02
"""Zone changes a step below which they are not what made a run slow."""
TIMES = {"compile_time": "reading and compiling", "solve_time": "stepping", "wall_time": "all together"}


def slow_data(result: Result) -> dict[str, Any]:
    """A sentence, the busiest parts and kinds with their share of all zone changes, and the text of a profile."""
    run = result.run
    counts, kinds, zones = _counted(result)
    total = counts.total()
    return {
        "sentence": _sentence(run, counts, kinds, zones), "parts": _rows(_shown(counts, zones), total),
        "kinds": _rows(kinds, total, roles_of(result)), "alike": kinds == counts,
        "profile": str(run.get("profile") or ""), "total": total,
        "times": [*((word, run[key]) for key, word in TIMES.items() if run.get(key) is not None), *_rest(run)],
    }  # fmt: skip


def _rest(run: Mapping[str, Any]) -> list[tuple[str, float]]:
    """What is left of the whole time beside reading and stepping."""
    if any(run.get(key) is None for key in TIMES):
        return []
    rest = run["wall_time"] - run["compile_time"] - run["solve_time"]
    return [("the rest, for loading the engine and recording", rest)]


def _rows(counts: Counter[str], total: int, roles: Mapping[str, str] = MappingProxyType({})) -> list[dict[str, Any]]:
    most = counts.most_common(MOST_ROWS)
    return [
        {"name": f"{name}{roles.get(name, '')}", "count": n, "share": n / total, "bar": n / most[0][1]}
        for name, n in most
    ]


def _shown(counts: Counter[str], zones: Mapping[str, set[str]]) -> Counter[str]:
    """The busiest parts, and the busiest contact in place of the last of them where it is none of them."""
    most, who = dict(counts.most_common(MOST_ROWS)), _busiest_contact(counts, zones)
    if who is not None and who not in most:
        most.popitem()
        most[who] = counts[who]
    return Counter(most)


def slowest(result: Result) -> str:
    """Which kind of part, and which contact, ended most steps, with its share; empty where nothing changed zone."""
    counts, kinds, zones = _counted(result)
    total = counts.total()
    if not total:
        return ""
    roles = roles_of(result)
    (first, n), *others = kinds.most_common(2)
    changes = f"{total} change{'s' * (total > 1)}"
    taken = result.run.get("steps") or 0
    if total < FEW * taken:
        who = f", {'in' if not others else 'most of them in'} {first}{roles.get(first, '')}"
        return f"No contact did: parts changed zone {_times(total)} in {taken} steps{who}."
    kind = f"By kind of part, {first}{roles.get(first, '')} changed zone most: {_percent(n, total)} of {changes}"
    if not others:
        kind = f"Only {first}{roles.get(first, '')} changed zone, {_times(total)}"
    kind += "".join(f", then {name}{roles.get(name, '')} with {_percent(m, total)}" for name, m in others)
    steps = f" All together: {taken} steps." if taken else ""
    return (
        f"{kind}.{_single(counts, zones, roles, first)} In a zone change a part {_changes(zones)}. A step ends at "
        f"each, and short ones follow.{steps}"
    )


def _times(n: int) -> str:
    return {1: "once", 2: "twice"}.get(n, f"{n} times")


def _single(counts: Counter[str], zones: Mapping[str, set[str]], roles: Mapping[str, str], said: str) -> str:
    """The contact that changed zone most, unless it is the kind that was named already."""
    who = _busiest_contact(counts, zones)
    if who is None or who == said:
        return ""
    total, own = counts.total(), family(who)[0]
    few = "; no contact stands out" if counts[who] < STANDS_OUT * total else ""
    role = "" if own == said else roles.get(own, "")
    part = counts.most_common(1)[0][0]
    first = "" if part == who else f" Of single parts it is {part}: {_times(counts[part])}."
    return f"{first} Of single contacts it is {who}{role}: {counts[who]} times, {_percent(counts[who], total)}{few}."


def _busiest_contact(counts: Counter[str], zones: Mapping[str, set[str]]) -> str | None:
    """The busiest of the parts that stick at times."""
    return next((name for name, _ in counts.most_common() if "stuck" in map(meaning, zones[name])), None)


def _changes(zones: Mapping[str, set[str]]) -> str:
    """What the parts of this run do when they change zone, in words."""
    met = [{meaning(zone) for zone in each} for each in zones.values()]
    of_contacts = [each for each in met if each & {"stuck", "off"} or each >= SLIDING]
    seen = set[str]().union(*of_contacts, *(each - SLIDING for each in met))
    does = [word for word, means in CHANGES.items() if seen & set(means)]
    if not does:
        return "goes over to another branch of its law"
    return f"begins or ceases to {', '.join(does[:-1])}{' or ' if len(does) > 1 else ''}{does[-1]}"


def _percent(n: int, total: int) -> str:
    share = 100 * n / total
    return f"{share:.0f} %" if share >= 10 else f"{share:.2g} %"


def _counted(result: Result) -> tuple[Counter[str], Counter[str], dict[str, set[str]]]:
    """Zone changes by part and by kind, and the zones of each part; guards that left the zone as it was change none."""
    zones: dict[str, set[str]] = defaultdict(set)
    changes = [event for event in result.events if event.zone_from != event.zone_to]
    for event in changes:
        zones[event.component] |= {event.zone_from, event.zone_to}
    counts = Counter(event.component for event in changes)
    kind = kinds_of(list(counts))
    return counts, Counter(kind[event.component] for event in changes), zones


def _sentence(run: dict[str, Any], counts: Counter[str], kinds: Counter[str], zones: Mapping[str, set[str]]) -> str:
    steps, rejected = run.get("steps") or 0, run.get("rejected") or 0
    cost = f"{steps} steps and {rejected} rejected ones" if steps else "its steps"
    if not counts:
        return f"The run spent its time on {cost}; nothing changed zone."
    (who, n), (kind, m), total = counts.most_common(1)[0], kinds.most_common(1)[0], counts.total()
    contact, share = _busiest_contact(counts, zones), f"{_percent(m, total)} of all"
    more = f" Of contacts, {contact} changes most ({counts[contact]} times)." if contact not in (None, who) else ""
    single = "" if who == kind else f", and of single parts in {who} ({_times(n)}, {_percent(n, total)})"
    most = f"only in {kind}" if m == total else f"most often in {kind} ({share})"
    return (
        f"The run took {cost}. A step ends where a part changes zone, which happened {_times(total)}: "
        f"{most}{single}.{more}"
    )
