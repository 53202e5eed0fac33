"""Arithmetic in braces: "{2*mu}" and "{2*mu} N", parsed, bounded, and worked out with dimensions.

Python's parser reads the text; the tree is then walked node by node, and what is not on the short list below
is refused. Nothing is ever evaluated as Python.

A parameter that is a quantity ("0.3 m/s") takes part with its dimension: "{2*speed}" is "0.6 m/s", and metres
do not add to seconds. Angles are a kind of their own here too: with the constants `rad` and `deg`,
"{speed/radius*rad}" is an angular speed and "{radius*angle/rad}" a length. A quantity is written in parentheses:
"{angle/n*(1 m)}".
"""

from __future__ import annotations

import ast
import math
import operator
import re
import warnings
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

from fairlead.errors import FairleadError, did_you_mean, listing, shown
from fairlead.quantities import NONE, RAD, Dimension, Quantity, QuantityError, quantity, unit_text

LONGEST = 200
MOST_NODES = 100
LARGEST_POWER = 16
LARGEST_WHOLE = 2**53  # whole numbers stay whole as long as a float would hold them exactly

Scalar = str | int | float | bool | None
ANGLE: Dimension = tuple(int(index == RAD) for index in range(len(NONE)))
CONSTANTS = {
    "pi": Quantity(math.pi),
    "rad": Quantity(1.0, ANGLE),
    "deg": Quantity(math.pi / 180, ANGLE),
}
FUNCTIONS = ("sqrt", "sin", "cos", "exp", "log", "abs", "min", "max")
RESERVED = frozenset((*CONSTANTS, *FUNCTIONS))
WHOLE_TEXT = re.compile(r"\{([^{}]*)\}(?: +([^{}\s][^{}]*))?")
WRITTEN = re.compile(r"\(\s*([0-9.]+(?:[eE][-+]?[0-9]+)?)\s+([A-Za-zµμΩ°%][^(){}]*?)\s*\)")
SPELLED = "_quantity_"
BARE = re.compile(r"[0-9.]+\s+[A-Za-zµμΩ°%]")
ALLOWED = (
    "Allowed are parameters, numbers, quantities in parentheses such as (1 m), + - * / ** ( ), "
    f"{listing(FUNCTIONS)} and {listing(CONSTANTS)}."
)


class ExpressionError(FairleadError, ValueError):
    """An expression that cannot be worked out: `what` begins with its text, `way_out` says what helps."""

    def __init__(self, what: str, way_out: str = "") -> None:
        super().__init__(what, way_out)
        self.what, self.way_out = what, way_out

    def __str__(self) -> str:
        return f"{self.what}. {self.way_out}".strip()


def has_expression(text: str) -> bool:
    """Whether a text holds braces, and so must be an expression."""
    return "{" in text or "}" in text


def substitute(text: str, parameters: Mapping[str, Scalar]) -> Scalar:
    """What "{expression}" or "{expression} unit" stands for.

    A parameter alone stands for itself, whatever it is. A result with a dimension becomes text in SI, such as
    "0.6 m/s"; a unit after the braces is put behind a plain number. Raises ExpressionError.
    """
    match = WHOLE_TEXT.fullmatch(text) if len(text) <= 2 * LONGEST else None
    if match is None:
        advice = 'Put all arithmetic inside one pair of braces, then a unit: "{2*mu} N".'
        raise ExpressionError(f"{shown(text)} is not an expression", advice)
    inside, unit = match[1].strip(), match[2]
    if inside in parameters and not unit:
        return parameters[inside]
    result = evaluate(inside, parameters)
    own_unit = unit_of(result, inside)
    if unit and own_unit:
        what = f"{shown(text)} has two units, {own_unit} from its parameters and {shown(unit)}"
        raise ExpressionError(what, "Leave out the unit after the braces.")
    return f"{result.value!r} {unit or own_unit}" if unit or own_unit else result.value


def evaluate(text: str, parameters: Mapping[str, Scalar]) -> Quantity:
    """The value of an expression (without braces); raises ExpressionError."""
    plain, written = spelled(text)
    try:
        result = _walk(parse(plain), {**parameters, **written} if written else parameters)
    except ExpressionError as error:
        raise ExpressionError(f"{{{shown(text)}}}: {error.what}", error.way_out) from None
    except ZeroDivisionError:
        advice = "What it is divided by is zero; give a number other than zero there."
        raise ExpressionError(f"{{{shown(text)}}}: division by zero", advice) from None
    except OverflowError:
        raise ExpressionError(f"{{{shown(text)}}}: the result is too large") from None
    except ValueError:
        what = f"{{{shown(text)}}}: a square root or logarithm that does not exist"
        raise ExpressionError(what) from None
    if not math.isfinite(result.value):
        raise ExpressionError(f"{{{shown(text)}}} is not finite")
    return result


