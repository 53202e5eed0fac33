"""What a zone says, as lines of text: balances, rates, held motions, outputs; and when its guards fire.

    tension = stiffness*(b.x - a.x - length)
    a.force = -tension          b.force = tension

An output that stands for a longer expression is used by its name wherever that expression returns.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import sympy

from fairlead.component.declare import Port
from fairlead.component.given import Parameter
from fairlead.component.trace import Traced, TracedGuard, TracedZone, TraceError, symbol, trace_function
from fairlead.describe.formula import Names, formula, is_parameter, names_of, negative

LEDGER_WORDS = {"stored": "stored energy", "dissipated": "dissipated power", "supplied": "supplied power"}
NEVER = "never"


@dataclass(frozen=True)
class Writing:
    """How a class's expressions are written: names of symbols, inertias and what is prescribed, by port."""

    ports: Mapping[str, Port]
    names: Names
    states: frozenset[str]
    positive: frozenset[str]  # keys of parameters that are above zero
    inertias: Mapping[str, sympy.Expr]
    prescribed: Mapping[str, tuple[str, str, str] | None]
    ties: tuple[tuple[str, str, sympy.Expr, sympy.Expr], ...]  # (a, b, ratio, offset):  b = ratio * a + offset


def writing_of(traced: Traced) -> Writing:
    """The writing of a traced class."""
    kind, has = traced.variant.type, traced.variant.type.declaration
    prescribes = kind.answers.prescribes
    positive = (
        f"p:{n}" for n, d in has.parameters.items() if isinstance(d, Parameter) and d.above is not None and d.above >= 0
    )
    return Writing(
        has.ports,
        names_of(has),
        frozenset(has.states),
        frozenset(positive),
        _map_of(_asked(traced, "inertia")),
        prescribes() if prescribes else {},
        tuple((a, b, _exact(ratio), _exact(offset)) for a, b, ratio, offset in _rows_of(_asked(traced, "ties"))),
    )


def _asked(traced: Traced, name: str) -> Any:
    """What a method of `p` says of symbols; None if the class has none or computes it in plain Python."""
    method = getattr(traced.variant.type.answers, name)
    try:
        return trace_function(traced.variant, method)[0] if method else None
    except TraceError:
        return None


def _map_of(said: Any) -> Mapping[str, Any]:
    """What is no map is told where a netlist asks; a page leaves it out."""
    return said if isinstance(said, Mapping) else {}


def _rows_of(said: Any) -> list[Any]:
    """The same of ties, which are rows of four."""
    rows = said if isinstance(said, tuple | list) else ()
    return [row for row in rows if isinstance(row, tuple | list) and len(row) == 4]


def _exact(number: Any) -> sympy.Expr:
    """1 for 1.0."""
    return sympy.Integer(number) if isinstance(number, float) and number.is_integer() else sympy.sympify(number)


def equations(zone: TracedZone, writing: Writing) -> list[str]:
    """All that a zone says, one line each. What it does not mention is zero."""
    say = _Say(zone, writing)
    outputs = {name: say(value, leave_out=name) for name, value in zone.outputs.items()}
    lines = _together({name: text for name, text in outputs.items() if not _is_number(text)})
    kept = {name: row.slip if row.gap is None else row.gap for name, row in zone.holds.items()}
    lines += [f"{say(value)} is kept at 0 by {name}" for name, value in kept.items()]
    lines += [_own(name, value, say, writing) for name, value in zone.own.items() if name not in zone.holds]
    lines += _together(_balances(zone, writing, say) | {n: t for n, t in outputs.items() if _is_number(t)})
    lines += [*_prescribed(writing), *_tied(writing)]
    return lines + [f"{LEDGER_WORDS[name]} = {say(value)}" for name, value in zone.ledger.items() if value != 0]


def _together(values: Mapping[str, str]) -> list[str]:
    """One line a value; names of the same number share a line."""
    said: dict[str, list[str]] = {}
    for name, text in values.items():
        said.setdefault(text if _is_number(text) else f"{text}\n{name}", []).append(name)
    return [f"{' = '.join(names)} = {text.partition(chr(10))[0]}" for text, names in said.items()]


def _is_number(text: str) -> bool:
    return text.lstrip("-").replace(".", "", 1).isdigit()


def condition(guard: TracedGuard, zone: TracedZone, writing: Writing) -> str:
    """When a guard fires: `normal <= lift`; every further condition of a group has a line of its own."""
    say = _Say(zone, writing)
    said = [_relation(_without_scale(say.abbreviated(value), writing), say) for value in guard.values]
    return NEVER if NEVER in said else " and\n".join(dict.fromkeys(said))


class _Say:
    """Writes an expression of one zone, tables as functions and outputs by their names."""

    def __init__(self, zone: TracedZone, writing: Writing) -> None:
        self._writing, self._tables = writing, zone.tables
        named = {e: n for n, e in reversed(zone.outputs.items()) if len(e.free_symbols) > 1 or e.count_ops() > 1}
        self._short = sorted(((n, e) for e, n in named.items()), key=lambda item: -item[1].count_ops())

    def __call__(self, value: sympy.Expr, leave_out: str = "") -> str:
        return formula(self.abbreviated(value, leave_out), self._writing.names)

    def abbreviated(self, value: sympy.Expr, leave_out: str = "") -> sympy.Expr:
        """The expression with names of outputs in it; an output names only what is shorter than itself."""
        names = [name for name, _ in self._short]
        first = names.index(leave_out) + 1 if leave_out in names else 0
        for name, long in self._short[first:]:
            if long.free_symbols <= value.free_symbols:
                for form in dict.fromkeys((long, sympy.signsimp(long))):  # the latter is how it stands inside |...|
                    if _may_hold(value, form):
                        value = value.subs(form, symbol(f"own:{name}"))
        return tables_as_functions(value.replace(_is_negated_sum, _minus_inside), self._tables)


