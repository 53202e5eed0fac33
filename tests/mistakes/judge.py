"""What is missing in an answer."""

from __future__ import annotations

import re
from dataclasses import dataclass

from tests.mistakes.entry import ERROR, WARNING, Mistake

SILENT, TRACEBACK, HANG, REFUSED, ONLY_A_WARNING = "silent", "traceback", "hang", "refused", "only a warning"


@dataclass(frozen=True)
class Answer:
    """What fairlead said: `text`, whether it refused, and whether it fell over (`crashed`) or found no end (`hung`)."""

    text: str
    refused: bool = False
    crashed: bool = False
    hung: bool = False


def faults(mistake: Mistake, answer: Answer) -> list[str]:
    """Return what is wrong with an answer; nothing if it is good."""
    if answer.hung:
        return [HANG]
    if answer.crashed:
        return [TRACEBACK]
    if not answer.refused and not answer.text:
        return [SILENT]
    return missing(mistake, answer.text) + manner(mistake, answer)


def missing(mistake: Mistake, text: str) -> list[str]:
    """Return which of place, part and cure are not in a text."""
    plain = " ".join(text.split())
    has = {
        "place": any(found(word, plain) for word in mistake.place),
        "part": all(found(word, plain) for word in mistake.part),
        "cure": any(found(word, plain) for word in mistake.cure),
    }
    return [name for name, there in has.items() if not there]


def manner(mistake: Mistake, answer: Answer) -> list[str]:
    """Return whether it was refused where a warning is right, or let through where it is wrong."""
    if mistake.answer == WARNING and answer.refused:
        return [REFUSED]
    if mistake.answer == ERROR and not answer.refused:
        return [ONLY_A_WARNING]
    return []


def found(word: str, text: str) -> bool:
    """Return whether `word` stands in `text` as words of their own, in small or capital letters."""
    start = r"(?<![A-Za-z0-9_])" if word[0].isalnum() else ""
    end = r"(?![A-Za-z0-9_])" if word[-1].isalnum() else ""
    return re.search(start + re.escape(word) + end, text, re.IGNORECASE) is not None
