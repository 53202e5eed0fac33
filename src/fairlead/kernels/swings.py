"""What sines are taken of in guards, and in outputs that may feed one: it tells how fast they swing.

A sine that only a guard reads stands in no equation, so no error of a step knows it: a position that drifts evenly is
right after a step of any length, in which its sine went round many times. So a step is short against the angles
themselves (integrate/point/swings.py). Of a quantity in time the period is known beforehand (`sines` in structure.py),
and a force that swings moves what it acts on, which the error of the step sees.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import sympy

from fairlead.component.keys import key
from fairlead.kernels.structure import OF_GUARD

SINES = (sympy.sin, sympy.cos, sympy.tan)


def swings(
    guards: Iterable[sympy.Expr], outputs: Mapping[str, sympy.Expr | None], inputs: Sequence[str], periods: set[str]
) -> list[tuple[str, sympy.Expr]]:
    """What the sines of a zone are taken of, less what is fixed, each with the output it is in; OF_GUARD for guards.

    Left out is what does not change by itself, what may jump (a sign, an acceleration), and time in `periods`.
    """
    found: dict[sympy.Expr, str] = {}
    of = [(OF_GUARD, value) for value in guards] + [(n, v) for n, v in sorted(outputs.items()) if v is not None]
    for name, value in of:
        for each in sorted(sympy.sympify(value).atoms(*SINES), key=str):
            angle = _what_changes(each.args[0], inputs)
            jumps = angle.has(sympy.sign) or any(key(s.name).is_late for s in angle.free_symbols)
            if angle != 0 and not jumps and not _is_known(angle, periods):
                found.setdefault(angle, name)
    return [(name, angle) for angle, name in found.items()]


def by_place(zones: Sequence[Sequence[str]]) -> list[str]:
    """By place what has the angle there, in all zones alike; else OF_GUARD, for which it is always asked."""
    found = [{names[k] for names in zones if k < len(names)} for k in range(max(map(len, zones), default=0))]
    return [names.pop() if len(names) == 1 else OF_GUARD for names in found]


def _what_changes(angle: sympy.Expr, inputs: Sequence[str]) -> sympy.Expr:
    """The terms that read an input."""
    terms = sympy.Add.make_args(angle)
    return sympy.Add(*(term for term in terms if any(s.name in inputs for s in term.free_symbols)))


def _is_known(angle: sympy.Expr, periods: set[str]) -> bool:
    """True for the time times an angular frequency of a quantity in time."""
    names = {s.name for s in angle.free_symbols}
    return "t" in names and bool(names & periods)
