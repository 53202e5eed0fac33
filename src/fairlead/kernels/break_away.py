"""How much friction is left when a contact lets go: a fact of its law, whatever its parameters are called.

A zone that holds an unknown u is left for a zone of sliding when a guard that reads u rises through zero. There, at no
slip yet, the ports take in what they do by the law of sliding. The share

    what they take in by the law of sliding  /  what they take in by the law of holding with u at the limit

is 1 where friction goes over without a jump, and below 1 where the limit (stiction) is above the friction of sliding.
Some laws keep the limit in a zone of its own until the slip leaves a band (Karnopp): then the same is asked at the
guard of that slip. A share below zero is that of a guard for the other direction, and is not met.

Both are expressions of the traced law; what presses the surfaces together cancels out of their quotient, so that a
share of parameters and tables is left. Where anything else is left the share depends on the motion, and counts as 0.

`shares_left` finds these expressions (on a cache miss, with SymPy); `least_left` gives them their numbers.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from fairlead.component.keys import PARAMETER, key
from fairlead.component.piecewise import DEGREE
from fairlead.component.values import Values, parameter, polynomial

if TYPE_CHECKING:
    import sympy

    from fairlead.component.trace import HoldRow, Traced, TracedGuard, TracedZone

NOTHING = ("0.0", "1.0")
"""The share where it cannot be told: as if nothing were left."""
EXACT = 1e-9
"""What two routes to the same number may differ by."""
FUNCTIONS = ("exp", "log", "sqrt", "sin", "cos", "tan", "tanh", "atan")


def shares_left(traced: Traced) -> list[tuple[str, str]]:
    """The shares of a class, each as text of its numerator and denominator.

    They read `p["curve.rest"]`, a parameter, and `c["curve.points", 1, 0]`, number 1 of the piece of a table at 0.
    """
    found = {_text(*share) if share else NOTHING for share in _shares(traced)}
    return sorted(found - {("1", "1")})


def least_left(shares: Sequence[Sequence[str]], values: Values) -> float:
    """The least share that an instance is left with; 1 when it holds nothing, or lets go of it without a jump."""
    names = {"p": _Parameters(values), "c": _Coefficients(values), **{name: getattr(math, name) for name in FUNCTIONS}}
    names |= {"nan": math.nan, "zoo": math.inf}  # nothing over nothing, as of a stop that lets go at no force: no jump
    least = 1.0
    for share in shares:
        after, before = (float(eval(_compiled(text), names)) for text in share)
        if before != 0 and 0 <= after / before < least - EXACT:
            least = after / before
    return least


def number_of(text: str, values: Values) -> float:
    """The number of an expression of parameters, as `parameters_as_text` wrote it, for an instance."""
    return float(eval(_compiled(text), {"p": _Parameters(values), **{name: getattr(math, name) for name in FUNCTIONS}}))


def parameters_as_text(expression: sympy.Expr) -> str:
    """An expression of parameters alone as text that `number_of` reads."""
    return _written(expression, {})


class _Parameters:
    """Parameters of an instance by their keys."""

    def __init__(self, values: Values) -> None:
        self.values = values

    def __getitem__(self, key: str) -> float:
        return parameter(self.values, key)


class _Coefficients(_Parameters):
    """Numbers of the pieces of the tables of an instance."""

    def __getitem__(self, key: Any) -> float:
        path, place, at = key
        table = polynomial(self.values.path(path))
        return float(table.rows[table.piece_at(at), place])


@functools.cache
def _compiled(text: str) -> Any:
    return compile(text, "<share>", "eval")


class _Way(NamedTuple):
    """Out of one zone into another, at the value of one symbol; None where that cannot be told."""

    before: TracedZone
    after: TracedZone
    at: dict[sympy.Symbol, sympy.Expr] | None


def _ways(traced: Traced) -> Iterator[tuple[sympy.Symbol, _Way]]:
    """Every way out of a zone that holds an unknown, and one zone further by the slip, with that unknown."""
    from fairlead.component.trace import symbol

    for held in traced.zones.values():
        for unknown, row in held.holds.items():
            if row.gap is not None:  # never lets go
                continue
            u, (still, speed) = symbol(f"own:{unknown}"), _at_rest(row)
            for guard, limit in _guards(held, u):
                next_ = traced.zones[guard.to]
                yield u, _Way(held, next_, None if limit is None else {u: limit, **still})
                for further, slip in _guards(next_, speed):
                    beyond = traced.zones[further.to]
                    if unknown not in next_.holds and unknown not in beyond.holds:
                        yield u, _Way(next_, beyond, None if slip is None else {speed: slip})


def _guards(zone: TracedZone, of: sympy.Symbol) -> Iterator[tuple[TracedGuard, sympy.Expr | None]]:
    """Guards that read a symbol, each with the value of it at which the guard is zero."""
    for guard in zone.guards:
        roots = [_root(value, of) for value in guard.values if of in value.free_symbols]
        if guard.to and roots:
            yield guard, roots[0] if len(roots) == 1 else None


def _shares(traced: Traced) -> Iterator[tuple[sympy.Expr, Mapping[str, sympy.Expr]] | None]:
    """(share, where tables are read) of every way and every port."""
    for u, way in _ways(traced):
        for port, flow in way.before.flows.items():
            before, after = _settled(way.before, flow, u), _settled(way.after, way.after.flows[port], u)
            if before is None or after is None or way.at is None:
                yield None
            elif before != 0:
                where = {**way.before.tables, **way.after.tables}
                yield _at(after, way.at) / _at(before, way.at), {path: _at(x, way.at) for path, x in where.items()}


def _settled(zone: TracedZone, flow: sympy.Expr, u: sympy.Symbol) -> sympy.Expr | None:
    """What a port takes in, with the unknown as the zone's own balance has it; as it is where the zone holds."""
    unknown = key(u.name).name
    if u not in flow.free_symbols or unknown in zone.holds:
        return flow
    balance = _root(zone.own[unknown], u)
    return None if balance is None else flow.xreplace({u: balance})


