"""What every value and every guard of a kernel depends on, zone by zone: facts of its trace, found without a number.

    reads[zone][pieces]     pieces: one letter per table of the class, what its piece in force is

        values[k]           of output, target or line of the ledger k: the sums of inputs it depends on
        guards[slot]        of every member of that guard: the same, and whether it is one such sum and a constant

A *sum* is a list of (input, coefficient). A law that reads two positions, or two speeds, only through their difference
depends on the one sum  b.x - a.x : it does not depend on what moves both alike. A value that a piece of a table makes
constant, or that is multiplied by a piece that is zero, does not depend on where the table is read.

    pieces      "0" zero     "1" one     "c" any other constant     "v" anything else

Whatever cannot be shown to cancel counts as a dependence. What varies by itself (time, discrete variables) is not told
here: see `system/active/dependences.py`. Imported where a class is traced; SymPy is there already.
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterator, Sequence
from typing import Any

import sympy

from fairlead.component.keys import INPUT, PORT, TABLE, key
from fairlead.component.piecewise import DEGREE
from fairlead.component.trace import Traced, TracedGuard, TraceError, symbol
from fairlead.kernels.derivative import derivative, symbols_in
from fairlead.kernels.in_floats import varies
from fairlead.kernels.structure import PIECES, Sum

MANY_TERMS = 1000
"""An expression that would be written out as more than this is not: it counts as not cancelling, which is safe."""
FEW = 2
"""Tables of a class up to which their constant pieces are told apart: 4 to the power of this many cases."""


def cases(tables: Sequence[str]) -> list[str]:
    """The cases that are told apart, the last of them that of which nothing is known."""
    if len(tables) > FEW:
        return ["v" * len(tables)]
    return ["".join(letters) for letters in itertools.product(PIECES, repeat=len(tables))]


def in_case(expression: sympy.Expr, tables: Sequence[str], case: str) -> sympy.Expr:
    """An expression as it is where the pieces in force are of these kinds."""
    given: dict[Any, Any] = {}
    for path, kind in zip(tables, case, strict=True):
        if kind != "v":
            given |= {symbol(f"T:{path}:{k + 1}"): sympy.S.Zero for k in range(1, DEGREE + 1)}
        if kind in "01":
            given[symbol(f"T:{path}:1")] = sympy.Integer(kind)
    return expression.xreplace(given) if given.keys() & symbols_in(expression) else expression


def sums(expression: sympy.Expr, inputs: Sequence[str]) -> list[Sum]:
    """The sums of inputs through which an expression depends on them."""
    names = {s.name for s in symbols_in(expression)}
    used = [j for j, key in enumerate(inputs) if key in names]
    found: list[Sum] = []
    for alike in _alike(used, inputs):
        found += _differences(expression, alike, inputs)
    return found


def _alike(used: Sequence[int], inputs: Sequence[str]) -> Iterator[list[int]]:
    """Inputs of one kind: positions of ports, their speeds, their accelerations; every other one by itself."""
    kinds: dict[str, list[int]] = {}
    for j in used:
        one = key(inputs[j])
        kinds.setdefault(one.part if one.kind == PORT else inputs[j], []).append(j)
    yield from kinds.values()


def _differences(expression: sympy.Expr, alike: list[int], inputs: Sequence[str]) -> list[Sum]:
    """All of them over the first, or two over each other, where only their difference counts; else one by one."""
    for some in (alike, *itertools.combinations(alike, 2)):
        if len(some) > 1 and _moves_along(expression, [inputs[j] for j in some]):
            first, *others = some
            return [[(first, -1.0), (j, 1.0)] for j in others] + [[(j, 1.0)] for j in alike if j not in some]
    return [[(j, 1.0)] for j in alike]


def _moves_along(expression: sympy.Expr, keys: Sequence[str]) -> bool:
    """True if it reads these inputs only over each other: written in the first and the others over it, that cancels."""
    first, *others = (symbol(text) for text in keys)
    if varies(expression, [first, *others]):
        return False
    shifted = expression.xreplace({other: other + first for other in others})
    if first not in symbols_in(shifted):
        return True
    read = any(key(s.name).kind == TABLE for s in symbols_in(shifted))  # then the place counts; long to write out
    if read or any(_terms(part) > MANY_TERMS for part in sympy.preorder_traversal(shifted)):
        return False
    return first not in symbols_in(sympy.expand(shifted))


def _terms(expression: sympy.Expr) -> int:
    """How many terms an expression may have when it is written out."""
    if expression.is_Add:
        return sum(map(_terms, expression.args))
    if expression.is_Mul:
        return math.prod(map(_terms, expression.args))
    if expression.is_Pow and expression.exp.is_Integer and expression.exp > 0:
        return _terms(expression.base) ** int(expression.exp)
    return 1


def member(expression: sympy.Expr, inputs: Sequence[str]) -> dict[str, Any]:
    """A member of a guard: its sums; the slopes instead, where it is one sum with numbers for coefficients."""
    names = {s.name for s in symbols_in(expression)}
    used = [j for j, key in enumerate(inputs) if key in names]
    if used and expression.is_polynomial(*(symbol(inputs[j]) for j in used)):
        slopes = [derivative(expression, symbol(inputs[j])) for j in used]
        if all(slope.is_number for slope in slopes):
            return {"sums": [[(j, float(slope)) for j, slope in zip(used, slopes, strict=True)]], "straight": True}
    return {"sums": sums(expression, inputs), "straight": False}


def reads(
    values: Sequence[Any], guards: Sequence[TracedGuard], inputs: Sequence[str], tables: Sequence[str]
) -> dict[str, dict[str, Any]]:
    """What one zone depends on, case by case; a value that is not said in the zone depends on nothing."""
    value_reads = functools.cache(lambda expression: sums(expression, inputs))  # most are the same in every case
    member_reads = functools.cache(lambda expression: member(expression, inputs))
    return {
        case: {
            "values": [value_reads(in_case(sympy.sympify(v or 0), tables, case)) for v in values],
            "guards": [[member_reads(in_case(v, tables, case)) for v in guard.values] for guard in guards],
        }
        for case in cases(tables)
    }


def carried_ratio(traced: Traced) -> list[tuple[str, float]]:
    """The factors (key, power) of the ratio of speeds of a class that carries a node; a number first, with no key.

    Raises TraceError if the law in that zone does not tie the two speeds by a product of parameters and inputs.
    """
    kind = traced.variant.type
    says = kind.declaration.carries
    if says is None:
        return []
    flow = traced.zones[says.zone].flows.get(says.node, sympy.S.Zero)
    own, by = (derivative(flow, symbol(f"port:{port}:v")) for port in (says.node, says.by))
    ratio = sympy.cancel(-by / own) if own != 0 else sympy.S.Zero
    number, factors = ratio.as_coeff_Mul()
    found: list[tuple[str, float]] = [("", float(number))]
    for base, power in factors.as_powers_dict().items():
        if base == 1:
            continue
        read = key(base.name) if base.is_Symbol else None
        if not power.is_Integer or read is None or not (read.is_fixed or read.kind == INPUT):
            found = []
            break
        found.append((base.name, float(power)))
    if number == 0 or not found:
        raise TraceError(
            f"{kind.__name__}: zone {says.zone!r} is said to carry {says.node!r} by {says.by!r}, and its law ties "
            f"their speeds by {ratio}; it must be a product of numbers, parameters and inputs, such as damping * "
            f"({says.node}.v - {says.by}.v)"
        )
    return found
