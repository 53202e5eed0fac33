"""Cases whose full results are kept, by what is known of them when all have run.

17        the case of that number           failed       those that did not finish
broken    those that broke a limit          highest:peak, lowest:peak      the one with the extreme of a figure
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from fairlead.cases.row import FINISHED, KILLED
from fairlead.errors import UsageError, did_you_mean, listing, shown
from fairlead.quantities import digits

if TYPE_CHECKING:
    import pandas

MOST = 100
WORDS = ("failed", "broken")
ENDS = ("highest", "lowest")


def refuse(words: Sequence[str], figures: Sequence[str], count: int) -> None:
    """Raise UsageError for a word that chooses nothing."""
    for word in words:
        kind, colon, figure = word.partition(":")
        number = digits(word)
        if number is not None:
            if number >= count:
                raise UsageError(f"--keep {word}: there are cases 0 to {count - 1}.")
        elif kind in ENDS and colon:
            if figure not in figures:
                near = did_you_mean(figure, figures)
                raise UsageError(
                    f"--keep {shown(word)}: there is no such figure. {near}\n    There are {listing(figures)}."
                )
        elif word not in WORDS:
            raise UsageError(
                f"--keep {shown(word)}: give a number of a case, failed, broken, highest:FIGURE or lowest:FIGURE."
            )


def chosen(words: Sequence[str], frame: pandas.DataFrame) -> list[int]:
    """Numbers of the cases, MOST of them at most; those that kill a process are left out."""
    found: dict[int, None] = {}
    for word in words:
        kind, _, figure = word.partition(":")
        number = digits(word)
        if number is not None:
            rows = frame[frame["case"] == number]
        elif word == "failed":
            rows = frame[frame["status"] != FINISHED]
        elif word == "broken":
            rows = frame[frame["limits_broken"] > 0]
        else:
            known = frame[frame[figure].notna()].sort_values(figure, ascending=kind == "lowest", kind="stable")
            rows = known.head(1)
        found |= dict.fromkeys(rows[rows["status"] != KILLED]["case"].tolist())
    return list(found)[:MOST]
