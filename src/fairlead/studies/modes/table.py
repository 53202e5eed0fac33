"""Modes as they are handed back, and as lines of text: the pattern of zones, a table, patterns by damping."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from fairlead.results.table import row_of
from fairlead.studies.modes.linear import Linear
from fairlead.studies.modes.response import Response
from fairlead.studies.modes.spectrum import Mode, Zeros
from fairlead.studies.modes.squeal import Pattern

COLUMNS = ("mode", "frequency Hz", "damping", "growth 1/s", "time constant s", "who takes part")
RANKED = ("changed", "damping", "frequency Hz", "growth 1/s", "who takes part")
FEW, LITTLE = 3, 0.02
"""Components that a row names, and the share from which on."""
MOST_ROWS = 40
"""Modes and patterns that a table shows; `--json` and `--csv` have all."""
MOST_UNSTABLE = 5
"""Unstable modes that have a line each."""


@dataclass(frozen=True)
class Modes:
    """Modes by falling period, and what they belong to; it goes over the modes in a loop."""

    model: str
    t: float
    zones: dict[str, str]
    """Zone of every part that has several."""
    pattern: str
    """The same in words."""
    modes: tuple[Mode, ...]
    at_rest: int
    """Eigenvalues that are zero; `zeros` tells what they belong to."""
    held: int
    """Slips that are kept at zero."""
    response: Response | None
    patterns: tuple[Pattern, ...]
    remarks: tuple[str, ...]
    linear: Linear = field(repr=False)
    zeros: Zeros = field(default_factory=Zeros)
    """What the eigenvalues that are zero belong to."""

    def __iter__(self) -> Iterator[Mode]:
        return iter(self.modes)

    def __len__(self) -> int:
        """How many modes."""
        return len(self.modes)

    def __getitem__(self, index: int) -> Mode:
        """A mode. Raises NoRowError, which is an IndexError."""
        return self.modes[row_of(index, self.modes, "modes")]

    @property
    def unstable(self) -> tuple[Mode, ...]:
        """Modes that grow."""
        return tuple(one for one in self.modes if one.growth > one.error)

    def __str__(self) -> str:
        return "\n".join(lines_of(self))


def cells(number: int, mode: Mode) -> list[str]:
    """A mode as the texts of COLUMNS."""
    damping, growth = _clean(mode, mode.damping), _clean(mode, mode.growth)
    swings = (f"{mode.frequency:.5g}", f"{damping:.4g}") if mode.frequency else ("-", "-")
    return [str(number), *swings, f"{growth:.4g}", f"{1 / abs(growth):.4g}" if growth else "-", takes_part(mode)]


def ranked_cells(one: Pattern) -> list[str]:
    """A pattern as the texts of RANKED."""
    words = ", ".join(one.changes) or "as it is"
    if one.mode is None:
        return [words, "", "", "", one.sentence or "no mode but rest"]
    mode = one.mode
    return [words, f"{_clean(mode, mode.damping):.4g}", f"{mode.frequency:.5g}", f"{_clean(mode, mode.growth):.4g}",
            takes_part(mode)]  # fmt: skip


def takes_part(mode: Mode) -> str:
    """Components with the largest shares."""
    (first, most), *others = mode.participation.items()
    shares = [(first, most), *((name, share) for name, share in others if share >= LITTLE)]
    return ", ".join(f"{name} {share:.0%}" for name, share in shares[:FEW])


def notes(found: Modes) -> Iterator[str]:
    """What is to be said beside the table."""
    if found.pattern:
        yield found.pattern
    yield from of_zeros(found.zeros)
    for mode in found.unstable[:MOST_UNSTABLE]:
        how = f"swings up at {mode.frequency:.4g} Hz" if mode.frequency else "runs away"
        yield f"Unstable: {takes_part(mode)} {how}, by a factor of e in {1 / mode.growth:.3g} s."
    if len(found.unstable) > MOST_UNSTABLE:
        yield f"... and {len(found.unstable) - MOST_UNSTABLE} more that are unstable."
    yield from found.remarks
    if found.response is not None:
        yield of_response(found.response)


def of_zeros(zeros: Zeros) -> Iterator[str]:
    """What the eigenvalues that are zero belong to."""
    if not zeros.count:
        return
    are = "eigenvalue is" if zeros.count == 1 else "eigenvalues are"
    yield f"{zeros.count} {are} zero within rounding (below {zeros.below:.1g} 1/s)."
    if zeros.offsets:
        one = "a contact that holds, which stays where it took hold"
        whose = one if zeros.offsets == 1 else "contacts that hold, which stay where they took hold"
        yield f"    {zeros.offsets} for {whose}."
    rest = zeros.count - zeros.offsets
    if rest:
        names = ", ".join(list(zeros.others)[:FEW])
        yield f"    {rest} for what moves freely, stays put, or creeps too slowly to tell: {names}."


def of_response(one: Response) -> str:
    """Where the response is largest."""
    sizes = np.abs(one.values)
    k = int(np.argmax(sizes))
    lowest = f"{one.out} over {one.acting}: {sizes[0]:.4g} {one.unit} at {one.frequencies[0]:.3g} Hz"
    return f"{lowest}, largest {sizes[k]:.4g} at {one.frequencies[k]:.4g} Hz."


def lines_of(found: Modes) -> Iterator[str]:
    """All of it as lines of aligned text."""
    yield f"{found.model} at {found.t:.6g} s"
    yield from notes(found)
    if found.modes:
        yield from _aligned([list(COLUMNS), *(cells(k, one) for k, one in enumerate(found.modes[:MOST_ROWS], 1))])
    if len(found.modes) > MOST_ROWS:
        yield f"... and {len(found.modes) - MOST_ROWS} more"
    if found.patterns:
        yield from _aligned([list(RANKED), *map(ranked_cells, found.patterns[:MOST_ROWS])])


def _aligned(rows: list[list[str]]) -> Iterator[str]:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip()


def _clean(mode: Mode, value: float) -> float:
    """Damping or growth of a mode, 0 where it is rounding."""
    return 0.0 if abs(mode.growth) <= mode.error else value
