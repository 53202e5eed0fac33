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
    counts = Counter(event.component for event in result.events)
    zones: dict[str, set[str]] = defaultdict(set)
    for event in result.events:
        zones[event.component] |= {event.zone_from, event.zone_to}
    kinds = Counter(family(event.component)[0] for event in result.events)
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
