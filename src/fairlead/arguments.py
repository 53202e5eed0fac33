"""Arguments of Python calls that cannot be meant, refused by name like the keys of a netlist, all of a call at once.

    asked = Arguments("Model.run")
    asked.folder("out", out)
    asked.yes_or_no("force", force)
    asked.refuse()                  raises ModelError with every mistake
"""

from __future__ import annotations

import contextlib
import functools
import inspect
import math
import os
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from fairlead.errors import Fault, Location, ModelError, UsageError, did_you_mean, listing, shown
from fairlead.quantities import QuantityError, si

NAN = "Look where it comes from: an empty cell of a table is nan, and 0/0."
NONE = 'Give a value, or "null" for a parameter as if it were not given; a part is left out in the netlist.'
ONE = "Give one value; for several make a model of each, in a loop."
P = ParamSpec("P")
T = TypeVar("T")


def keywords_told(call: Callable[P, T]) -> Callable[P, T]:
    """The call, which tells a keyword that it does not know with a near one: a UsageError in place of a TypeError.

    So it does with more arguments than it has places for.
    """
    takes = inspect.signature(call).parameters.values()
    any_word = any(one.kind is one.VAR_KEYWORD for one in takes)
    places = [one.name for one in takes if one.kind in (one.POSITIONAL_ONLY, one.POSITIONAL_OR_KEYWORD)]
    any_place = any(one.kind is one.VAR_POSITIONAL for one in takes)
    known = [one.name for one in takes if one.kind in (one.POSITIONAL_OR_KEYWORD, one.KEYWORD_ONLY)]
    name = call.__qualname__.removesuffix(".__init__")

    @functools.wraps(call)
    def told(*arguments: P.args, **given: P.kwargs) -> T:
        if len(arguments) > len(places) and not any_place:
            more = shown(repr(arguments[len(places)]))
            fitting = [one for one in places if one != "self"]
            raise UsageError(f"{name}: {more} is one argument too many.\n    {_takes_what(fitting, any_word)}")
        for word in given:
            if word not in known and not any_word:
                names = [one for one in known if one != "self"]
                what = f"{name}: there is no argument {shown(word)}. {did_you_mean(word, names)}".rstrip()
                raise UsageError(f"{what}\n    Arguments are {listing(names)}.")
        return call(*arguments, **given)

    return told


def _takes_what(places: list[str], any_word: bool) -> str:
    """Which arguments a call takes without their names, and how others are given."""
    words = ", or in a dict: {NAME: VALUE}" if any_word else ""
    without = f"Without a name it takes {listing(places)}" if places else "It takes none without a name"
    return f"{without}; others are given as NAME=VALUE{words}."


@contextlib.contextmanager
def told_of(call: str, inner: str, names: Mapping[str, str] | None = None) -> Iterator[None]:
    """Mistakes that the call `inner` tells are told as of `call`, the one that the user made.

    `names` are those of values there, by the name that `inner` has for them.
    """
    try:
        yield
    except ModelError as error:
        raise ModelError(_as_of(fault, call, inner, names or {}) for fault in error.faults) from None


def _as_of(fault: Fault, call: str, inner: str, names: Mapping[str, str]) -> Fault:
    what = fault.what
    for inside, name in names.items():
        what = what.replace(f"values[{inside}]", inside)
        what = what if name == inside else f"{name}: {what}"
    return Fault(Location(call) if fault.where == Location(inner) else fault.where, what, fault.way_out)


