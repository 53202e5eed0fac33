"""Signals of a run by name: one, those that fit a pattern, or several of either; old names of outputs too."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from fairlead.errors import FairleadError, RunWarning, did_you_mean, listing, shown
from fairlead.renamed import of_today
from fairlead.results.asked import instead_of, not_names
from fairlead.results.signal import Signal, matching

BY_ONE, BY_MATCH = 4, 5
"""Calls from a warning on an old name out to who wrote it: `result[...]`, and `result.match`, which is decorated."""


class UnknownSignalError(FairleadError, KeyError):
    """A name that was not recorded."""

    def __str__(self) -> str:
        return str(self.args[0])  # KeyError would show the message in quotes.


@dataclass(frozen=True)
class Names:
    """What is recorded, and what messages call the place where it lies."""

    signals: Mapping[str, Signal]
    place: str

    def one(self, name: str) -> Signal:
        """The signal of that name, also of an old one. Raises UnknownSignalError."""
        if not isinstance(name, str):
            raise UnknownSignalError(f"{shown(name)} is not the name of a signal, which is a text.{instead_of(name)}")
        if name in self.signals:
            return self.signals[name]
        if len(old := self._of_old(name, BY_ONE)) == 1:
            return self.signals[old[0]]
        several = matching(self.signals, name)
        inside = [one for one in self.signals if isinstance(name, str) and one.startswith(f"{name}.")]
        if inside:
            advice = f"It gives {listing(inside)}."
        elif several:
            advice = f'It stands for {len(several)} signals: use result.match("{name}").'
        else:
            advice = did_you_mean(name, self.signals) or f"Recorded are {listing(self.signals)}."
        raise UnknownSignalError(f"{name} was not recorded in {self.place}. {advice}")

    def match(self, pattern: str) -> list[str]:
        """The recorded names that fit a pattern. Raises UnknownSignalError."""
        if not isinstance(pattern, str):
            raise UnknownSignalError(f"match: pattern = {shown(pattern)} is not a text.\n    Write it as \"block.*\".")
        return matching(self.signals, pattern) or self._of_old(pattern, BY_MATCH)

    def chosen(self, names: str | Iterable[str] | None) -> list[str]:
        """The names of signals: all, one or several, each a name or a pattern. Raises UnknownSignalError."""
        if names is None:
            return list(self.signals)
        if way_out := not_names(names):
            raise UnknownSignalError(f"names = {shown(names)} is neither a text nor a list of texts.\n    {way_out}")
        given = [names] if isinstance(names, str) else list(names)
        found = [one for each in given
                 for one in ([each] if each in self.signals else self._fitting(each))]  # fmt: skip
        return list(dict.fromkeys(found))

    def _fitting(self, pattern: str) -> list[str]:
        if not isinstance(pattern, str) or not (found := self.match(pattern)):
            return [self.one(pattern).name]
        return found

    def _of_old(self, pattern: str, stacklevel: int) -> list[str]:
        """The signals that an old name of an output means; it warns of that."""
        fit = {one: matching(self.signals, one) for one in (of_today(pattern) if isinstance(pattern, str) else ())}
        found = {name for names in fit.values() for name in names}
        if found:
            today = " or ".join(one for one, names in fit.items() if names)
            warnings.warn(f"{pattern} is called {today} now; write that.", RunWarning, stacklevel=stacklevel)
        return [name for name in self.signals if name in found]
