"""A sentence on what switched to and fro within its dwell: which, how many, and what to do.

They are told by family (`line.outer[*]`), those of which most did so first; a list of all would say nothing.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from fairlead.results.signal import family

MOST_NAMED = 3
LONGER = 1e4
"""Dwells in one that makes a sliding mode cheap: its own is a hundredth of the accuracy of the span, or less."""


def remark(names: Sequence[str], dwell: float, reaction: str) -> str:
    """What to tell of these contacts, parts of a run with this dwell [s] and `run.chatter`; "" for none."""
    if not names:
        return ""
    counts = Counter(family(name)[0] for name in names)
    first = {family(name)[0]: name for name in reversed(names)}
    told = [f"{count} of {one}" if count > 1 else first[one] for one, count in counts.most_common(MOST_NAMED)]
    rest = len(names) - sum(count for _, count in counts.most_common(MOST_NAMED))
    more = f" and {rest} more" if rest else ""
    done = (
        "Each was held for that time." if reaction == "hold" else
        "Usually a load stays at its limit there, and the motion is right; run.chatter: hold keeps what switches in "
        f"its zone for that time, or for a longer one that you give, such as run.dwell: {LONGER * dwell:.1g} s. A "
        "relay or a comparator in a loop wants hysteresis."
    )  # fmt: skip
    return (
        f"{', '.join(told)}{more} switched to and fro, each time within {dwell:.2g} s (run.dwell). {done} It happens "
        "as well where two laws contradict each other; then a finer run.accuracy gives another motion."
    )
