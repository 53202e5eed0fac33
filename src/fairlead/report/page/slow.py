"""What made a run slow: who changed zone how often, what steps were for, and the profile if there is one."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from fairlead.report.page.zones import meaning
from fairlead.results.signal import family

if TYPE_CHECKING:
    from fairlead.results import Result

MOST_ROWS = 12
TIMES = {"compile_time": "reading and compiling", "solve_time": "stepping", "wall_time": "all together"}


def slow_data(result: Result) -> dict[str, Any]:
    """A sentence, the busiest parts and kinds with their share of all zone changes, and the text of a profile."""
    run = result.run
    counts, kinds, zones = _counted(result)
    total = counts.total()
    return {
        "sentence": _sentence(run, counts, kinds, zones), "parts": _rows(counts, total), "kinds": _rows(kinds, total),
        "profile": str(run.get("profile") or ""), "total": total,
        "times": [*((word, run[key]) for key, word in TIMES.items() if run.get(key) is not None), *_rest(run)],
    }  # fmt: skip


def _rest(run: Mapping[str, Any]) -> list[tuple[str, float]]:
    """What is left of the whole time beside reading and stepping."""
    if any(run.get(key) is None for key in TIMES):
        return []
    rest = run["wall_time"] - run["compile_time"] - run["solve_time"]
    return [("the rest, for loading the engine and recording", rest)]


def _rows(counts: Counter[str], total: int) -> list[dict[str, Any]]:
    most = counts.most_common(MOST_ROWS)
    return [{"name": name, "count": n, "share": n / total, "bar": n / most[0][1]} for name, n in most]


def slowest(result: Result) -> str:
    """Which contact, and which kinds of part, ended most steps; empty where nothing changed zone."""
    counts, kinds, zones = _counted(result)
    total = counts.total()
    if not total:
        return ""
    roles = _roles(result)
    first = kinds.most_common(2)
    told = " and ".join(f"{name}{roles.get(name, '')} {100 * n / total:.0f} %" for name, n in first)
    sticks = next((name for name, _ in counts.most_common() if "stuck" in map(meaning, zones[name])), None)
    contact = (
        f"The contact that changed zone most often is {sticks}{roles.get(family(sticks)[0], '')}: {counts[sticks]} of "
        f"{total} zone changes. " if sticks else ""
    )
    steps = f" {result.run['steps']} steps were needed in all." if result.run.get("steps") else ""
    ends = "A step ends at each change (to stick, to slide, slack, taut), and short ones follow."
    return f"{contact}By kind of part it is {told}. {ends}{steps}"


def _counted(result: Result) -> tuple[Counter[str], Counter[str], dict[str, set[str]]]:
    """Zone changes by part and by kind, and the zones of each part."""
    zones: dict[str, set[str]] = defaultdict(set)
    for event in result.events:
        zones[event.component] |= {event.zone_from, event.zone_to}
    counts = Counter(event.component for event in result.events)
    return counts, Counter(family(event.component)[0] for event in result.events), zones


def _roles(result: Result) -> dict[str, str]:
    """What the kinds of part of a line are, for those who do not know their names."""
    found = {}
    for record in result.run.get("routes") or ():
        line, layers = record["line"], record["layers"]
        if len(layers) > 1:
            found[f"{line}.inner[*]"] = f" ({layers[1]} on {layers[0]})"
        found[f"{line}.outer[*]"] = " (line on its devices)"
        found |= {f"{line}.{layer}[*]": f" (elements of the {layer})" for layer in layers}
    return found


def _sentence(
    run: dict[str, Any], counts: Counter[str], kinds: Counter[str], zones: Mapping[str, set[str]]
) -> str:
    steps, rejected = run.get("steps") or 0, run.get("rejected") or 0
    cost = f"{steps} steps and {rejected} rejected ones" if steps else "its steps"
    if not counts:
        return f"The run spent its time on {cost}; nothing changed zone."
    (who, n), (kind, m), total = counts.most_common(1)[0], kinds.most_common(1)[0], counts.total()
    return (
        f"The run took {cost}. A step ends where a part changes zone, which happened {total} times: most often in "
        f"{kind} ({100 * m / total:.0f} % of all changes), and of single parts in {who} ({n} times)."
        f"{_contact(zones, counts)}"
    )


def _contact(zones: Mapping[str, set[str]], counts: Counter[str]) -> str:
    """The busiest of the parts that stick at times, if that is not the busiest of all."""
    sticks = [name for name, _ in counts.most_common() if "stuck" in map(meaning, zones[name])]
    if not sticks or counts[sticks[0]] == counts.most_common(1)[0][1]:
        return ""
    return f" Of contacts, {sticks[0]} changes most ({counts[sticks[0]]} times)."
