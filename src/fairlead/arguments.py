"""Arguments of Python calls that cannot be meant, refused by name like the keys of a netlist, all of a call at once.

    asked = Arguments("Model.run")
    asked.folder("out", out)
    asked.yes_or_no("force", force)
    asked.refuse()                  raises ModelError with every mistake
"""

from __future__ import annotations

import inspect
import math
import os
from collections.abc import Collection, Iterable, Mapping
from typing import Any

from fairlead.errors import Fault, Location, ModelError, did_you_mean, listing, shown
from fairlead.quantities import QuantityError, si

NAN = "Look where it comes from: an empty cell of a table is nan, and 0/0."
NONE = 'Give a value, or "null" for a parameter as if it were not given; a part is left out in the netlist.'
ONE = "Give one value; for several make a model of each, in a loop."


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
        if (value is None and none) or (isinstance(value, str | os.PathLike) and os.fspath(value) not in ("", b"")):
            return
        self._wrong(name, value, "is not a path", f"Give a text or a pathlib.Path{f', or {none}' if none else ''}.")

    def model(self, value: object) -> None:
        """A model that was loaded; its name or its file is none."""
        if value is None or isinstance(value, str | os.PathLike):
            self._wrong("model", value, "is not a Model", f"Load it: fairlead.load({value!r}).")

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

    def pair(self, name: str, value: object, example: str) -> None:
        """Not two numbers in rising order, which is a mistake."""
        self._wrong(name, value, "are not two numbers, the first below the second", f"Write it as {example}.")

    def one_of(self, name: str, value: object, allowed: Collection[str]) -> None:
        """One of some words."""
        if value not in allowed:
            near = did_you_mean(value, allowed) if isinstance(value, str) else ""
            self._wrong(name, value, "is not known", f"{near} Allowed are {listing(allowed)}.".strip())

    def values_by_name(self, name: str, value: object) -> None:
        """A map of names to texts or numbers, or None."""
        if value is None:
            return
        if not isinstance(value, Mapping):
            self._wrong(name, value, "is not a map", 'Write it as {"run.stop": "5 s"}.')
            return
        for key, one in value.items():
            if not isinstance(key, str):
                self._wrong(name, key, "is no name of a parameter or a setting", 'Write it as {"run.stop": "5 s"}.')
            elif not _is(one, str | int | float):
                way_out = NONE if one is None else ONE
                self._wrong(f"{name}[{shown(key)}]", one, "is neither a text nor a number", way_out)
            elif one != one:
                self._wrong(f"{name}[{shown(key)}]", one, "is not a number", NAN)

    def texts(self, name: str, value: object, example: str) -> None:
        """Several texts or paths; a single one is taken for the mistake it is."""
        if isinstance(value, str | bytes | os.PathLike) or not isinstance(value, Iterable):
            self._wrong(name, value, "is not a list", f"Write it as [{example}].")
        elif wrong := [one for one in value if not isinstance(one, str | os.PathLike)]:
            self._wrong(name, wrong[0], "is not a path", f"Write it as [{example}].")

    def _wrong(self, name: str, value: object, what: str, way_out: str) -> None:
        told = shown(value if isinstance(value, str) else repr(value))
        self.faults.append(Fault(self.place, f"{name} = {told} {what}", way_out))


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
