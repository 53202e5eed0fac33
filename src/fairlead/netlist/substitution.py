"""Scene parameters put into the places that name them: every text with braces in a tree is worked out."""

from __future__ import annotations

from dataclasses import replace

from fairlead.errors import Fault, shown
from fairlead.netlist.expressions import has_expression
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.netlist.netlist import Value
from fairlead.netlist.parameters import NAME, Parameters, work_out

FILLED = ("components", "friction", "effects", "initial", "nominal", "run", "limits")


def fill_tree(tree: Value) -> tuple[Value, list[Fault]]:
    """The tree of a netlist with its parameters worked out and put into every block that may use them.

    In `record` only `every` is filled: signals are patterns, and titles may hold braces of their own.
    """
    entries = dict(tree.entries)
    given = entries["parameters"].entries if "parameters" in entries else {}
    parameters, faults = work_out(given)
    if given:
        values = {
            name: replace(given[name], content=content, written=_expression(given[name]))
            for name, content in parameters.values.items()
        }
        entries["parameters"] = replace(entries["parameters"], content=values)
    for block in FILLED:
        if block in entries:
            begin = "" if block == "components" else f"{block}."
            inner = {
                name: _fill(value, parameters, faults, f"{begin}{shown(name)}")
                for name, value in entries[block].entries.items()
            }
            entries[block] = replace(entries[block], content=inner or entries[block].content)
    if "record" in entries and (every := entries["record"].entries.get("every")):
        inner = {**entries["record"].entries, "every": _fill(every, parameters, faults, "record.every")}
        entries["record"] = replace(entries["record"], content=inner)
    return replace(tree, content=entries), faults


def _expression(value: Value) -> str:
    """What a parameter is worked out from, if it is."""
    return value.content if isinstance(value.content, str) and has_expression(value.content) else ""


def _fill(value: Value, parameters: Parameters, faults: list[Fault], path: str) -> Value:
    """The value at `path` with every expression in it worked out; one that cannot be becomes 0, with a fault."""
    content = value.content
    if len(faults) > MOST_FAULTS:
        return value
    if isinstance(content, dict):
        if bare := _unquoted(content, parameters):
            way_out = f'Put an expression in quotes: "{{{bare}}}".'
            faults.append(Fault(value.where, f"{path}: {{{shown(bare)}}} without quotes is a map in YAML", way_out))
            return replace(value, content=0)
        return replace(
            value,
            content={name: _fill(item, parameters, faults, f"{path}.{shown(name)}") for name, item in content.items()},
        )
    if isinstance(content, list):
        filled_in = [_fill(item, parameters, faults, f"{path}[{k}]") for k, item in enumerate(content)]
        return replace(value, content=filled_in)
    filled, fault = parameters.put_into(value, path)
    faults += [fault] if fault else []
    return filled


def _unquoted(content: dict[str, Value], parameters: Parameters) -> str:
    """The expression that a map such as {mu} or {2*mu} was meant to be, or "" for an honest map."""
    if len(content) != 1:
        return ""
    ((name, item),) = content.items()
    known = name in parameters.values or name in parameters.broken
    return name if item.content is None and (known or not NAME.fullmatch(name)) else ""
