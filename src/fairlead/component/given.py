"""What a component is given: numbers, words, counts, names, parts, blocks, tables and quantities in time.

Small frozen records like those of `declare.py`; `parameters.py` reads what a netlist writes for them.

Two marks tell the framework what a parameter is for, whatever it is called:

    mesh=True       it says how fine the elements are: a `Count` how many, a `Parameter` or the y of a `Table` how long
    physics=False   it says where, how or at what something starts, so that leaving it out models nothing less
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from fairlead.netlist.item_names import item_names

REQUIRED: Any = object()


@dataclass(frozen=True)
class Parameter:
    """A number with a unit and a range; SI inside, any unit of the same kind in a netlist.

    `above`/`below` exclude the bound, `least`/`most` include it. Without a default it must be given.
    A default of None means "absent": the law must not read it then. `usual` is the range in which such a quantity
    lies in practice; what a netlist gives beyond it is remarked, not refused. `like` names the input whose unit a plain
    number has: a netlist may write it with that unit, and another one than that of the signal joined there is refused.
    """

    unit: str
    doc: str = ""
    default: Any = REQUIRED
    above: float | None = None
    least: float | None = None
    below: float | None = None
    most: float | None = None
    mesh: bool = False
    physics: bool = True
    usual: tuple[float, float] | None = None
    like: str = ""


@dataclass(frozen=True)
class Choice:
    """A word among a few; each option is a variant of its own, traced and compiled apart."""

    options: tuple[str, ...]
    doc: str = ""
    default: Any = REQUIRED
    physics: bool = True


SWITCH = ("on", "off")


@dataclass(frozen=True)
class Effect(Choice):
    """Physics that may be left out: `p.name` is "on" or "off", each traced and compiled apart.

    A composite makes no children for what is off; a law has no term for it. Where an unknown or a zone is to
    go, `off` names the limiting model, a class with the same ports and signals and with parameters of the same
    names: it takes the place of the component. How a netlist says it is in `effects.py`.
    """

    off: type | None = None

    def __init__(self, doc: str = "", default: str = "on", *, off: type | None = None) -> None:
        """An effect that is on unless `default` says otherwise."""
        super().__init__(SWITCH, doc, default)
        object.__setattr__(self, "off", off)


@dataclass(frozen=True)
class Count:
    """A whole number that shapes a composite (how many children); never seen by a law."""

    doc: str = ""
    default: Any = REQUIRED
    least: int = 1
    most: int = 1_000_000
    mesh: bool = False


@dataclass(frozen=True)
class Name:
    """A lower_snake name by which something is spoken of, such as a device of a route; never seen by a law."""

    doc: str = ""
    default: Any = REQUIRED


@dataclass(frozen=True)
class File:
    """A file in the folder of the netlist or below, given relative to that; read as its whole path. No law sees it."""

    doc: str = ""
    default: Any = REQUIRED
    ending: str = ""  # of those that a message offers


@dataclass(frozen=True)
class Entries:
    """A map with keys of the user's own, read as pairs in their order; what it means is the class's business."""

    doc: str = ""
    default: Any = REQUIRED


@dataclass(frozen=True)
class Text:
    """A line of text with a meaning of its own, such as an expression; read by the class, and never seen by a law."""

    doc: str = ""
    default: Any = REQUIRED


@dataclass(frozen=True)
class Matrix:
    """Numbers in rows, in SI: a list of lists of one length, a list for one row, a number for one by one.

    Read as a tuple of rows; no law sees it. Whether a list is a row or a column is for the class to say.
    """

    doc: str = ""
    default: Any = REQUIRED


@dataclass(frozen=True)
class Part:
    """A replaceable part of a law: an instance of a `family` of small declarations (such as a curve)."""

    family: type
    doc: str = ""
    default: Any = REQUIRED


@dataclass(frozen=True)
class Block:
    """A group of parameters written as a map in the netlist: `hose: {mass: 1.6 kg/m, ...}`.

    With a default of None the whole block may be left out. A block is never seen by a law.
    """

    parameters: Mapping[str, Parameter]
    doc: str = ""
    default: Any = REQUIRED


@dataclass(frozen=True)
class Table:
    """An x-y table as a law function: value and derivative, its interval frozen inside a step."""

    x: str
    y: str
    doc: str = ""
    default: Any = REQUIRED
    mesh: bool = False
    physics: bool = True


@dataclass(frozen=True)
class Waveform:
    """A quantity given in time: constant, ramp, step, sine, trapezoid or table; pieces end exactly."""

    unit: str
    doc: str = ""
    default: Any = REQUIRED


@dataclass(frozen=True)
class Stations:
    """The ordered devices of a route, each an instance of a `family`."""

    family: type
    doc: str = ""

    @staticmethod
    def names(stations: Iterable[Any]) -> list[str]:
        """Given names, else the type in small letters, with a number when there are several: bend_1, bend_2."""
        return [str(name) for name in item_names((one.name, one.type.word) for one in stations)]
