"""Conditions over signals: comparisons joined by `and` and `or`, as what must rise above zero.

    alternatives("a > 2 and b < c or d > 0", 4)        [["(a) - (2)", "(c) - (b)"], ["(d) - (0)"]]
"""

from __future__ import annotations

import ast

from fairlead.component.formula import FormulaError
from fairlead.errors import shown
from fairlead.netlist.expressions import ExpressionError, parse, spelled

FORM = 'Write comparisons by < and >, joined by and, then by or: "level > 0.8 and speed < 2 or stop > 0.5".'


def alternatives(text: str, most: int) -> list[list[str]]:
    """Expressions of which all of one list must be above zero. Raises FormulaError for what is no such condition."""
    plain, written = spelled(text)
    try:
        tree = parse(plain)
    except ExpressionError as error:
        raise FormulaError("expression", f"{shown(text)}: {error.what}", FORM) from None
    found = []
    for one in _joined(tree, ast.Or):
        parts = _joined(one, ast.And)
        if len(parts) > most:
            what = f"{shown(text)} joins {len(parts)} comparisons by and, and {most} are the most"
            raise FormulaError("expression", what, "Take a LogicGate, or a SignalFunction with min, before it.")
        found.append([_written(_difference(part, text), written) for part in parts])
    return found


def _joined(node: ast.expr, by: type[ast.boolop]) -> list[ast.expr]:
    return node.values if isinstance(node, ast.BoolOp) and isinstance(node.op, by) else [node]


def _difference(node: ast.expr, text: str) -> str:
    """The larger side less the smaller."""
    if not isinstance(node, ast.Compare) or len(node.ops) != 1:
        raise FormulaError("expression", f"{shown(text)}: {shown(ast.unparse(node))} is no comparison", FORM)
    left, right = ast.unparse(node.left), ast.unparse(node.comparators[0])
    if isinstance(node.ops[0], ast.Gt | ast.GtE):
        return f"({left}) - ({right})"
    if isinstance(node.ops[0], ast.Lt | ast.LtE):
        return f"({right}) - ({left})"
    raise FormulaError("expression", f"{shown(text)} compares by something else than < and >", FORM)


def _written(text: str, quantities: dict[str, str | int | float | bool | None]) -> str:
    """The quantities in parentheses as they were written."""
    for name, quantity in quantities.items():
        text = text.replace(name, f"({quantity})")
    return text