def names_in(text: str) -> set[str]:
    """The parameters that "{expression} unit" needs; empty when it cannot be read."""
    match = WHOLE_TEXT.fullmatch(text) if len(text) <= 2 * LONGEST else None
    try:
        plain, written = spelled(match[1].strip()) if match else ("0", {})
        tree = parse(plain)
    except ExpressionError:
        return set()
    return {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)} - RESERVED - written.keys()


def spelled(text: str) -> tuple[str, dict[str, Scalar]]:
    """The expression with a name for every quantity in parentheses, such as `(1 m)`, and the quantities by name."""
    written: dict[str, Scalar] = {}

    def named(found: re.Match[str]) -> str:
        name = f"{SPELLED}{len(written)}"
        written[name] = f"{found[1]} {found[2]}"
        return f"({name})"

    return WRITTEN.sub(named, text), written


def parse(text: str) -> ast.expr:
    """The tree of an expression, within bounds of length and size; raises ExpressionError."""
    if len(text) > LONGEST:
        raise ExpressionError("too long", f"An expression has at most {LONGEST} characters.")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Python's opinion of "1if 2else 3" is not for our users
            tree = ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        advice = "A quantity in an expression stands in parentheses: (1 m)." if BARE.search(text) else ALLOWED
        raise ExpressionError("this is not arithmetic", advice) from None
    if sum(1 for _ in ast.walk(tree)) > 3 * MOST_NODES:
        raise ExpressionError("too many terms", f"An expression has at most {MOST_NODES} parts.")
    return tree


def _walk(node: ast.expr, parameters: Mapping[str, Scalar]) -> Quantity:
    found = leaf(node, parameters)
    return applied(node, [_walk(one, parameters) for one in operands(node)]) if found is None else found


def leaf(node: ast.expr, parameters: Mapping[str, Scalar]) -> Quantity | None:
    """The value of a number or of a name; None of what is made of others."""
    if (
        isinstance(node, ast.Constant)
        and isinstance(node.value, int | float)
        and not isinstance(node.value, bool)
    ):
        return Quantity(node.value)
    return _named(node.id, parameters) if isinstance(node, ast.Name) else None


def operands(node: ast.expr) -> list[ast.expr]:
    """What an operation or a function works on. Raises ExpressionError for anything else."""
    if isinstance(node, ast.UnaryOp) and type(node.op) in _SIGNS:
        return [node.operand]
    if isinstance(node, ast.BinOp) and type(node.op) in _OPERATIONS:
        return [node.left, node.right]
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
        return node.args
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitXor):
        raise ExpressionError("^ is not a power here", "Write ** for a power.")
    if isinstance(node, ast.Tuple):
        what = "a comma stands only between the arguments of a function"
        raise ExpressionError(what, "Write a decimal point, not a decimal comma.")
    raise ExpressionError(f"{shown(ast.unparse(node))} is not arithmetic", ALLOWED)


def applied(node: ast.expr, values: list[Quantity]) -> Quantity:
    """The value of an operation or a function whose operands have these values."""
    if isinstance(node, ast.UnaryOp):
        return Quantity(_SIGNS[type(node.op)](values[0].value), values[0].dimension)
    if isinstance(node, ast.BinOp):
        return _OPERATIONS[type(node.op)](*values)
    assert isinstance(node, ast.Call)  # see operands
    assert isinstance(node.func, ast.Name)
    return _call(node.func.id, values)


def _named(name: str, parameters: Mapping[str, Scalar]) -> Quantity:
    if name in CONSTANTS:
        return CONSTANTS[name]
    if name not in parameters:
        known = f"Parameters are {listing(parameters)}." if parameters else "The netlist has no parameters."
        raise ExpressionError(
            f"there is no parameter {name}", f"{did_you_mean(name, parameters)} {known}".strip()
        )
    content = parameters[name]
    if isinstance(content, (int, float)) and not isinstance(content, bool):
        return Quantity(content)
    try:
        return quantity(content if isinstance(content, str) else shown(content))
    except QuantityError as error:
        of = "" if name.startswith(SPELLED) else f"{name} = "
        raise ExpressionError(f"{of}{error.what}", error.allowed) from None


