"""Figures that a case can be asked for, read from a text and checked against the model before anything runs.

    end(block.x)                 value at the end               at(block.x, 2 s)        value at a time
    peak(line.hose[*].tension)   highest of all these signals   lowest(...)             lowest
    largest(block.x)             largest without its sign       mean(block.x, 1 s, 3 s) over a span, or the run
    rms(block.x)                 root of the mean square        time(pad, held, 2)     second change into a zone
    period(pad, held)            from the last but one change into a zone to the last; with n from the n-th on
    switches(pad)                zone changes                   energy(dissipated)      an entry of the ledger
    margin(ruck)                 of lines: ruck, slack, side_wall, slip
    broken()                     how many limits of the netlist the run broke

A figure may also be a Python function that takes the `Result` and returns a number. It sees what the netlist records,
as often as the netlist says. How accurate a figure is does not depend on which others are asked for.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fairlead.analysis.record.declared_signals import signals_of
from fairlead.analysis.record.suggestion import inside, suggest
from fairlead.errors import Fault, Location, ModelError, did_you_mean, listing, shown
from fairlead.patterns import picked
from fairlead.quantities import QuantityError, digits, si

if TYPE_CHECKING:
    from fairlead.model import Model

Function = Callable[[Any], float]
OF_SEVERAL = ("peak", "lowest", "largest")
OF_ONE = ("end", "at", "mean", "rms")
MARGINS = {"ruck": "1", "slack": "N", "side_wall": "1", "slip": "m"}
LEDGER = {"supplied": "J", "dissipated": "J", "stored": "J", "closure": "1"}
KINDS = (*OF_ONE, *OF_SEVERAL, "time", "period", "switches", "margin", "energy", "broken")
LAST = 0
"""Of a period: the last one of the run."""
EXAMPLE = "Write it as in peak(block.x), mean(block.x, 1 s, 3 s) or time(pad, held)."
PLACE = Location("figures")


@dataclass(frozen=True)
class Figure:
    """One figure: what is asked of which signals or components, and its unit."""

    name: str
    text: str
    kind: str
    signals: tuple[str, ...] = ()
    """Patterns to record."""
    arguments: tuple[Any, ...] = ()
    """What follows, in SI: times, a zone, the number of an event, a word."""
    unit: str = "1"
    function: Function | None = None

    @property
    def wants_curves(self) -> bool:
        """Whether it is told from rows of all steps, on the curves that go through them."""
        return self.kind in ("at", "mean", "rms")

    @property
    def wants_rows(self) -> bool:
        """Whether it is told from rows of its signals, and not from their extremes."""
        return self.kind not in OF_SEVERAL

    @property
    def wants_extremes(self) -> bool:
        """Whether it is told from the extremes that the run looks for as it goes."""
        of_most = self.kind == "energy" and self.arguments == ("closure",)  # it goes by the most energy at any time
        return self.kind in OF_SEVERAL or self.wants_record or of_most

    @property
    def wants_record(self) -> bool:
        """Whether it is told from what the netlist records, as often as it says."""
        return self.kind in ("margin", "function")


def read_figures(wanted: Mapping[str, str | Function], model: Model) -> tuple[Figure, ...]:
    """The figures of a model. Raises ModelError with every mistake in them."""
    known = _Known(model)
    found: list[Figure] = []
    faults: list[Fault] = []
    for name, text in wanted.items():
        try:
            found.append(_function(name, text) if callable(text) else known.figure(str(name), str(text)))
        except _Wrong as wrong:
            faults.append(Fault(PLACE, f"{shown(name)} = {shown(text)}: {wrong.what}", wrong.way_out))
    if faults:
        raise ModelError(faults)
    return tuple(found)


def _function(name: str, function: Function) -> Figure:
    return Figure(name, _label(function), "function", function=function)


def _label(function: Function) -> str:
    """What a function is known by: its name and its text, where Python has that."""
    label = getattr(function, "label", None)
    if isinstance(label, str):
        return label
    try:
        text = inspect.getsource(function)
    except (OSError, TypeError):
        text = ""
    return f"{getattr(function, '__qualname__', type(function).__name__)} {text}"


class _Wrong(ValueError):
    def __init__(self, what: str, way_out: str = EXAMPLE) -> None:
        super().__init__(what)
        self.what, self.way_out = what, way_out


@dataclass
class _Known:
    """A model and its names."""

    model: Model

    def __post_init__(self) -> None:
        self.units = {one.name: one.unit for one in signals_of(self.model.flat.assembly)}

    def figure(self, name: str, text: str) -> Figure:
        """Read one text. Raises _Wrong."""
        parts = re.fullmatch(r"\s*(\w+)\s*\((.*)\)\s*", text, re.DOTALL)
        if parts is None:
            raise _Wrong("this is no figure")
        kind, given = parts[1], [one.strip() for one in parts[2].split(",") if one.strip()]
        if kind not in KINDS:
            raise _Wrong(
                f"there is no figure {kind}. {did_you_mean(kind, KINDS)}".rstrip(), f"There are {listing(KINDS)}."
            )
        made: dict[str, Any] = getattr(self, f"_{kind}" if hasattr(self, f"_{kind}") else "_of_signals")(kind, given)
        return Figure(name, text, kind, **made)

    def _of_signals(self, kind: str, given: Sequence[str]) -> dict[str, Any]:
        if not given:
            raise _Wrong(f"{kind} of what? A signal is missing")
        names = picked(self.units, given[0])
        if not names:
            near, way_out = suggest(given[0], [*self.units])
            way_out = f"{inside(self.model.flat.assembly, given[0])} {way_out}".strip()
            raise _Wrong(f"no signal has the name {shown(given[0])}. {near}".rstrip(), way_out or EXAMPLE)
        if kind in OF_ONE and len(names) > 1:
            raise _Wrong(
                f"{shown(given[0])} stands for {len(names)} signals",
                f"{kind} takes one; {listing(OF_SEVERAL)} take several.",
            )
        times = tuple(_seconds(one) for one in given[1:])
        if len(times) not in {"at": (1,), "mean": (0, 2), "rms": (0, 2)}.get(kind, (0,)):
            raise _Wrong(
                f"{kind} takes {'one time' if kind == 'at' else 'no time or two' if kind in OF_ONE else 'no time'}"
            )
        if len(times) == 2 and not times[0] < times[1]:
            raise _Wrong(f"the span from {times[0]:g} s to {times[1]:g} s is empty")
        run = self.model.netlist.run
        if outside := [t for t in times if not run.start <= t <= run.stop]:
            raise _Wrong(f"{outside[0]:g} s is not in the run, which goes from {run.start:g} s to {run.stop:g} s",
                         "Take another time, or another run.stop.")  # fmt: skip
        return {"signals": (given[0],), "arguments": times, "unit": self.units[names[0]]}

    def _time(self, kind: str, given: Sequence[str]) -> dict[str, Any]:
        if not 1 <= len(given) <= 3:
            raise _Wrong(
                f"{kind} takes a component, a zone, and which of the changes is meant",
                f"Write it as in {kind}(pad, held, 2).",
            )
        text = given[2] if len(given) > 2 else "1"
        number = digits(text)
        if number is None or number < 1:
            raise _Wrong(f"{shown(text)} is no number of an event", "They are counted from 1.")
        count = LAST if kind == "period" and len(given) < 3 else number
        component = self._component(given[0])
        system = self.model.system
        zones = dict.fromkeys(zone for k, name in enumerate(system.machine_names) if name in component
                              for zone in system.zone_names(k))  # fmt: skip
        if len(given) > 1 and given[1] not in zones:
            raise _Wrong(
                f"{given[0]} has no zone {shown(given[1])}. {did_you_mean(given[1], zones)}".rstrip(),
                f"There are {listing(zones)}.",
            )
        return {"arguments": (given[0], given[1] if len(given) > 1 else "", count), "unit": "s"}

    _period = _time

    def _switches(self, kind: str, given: Sequence[str]) -> dict[str, Any]:
        if len(given) > 1:
            raise _Wrong("switches takes one component, or none for all of them")
        if given:
            self._component(given[0])
        return {"arguments": (given[0] if given else "*",)}

    def _component(self, pattern: str) -> set[str]:
        names = dict.fromkeys(self.model.system.machine_names)
        found = picked(names, pattern)
        if not found:
            inside = [name for name in names if name.startswith(f"{pattern}.")]
            near = f"Did you mean {inside[0]}?" if inside else did_you_mean(pattern, names)
            raise _Wrong(
                f"no component of the name {shown(pattern)} has zones. {near}".rstrip(), f"There are {listing(names)}."
            )
        return set(found)

    def _margin(self, kind: str, given: Sequence[str]) -> dict[str, Any]:
        word = _word(kind, given, MARGINS)
        from fairlead.analysis.statics.route_record import route_records

        lines = route_records(self.model.flat)
        if not lines:
            raise _Wrong(f"{self.model.netlist.name} has no line on a route", "Margins are those of such lines.")
        if word in ("ruck", "side_wall"):
            limit = {"ruck": "ruck_force", "side_wall": "side_wall"}[word]
            if all(line[limit] is None for line in lines):
                raise _Wrong(f"no line says what it bears ({limit})", f"Give {lines[0]['line']} a {limit}.")
        return {"signals": tuple(_recorded(lines)), "arguments": (word,), "unit": MARGINS[word]}

    def _energy(self, kind: str, given: Sequence[str]) -> dict[str, Any]:
        word = _word(kind, given, LEDGER)
        return {"arguments": (word,), "unit": LEDGER[word]}

    def _broken(self, kind: str, given: Sequence[str]) -> dict[str, Any]:
        if given:
            raise _Wrong("broken takes nothing: it counts the limits of the netlist")
        return {}


def _recorded(lines: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """Patterns of what margins of lines are told from."""
    for record in lines:
        line = record["line"]
        yield from (f"{line}.{layer}[*].tension" for layer in record["layers"])
        yield f"{line}.{record['outer']}[*].x"
        contacts = dict.fromkeys(each["contact"] for each in record["stations"] if each["contact"])
        yield from (f"{line}.{child}[*].slip" for child in contacts)


def _word(kind: str, given: Sequence[str], allowed: Mapping[str, str]) -> str:
    if len(given) != 1 or given[0] not in allowed:
        near = did_you_mean(given[0], allowed) if given else ""
        raise _Wrong(f"{kind} takes one word. {near}".rstrip(), f"There are {listing(allowed)}.")
    return given[0]


def _seconds(text: str) -> float:
    try:
        return si(text, "s")
    except QuantityError as error:
        raise _Wrong(error.what, error.allowed) from None


def default_figures(model: Model) -> dict[str, str]:
    """What is told when nobody says: extremes of what the netlist records by name, and margins of lines."""
    plotted = [pattern for plot in model.netlist.record.plots for pattern in plot.signals]
    patterns = [one for one in (*model.netlist.record.signals, *plotted) if one.strip("*")]
    patterns = list(dict.fromkeys(patterns)) or list(dict.fromkeys(plotted))
    found: dict[str, str] = {}
    for pattern in patterns[:MOST_DEFAULT]:
        found |= {f"{word}({pattern})": f"{word}({pattern})" for word in ("peak", "lowest")}
    for word in MARGINS:
        try:
            _Known(model).figure(word, f"margin({word})")
        except _Wrong:
            continue
        found[f"margin({word})"] = f"margin({word})"
    return found


MOST_DEFAULT = 6
"""Patterns of a netlist whose extremes are figures when nobody says which: a table stays readable."""