class Arguments:
    """The arguments of one call, and what is wrong with them."""

    def __init__(self, call: str) -> None:
        self.place = Location(call)
        self.faults: list[Fault] = []

    def refuse(self) -> None:
        """Raise ModelError when something is wrong."""
        if self.faults:
            raise ModelError(self.faults)

    def path(self, name: str, value: object, none: str = "") -> None:
        """A path: a text or a Path; `none` says what None stands for, where it may be None."""
        if value is None and none:
            return
        text = os.fsencode(value) if isinstance(value, str | os.PathLike) else b""
        if b"\0" in text:
            self._wrong(name, repr(value), "is not a path: it has the character NUL", "Give a text or a pathlib.Path.")
            return
        if text:
            return
        self._wrong(name, value, "is not a path", f"Give a text or a pathlib.Path{f', or {none}' if none else ''}.")

    def folder(self, name: str, value: object, none: str) -> None:
        """A path for results; a time is none, it is meant for `stop`."""
        self.path(name, value, none)
        if isinstance(value, str) and not value.replace(".", "").isdigit() and _fits(value, "s"):
            way_out = f'The end of a run is stop={value!r}. A folder of that name is pathlib.Path({value!r}).'
            self._wrong(name, value, "is a time, not a folder", way_out)

    def new_file(self, name: str, value: object) -> None:
        """A path of a file to write, whose folder is there."""
        before = len(self.faults)
        self.path(name, value)
        if len(self.faults) > before or not isinstance(value, str | os.PathLike):
            return
        file = Path(os.fsdecode(value))
        if file.is_dir():
            self._wrong(name, str(file), "is a folder", "Give the name of a file in it.")
        elif not file.parent.is_dir():
            what = f"cannot be written: there is no folder {shown(str(file.parent))}"
            self._wrong(name, str(file), what, "Make the folder first, or give another one.")

    def model(self, value: object) -> None:
        """A model that was loaded; its name or its file is none, nor is a result of it."""
        if value is None or isinstance(value, str | os.PathLike):
            self._wrong("model", value, "is not a Model", f"Load it: fairlead.load({value!r}).")
        elif not (hasattr(value, "netlist") and hasattr(value, "beside")):
            way_out = "Give the model of which it is a run; fairlead.load(PATH) gives one."
            self._wrong("model", f"a {type(value).__name__}", "is not a Model", way_out)

    def whole(self, name: str, value: object, least: int) -> None:
        """A whole number from `least` on."""
        number = value.item() if getattr(value, "shape", None) == () and hasattr(value, "item") else value
        if isinstance(number, bool) or not isinstance(number, int):
            self._wrong(name, value, "is not a whole number", f"Give a whole number, {least} or more.")
        elif number < least:
            self._wrong(name, value, f"is below {least}", f"Give a whole number, {least} or more.")

    def text(self, name: str, value: object, example: str) -> None:
        """A text."""
        if not isinstance(value, str):
            self._wrong(name, value, "is not a text", f"Write it as {example}.")

    def map_of(self, name: str, value: object, example: str, kind: Any = object, otherwise: str = "") -> None:
        """A map; where its values are of a kind, its names are texts. `otherwise` says what a value is that is not."""
        if not isinstance(value, Mapping):
            self._wrong(name, value, "is not a map", f"Write it as {example}.")
            return
        for key, one in value.items() if kind is not object else ():
            if not isinstance(key, str):
                self._wrong(name, key, "is not a name, which is a text", f"Write it as {example}.")
            elif not _is(one, kind):
                self._wrong(f"{name}[{shown(key)}]", one, otherwise, f"Write it as {example}.")

    def names(self, name: str, value: object, example: str, *, functions: bool = False) -> None:
        """One text, or several in a list; also functions, where these may be."""
        if not isinstance(value, Iterable) or isinstance(value, bytes):
            self._wrong(name, value, "is neither a text nor a list", f"Write it as {example}.")
            return
        for one in [value] if isinstance(value, str) else _again(value):
            if not isinstance(one, str) and not (functions and callable(one)):
                self._wrong(name, one, "is not a text", f"Write it as {example}.")

    def nothing_twice(self, name: str, value: Iterable[str], other: Iterable[str]) -> None:
        """Names that may be given in one of two places, and not in both."""
        for one in sorted({*value} & {*other}):
            self._wrong(name, one, "is given twice", "Give it once, in the map or by its name.")

    def yes_or_no(self, name: str, value: object) -> None:
        """True or False; a text would count as true, whatever it says."""
        if not _is(value, bool):
            self._wrong(name, value, "is neither True nor False", "")

    def function(self, name: str, value: object, takes: Collection[str]) -> None:
        """None, or what can be called with so many arguments."""
        if value is None:
            return
        wanted = f"Give a function of {', '.join(takes)}, or leave it out."
        if not callable(value):
            self._wrong(name, value, "is not a function", wanted)
        elif not _takes(value, len(takes)):
            self._wrong(name, getattr(value, "__name__", value), f"does not take {len(takes)} arguments", wanted)

    def above_zero(self, name: str, value: object, unit: str) -> float:
        """A number or a quantity above zero; returns it in SI. Infinity is taken."""
        try:
            number = math.inf if value == math.inf else si(value, unit)
        except QuantityError as error:
            self.faults.append(Fault(self.place, f"{name} = {error.what}", error.allowed))
            return math.nan
        if not number > 0:
            self._wrong(name, value, "is not above 0", f"Give a number of {unit}, or a text with its unit.")
        return number

    def quantity(self, name: str, value: object, unit: str) -> float:
        """A number or a quantity; returns it in SI."""
        try:
            return si(value, unit)
        except QuantityError as error:
            self.faults.append(Fault(self.place, f"{name} = {error.what}", error.allowed))
            return math.nan

    def alone(self, name: str, value: object, way_out: str) -> None:
        """What is of no use without others, and is given without them."""
        self._wrong(name, value, "is given alone", way_out)

    def outside(self, name: str, value: object, recorded: str) -> None:
        """A span in which there is nothing."""
        self._wrong(name, value, "has nothing to show", f"The run {recorded}.")

    def pair(self, name: str, value: object, example: str) -> None:
        """Not two numbers in rising order, which is a mistake."""
        self._wrong(name, value, "are not two numbers, the first below the second", f"Write it as {example}.")

    def one_of(self, name: str, value: object, allowed: Collection[str]) -> None:
        """One of some words."""
        if value not in allowed:
            near = did_you_mean(value, allowed) if isinstance(value, str) else ""
            self._wrong(name, value, "is not known", f"{near} Allowed are {listing(allowed)}.".strip())

    def values_by_name(self, name: str, value: object, *, none: bool = True) -> None:
        """A map of names to texts or numbers, or None where that may be."""
        if value is None and none:
            return
        if not isinstance(value, Mapping):
            self._wrong(name, value, "is not a map", 'Write it as {"run.stop": "5 s"}.')
            return
        for key, one in value.items():
            if not isinstance(key, str):
                self._wrong(name, key, "is no name of a parameter or a setting", 'Write it as {"run.stop": "5 s"}.')
            elif not _is(one, str | int | float):
                way_out = NONE if one is None else ONE
                if isinstance(one, Mapping) and one:
                    inner, given = next(iter(one.items()))
                    way_out = f'Write the whole name: {{"{key}.{inner}": {shown(repr(given))}}}.'
                self._wrong(f"{name}[{shown(key)}]", one, "is neither a text nor a number", way_out)
            elif one != one:
                self._wrong(f"{name}[{shown(key)}]", one, "is not a number", NAN)

    def texts(self, name: str, value: object, example: str, each: str = "path") -> None:
        """Several texts or paths; a single one is taken for the mistake it is. `each` says what one of them is."""
        if isinstance(value, str | bytes | os.PathLike) or not isinstance(value, Iterable):
            self._wrong(name, value, "is not a list", f"Write it as [{example}].")
        elif wrong := [one for one in _again(value) if not isinstance(one, str | os.PathLike)]:
            self._wrong(name, wrong[0], f"is not a {each}", f"Write it as [{example}].")

    def _wrong(self, name: str, value: object, what: str, way_out: str) -> None:
        told = shown(value if isinstance(value, str) else repr(value))
        self.faults.append(Fault(self.place, f"{name} = {told} {what}", way_out))


def _again(value: Iterable[Any]) -> Iterable[Any]:
    """What can be gone through twice; of an iterator nothing, for the call itself would find it empty."""
    return () if isinstance(value, Iterator) else value


def _fits(text: str, unit: str) -> bool:
    try:
        si(text, unit)
    except QuantityError:
        return False
    return True


def _is(value: object, kind: Any) -> bool:
    """Whether a value is of a kind, also as numpy has single numbers (which is not imported for it)."""
    return isinstance(value.item() if getattr(value, "shape", None) == () and hasattr(value, "item") else value, kind)


def _takes(function: Any, count: int) -> bool:
    """Whether a function can be called with so many arguments; where that cannot be told, it is tried."""
    try:
        inspect.signature(function).bind(*[None] * count)
    except TypeError:
        return False
    except ValueError:
        return True
    return True
