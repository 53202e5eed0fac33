"""Parameters that can be set while an FMU runs: which numbers of its memory follow them, and by which law.

A parameter is worked out into many numbers in Python (derived parameters, masses, plans), and there is none where the
FMU runs. So the model is laid out at a row of values of the parameter, from an eighth of its own to eight times it, as
far as it is taken. A number of memory that is not the same at all of them follows the law

    number = offset + slope p^power        power 1, 2, 3, 4, 1/2 or 3/2, or the negative of one of these
    number = (offset + slope p)^2
    number = 1/(offset + slope p)

if one of these gives all values of the row, but for rounding. What follows no such law cannot be worked out where the
FMU runs, and the parameter is refused, with the name of what depends on it. A value beyond the row is refused while
running.

What a run goes on with (`kept`) is not worked out of parameters any more: unknowns, zones, samples and inputs, as in
`tuning.py`. Where the start follows in another way, a parameter can be set after the start only.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import FairleadError, ModelError, UsageError, listing
from fairlead.fmu.image import OF_BLOCK, Laid
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.memory.layout import PLACES
from fairlead.outer import Variable
from fairlead.outside import LaidOpen
from fairlead.system.arrays.working import discrete, offsets
from fairlead.tuning import KEPT, discrete_columns

Floats = NDArray[np.float64]
ROW = (0.125, 0.2, 0.4, 0.7, 0.9, 1.1, 1.5, 2.5, 5.0, 8.0)
"""Values at which a model is laid out, of its own."""
POWERS: Mapping[str, Callable[[Floats], Floats]] = {
    "LAW_LINEAR": lambda p: p,
    "LAW_INVERSE": lambda p: 1 / p,
    "LAW_SQUARE": lambda p: p * p,
    "LAW_INVERSE_SQUARE": lambda p: 1 / (p * p),
    "LAW_ROOT": np.sqrt,
    "LAW_INVERSE_ROOT": lambda p: 1 / np.sqrt(p),
    "LAW_THREE_HALVES": lambda p: p * np.sqrt(p),
    "LAW_INVERSE_THREE_HALVES": lambda p: 1 / (p * np.sqrt(p)),
    "LAW_CUBE": lambda p: p * p * p,
    "LAW_INVERSE_CUBE": lambda p: 1 / (p * p * p),
    "LAW_FOURTH": lambda p: p * p * (p * p),
    "LAW_INVERSE_FOURTH": lambda p: 1 / (p * p * (p * p)),
}
"""By the name that c/tuned.c has for it."""
RECIPROCAL, SQUARED_LINE = "LAW_RECIPROCAL", "LAW_SQUARED_LINE"
ROUNDING = 64 * np.finfo(float).eps
"""Of the largest term: a few operations in a row."""
UNITS = "memory column_scale"
"""The units of the unknowns, which follow what a run begins with."""
LEAST = 4
"""Values that a row must have: a law has an offset and a slope, and two more show that it is one."""


BEFORE, AFTER, ALWAYS = "WHEN_BEFORE", "WHEN_AFTER", "WHEN_ALWAYS"
"""When a parameter can be set, by the name that c/tuned.h has for it."""


class Another(FairleadError):
    """With this value it is a model of another structure; the text says why."""


class Law(NamedTuple):
    """A number of memory that follows a parameter."""

    at: int
    """Its place in bytes."""
    law: str
    offset: float
    slope: float


@dataclass(frozen=True)
class Tuned:
    """A parameter as the library knows it."""

    name: str
    value: float
    low: float
    high: float
    """The range for which the laws were seen to hold."""
    laws: Sequence[Law]
    when: str
    """BEFORE, AFTER the start, or ALWAYS."""


class Row(NamedTuple):
    """The model laid out at values of a parameter, its own among them."""

    values: Floats
    laid: Sequence[Laid]


Lay = Callable[[Mapping[str, float], Collection[str]], Laid]
"""(values by name inside, arrays to move into the memory of an instance) -> the model laid out with them."""


def with_parameters(parameters: Sequence[Variable], lay: Lay, opened: LaidOpen) -> tuple[Laid, list[Tuned]]:
    """The model laid out so that its parameters can be set, and these. Raises UsageError for one that cannot be."""
    moved = {UNITS} if parameters else set()
    rows = {}
    for one in parameters:
        rows[one.name] = row_of(one.start or 0.0, functools.partial(_laid_at, lay, one.of), one.of)
        moved |= followers(rows[one.name])
    found = lay({}, sorted(moved))
    name_of, start = named_words(opened, found), kept_words(opened, found.memory.size, ())
    start += [(place.at, place.end - place.begin) for name, place in found.places.items() if name == UNITS]
    tuned = []
    for one in parameters:
        row = Row(rows[one.name].values, [lay({one.of: value}, sorted(moved)) for value in rows[one.name].values])
        laws, when = laws_of(row, start, one.of, name_of)
        low, high = float(row.values.min()), float(row.values.max())
        tuned.append(Tuned(one.name, float(one.start or 0.0), low, high, laws, when))
    refuse_shared(tuned)
    return found, tuned


def _laid_at(lay: Lay, name: str, value: float) -> Laid:
    return lay({name: value}, ())


def row_of(value: float, lay: Callable[[float], Laid], what: str) -> Row:
    """The model at a row of values, as far as it takes them and is laid out alike. Raises UsageError for too few."""
    if value == 0.0:
        raise UsageError(f"{what} is 0, from which no range follows.\n    Export the model with another value of it.")
    own = lay(value)
    found, why = {value: own}, ""
    for factors in (ROW[ROW.index(0.9) :: -1], ROW[ROW.index(1.1) :]):
        for factor in factors:
            try:
                other = lay(factor * value)
            except (ModelError, Another) as error:
                why = error.faults[0].what if isinstance(error, ModelError) else str(error)
                break
            if other.links != own.links or other.shared.size != own.shared.size:
                why = f"at {factor * value:.6g} [SI] the model is made of other laws"
                break
            found[factor * value] = other
    if len(found) < LEAST:
        raise UsageError(f"{what} cannot be set in the FMU: {why}.\n    Leave it as it is.")
    values = sorted(found)
    return Row(np.array(values), [found[one] for one in values])


def followers(row: Row) -> set[str]:
    """Names of the arrays in which a number follows the parameter. Raises UsageError if their lengths do."""
    first = row.laid[0].arrays
    return {
        name for name in first if name != "arena"
        for other in row.laid[1:] if not np.array_equal(_words(first[name]), _words(other.arrays[name]))
    }  # fmt: skip


def laws_of(
    row: Row, start: Sequence[tuple[int, int]], what: str, name_of: Callable[[int], str]
) -> tuple[list[Law], str]:
    """Laws of all numbers that follow, and when the parameter can be set.

    `start` are the stretches of memory that say how a run begins, and nothing afterwards. Raises UsageError with the
    names of what follows in a way that is no law, and for a parameter that nothing follows.
    """
    of_start = np.zeros(row.laid[0].memory.size // 8, dtype=bool)
    for begin, length in start:
        of_start[begin // 8 : (begin + length) // 8] = True
    words = np.array([one.memory.view(np.int64) for one in row.laid])
    changed = np.flatnonzero((words != words[0]).any(axis=0))
    numbers = words[:, changed].view(np.float64)
    laws, late, lost = list[Law](), False, list[int]()
    if not changed.size:
        raise UsageError(f"{what} cannot be set: nothing in this model follows it.\n    Name another parameter.")
    for at, values in zip((8 * changed).tolist(), numbers.T, strict=True):
        law = _law(at, row.values, values)
        if law is not None:
            laws.append(law)
        elif of_start[at // 8]:
            late = True
        else:
            lost.append(at)
    if lost:
        names = sorted({name_of(at) for at in lost})
        raise UsageError(
            f"{what} cannot be set in the FMU: {listing(names)} {'follows' if len(names) == 1 else 'follow'} it by a "
            "law that the FMU cannot work out.\n    Leave it as it is, or make what it means a signal input."
        )
    begins_only = all(of_start[law.at // 8] for law in laws)
    if late and begins_only:
        raise UsageError(
            f"{what} cannot be set in the FMU: it says how a run begins, by a law that the FMU cannot work out.\n"
            "    Leave it as it is."
        )
    return laws, AFTER if late else BEFORE if begins_only else ALWAYS


def before_the_start(one: Tuned) -> Tuned:
    """The same, to be set before the start only. Raises UsageError where it can be set after it only."""
    if one.when == AFTER:
        why = "what moves as given would jump"
        raise UsageError(f"{one.name} cannot be set in the FMU: {why}.\n    Leave it as it is.")
    return dataclasses.replace(one, when=BEFORE)


def _law(at: int, p: Floats, values: Floats) -> Law | None:
    """The law of a number, the simplest that gives all its values; None if there is none."""
    if not np.isfinite(values).all() or (np.abs(values[values != 0.0]) < np.finfo(float).tiny).any():
        return None  # whole numbers, read as numbers with a point, are smaller than any of these
    with np.errstate(all="ignore"):
        powers = {name: power(p) for name, power in POWERS.items()}
        powers = {name: g for name, g in powers.items() if np.isfinite(g).all()}
        for name, g in powers.items():
            for slope in dict.fromkeys((values / g).tolist()):
                if _fits(slope * g, values, np.abs(values)):
                    return Law(at, name, 0.0, slope)
        for name, g in powers.items():
            if (line := _line(g, values)) is not None:
                return Law(at, name, *line)
        if (values >= 0.0).all() and (squared := _squared_line(p, values)) is not None:
            return Law(at, SQUARED_LINE, *squared)
        if (values != 0.0).all() and (line := _line(p, 1 / values)) is not None:
            return Law(at, RECIPROCAL, *line)
    return None


def _line(g: Floats, values: Floats) -> tuple[float, float] | None:
    """Offset and slope of a straight line through all values; None if there is none."""
    slope = float((values[-1] - values[0]) / (g[-1] - g[0]))
    offset = float(values[0] - slope * g[0])
    size = np.maximum(np.abs(values), np.abs(slope * g)) + abs(offset)
    return (offset, slope) if _fits(offset + slope * g, values, size) else None


def _squared_line(p: Floats, values: Floats) -> tuple[float, float] | None:
    """Offset and slope of a line whose square goes through all values; it may be zero between two of them."""
    roots = np.sqrt(values)
    for below in range(len(p)):
        signed = np.where(np.arange(len(p)) < below, -roots, roots)
        slope = float((signed[-1] - signed[0]) / (p[-1] - p[0]))
        offset = float(signed[0] - slope * p[0])
        size = (np.abs(slope * p) + abs(offset)) ** 2
        if slope and _fits((offset + slope * p) ** 2, values, size):
            return offset, slope
    return None


def _fits(found: Floats, values: Floats, size: Floats) -> bool:
    return bool((np.abs(found - values) <= ROUNDING * size).all())


def refuse_shared(parameters: Sequence[Tuned]) -> None:
    """Raise UsageError for parameters that one number follows together: what both do to it is not known."""
    owner: dict[int, str] = {}
    for one in parameters:
        for law in one.laws:
            other = owner.setdefault(law.at, one.name)
            if other != one.name:
                raise UsageError(
                    f"{other} and {one.name} cannot both be set in the FMU: they are worked out into one number.\n"
                    "    Name one of them."
                )


def kept_words(opened: LaidOpen, size: int, laws: Sequence[Law]) -> list[tuple[int, int]]:
    """Stretches of memory (place, length in bytes) that a run goes on with, whatever its parameters are."""
    memory, own = opened.memory, opened.problem
    marked = np.zeros(size // 8, dtype=bool)
    _mark(marked, memory, memory.array["y"])
    for name in KEPT:
        _mark(marked, memory, own.memory[name])
    for k, block in enumerate(own.blocks):
        if offsets(k) in own.working.places:
            _mark(marked, memory, block.in_offset, [law.at for law in laws])
        if discrete(k) in own.working.places:
            for row in block.parameters:
                for column in np.flatnonzero(discrete_columns(block)):
                    _mark(marked, memory, row[column : column + 1])
    return list(_stretches(marked))


def _mark(marked: NDArray[np.bool_], memory: Memory, array: NDArray, but: Sequence[int] = ()) -> None:
    if not array.size:
        return
    begin = (int(array.ctypes.data) - int(memory.arena.ctypes.data)) // 8
    if not 0 <= begin < memory.arena.nbytes // 8:
        raise ValueError("what a run goes on with does not lie in its state")
    marked[begin : begin + array.size] = True
    marked[[at // 8 for at in but if begin <= at // 8 < begin + array.size]] = False


def _stretches(marked: NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    edges = np.flatnonzero(np.diff(np.concatenate([[False], marked, [False]]).astype(np.int8)))
    for begin, end in edges.reshape(-1, 2).tolist():
        yield 8 * begin, 8 * (end - begin)


def named_words(opened: LaidOpen, found: Laid) -> Callable[[int], str]:
    """A function from a place in memory to the name of what lies there."""
    memory = opened.memory
    fields = {at: name for name, places in PLACES.items() for at in places}
    inside = list(memory.array.items())
    begin = int(memory.arena.ctypes.data)

    def name(at: int) -> str:
        if at in fields:
            return fields[at]
        for one, array in inside:
            first = int(array.ctypes.data) - begin
            if first <= at < first + array.nbytes:
                return _in_words(one, opened)
        for one, place in found.places.items():
            if one != "arena" and place.at <= at < place.at + place.end - place.begin:
                return _in_words(one, opened)
        return f"the number at {at}"

    return name


def _in_words(array: str, opened: LaidOpen) -> str:
    """What an array is, for somebody who has not seen the engine."""
    name, _, number = array.partition(" ")
    if name in OF_BLOCK and number.isdigit():
        return f"a number of {opened.problem.blocks[int(number)].kernel.variant.label}"
    if array.removeprefix("memory ") in ("absolute", "relative", "cap", "column_scale"):
        return "what is tolerated of an unknown"
    return array.removeprefix("memory ")


def _words(array: NDArray) -> NDArray[np.int64]:
    return np.ascontiguousarray(array).reshape(-1).view(np.int64)
