"""One line of the verdict of a page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from fairlead.analysis.margins.ruck_words import figure


class Sentence(NamedTuple):
    """One line of the verdict; `points` are more sentences, each with the word for what it is about."""

    about: str
    mood: str
    text: str
    points: Sequence[tuple[str, str]] = ()
    brief: str = ""
    """What stands for it where it is folded away, if that is not `about`."""
    worth: bool = False
    """True for what tells how far the numbers can be trusted; it is folded away where nothing is wrong."""
    above: bool = False
    """True where the verdict on a line says the same, so that nothing has to be folded open for it."""

    @property
    def opens(self) -> bool:
        """True for what a reader must not overlook, and finds nowhere else."""
        return self.mood in ("bad", "fair") and not self.above

    def rewritten(self, rewrite: Callable[[str], str]) -> Sentence:
        """The same with other texts."""
        return self._replace(text=rewrite(self.text), points=[(word, rewrite(text)) for word, text in self.points])


def ended(text: str) -> str:
    """The text as a sentence that ends."""
    text = text.strip()
    return text if text.endswith((".", "!", "?")) else f"{text}."


def number(value: Any) -> str:
    """Three digits, or the word for a value that is not there."""
    return "unknown" if value is None else figure(value)
