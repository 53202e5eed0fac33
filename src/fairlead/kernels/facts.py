"""What a kernel reads and writes, numbered once for all zones of a class: inputs, parameters, outputs, derivatives.

The text of the kernel (`text.py`) goes by these numbers, and what calls it by the `Structure` they give.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy

from fairlead.component.keys import INPUT, OWN, PARAMETER, PORT, RATE, TIME, key
from fairlead.component.symbols import inverse_mass, sine, symbol
from fairlead.component.trace import HoldRow, Traced, TracedGuard, TracedZone, is_kinked, read_in_python
from fairlead.kernels import layout
from fairlead.kernels.break_away import parameters_as_text, shares_left
from fairlead.kernels.dependence import carried_ratio, reads
from fairlead.kernels.derivative import derivative, symbols_in
from fairlead.kernels.flow_rates import flow_rates, joins, output_rates, yields
from fairlead.kernels.guard_slots import bounds_what_holds, in_slots, latches
from fairlead.kernels.held_pairs import held_pairs, held_ratios
from fairlead.kernels.in_floats import differs
from fairlead.kernels.structure import Structure
from fairlead.kernels.swings import by_place, swings

WATTS = {("m/s", "N"), ("rad/s", "N*m"), ("Pa", "m^3/s"), ("V", "A")}
"""Units of what is equal at a node and of what sums to zero there, where their product is a power."""


class KernelFacts:
    """The numbers of one class variant."""

    def __init__(self, traced: Traced, *, rated: int = 0) -> None:
        """Number the inputs, parameters, tables and outputs of the class once, for all zones.

        A `rated` kernel also knows at what rate its flows change, one rated 2 its outputs too (flow_rates.py).
        """
        self.traced = traced = in_slots(traced)
        has = traced.variant.type.declaration
        self.zones = list(traced.zones.values())
        told = [flow_rates(zone, has) if rated else ({}, {}) for zone in self.zones]
        self.rates = {id(zone): rates for zone, (rates, _) in zip(self.zones, told, strict=True)}
        self.unrated = {port: why for _, hindered in told for port, why in hindered.items()}
        self.yields = sorted({port for zone in self.zones for port in yields(zone, has)}) if rated else []
        self.joins = {name: joins(zone, has) if rated else [] for name, zone in traced.zones.items()}
        fit = [name for name in has.outputs if rated > 1 and not self._unfit(name)]
        of_outputs = output_rates(self.zones, fit, has)
        self.output_values = {id(z): {**z.outputs, **more} for z, more in zip(self.zones, of_outputs, strict=True)}
        self.ledger = [
            line for line in (layout.DISSIPATED, layout.SUPPLIED) if any(line in z.ledger for z in self.zones)
        ]
        self.targets = [f"port:{name}" for name in self._flowing()] + [f"own:{n}" for n in (*has.states, *has.unknowns)]
        self.targets += [f"{RATE}:{name}" for name in (self._flowing() if rated else [])]
        self.outputs = [*has.outputs, *(of_outputs[0] if of_outputs else ())]
        symbols = sorted({s.name for e in self._everything() for s in symbols_in(e)} | set(read_in_python(has)))
        self.inputs = [text for text in symbols if key(text).kind in (PORT, OWN, INPUT, TIME)]
        discrete = {f"p:#{name}" for name in has.discrete}
        numbers = {text for text in symbols if key(text).kind == PARAMETER} | discrete
        self.parameters = [key(text).number for text in sorted(numbers)]
        self.machines = (1 if len(traced.zones) > 1 else 0) + len(traced.tables)
        self.unfit = {name: why for name in has.outputs if (why := self._unfit(name))}
        self.d_signals = self._pairs(self.fit_outputs)
        self.d_flows = self._pairs(self.target_values)
        self.d_ledger = self._pairs(self.ledger_values)
        self.mass = sorted({(u, self.inputs.index(s)) for z in self.zones for u, h in z.holds.items() for s in h.rates})
        self.slots = max((len(z.guards) for z in self.zones), default=0)
        self.members = max((len(of_groups(z)) for z in self.zones), default=0)
        periods = {sine(path, "omega") for path in traced.time_tables}
        self.swings = {id(zone): self._swings(zone, periods) for zone in self.zones}
        self.most_swings = by_place([[name for name, _ in each] for each in self.swings.values()])
        # Kinds of derivatives: where they go, which, the values by zone, and which of them never change.
        self.kinds = [
            (layout.D_SIGNALS, self.d_signals, self.fit_outputs),
            (layout.D_FLOWS, self.d_flows, self.target_values),
            (layout.D_LEDGER, self.d_ledger, self.ledger_values),
        ]
        self.fixed = [self._fixed(pairs, values) for _, pairs, values in self.kinds]

    def structure(self, modes: list[int]) -> Structure:
        """What is stored with the machine code, which answers these modes."""
        t, paired, ratios = self.traced, held_pairs(self.zones), held_ratios(self.zones)
        has = t.variant.type.declaration
        return Structure(
            inputs=self.inputs, parameters=self.parameters, tables=t.tables, time_tables=t.time_tables,
            zones=list(t.zones), machines=self.machines, outputs=self.outputs, unfit=self.unfit,
            zeros=[name for name in has.outputs if all(zone.outputs.get(name) == 0 for zone in self.zones)],
            targets=self.targets, ledger=self.ledger, mass=self.mass,
            d_signals=self.d_signals, d_flows=self.d_flows, d_ledger=self.d_ledger,
            holds={u: [n for n, z in t.zones.items() if u in z.holds] for z in self.zones for u in z.holds},
            rigid=sorted({u for z in self.zones for u, h in z.holds.items() if h.impulse == h.slip}),
            positions={u: sorted(h.ratios) for z in self.zones for u, h in z.holds.items() if h.gap is not None},
            stops={u: _ports_of(h.way) for z in self.zones for u, h in z.holds.items() if h.way is not None},
            silent=self._silent(), rebounds={
                u: self._restitution(h) for z in self.zones for u, h in z.holds.items() if h.restitution != 0
            },
            pairs={u: pair for u, (pair, _) in paired.items()}, ratios={u: texts for u, (texts, _) in ratios.items()},
            senses={u: sense for u, (_, sense) in {**paired, **ratios}.items()},
            guards={name: [_describe(g, self, zone) for g in zone.guards] for name, zone in t.zones.items()},
            slots=self.slots, fixed_signals=self.fixed[0], fixed_flows=self.fixed[1], fixed_ledger=self.fixed[2],
            linear=not self._curved(self.d_flows, self.target_values),
            curved=self._curved(self.d_signals, self.fit_outputs), guards_read=self._guards_read(),
            late=self._late(), stores=any(zone.ledger.get(layout.STORED_ENERGY, 0) != 0 for zone in self.zones),
            modes=modes, members=self.members, shares_left=shares_left(t), sines=self._sines(),
            swings=self.most_swings,
            carries=carried_ratio(t) if has.carries else [],
            reads={name: self._reads(zone) for name, zone in t.zones.items()},
            inverse_masses={
                mass: port for port in has.ports if (mass := key(inverse_mass(port)).number) in self.parameters
            },
            flow_inputs={name: self._dependence(zone) for name, zone in t.zones.items()},
            period=next(iter(has.periods), ""), dampings=self._dampings(), joins=self.joins, unrated=self.unrated,
            yields=self.yields,
            reaches={name: {path: str(at) for path, at in zone.tables.items()} for name, zone in t.zones.items()},
        )  # fmt: skip

    def fit_outputs(self, zone: TracedZone) -> list[Any]:
        """By output what it is in a zone; None for those that can be recorded only."""
        return [None if n in self.unfit else self.output_values[id(zone)].get(n) for n in self.outputs]

    def target_values(self, zone: TracedZone) -> list[Any]:
        """By target what goes there in a zone."""
        by_kind = {PORT: zone.flows, OWN: zone.own, RATE: self.rates[id(zone)]}
        return [by_kind[one.kind].get(one.name) for one in map(key, self.targets)]

    def ledger_values(self, zone: TracedZone) -> list[Any]:
        """By line of the ledger its power or energy in a zone."""
        return [zone.ledger.get(line) for line in self.ledger]

    def partial(self, values: list[Any], pair: tuple[int, int]) -> sympy.Expr:
        """The derivative of a value to an input."""
        return derivative(sympy.sympify(values[pair[0]] or 0), symbol(self.inputs[pair[1]]))

    def _fixed(self, pairs: list[tuple[int, int]], values: Callable[[TracedZone], list[Any]]) -> list[int]:
        """Places of the derivatives that are the same in all zones, and made of parameters alone."""
        given = [values(zone) for zone in self.zones]
        found = []
        for e, pair in enumerate(pairs):
            partials = [self.partial(each, pair) for each in given]
            plain = all(key(s.name).is_fixed for s in symbols_in(partials[0]))
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
            and any(s.name in self.inputs for s in symbols_in(self.partial(values(zone), pair)))
        }
        return sorted(found)

    def _dampings(self) -> dict[str, str]:
        """By port what it takes in more for every speed of its own, where that is made of parameters in all zones."""
        found = {}
        for e in self.fixed[1]:
            k, j = self.d_flows[e]
            target, speed = key(self.targets[k]), key(self.inputs[j])
            if target.kind == PORT and speed.is_speed and speed.name == target.name:
                found[target.name] = parameters_as_text(self.partial(self.target_values(self.zones[0]), (k, j)))
        return found

    def _guards_read(self) -> bool:
        """True if a guard reads what is known only after the forces."""
        return any(_is_late(value) for z in self.zones for g in z.guards for value in g.values)

    def _late(self) -> list[int]:
        """Places of the outputs that read what is known only after the forces."""
        names = [*self.outputs, *layout.OUTPUT_LINES]
        values = [{**zone.outputs, **zone.ledger} for zone in self.zones]
        return [k for k, name in enumerate(names) if any(name in of and _is_late(of[name]) for of in values)]

    def _flowing(self) -> list[str]:
        return [n for n in self.traced.variant.type.declaration.ports if any(n in z.flows for z in self.zones)]

    def _unfit(self, name: str) -> str:
        """Why an output can be recorded only, or "" when it may feed a law."""
        values = [zone.outputs[name] for zone in self.zones if name in zone.outputs]
        symbols = (key(s.name) for value in values for s in symbols_in(value))
        read = {one.part for one in symbols if one.kind == PORT}
        if "a" in read:
            return "it reads an acceleration, which is known only after the forces"
        if "R" in read:
            return "it reads the force of a prescribed motion, which is known only after the forces"
        return "it has a corner where its derivative jumps" if any(map(is_kinked, values)) else ""

    def _everything(self) -> list[sympy.Expr]:
        found: list[sympy.Expr] = list(self.traced.sample.values())
        for z in self.zones:
            found += [*z.flows.values(), *z.own.values(), *z.outputs.values(), *z.ledger.values()]
            found += [*self.rates[id(z)].values(), *self.output_values[id(z)].values()]
            found += [value for g in z.guards for value in g.values]
            for h in z.holds.values():
                found += [h.slip, h.impulse, h.restitution, *h.rates.values(), *([] if h.place is None else [h.place])]
        return found

    def _pairs(self, values: Any) -> list[tuple[int, int]]:
        """(value, input) for every derivative that is not identically zero in some zone."""
        found = set()
        for zone in self.zones:
            for k, value in enumerate(values(zone)):
                if value is not None:
                    used = {s.name for s in symbols_in(value)}
                    found |= {(k, j) for j, text in enumerate(self.inputs) if text in used}
        return sorted(found)

    def _silent(self) -> bool:
        """True if it passes power at its ports and says nothing of energy: a class of a user who left that out."""
        if self.ledger or any(zone.ledger.get(layout.STORED_ENERGY, 0) != 0 for zone in self.zones):
            return False
        powers = map(self._power, self.zones)
        return any(differs(power, sympy.S.Zero) or sympy.expand(power) != 0 for power in powers)

    def _power(self, zone: TracedZone) -> sympy.Expr:
        """What a zone takes in at its ports [W], where what it holds does not slip."""
        ports = self.traced.variant.type.declaration.ports
        power = sympy.S.Zero
        for name, flow in zone.flows.items():
            domain = ports[name].domain
            if (domain.across[-1][1], domain.through[1]) in WATTS:
                power += flow * symbol(f"port:{name}:{'v' if len(domain.across) > 1 else 'x'}")
        for unknown, row in zone.holds.items():
            if row.gap is not None:  # what it puts on its ports does no work, term by term
                power += symbol(f"own:{unknown}") * row.slip
                continue
            speed = symbol(next(iter(row.rates)))
            power = power.subs(speed, speed - row.slip / row.rates[speed.name])
        return power

    def _restitution(self, row: HoldRow) -> tuple[int, float]:
        """Place in the parameters, or -1 where it is a number, which follows."""
        if row.restitution.is_Symbol:
            return self.parameters.index(key(row.restitution.name).number), 0.0
        return -1, float(row.restitution)

    def _reads(self, zone: TracedZone) -> dict[str, dict[str, Any]]:
        """What this zone depends on, see dependence.py."""
        values = [*self.fit_outputs(zone), *self.target_values(zone), *self.ledger_values(zone)]
        places = [path for path in self.traced.tables if path not in self.traced.time_tables]
        return reads(values, zone.guards, self.inputs, places)

    def _sines(self) -> list[tuple[int, int]]:
        """Places of what a quantity in time swings with."""
        at = {text: k for k, text in enumerate(self.parameters)}
        keys = ([key(sine(path, part)) for part in ("amplitude", "omega")] for path in self.traced.time_tables)
        parts = ([at.get(one.number) for one in both] for both in keys)
        return [(size, pace) for size, pace in parts if size is not None and pace is not None]

    def _swings(self, zone: TracedZone, periods: set[str]) -> list[tuple[str, sympy.Expr]]:
        """What sines of a zone are taken of; an output that can be recorded only feeds nothing."""
        outputs = dict(zip(self.outputs, self.fit_outputs(zone), strict=True))
        return swings([value for guard in zone.guards for value in guard.values], outputs, self.inputs, periods)

    def _dependence(self, zone: TracedZone) -> dict[str, list[str]]:
        pairs = zip(self.targets, self.target_values(zone), strict=True)
        return {t: sorted(s.name for s in symbols_in(v) if s.name in self.inputs) for t, v in pairs if v is not None}


def _ports_of(way: sympy.Expr) -> list[str]:
    """The ports whose positions stand in it."""
    return sorted({key(s.name).name for s in symbols_in(way) if key(s.name).kind == PORT})


def _is_late(value: Any) -> bool:
    """True if it reads an acceleration or a reaction."""
    return any(key(s.name).is_late for s in symbols_in(sympy.sympify(value)))


def of_groups(zone: TracedZone) -> list[sympy.Expr]:
    """The values of the guards that are groups, in order."""
    return [value for guard in zone.guards if len(guard.values) > 1 for value in guard.values]


def _describe(guard: TracedGuard, facts: KernelFacts, zone: TracedZone) -> dict[str, Any]:
    base = facts.machines - len(facts.traced.tables)
    machine = base + facts.traced.tables.index(guard.table) if guard.table else 0
    to = -1 if guard.table else list(facts.traced.zones).index(guard.to)
    return {
        "name": guard.name, "to": to, "unit": guard.unit, "machine": machine, "step": guard.step,
        "limits": bounds_what_holds(guard, zone), "latches": latches(guard, facts.traced),
        "values": len(guard.values),
    }  # fmt: skip