def _may_hold(value: sympy.Expr, form: sympy.Expr) -> bool:
    """Whether a product may occur in a value: all of its factors are factors of one product there.

    For every product that it meets, SymPy would first denest the powers of all it is made of, a second at a time.
    """
    if not form.is_Mul:
        return True
    wanted = _bases(form)
    return any(part.is_Mul and wanted <= _bases(part) for part in sympy.preorder_traversal(value))


@functools.lru_cache(maxsize=4096)
def _bases(product: sympy.Expr) -> frozenset[sympy.Expr]:
    """What the factors of a product are powers of, of either sign, numbers left out."""
    bases = (factor.as_base_exp()[0] for factor in product.args if not factor.is_Number)
    return frozenset(-base if base.could_extract_minus_sign() else base for base in bases)


def _is_negated_sum(value: sympy.Expr) -> bool:
    """Whether it is minus a sum, over something or not."""
    if not value.is_Mul or value.args[0] != -1:
        return False
    above = [factor for factor in value.args[1:] if not (factor.is_Pow and factor.exp.is_negative)]
    return len(above) == 1 and above[0].is_Add


def _minus_inside(value: sympy.Expr) -> sympy.Expr:
    """`(b - a)/c` for `-(a - b)/c`."""
    return sympy.Mul(*(sympy.Mul(-1, factor) if factor.is_Add else factor for factor in value.args[1:]))


def tables_as_functions(value: sympy.Expr, reads: Mapping[str, sympy.Expr]) -> sympy.Expr:
    """`points(v)` for the polynomial of the interval in force.

    What is said depends on the table's value, rate and second derivative only, so the point about which the
    polynomial is written is free: with s = x its coefficients are these three.
    """
    for path, at in reads.items():
        word = sympy.Function(path, real=True)
        rates = [
            word(at),
            sympy.Function(f"{path}'", real=True)(at),
            sympy.Function(f"{path}''", real=True)(at) / 2,
        ]
        value = value.subs({symbol(f"p:{path}:amplitude"): 0, symbol(f"T:{path}:0"): at})
        value = value.xreplace({symbol(f"T:{path}:{k + 1}"): rate for k, rate in enumerate(rates)})
    return value


def _own(name: str, value: sympy.Expr, say: _Say, writing: Writing) -> str:
    """A rate for a state; for an unknown the value its balance gives it, or the balance."""
    if name in writing.states:
        return f"d({name})/dt = {say(value)}"
    unknown = symbol(f"own:{name}")
    slope = sympy.diff(value, unknown)
    if slope in (1, -1):
        return f"{name} = {say(-slope * value.subs(unknown, 0))}"
    return f"0 = {say(value)}, which gives {name}"


def _balances(zone: TracedZone, writing: Writing, say: _Say) -> dict[str, str]:
    """What acts on the component at its ports; an inertia takes its mass times the acceleration."""
    said = {}
    for port, flow in zone.flows.items():
        domain = writing.ports[port].domain
        if port in writing.inertias:
            flow += writing.inertias[port] * symbol(f"port:{port}:a")
        if port not in writing.prescribed:
            said[f"{port}.{domain.through[0]}"] = say(flow)
    return said


def _tied(writing: Writing) -> Iterator[str]:
    """Motions that follow each other, and the forces that do no work together."""
    for a, b, ratio, offset in writing.ties:
        y = writing.ports[b].domain.across[0][0]
        one, other = symbol(f"port:{a}:x"), symbol(f"port:{b}:F")
        names = {**writing.names, other.name: f"{b}.{writing.ports[b].domain.through[0]}"}
        yield f"{b}.{y} = {formula(ratio * one + offset, names)}, always"
        yield f"{a}.{writing.ports[a].domain.through[0]} = {formula(-ratio * other, names)}"


def _prescribed(writing: Writing) -> Iterator[str]:
    for port, outputs in writing.prescribed.items():
        variables = [name for name, _ in writing.ports[port].domain.across]
        moves = (
            ", ".join(f"{port}.{v} = {o}" for v, o in zip(variables, outputs or (), strict=False))
            or f"{port} does not move"
        )
        yield f"{moves}; {port}.{writing.ports[port].domain.through[0]} is whatever that takes"


def _relation(value: sympy.Expr, say: _Say) -> str:
    """A guard, written as the relation that its rise through zero makes true."""
    if value.is_Number:
        return NEVER if value < 0 else "always"
    terms = sympy.Add.make_args(value)
    fixed = [t for t in terms if is_parameter(t)]
    right = fixed or [t for t in terms if negative(t)]
    left = [t for t in terms if t not in right]
    if not left:
        return f"{say(value)} >= 0" if fixed else f"{say(-value)} <= 0"
    below = all(map(negative, left)) or (fixed and not any(map(negative, fixed)) and any(map(negative, left)))
    below = below or (not fixed and right and all(isinstance(-t, sympy.Abs) for t in right))
    one, other = sympy.Add(*left), -sympy.Add(*right)
    if not below:
        return f"{say(one)} >= {say(other)}"
    return f"{say(-one)} <= {say(-other)}" if fixed else f"{say(other)} <= {say(one)}"


def _without_scale(value: sympy.Expr, writing: Writing) -> sympy.Expr:
    """A guard whose parts were divided by a positive parameter fires no earlier without that."""
    above, below = sympy.fraction(sympy.together(value))
    positive = {s.name for s in below.free_symbols} <= writing.positive
    return above if positive and above.count_ops() < value.count_ops() else value
