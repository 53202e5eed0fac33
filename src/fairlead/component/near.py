"""Whether a name is nearly another one: a slip of the pen."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

NEAR = 0.82
"""Likeness (Ratcliff and Obershelp, as difflib has it) from which on a name counts as misspelt: one letter of four."""


def near_to(word: str, known: Iterable[str]) -> str:
    """The known name that a word is nearly; "" when there is none."""
    by_key = {key: name for name in known if _may_be_near(_key(word), key := _key(name))}
    if not by_key:
        return ""
    import difflib

    found = difflib.get_close_matches(_key(word), by_key, n=1, cutoff=NEAR)
    found = found or [key for key in by_key if len(key) > 3 and _exchanged(_key(word), key)]
    return by_key[found[0]] if found else ""


def _may_be_near(word: str, other: str) -> bool:
    """False where the letters in common, in whatever order, are too few for NEAR: what difflib counts is no more."""
    least = NEAR * (len(word) + len(other))
    return 2 * min(len(word), len(other)) >= least and 2 * (Counter(word) & Counter(other)).total() >= least


def _exchanged(word: str, other: str) -> bool:
    """Whether two words differ by two neighbouring letters that changed places, as in `strat`."""
    differ = [k for k, (one, two) in enumerate(zip(word, other, strict=False)) if one != two]
    return (
        len(word) == len(other) and len(differ) == 2 and differ[1] == differ[0] + 1
        and word[differ[0]] == other[differ[1]] and word[differ[1]] == other[differ[0]]
    )  # fmt: skip


def _key(word: str) -> str:
    return word.lower().replace("_", "")
