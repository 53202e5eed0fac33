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

from fairlead.component.piecewise import DEGREE, STRIDE
from fairlead.component.trace import (
    Traced,
    TracedGuard,
    TracedZone,
    inverse_mass,
    is_kinked,
    read_in_python,
    sine,
    symbol,
)
from fairlead.system import layout
from fairlead.system.break_away import shares_left
from fairlead.system.dependence import carried_ratio, reads
from fairlead.system.held_pairs import held_pairs
from fairlead.system.structure import Structure

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

    def _print_sign(self, expression: sympy.Expr) -> str:
        return f"sign({self._print(expression.args[0])})"

    def _print_Pi(self, constant: sympy.Expr) -> str:
        return repr(float(constant))  # by value, as a kernel knows no such names

    def _print_Exp1(self, constant: sympy.Expr) -> str:
        return repr(float(constant))


class KernelText:
    """Builds the text of one kernel and the structure that goes with it."""

    def __init__(self, traced: Traced) -> None:
        """Number the inputs, parameters, tables and outputs of the class once, for all zones."""
        self.traced = traced
        has = traced.variant.type.declaration
        self.zones = list(traced.zones.values())
        self.ledger = [
            line for line in (layout.DISSIPATED, layout.SUPPLIED) if any(line in z.ledger for z in self.zones)
        ]
        self.targets = [f"port:{name}" for name in self._flowing()] + [f"own:{n}" for n in (*has.states, *has.unknowns)]
        self.outputs = list(has.outputs)
        symbols = sorted({s.name for e in self._everything() for s in e.free_symbols} | set(read_in_python(has)))
        self.inputs = [key for key in symbols if key.split(":")[0] in ("port", "own", "in", "t")]
        discrete = {f"p:#{name}" for name in has.discrete}
        self.parameters = [key[2:] for key in sorted({k for k in symbols if k.startswith("p:")} | discrete)]
        self.machines = (1 if len(traced.zones) > 1 else 0) + len(traced.tables)
        self.unfit = {name: why for name in self.outputs if (why := self._unfit(name))}
        self.d_signals = self._pairs(self._fit_outputs)
        self.d_flows = self._pairs(self._target_values)
        self.d_ledger = self._pairs(self._ledger_values)
        self.mass = sorted({(u, self.inputs.index(s)) for z in self.zones for u, h in z.holds.items() for s in h.rates})
        self.slots = max((len(z.guards) for z in self.zones), default=0)
        self.members = max((len(_of_groups(z)) for z in self.zones), default=0)
        # Kinds of derivatives: where they go, which, the values by zone, and which of them never change.
        self.kinds = [
            (layout.D_SIGNALS, self.d_signals, self._fit_outputs),
            (layout.D_FLOWS, self.d_flows, self._target_values),
            (layout.D_LEDGER, self.d_ledger, self._ledger_values),
        ]
        self.fixed = [self._fixed(pairs, values) for _, pairs, values in self.kinds]

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
            layout.GUARD: self._guards,
            layout.OUTPUT: self._all_outputs,
            layout.SAMPLE: self._sample,
            layout.MEMBERS: self._members,
        }
        loops = {mode: self._loop(mode, [what(zone) for zone in self.zones]) for mode, what in modes.items()}
        for kind, mode in enumerate((layout.FIXED_SIGNALS, layout.FIXED_FLOWS, layout.FIXED_LEDGER)):
            loops[mode] = self._loop(mode, [self._partials(kind, self.zones[0], fixed=True)], zoned=False)
        answered = sorted(mode for mode, text in loops.items() if text)
        return HEAD.format(**fields) + "".join(loops.values()), self._structure(answered)


    def _signals(self, zone: TracedZone) -> list[Statement]:
        place = f"out[si[i*{len(self.outputs)}+{{k}}]] = {{{{}}}}"
        return [(place.format(k=k), zone.outputs.get(n, sympy.S.Zero)) for k, n in enumerate(self.outputs)]

    def _flows(self, zone: TracedZone) -> list[Statement]:
        f = len(self.targets)
        return [
            (f"out[fi[i*{f}+{k}]] += fc[i*fs+{k}]*({{}})", value)
            for k, value in enumerate(self._target_values(zone))
            if value is not None and value != 0
        ]

    def _ledger_lines(self, zone: TracedZone) -> list[Statement]:
        return [(f"{n} += {{}}", zone.ledger[n]) for n in self.ledger if zone.ledger.get(n)]

    def _partials(self, kind: int, zone: TracedZone, *, fixed: bool) -> list[Statement]:
        base, pairs, values = self.kinds[kind]
        place, given = f"out[block[{base}] + i*{len(pairs)} + {{e}}] = {{{{}}}}", values(zone)
        return [
            (place.format(e=e), self._partial(given, pair))
            for e, pair in enumerate(pairs)
            if (e in self.fixed[kind]) == fixed
        ]

    def _partial(self, values: list[Any], pair: tuple[int, int]) -> sympy.Expr:
        return sympy.diff(values[pair[0]] or 0, symbol(self.inputs[pair[1]]))

    def _fixed(self, pairs: list[tuple[int, int]], values: Callable[[TracedZone], list[Any]]) -> list[int]:
        """Places of the derivatives that are the same in all zones, and made of parameters alone."""
        given = [values(zone) for zone in self.zones]
        found = []
        for e, pair in enumerate(pairs):
            partials = [self._partial(each, pair) for each in given]
            plain = all(s.name.startswith("p:") and s.name[2] != "#" for s in partials[0].free_symbols)
            if plain and all(other == partials[0] for other in partials):
                found.append(e)
        return found

    def _curved(self, pairs: list[tuple[int, int]], values: Callable[[TracedZone], list[Any]]) -> list[int]:
        """Places of the values with a derivative, other than that to time, that reads an input, in some zone."""
        found = {
            pair[0]
            for zone in self.zones
            for pair in pairs
            if self.inputs[pair[1]] != "t"
            and any(s.name in self.inputs for s in self._partial(values(zone), pair).free_symbols)
        }
        return sorted(found)

    def _guards_read(self) -> bool:
        """True if a guard reads what is known only after the forces."""
        return any(_is_late(value) for z in self.zones for g in z.guards for value in g.values)

    def _late(self) -> list[int]:
        """Places of the outputs that read what is known only after the forces."""
        names = [*self.outputs, *layout.OUTPUT_LINES]
        values = [{**zone.outputs, **zone.ledger} for zone in self.zones]
        return [k for k, name in enumerate(names) if any(name in of and _is_late(of[name]) for of in values)]

    def _mass(self, zone: TracedZone) -> list[Statement]:
        place = f"out[block[{layout.D_MASS}] + i*{len(self.mass)} + {{e}}] = {{{{}}}}"
        return [
            (
                place.format(e=e),
                zone.holds[u].rates.get(self.inputs[j], sympy.S.Zero) if u in zone.holds else sympy.S.Zero,
            )
            for e, (u, j) in enumerate(self.mass)
        ]

    def _slip(self, zone: TracedZone, what: str) -> list[Statement]:
        f = len(self.targets)
        return [
            (f"out[fi[i*{f}+{self.targets.index('own:' + u)}]] = -({{}})", getattr(h, what))
            for u, h in zone.holds.items()
        ]

    def _guards(self, zone: TracedZone) -> list[Statement]:
        place = f"out[block[{layout.GUARDS}] + i*{self.slots} + {{s}}] = {{{{}}}}"
        used = [(place.format(s=s), _group(g)) for s, g in enumerate(zone.guards)]
        idle = [(place.format(s=s), sympy.Float(layout.NOT_IN_FORCE)) for s in range(len(zone.guards), self.slots)]
        return used + idle

    def _members(self, zone: TracedZone) -> list[Statement]:
        """Every value of the guards that are groups."""
        place = f"out[i*{self.members} + {{k}}] = {{{{}}}}"
        return [(place.format(k=k), value) for k, value in enumerate(_of_groups(zone))]

    def _all_outputs(self, zone: TracedZone) -> list[Statement]:
        names = [*self.outputs, *layout.OUTPUT_LINES]
        place = f"out[block[{layout.OUTPUTS}] + i*{len(names)} + {{k}}] = {{{{}}}}"
        values = {**zone.outputs, **zone.ledger}
        return [(place.format(k=k), values.get(n, sympy.S.Zero)) for k, n in enumerate(names)]

    def _sample(self, zone: TracedZone) -> list[Statement]:
        """New values are stored after everything was loaded, so all read the old ones."""
        place = f"par[i*{len(self.parameters)}+{{k}}] = {{{{}}}}"
        return [(place.format(k=self.parameters.index(f"#{n}")), e) for n, e in self.traced.sample.items()]


    def _loop(self, mode: int, bodies: list[list[Statement]], *, zoned: bool = True) -> str:
        """One loop over the instances, with a branch per zone unless told otherwise."""
        if not any(bodies):
            return ""
        summed = self.ledger if mode == layout.LEDGER else ()
        lines = [f"    if mode == {mode}:", *(f"        {n} = 0.0" for n in summed)]
        lines.append("        for i in range(start, stop):")
        many = zoned and len(self.zones) > 1
        if many:
            lines.append(f"            zone = zones[ms[i*{self.machines}]]")
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

        So a node of a line outside its device costs no more than the look at its window.
        """
        factors = {s for _, e in statements for s in e.free_symbols if _is_coefficient(s)}
        rest = [(place, e.xreplace(dict.fromkeys(factors, sympy.S.Zero))) for place, e in statements]
        if len(self.traced.tables) != 1 or self._count_inputs(statements) < self._count_inputs(rest) + WORTH:
            return self._body(statements)
        rows = [f"tables[{self._piece(0)} + {COEFFICIENT[str(k)]}] == 0" for k in range(1, DEGREE + 2)]
        return [
            "full = 1", f"if {' and '.join(rows)}:", "    full = 0",
            "if full == 0:", *("    " + line for line in self._body(rest)),
            "if full == 1:", *("    " + line for line in self._body(statements)),
        ]  # fmt: skip

    def _count_inputs(self, statements: list[Statement]) -> int:
        return len({s for _, e in statements for s in e.free_symbols if s.name in self.inputs})

    def _piece(self, table: int) -> str:
        """Where in `tables` the piece of a table begins that is in force."""
        machine = self.machines - len(self.traced.tables) + table
        return f"tb[i*{len(self.traced.tables)}+{table}] + {STRIDE}*zones[ms[i*{self.machines}+{machine}]]"

    def _body(self, statements: list[Statement]) -> list[str]:
        """Loads, shared subexpressions and stores of one zone."""
        names = {s: sympy.Symbol(n, real=True) for s, n in self._identifiers(e for _, e in statements).items()}
        shared, values = sympy.cse([e.xreplace(names) for _, e in statements], sympy.numbered_symbols("s"))
        printer = _Printer()
        return [
            *self._loads(names),
            *(f"{name} = {printer.doprint(value)}" for name, value in shared),
            *(place.format(printer.doprint(value)) for (place, _), value in zip(statements, values, strict=True)),
        ]

    def _identifiers(self, expressions: Iterable[sympy.Expr]) -> dict[sympy.Symbol, str]:
        """Short names of the symbols in use: u input, p parameter, c coefficient of a table."""
        found = sorted({s for e in expressions for s in e.free_symbols}, key=lambda s: s.name)
        names = {}
        for s in found:
            kind, _, rest = s.name.partition(":")
            if kind == "p":
                names[s] = f"p{self.parameters.index(rest)}"
            elif kind == "T":
                path, _, what = rest.rpartition(":")
                names[s] = f"c{self.traced.tables.index(path)}_{what}"
            else:
                names[s] = f"u{self.inputs.index(s.name)}"
        return names

    def _loads(self, names: dict[sympy.Symbol, sympy.Symbol]) -> list[str]:
        inputs, parameters = len(self.inputs), len(self.parameters)
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


    def _flowing(self) -> list[str]:
        return [n for n in self.traced.variant.type.declaration.ports if any(n in z.flows for z in self.zones)]

    def _unfit(self, name: str) -> str:
        """Why an output can be recorded only, or "" when it may feed a law."""
        values = [zone.outputs[name] for zone in self.zones if name in zone.outputs]
        read = {s.name.rpartition(":")[2] for value in values for s in value.free_symbols if s.name.startswith("port:")}
        if "a" in read:
            return "it reads an acceleration, which is known only after the forces"
        if "R" in read:
            return "it reads the force of a prescribed motion, which is known only after the forces"
        return "it has a corner where its derivative jumps" if any(map(is_kinked, values)) else ""

    def _fit_outputs(self, zone: TracedZone) -> list[Any]:
        return [None if n in self.unfit else zone.outputs.get(n) for n in self.outputs]

    def _target_values(self, zone: TracedZone) -> list[Any]:
        return [(zone.flows if t.startswith("port:") else zone.own).get(t.split(":")[1]) for t in self.targets]

    def _ledger_values(self, zone: TracedZone) -> list[Any]:
        return [zone.ledger.get(line) for line in self.ledger]

    def _everything(self) -> list[sympy.Expr]:
        found: list[sympy.Expr] = list(self.traced.sample.values())
        for z in self.zones:
            found += [*z.flows.values(), *z.own.values(), *z.outputs.values(), *z.ledger.values()]
            found += [value for g in z.guards for value in g.values]
            found += [value for h in z.holds.values() for value in (h.slip, h.impulse, *h.rates.values())]
        return found

    def _pairs(self, values: Any) -> list[tuple[int, int]]:
        """(value, input) for every derivative that is not identically zero in some zone."""
        found = set()
        for zone in self.zones:
            for k, value in enumerate(values(zone)):
                if value is not None:
                    used = {s.name for s in value.free_symbols}
                    found |= {(k, j) for j, key in enumerate(self.inputs) if key in used}
        return sorted(found)

    def _structure(self, modes: list[int]) -> Structure:
        t, paired = self.traced, held_pairs(self.zones)
        has = t.variant.type.declaration
        return Structure(
            inputs=self.inputs, parameters=self.parameters, tables=t.tables, time_tables=t.time_tables,
            zones=list(t.zones), machines=self.machines, outputs=self.outputs, unfit=self.unfit,
            targets=self.targets, ledger=self.ledger, mass=self.mass,
            d_signals=self.d_signals, d_flows=self.d_flows, d_ledger=self.d_ledger,
            holds={u: [n for n, z in t.zones.items() if u in z.holds] for z in self.zones for u in z.holds},
            rigid=sorted({u for z in self.zones for u, h in z.holds.items() if h.impulse == h.slip}),
            pairs={u: pair for u, (pair, _) in paired.items()}, senses={u: sense for u, (_, sense) in paired.items()},
            guards={name: [_describe(g, self, zone) for g in zone.guards] for name, zone in t.zones.items()},
            slots=self.slots, fixed_signals=self.fixed[0], fixed_flows=self.fixed[1], fixed_ledger=self.fixed[2],
            linear=not self._curved(self.d_flows, self._target_values),
            curved=self._curved(self.d_signals, self._fit_outputs), guards_read=self._guards_read(),
            late=self._late(), stores=any(zone.ledger.get(layout.STORED_ENERGY, 0) != 0 for zone in self.zones),
            modes=modes, members=self.members, shares_left=shares_left(t), sines=self._sines(),
            carries=carried_ratio(t) if has.carries else [],
            reads={name: self._reads(zone) for name, zone in t.zones.items()},
            inverse_masses={
                mass: port for port in has.ports if (mass := inverse_mass(port)[2:]) in self.parameters
            },
            flow_inputs={name: self._dependence(zone) for name, zone in t.zones.items()},
            period=next(iter(has.periods), ""),
            reaches={name: {path: str(at) for path, at in zone.tables.items()} for name, zone in t.zones.items()},
        )  # fmt: skip

    def _reads(self, zone: TracedZone) -> dict[str, dict[str, Any]]:
        """What this zone depends on, see dependence.py."""
        values = [*self._fit_outputs(zone), *self._target_values(zone), *self._ledger_values(zone)]
        places = [path for path in self.traced.tables if path not in self.traced.time_tables]
        return reads(values, zone.guards, self.inputs, places)

    def _sines(self) -> list[tuple[int, int]]:
        """Places of what a quantity in time swings with."""
        at = {key: k for k, key in enumerate(self.parameters)}
        parts = ([at.get(sine(path, part)[2:]) for part in ("amplitude", "omega")] for path in self.traced.time_tables)
        return [(size, pace) for size, pace in parts if size is not None and pace is not None]

    def _dependence(self, zone: TracedZone) -> dict[str, list[str]]:
        pairs = zip(self.targets, self._target_values(zone), strict=True)
        return {t: sorted(s.name for s in v.free_symbols if s.name in self.inputs) for t, v in pairs if v is not None}


def _is_coefficient(symbol_: sympy.Symbol) -> bool:
    """True for what multiplies the powers in a piece of a table."""
    kind, _, what = symbol_.name.rpartition(":")
    return kind.startswith("T:") and what.isdigit() and int(what) > 0


def _is_late(value: Any) -> bool:
    """True if it reads an acceleration or a reaction."""
    names = (s.name for s in sympy.sympify(value).free_symbols)
    return any(name.startswith("port:") and name.rpartition(":")[2] in "aR" for name in names)


def _of_groups(zone: TracedZone) -> list[sympy.Expr]:
    """The values of the guards that are groups, in order."""
    return [value for guard in zone.guards if len(guard.values) > 1 for value in guard.values]


def _group(guard: TracedGuard) -> sympy.Expr:
    """All of a group must have risen: the least of them decides."""
    return guard.values[0] if len(guard.values) == 1 else sympy.Min(*guard.values)


def _describe(guard: TracedGuard, text: KernelText, zone: TracedZone) -> dict[str, Any]:
    base = text.machines - len(text.traced.tables)
    machine = base + text.traced.tables.index(guard.table) if guard.table else 0
    to = -1 if guard.table else list(text.traced.zones).index(guard.to)
    held = {f"own:{unknown}" for unknown in zone.holds}
    limits = any(s.name in held for value in guard.values for s in value.free_symbols)
    return {
        "name": guard.name, "to": to, "unit": guard.unit, "machine": machine, "step": guard.step, "limits": limits,
    }  # fmt: skip
