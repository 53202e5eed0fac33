"""What fairlead says when something is wrong: locations, faults, the exceptions and "did you mean".

A message has the form

    models/belt.yaml:9:6: spring.c: Spring has ports a, b. Did you mean spring.b?
        A way out on a line of its own, when there is one.

so that an editor can jump to the place. Every exception that fairlead raises on purpose descends
from `FairleadError` and carries the exit code of the command line.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

MOST_FAULTS_PRINTED = 100
LONGEST_VALUE_SHOWN = 60
LONGEST_WORD_COMPARED = 100
MOST_WORDS_COMPARED = 500  # 10 ms; of more names only those with the same beginning or end are compared


@dataclass(frozen=True, order=True)
class Location:
    """A place in a file, counted from 1; line 0 means the file as a whole (or no file, as in `--set`)."""

    file: str
    line: int = 0
    column: int = 0

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}" if self.line else self.file


@dataclass(frozen=True)
class Fault:
    """One mistake: where it stands, what is wrong with which value, and a way out."""

    where: Location | None
    what: str
    way_out: str = ""

    def __str__(self) -> str:
        place = f"{self.where}: " if self.where else ""
        advice = "".join(f"\n    {line}" for line in self.way_out.splitlines())
        return f"{place}{self.what}{advice}"


class FairleadError(Exception):
    """Something fairlead refuses, explained; `exit_code` is what the command line returns."""

    exit_code = 1


class ModelError(FairleadError):
    """All mistakes found in a model, collected so that they can be mended in one go."""

    exit_code = 1

    def __init__(self, faults: Iterable[Fault]) -> None:
        self.faults: tuple[Fault, ...] = tuple(faults)
        super().__init__(self.faults)

    def __str__(self) -> str:
        lines = [str(fault) for fault in self.faults[:MOST_FAULTS_PRINTED]]
        left_out = len(self.faults) - len(lines)
        return "\n".join([*lines, f"... and {left_out} more mistakes."] if left_out else lines)


class UsageError(FairleadError):
    """A command that cannot be carried out as typed, such as a run into a finished directory."""

    exit_code = 2


class NoCopyError(UsageError, TypeError):
    """What cannot be pickled or copied; of Python's own kind as well, so that whoever sends objects about knows it."""


class RunError(FairleadError):
    """A run that failed or was cut short: `result` is the `Result` of what was computed until then.

    `run(check=False)` returns that result instead. The exit code is that of `fairlead run`: 3 for a failure, 4 for a
    budget that is used up, 130 after Ctrl-C.
    """

    exit_code = 3

    def __init__(self, result: Any) -> None:
        self.result = result
        self.exit_code = {"budget": 4, "interrupted": 130}.get(result.status, 3)
        super().__init__(result)

    def __str__(self) -> str:
        run, where = self.result.run, f" and in {self.result.path}" if self.result.path else ""
        said = str(run.get("sentence") or "the run ended early").rstrip()
        return (
            f"{run.get('name', 'the model')}: {self.result.status}: {said}\n"
            f"    What was computed is in `.result` of this error{where}; run(check=False) returns it."
        )


class SteppingError(FairleadError):
    """A run that is stepped from outside and came to an end of its own: the sentence says why, `t` is when [s]."""

    exit_code = 3

    def __init__(self, sentence: str, t: float) -> None:
        self.t = t
        super().__init__(sentence)


class RunInterrupted(RunError, KeyboardInterrupt):
    """Ctrl-C during a run: what was computed is in `result`, and whoever handles a KeyboardInterrupt handles this."""


class RunWarning(UserWarning):
    """A remark on a run: what `check` would remark, chatter, an energy ledger that does not close, a broken limit."""


class NumericalError(FairleadError):
    """The integrator could not go on: NaN, step size at its floor, zones that do not settle."""

    exit_code = 3


def without_echoes(faults: Iterable[Fault], earlier: Iterable[Fault]) -> list[Fault]:
    """The faults of a later stage, less those at a place that an earlier stage has blamed already.

    What stands there could not be read, so whatever a later stage says about it is only an echo. What was given by
    `--set` or an argument has no line; there the place is the path with which both begin (`block.mass: ...`).
    """
    blamed = {_blamed(fault) for fault in earlier if fault.where}
    return [fault for fault in faults if _blamed(fault) not in blamed]