def _add(sign: int) -> Callable[[Quantity, Quantity], Quantity]:
    def add(left: Quantity, right: Quantity) -> Quantity:
        _same(left, right)
        return Quantity(_whole(left.value + sign * right.value), left.dimension)

    return add


def _multiply(left: Quantity, right: Quantity) -> Quantity:
    powers = tuple(one + other for one, other in zip(left.dimension, right.dimension))
    return Quantity(_whole(left.value * right.value), powers)


def _divide(left: Quantity, right: Quantity) -> Quantity:
    powers = tuple(one - other for one, other in zip(left.dimension, right.dimension))
    return Quantity(left.value / right.value, powers)


def _power(base: Quantity, exponent: Quantity) -> Quantity:
    if exponent.dimension != NONE or not abs(exponent.value) <= LARGEST_POWER:
        advice = f"An exponent is a plain number between -{LARGEST_POWER} and {LARGEST_POWER}."
        raise ExpressionError(f"{_text(exponent)} is too much of an exponent", advice)
    value = float(base.value) ** exponent.value
    if isinstance(value, complex):
        raise ExpressionError(f"{_text(base)} has no real power {_text(exponent)}")
    whole = isinstance(base.value, int) and isinstance(exponent.value, int) and exponent.value >= 0
    turns = Fraction(exponent.value).limit_denominator(12)
    if base.dimension != NONE and abs(float(turns) - exponent.value) > 1e-12:
        raise ExpressionError(f"{_text(base)} to the power {_text(exponent)} has no unit")
    return Quantity(
        int(value) if whole and abs(value) < LARGEST_WHOLE else value, _times(base.dimension, turns)
    )


def _call(name: str, arguments: list[Quantity]) -> Quantity:
    if name not in FUNCTIONS:
        raise ExpressionError(
            f"there is no function {name}", f"{did_you_mean(name, FUNCTIONS)} {ALLOWED}".strip()
        )
    if name in ("min", "max") and len(arguments) >= 2:
        for other in arguments[1:]:
            _same(arguments[0], other)
        return Quantity(_BY_NAME[name](item.value for item in arguments), arguments[0].dimension)
    if name in ("min", "max") or len(arguments) != 1:
        count = "two arguments or more" if name in ("min", "max") else "one argument"
        raise ExpressionError(f"{name} takes {count}, not {len(arguments)}")
    (argument,) = arguments
    if name == "abs":
        return Quantity(abs(argument.value), argument.dimension)
    if name == "sqrt":
        return Quantity(math.sqrt(argument.value), _times(argument.dimension, Fraction(1, 2)))
    if argument.dimension != NONE and not (name in ("sin", "cos") and argument.dimension == ANGLE):
        takes = "an angle or a plain number" if name in ("sin", "cos") else "a plain number"
        raise ExpressionError(f"{name} takes {takes}, not {_text(argument)}")
    return Quantity(_BY_NAME[name](argument.value))


_BY_NAME: dict[str, Any] = {
    "sin": math.sin,
    "cos": math.cos,
    "exp": math.exp,
    "log": math.log,
    "min": min,
    "max": max,
}
_SIGNS: dict[type, Callable[[Any], Any]] = {ast.USub: operator.neg, ast.UAdd: operator.pos}
_OPERATIONS: dict[type, Callable[[Quantity, Quantity], Quantity]] = {
    ast.Add: _add(1),
    ast.Sub: _add(-1),
    ast.Mult: _multiply,
    ast.Div: _divide,
    ast.Pow: _power,
}


def _same(left: Quantity, right: Quantity) -> None:
    if left.dimension != right.dimension:
        raise ExpressionError(f"{_text(left)} and {_text(right)} are not of one kind")


def _times(dimension: Dimension, turns: Fraction) -> Dimension:
    return tuple(turns * power for power in dimension)


def _whole(value: float) -> float:
    return value if abs(value) < LARGEST_WHOLE else float(value)


def unit_of(result: Quantity, text: str) -> str:
    """The unit in SI of a result, "" of a plain number. Raises ExpressionError where there is none."""
    try:
        return unit_text(result.dimension)
    except QuantityError as error:
        raise ExpressionError(f"{{{shown(text)}}}: {error.what}", error.allowed) from None


def _text(item: Quantity) -> str:
    if item.dimension == NONE:
        return shown(item.value)
    try:
        return f"{item.value:g} {unit_text(item.dimension)}"
    except QuantityError:
        return f"{item.value:g} of no unit"
