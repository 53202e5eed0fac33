"""Traced expressions written out as the Python text of a kernel. Imported on a cache miss only.

For every mode the text has one loop over instances and, inside, one branch per zone:

    if mode == 1:
        for i in range(start, stop):
            zone = zones[ms[i*1]]
            if zone == 1:
                u0 = zc[i*cs+0]*z[zi[i*4+0]] + zo[i*os+0]
                ...
                out[fi[i*2+0]] += fc[i*fs+0]*(-p0*(u2 - u0))
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import sympy
from sympy.printing.pycode import PythonCodePrinter

from fairlead.component.keys import PARAMETER, TABLE, key
from fairlead.component.piecewise import DEGREE, STRIDE
from fairlead.component.trace import Traced, TracedGuard, TracedZone
from fairlead.kernels import layout
from fairlead.kernels.derivative import symbols_in
from fairlead.kernels.facts import KernelFacts, of_groups
from fairlead.kernels.structure import Structure

HEAD = """def kernel(mode, block, start, stop, z, zones, tables, out):
    par = f8(block[{PAR}]); zi = i8(block[{IN_INDEX}]); zc = f8(block[{IN_COEF}]); zo = f8(block[{IN_OFFSET}])
    ms = i8(block[{MACHINES}]); tb = i8(block[{TABLE_BASE}]); si = i8(block[{SIG_INDEX}])
    fi = i8(block[{FLOW_INDEX}]); fc = f8(block[{FLOW_COEF}]); li = i8(block[{LEDGER_INDEX}])
    cs = block[{IN_COEF_STEP}]; os = block[{IN_OFFSET_STEP}]; fs = block[{FLOW_COEF_STEP}]
