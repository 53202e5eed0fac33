"""How a pattern picks signals by name: `*` is any run of characters, `?` is one, brackets mean themselves (`core[12]`).

    fits = matcher("line.*.tension")
    fits("line.core[12].tension")        True

A pattern comes from a netlist, a command line or a run.json, so none may take long. What stands between two stars is
sought from left to right and never again (a possessive group), since the first place where it fits leaves most room for
what follows. That takes the length of the name times that of the pattern at most, however many stars there are.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection

from fairlead.renamed import of_today

LONGEST = 1000
"""Characters of a pattern; nothing in a model has so long a name."""
INDEX = r"(?:\[\d+\])?"


def picked(names: Collection[str], pattern: str) -> list[str]:
    """The names that fit a pattern, in their own order; one without * and ? is looked up (give a set or a dict).

    Where none does, the old name of an output (`rotor.rate`) stands for that of today.
    """
    found = _picked(names, pattern)
    if found:
        return found
    fit = {name for today in as_today(names, pattern) for name in _picked(names, today)}
    return [name for name in names if name in fit] if fit else []


def as_today(names: Collection[str], pattern: str) -> list[str]:
    """The pattern with today's names of an output, those that fit, if only so it fits."""
    today = of_today(pattern)
    return [one for one in today if _picked(names, one)] if today and not _picked(names, pattern) else []


def _picked(names: Collection[str], pattern: str) -> list[str]:
    if "*" not in pattern and "?" not in pattern:
        return [pattern] if pattern in names else []
    return [*filter(matcher(pattern), names)]


def matcher(pattern: str, *, any_index: bool = False) -> Callable[[str], bool]:
    """A function that says whether a whole name fits.

    With `any_index` a segment without an index also stands for all its elements: `line.core.tension` fits
    `line.core[12].tension`.
    """
    if len(pattern) > LONGEST:
        return lambda name: False
    first, *others = (_literal(piece) for piece in _pieces(pattern, any_index))
    if not others:
        return _whole(first)
    *middle, last = others
    sought = "".join(f"(?>.*?{piece})" for piece in middle if piece)
    return _whole(f"{first}{sought}.*{last}")


def _whole(expression: str) -> Callable[[str], bool]:
    fits = re.compile(expression, re.DOTALL).fullmatch
    return lambda name: fits(name) is not None


def _pieces(pattern: str, any_index: bool) -> list[str]:
    """What stands between the stars; a zero byte marks where an index may stand that the pattern does not name."""
    if not any_index:
        return pattern.split("*")
    segments = (one if one.endswith(("]", "*")) else f"{one}\0" for one in pattern.split("."))
    return ".".join(segments).split("*")


def _literal(piece: str) -> str:
    """A piece without stars as a regular expression."""
    return re.escape(piece).replace(r"\?", ".").replace("\\\0", INDEX).replace("\0", INDEX)
