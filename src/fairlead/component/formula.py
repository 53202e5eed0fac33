"""An expression of signals, as a tree of steps with a dimension each: what `SignalFunction` makes blocks of.

It is read by the safe language of expressions in a netlist (`netlist/expressions.py`), which works with numbers; here
some names stand for signals, of which only the dimension is known. What has no signal in it is worked out at once.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from fairlead.errors import did_you_mean, listing, shown
from fairlead.netlist.expressions import (
    RESERVED,
    ExpressionError,
    Scalar,
    applied,
    leaf,
    operands,
    parse,
    spelled,
    unit_of,
)
from fairlead.quantities import Quantity, QuantityError, parse_unit

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*", re.ASCII)
OPERATIONS: dict[type, str] = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**", ast.USub: "neg", ast.UAdd: "pos",
}  # fmt: skip


@dataclass(frozen=True)
class Step:
    """One operation: its sign or its function, what it works on, and the number if it is one; "input" is a signal."""

    operation: str
    inner: tuple[Step, ...] = ()
    number: float | None = None
    name: str = ""

    def names(self) -> Iterator[str]:
        """The signals it needs, each as often as it occurs."""
        if self.operation == "input":
            yield self.name
        for one in self.inner:
            yield from one.names()

    def parts(self) -> Iterator[Step]:
        """It and all it is made of."""
        yield self
        for one in self.inner:
            yield from one.parts()

    def narrowed(self) -> Iterator[Step]:
        """What stands in an exponential or is divided by: what is wide there may be narrow outside."""
        for one in self.parts():
            if one.operation == "exp":
                yield from one.inner[0].parts()
            elif one.operation == "/":
                yield from one.inner[1].parts()
            elif one.operation == "**" and (one.inner[1].number or 0.0) < 0:
                yield from one.inner[0].parts()


class FormulaError(ExpressionError):
    """An expression that is no function of its signals; `of` names the parameter that is wrong."""

    def __init__(self, of: str, what: str, way_out: str = "") -> None:
        super().__init__(what, way_out)
        self.of = of


def formula(
    text: str, units: Mapping[str, str] | None, constants: Mapping[str, Scalar], *, output: str
) -> tuple[Step, str]:
    """The tree of an expression and the unit of its value.

    `units` are those of the signals; None: all plain numbers. `output` is the name that no signal may have.
    Raises FormulaError for what is no arithmetic, has no such name or mixes units.
    """
    try:
        plain, written = spelled(text)
        tree = parse(plain)
        if units is None:
            named = [node.id for node in ast.walk(tree) if isinstance(node, ast.Name)]
            calls = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
            taken = {*RESERVED, *constants, *written, *(node.id for node in calls if isinstance(node, ast.Name))}
            units = {name: "1" for name in named if name not in taken}
        signals = {name: _dimensioned(name, unit, output) for name, unit in units.items()}
        step, quantity = _walk(tree, signals, {**constants, **written})
        return step, unit_of(quantity, text) or "1"
    except FormulaError:
        raise
    except ExpressionError as error:
        said = error.what if error.what.startswith("{") else f"{shown(text)}: {error.what}"
        raise FormulaError("expression", said, error.way_out) from None
    except ZeroDivisionError:
        raise FormulaError("expression", f"{shown(text)} divides by zero", "Give another number there.") from None
    except (OverflowError, ValueError):
        what = f"{shown(text)} has a part that is no finite number"
        raise FormulaError("expression", what, "Look at its roots, logarithms and powers.") from None


def _dimensioned(name: str, unit: str, output: str) -> Quantity:
    if not NAME.fullmatch(name) or name in RESERVED or name == output:
        taken = f" {listing(sorted((*RESERVED, output)))} have a meaning already."
        raise FormulaError("inputs", f"{shown(name)} cannot be the name of an input", f"Take letters, digits.{taken}")
    try:
        return Quantity(1.0, parse_unit(unit).dimension)
    except QuantityError as error:
        raise FormulaError("inputs", f"the unit of {name}: {error.what}", error.allowed) from None


def _walk(node: ast.expr, signals: Mapping[str, Quantity], numbers: Mapping[str, Scalar]) -> tuple[Step, Quantity]:
    """A step, and a quantity that has its dimension; of what has a signal in it the value is 1."""
    if isinstance(node, ast.Name) and node.id in signals:
        return Step("input", name=node.id), signals[node.id]
    if isinstance(node, ast.Name) and node.id not in numbers and node.id not in RESERVED:
        known = [*signals, *numbers]
        what = f"there is no input {node.id}"
        raise ExpressionError(what, f"{did_you_mean(node.id, known)} Name it in inputs or in constants.".strip())
    found = leaf(node, numbers)
    if found is not None:
        return Step("number", number=float(found.value)), found
    inner = [_walk(one, signals, numbers) for one in operands(node)]
    steps = tuple(step for step, _ in inner)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow) and steps[1].number is None:
        raise ExpressionError("an exponent is a number", "Write exp(b*log(a)) for a to the power b, of a above zero.")
    result = applied(node, [quantity for _, quantity in inner])
    if all(step.number is not None for step in steps):
        return Step("number", number=float(result.value)), result
    function = node.func.id if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) else ""
    operation = function or OPERATIONS[type(node.op)]  # type: ignore[attr-defined]
    return Step(operation, steps), Quantity(1.0, result.dimension)
