"""What a component does: its zones, the table of its transitions, its equations zone by zone, as traced."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Iterator

from sympy import Expr, sympify

from fairlead.component.answers import METHODS
from fairlead.component.base import Declared
from fairlead.component.declare import Guard
from fairlead.component.given import Choice
from fairlead.component.symbols import TraceError, inverse_mass, symbol
from fairlead.component.trace import Traced, trace_function
from fairlead.describe.columns import columns, heading, wrapped
from fairlead.describe.equations import NEVER, Writing, condition, equations, tables_as_functions, writing_of
from fairlead.describe.formula import formula
from fairlead.describe.interface import first_line
from fairlead.describe.specimen import specimen, traced_specimen


def behaviour(kind: type[Declared]) -> Iterator[str]:
    """Zones, transitions and equations of a leaf component."""
    try:
        traced = traced_specimen(kind)
    except TraceError as error:
        yield from (*heading("equations"), f"  cannot be traced: {error}")
        return
    writing = writing_of(traced)
    if len(traced.zones) > 1:
        yield from heading("zones")
        yield from columns(_without_repeats((name, first_line(kind.declaration.laws[name])) for name in traced.zones))
        yield from _transitions(kind, traced, writing)
    yield from heading(f"equations{_chosen(kind, traced)}")
    said = [*_equations(traced, writing), *_samples(kind, traced, writing)]
    yield from said or ["  none; it takes part in nothing but the graph"]
    yield from _legend(traced, "\n".join(said))


def functions(kind: type[Declared], indent: int = 2) -> list[str]:
    """What a part of a law, such as a friction curve, computes; what is plain Python is left out."""
    variant = specimen(kind, open_parts=True)
    rows = []
    for name, function in inspect.getmembers(kind, inspect.isfunction):
        if name.startswith("_") or name in METHODS:
            continue
        arguments = list(inspect.signature(function).parameters)[1:]
        try:
            value, reads = trace_function(variant, function, *(symbol(f"own:{n}") for n in arguments))
        except TraceError:
            continue
        if isinstance(value, int | float | Expr) and not isinstance(value, bool):
            said = formula(tables_as_functions(sympify(value), reads), {})
            rows.append((f"{name}({', '.join(arguments)}) = {said}", first_line(function)))
    return columns(rows, indent)


def _chosen(kind: type[Declared], traced: Traced) -> str:
    """The words the equations are traced with, where other words give others."""
    words = [f"{n}: {w}" for n, w in traced.variant.words if isinstance(kind.declaration.parameters.get(n), Choice)]
    return f", with {', '.join(words)}" if words else ""


def _transitions(kind: type[Declared], traced: Traced, writing: Writing) -> Iterator[str]:
    """From, to, guard and when; zones that a guard leaves alike share a line."""
    lines: dict[tuple[str, str, str], list[str]] = {}
    for name, zone in traced.zones.items():
        for guard in zone.guards:
            if not guard.table and (when := condition(guard, zone, writing)) != NEVER:
                lines.setdefault((guard.name, guard.to, when), []).append(name)
    yield from heading("transitions: from -> to, guard, fires when this becomes true")
    everywhere = set(traced.zones)
    yield from columns(
        (
            "all others" if set(zones) == everywhere - {to} and len(zones) > 1 else ", ".join(zones),
            f"-> {to}",
            guard,
            when,
        )
        for (guard, to, when), zones in lines.items()
    )
    used = {guard for guard, _, _ in lines}
    yield ""
    guards = kind.declaration.guards.items()
    yield from columns((n, _said_of(n, mark)) for n, mark in guards if n in used)


def _said_of(name: str, mark: Guard) -> str:
    """The sentence of a guard; of a mirror, which guard it mirrors."""
    return f"As {mark.mirrored}, the other way." if mark.direction < 0 else first_line(mark.function)


def _without_repeats(rows: Iterable[tuple[str, str]]) -> Iterator[tuple[str, str]]:
    before = None
    for name, said in rows:
        yield name, "as above" if said == before else said
        before = said


def _equations(traced: Traced, writing: Writing) -> Iterator[str]:
    """What all zones have in common, then what each says; zones that say the same share a paragraph."""
    said = {name: equations(zone, writing) for name, zone in traced.zones.items()}
    first = next(iter(said.values()))
    common = [line for line in first if all(line in lines for lines in said.values())] if len(said) > 1 else first
    for line in common:
        yield from wrapped(f"  {line}", 6)
    own: dict[tuple[str, ...], list[str]] = {}
    for name, lines in said.items():
        own.setdefault(tuple(line for line in lines if line not in common), []).append(name)
    for lines_of_zone, names in own.items():
        if len(said) > 1:
            yield f"  in zone {', '.join(names)}"
            for line in lines_of_zone:
                yield from wrapped(f"    {line}", 8)


def _samples(kind: type[Declared], traced: Traced, writing: Writing) -> Iterator[str]:
    """What is computed at sample times from the values before them, and then held."""
    has = kind.declaration
    if has.python:
        yield "  every period, in plain Python, and held in between: " + ", ".join(has.outputs)
    for sample in has.samples.values():
        yield f"  every {sample.period}, from the values before it"
        for name, value in traced.sample.items():
            yield from wrapped(f"    {name} = {formula(value, writing.names)}", 8)


def _legend(traced: Traced, equations_said: str) -> Iterator[str]:
    """What the words that no list explains stand for."""
    has = traced.variant.type.declaration
    names = {
        s.name for zone in traced.zones.values() for guard in zone.guards for v in guard.values for s in v.free_symbols
    }
    flows = [(n, f"{n}.{p.domain.through[0]}") for n, p in has.ports.items()]
    port, flow = next(((n, flow) for n, flow in flows if f"{flow} =" in equations_said), ("", ""))
    if port:
        yield from ("", f"  {flow} is what acts on the component at {port}.")
    for name in has.ports:
        if inverse_mass(name) in names:
            yield f"  {name}.inverse_mass is 1 / mass of the body at {name}, 0 if its motion is prescribed."
    if len(traced.zones) > 1 and has.outputs:
        yield "  An output that a zone does not mention is 0 there."