def _at(expression: sympy.Expr, at: Mapping[sympy.Symbol, sympy.Expr]) -> sympy.Expr:
    """With u first: its limit may read the speeds, of which one goes by the others."""
    for one, value in at.items():
        expression = expression.xreplace({one: value})
    return expression


def _at_rest(row: HoldRow) -> tuple[dict[sympy.Symbol, sympy.Expr], sympy.Symbol]:
    """One speed by the others, so that there is no slip; and that speed."""
    from fairlead.component.trace import symbol

    key, rate = next(iter(row.rates.items()))
    return {symbol(key): (symbol(key) - row.slip / rate).expand()}, symbol(key)


def _root(expression: sympy.Expr, u: sympy.Symbol) -> sympy.Expr | None:
    """Where an expression is zero that is linear in u."""
    slope = expression.diff(u)
    return None if slope == 0 or u in slope.free_symbols else -expression.xreplace({u: u * 0}) / slope


def _text(share: sympy.Expr, where: Mapping[str, sympy.Expr]) -> tuple[str, str]:
    """Numerator and denominator as text of parameters and tables; NOTHING if they read anything else."""
    import sympy

    from fairlead.component.trace import symbol

    known: dict[Any, str] = {}
    for path, at in where.items():
        places = {"left": 0, "right": 1, **{str(k): k + 2 for k in range(DEGREE + 2)}}
        if _told(at, {}):
            place = _written(at, {})
            known |= {symbol(f"T:{path}:{k}"): f'c["{path}", {n}, {place}]' for k, n in places.items()}
    if not _told(share, known):
        share = sympy.simplify(share)
    if not _told(share, known):
        return NOTHING
    after, before = sympy.fraction(share)
    return _written(after, known), _written(before, known)


def _written(expression: sympy.Expr, known: Mapping[Any, str]) -> str:
    import sympy

    names = {s: sympy.Symbol(known.get(s) or f'p["{key(s.name).number}"]') for s in expression.free_symbols}
    return str(sympy.pycode(expression.xreplace(names), fully_qualified_modules=False))


def _told(share: sympy.Expr, known: Mapping[Any, str]) -> bool:
    return all(s in known or key(s.name).kind == PARAMETER for s in share.free_symbols)