def _blamed(fault: Fault) -> tuple[Location | None, str]:
    no_line = fault.where is not None and not fault.where.line
    return fault.where, fault.what.split(" ", 1)[0].rstrip(":") if no_line else ""


def no_attribute(owner: object, name: str, called: Mapping[str, str], more: str = "") -> AttributeError:
    """What `__getattr__` raises: what was meant, by what others call it (`called`) or by its letters, else `more`."""
    public = [one for one in dir(type(owner)) if not one.startswith("_")]
    meant = f"Did you mean {called[name]}?" if name in called else did_you_mean(name, public) or more
    return AttributeError(f"a {type(owner).__name__} has no {shown(name)}. {meant}".rstrip())


def did_you_mean(word: object, allowed: Iterable[str]) -> str:
    """The sentence "Did you mean X?" for the nearest allowed word, or "" when none is near, or `word` is no text.

    Case, underscores and hyphens do not count as differences. A longer name that contains `word` as a whole
    (`force` for `normal_force`) is offered when it is the only one.
    """
    if not isinstance(word, str) or not 0 < len(word) <= LONGEST_WORD_COMPARED:
        return ""
    by_key: dict[str, str] = {}
    for name in allowed:
        by_key.setdefault(_key(name), name)
    if len(by_key) > MOST_WORDS_COMPARED:
        ends = _key(word)[:3], _key(word)[-3:]
        by_key = {
            key: name for key, name in by_key.items() if key.startswith(ends[0]) or key.endswith(ends[1])
        }
    near = _one_letter_off(_key(word), by_key)
    if len(near) != 1:
        near = [key for key in by_key if sorted(key) == sorted(_key(word))]  # two letters in the wrong order
    if len(near) != 1:
        import difflib

        near = difflib.get_close_matches(_key(word), [*by_key][:MOST_WORDS_COMPARED], n=1, cutoff=0.6)
    if not near:
        near = [key for key in by_key if len(word) > 2 and _key(word) in key]
    return f"Did you mean {by_key[near[0]]}?" if len(near) == 1 else ""


def _one_letter_off(word: str, names: Iterable[str]) -> list[str]:
    """Short names that differ in one letter only, where difflib would prefer a shorter one."""
    alike = [name for name in names if len(name) == len(word) <= 3]
    return [name for name in alike if sum(one != other for one, other in zip(word, name)) == 1]


def _key(word: str) -> str:
    return word.lower().replace("_", "").replace("-", "")


def listing(names: Iterable[str], most: int = 12) -> str:
    """The names separated by commas; a long list is cut and says how many were left out."""
    words = [name if len(name) <= LONGEST_VALUE_SHOWN else shown(name) for name in names]
    shown_words = ", ".join(words[:most])
    return f"{shown_words} and {len(words) - most} more" if len(words) > most else shown_words


def shown(value: object, most: int = LONGEST_VALUE_SHOWN) -> str:
    """A value from a user's file as it may stand in a message: one line, printable, of `most` characters."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if value is None:
        return "nothing"
    if isinstance(value, dict):
        return f"a map of {len(value)}" if value else "an empty map"
    if isinstance(value, (list, tuple)):
        return f"a list of {len(value)}" if value else "an empty list"
    if isinstance(value, int) and abs(value) >= 10**LONGEST_VALUE_SHOWN:
        return f"a whole number of more than {LONGEST_VALUE_SHOWN} digits"
    text = value if isinstance(value, str) else str(value)
    if len(text) > most:
        return f"{_printable(text[: most - 20])!r}... ({len(text)} characters)"
    return _printable(text) if text.strip() else repr(text)


def printable(text: str) -> str:
    """The text with a mark for every character that is none to be seen: escapes, directions, halves of characters.

    Line breaks and tabs stay.
    """
    return text if text.isprintable() else "".join(map(_seen, text))


def _seen(letter: str) -> str:
    return letter if letter.isprintable() or letter in "\n\t" else " " if letter.isspace() else "\ufffd"


def _printable(text: str) -> str:
    return "".join(letter if letter.isprintable() else " " if letter.isspace() else "\ufffd" for letter in text)