"""
WORTH = 2
"""Inputs that need not be read where a table is zero, from which on that is looked at."""
COEFFICIENT = {"left": 0, "right": 1, **{str(k): k + 2 for k in range(DEGREE + 2)}}

Statement = tuple[str, sympy.Expr]  # text with {} for the value


class _Printer(PythonCodePrinter):
    """Plain names instead of `math.exp`, so that the text runs with math and with cmath."""

    def __init__(self) -> None:
        super().__init__({"fully_qualified_modules": False})
        self._not_supported: set[Any] = set()
        self._number_symbols: set[Any] = set()
        self._written: dict[sympy.Expr, str] = {}

    def text(self, expression: sympy.Expr) -> str:
        """What `doprint` writes, without its search for what no law can hold; what cannot be printed is left to it."""
        written = self._print(expression)
        return self.doprint(expression) if self._not_supported or self._number_symbols else written

    def _print(self, expression: Any, **kwargs: Any) -> str:
        """What is made of others is written once: modes have many parts in common."""
        if not expression.args or kwargs:
            return str(super()._print(expression, **kwargs))
        found = self._written.get(expression)
        if found is None:
            found = self._written[expression] = str(super()._print(expression))
        return found

    def _print_sign(self, expression: sympy.Expr) -> str:
        return f"sign({self._print(expression.args[0])})"

    def _print_Pi(self, constant: sympy.Expr) -> str:
        return repr(float(constant))  # by value, as a kernel knows no such names

    def _print_Exp1(self, constant: sympy.Expr) -> str:
        return repr(float(constant))


class KernelText:
    """Builds the text of one kernel and the structure that goes with it."""

    def __init__(self, traced: Traced, *, rated: int = 0) -> None:
        """Number what the class reads and writes, if `rated` with the rates of its flows."""
        self.facts = KernelFacts(traced, rated=rated)
        self._short: dict[sympy.Expr, sympy.Expr] = {}
        self._printer = _Printer()

    def write(self) -> tuple[str, Structure]:
        """The text and the structure."""
        fields = {name: value for name, value in vars(layout).items() if name.isupper()}
        modes: dict[int, Callable[[TracedZone], list[Statement]]] = {
            layout.SIGNALS: self._signals,
            layout.FLOWS: self._flows,
            layout.LEDGER: self._ledger_lines,
            layout.PARTIALS_SIGNALS: lambda z: self._partials(0, z, fixed=False),
            layout.PARTIALS_FLOWS: lambda z: self._partials(1, z, fixed=False),
            layout.PARTIALS_LEDGER: lambda z: self._partials(2, z, fixed=False),
            layout.MASS: self._mass,
            layout.SLIP: lambda z: self._slip(z, "impulse"),
            layout.DRIFT: lambda z: self._slip(z, "slip"),
            layout.GAP: lambda z: self._slip(z, "place"),
            layout.GUARD: self._guards,
            layout.OUTPUT: self._all_outputs,
            layout.SAMPLE: self._sample,
            layout.MEMBERS: self._members,
            layout.SWINGS: self._swings,
        }
        loops = {mode: self._loop(mode, [what(zone) for zone in self.facts.zones]) for mode, what in modes.items()}
        for kind, mode in enumerate((layout.FIXED_SIGNALS, layout.FIXED_FLOWS, layout.FIXED_LEDGER)):
            loops[mode] = self._loop(mode, [self._partials(kind, self.facts.zones[0], fixed=True)], zoned=False)
        answered = sorted(mode for mode, text in loops.items() if text)
        return HEAD.format(**fields) + "".join(loops.values()), self.facts.structure(answered)

    def _signals(self, zone: TracedZone) -> list[Statement]:
        place, given = f"out[si[i*{len(self.facts.outputs)}+{{k}}]] = {{{{}}}}", self.facts.output_values[id(zone)]
        return [(place.format(k=k), given.get(n, sympy.S.Zero)) for k, n in enumerate(self.facts.outputs)]

    def _flows(self, zone: TracedZone) -> list[Statement]:
        f = len(self.facts.targets)
        return [
            (f"out[fi[i*{f}+{k}]] += fc[i*fs+{k}]*({{}})", value)
            for k, value in enumerate(self.facts.target_values(zone))
            if value is not None and value != 0
        ]

    def _ledger_lines(self, zone: TracedZone) -> list[Statement]:
        return [(f"{n} += {{}}", zone.ledger[n]) for n in self.facts.ledger if zone.ledger.get(n)]

    def _partials(self, kind: int, zone: TracedZone, *, fixed: bool) -> list[Statement]:
        base, pairs, values = self.facts.kinds[kind]
        place, given = f"out[block[{base}] + i*{len(pairs)} + {{e}}] = {{{{}}}}", values(zone)
        return [
            (place.format(e=e), self.facts.partial(given, pair))
            for e, pair in enumerate(pairs)
            if (e in self.facts.fixed[kind]) == fixed
        ]

    def _mass(self, zone: TracedZone) -> list[Statement]:
        place = f"out[block[{layout.D_MASS}] + i*{len(self.facts.mass)} + {{e}}] = {{{{}}}}"
        return [
            (
                place.format(e=e),
                zone.holds[u].rates.get(self.facts.inputs[j], sympy.S.Zero) if u in zone.holds else sympy.S.Zero,
            )
            for e, (u, j) in enumerate(self.facts.mass)
        ]

    def _slip(self, zone: TracedZone, what: str) -> list[Statement]:
        f = len(self.facts.targets)
        return [
            (f"out[fi[i*{f}+{self.facts.targets.index('own:' + u)}]] = -({{}})", getattr(h, what))
            for u, h in zone.holds.items()
            if getattr(h, what) is not None
        ]

    def _guards(self, zone: TracedZone) -> list[Statement]:
        place = f"out[block[{layout.GUARDS}] + i*{self.facts.slots} + {{s}}] = {{{{}}}}"
        used = [(place.format(s=s), _group(g)) for s, g in enumerate(zone.guards)]
        slots = range(len(zone.guards), self.facts.slots)
        idle = [(place.format(s=s), sympy.Float(layout.NOT_IN_FORCE)) for s in slots]
        return used + idle

    def _members(self, zone: TracedZone) -> list[Statement]:
        """Every value of the guards that are groups."""
        place = f"out[i*{self.facts.members} + {{k}}] = {{{{}}}}"
        return [(place.format(k=k), value) for k, value in enumerate(of_groups(zone))]

    def _swings(self, zone: TracedZone) -> list[Statement]:
        """What sines are taken of; zero where another zone has more of them."""
        most, given = len(self.facts.most_swings), [angle for _, angle in self.facts.swings[id(zone)]]
        place = f"out[block[{layout.SWING_FIRST}] + i*{most} + {{k}}] = {{{{}}}}"
        return [(place.format(k=k), given[k] if k < len(given) else sympy.S.Zero) for k in range(most)]

    def _all_outputs(self, zone: TracedZone) -> list[Statement]:
        names = [*self.facts.outputs, *layout.OUTPUT_LINES]
        place = f"out[block[{layout.OUTPUTS}] + i*{len(names)} + {{k}}] = {{{{}}}}"
        values = {**self.facts.output_values[id(zone)], **zone.ledger}
        return [(place.format(k=k), values.get(n, sympy.S.Zero)) for k, n in enumerate(names)]

    def _sample(self, zone: TracedZone) -> list[Statement]:
        """New values are stored after everything was loaded, so all read the old ones."""
        place = f"par[i*{len(self.facts.parameters)}+{{k}}] = {{{{}}}}"
        return [(place.format(k=self.facts.parameters.index(f"#{n}")), e) for n, e in self.facts.traced.sample.items()]

    def _loop(self, mode: int, bodies: list[list[Statement]], *, zoned: bool = True) -> str:
        """One loop over the instances, with a branch per zone unless told otherwise."""
        if not any(bodies):
            return ""
        summed = self.facts.ledger if mode == layout.LEDGER else ()
        lines = [f"    if mode == {mode}:", *(f"        {n} = 0.0" for n in summed)]
        lines.append("        for i in range(start, stop):")
        many = zoned and len(self.facts.zones) > 1
        if many:
            lines.append(f"            zone = zones[ms[i*{self.facts.machines}]]")
        for number, body in enumerate(bodies):
            if not body:
                continue
            if many:
                lines.append(f"            if zone == {number}:")
            pad = " " * (16 if many else 12)
            lines += [pad + line for line in self._branches(body)]
        ledger = (layout.DISSIPATED, layout.SUPPLIED)
        lines += [f"        out[li[{ledger.index(n)}]] += {n}" for n in summed]
        return "\n".join(lines) + "\n"

    def _branches(self, statements: list[Statement]) -> list[str]:
        """The body of one zone; and, for a table that is zero in this piece, one without all that it multiplies.

        So a node of a line outside its device costs no more than the look at its window. Not where a value is a
        quotient of the table, which has none there.
        """
        factors = {s for _, e in statements for s in symbols_in(e) if _is_coefficient(s)}
        rest = [(place, e.xreplace(dict.fromkeys(factors, sympy.S.Zero))) for place, e in statements]
        if len(self.facts.traced.tables) != 1 or self._count_inputs(statements) < self._count_inputs(rest) + WORTH:
            return self._body(statements)
        if any(e.has(sympy.nan, sympy.zoo) for _, e in rest):
            return self._body(statements)
        rows = [f"tables[{self._piece(0)} + {COEFFICIENT[str(k)]}] == 0" for k in range(1, DEGREE + 2)]
        return [
            "full = 1", f"if {' and '.join(rows)}:", "    full = 0",
            "if full == 0:", *("    " + line for line in self._body(rest)),
            "if full == 1:", *("    " + line for line in self._body(statements)),
        ]  # fmt: skip

    def _count_inputs(self, statements: list[Statement]) -> int:
        return len({s for _, e in statements for s in symbols_in(e) if s.name in self.facts.inputs})

    def _piece(self, table: int) -> str:
        """Where in `tables` the piece of a table begins that is in force."""
        machine = self.facts.machines - len(self.facts.traced.tables) + table
        return f"tb[i*{len(self.facts.traced.tables)}+{table}] + {STRIDE}*zones[ms[i*{self.facts.machines}+{machine}]]"

    def _body(self, statements: list[Statement]) -> list[str]:
        """Loads, shared subexpressions and stores of one zone."""
        names = {s: sympy.Symbol(n, real=True) for s, n in self._identifiers(e for _, e in statements).items()}
        self._short.update(names)
        shared, values = sympy.cse([self._shortened(e) for _, e in statements], sympy.numbered_symbols("s"))
        printer = self._printer
        return [
            *self._loads(names),
            *(f"{name} = {printer.text(value)}" for name, value in shared),
            *(place.format(printer.text(value)) for (place, _), value in zip(statements, values, strict=True)),
        ]

    def _shortened(self, expression: sympy.Expr) -> sympy.Expr:
        """With the short names; modes have many parts in common, each of which is renamed once."""
        found = self._short.get(expression)
        if found is None:
            parts = [self._shortened(part) for part in expression.args]
            same = all(new is old for new, old in zip(parts, expression.args, strict=True))
            found = expression if same else expression.func(*parts)
            self._short[expression] = found
        return found

    def _identifiers(self, expressions: Iterable[sympy.Expr]) -> dict[sympy.Symbol, str]:
        """Short names of the symbols in use: u input, p parameter, c coefficient of a table."""
        found = sorted({s for e in expressions for s in symbols_in(e)}, key=lambda s: s.name)
        names = {}
        for s in found:
            one = key(s.name)
            if one.kind == PARAMETER:
                names[s] = f"p{self.facts.parameters.index(one.number)}"
            elif one.kind == TABLE:
                names[s] = f"c{self.facts.traced.tables.index(one.name)}_{one.part}"
            else:
                names[s] = f"u{self.facts.inputs.index(s.name)}"
        return names

    def _loads(self, names: dict[sympy.Symbol, sympy.Symbol]) -> list[str]:
        inputs, parameters = len(self.facts.inputs), len(self.facts.parameters)
        lines, opened = [], set()
        for name in (n.name for n in names.values()):
            number = name[1:]
            if name[0] == "u":
                lines.append(f"{name} = zc[i*cs+{number}]*z[zi[i*{inputs}+{number}]] + zo[i*os+{number}]")
            elif name[0] == "p":
                lines.append(f"{name} = par[i*{parameters}+{number}]")
            else:
                table, what = number.split("_")
                if table not in opened:
                    opened.add(table)
                    lines.append(f"b{table} = {self._piece(int(table))}")
                lines.append(f"{name} = tables[b{table} + {COEFFICIENT[what]}]")
        return lines


def _is_coefficient(symbol_: sympy.Symbol) -> bool:
    """True for what multiplies the powers in a piece of a table."""
    one = key(symbol_.name)
    return one.kind == TABLE and one.part.isdigit() and int(one.part) > 0


def _group(guard: TracedGuard) -> sympy.Expr:
    """All of a group must have risen: the least of them decides."""
    return guard.values[0] if len(guard.values) == 1 else sympy.Min(*guard.values, evaluate=False)

