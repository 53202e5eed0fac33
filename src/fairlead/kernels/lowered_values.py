"""Expressions and conditions of the text that `lowering.py` makes into LLVM code.

    + - * / ** with names, numbers, x[index]       // and % of whole numbers by a whole constant above zero
    == != < <= > >=, chained as in 0 < a < 3       and, or, not: what follows is looked at only where needed
    exp log sqrt sin cos tan tanh atan abs min max sign, and shared functions

Conditions stand in `if` and `while` only. Numbers are those of the machine, so three things are said here:

- A whole number has 64 bit; it becomes a float beside a float. `/` gives a float, as in Python.
- Where Python raises (division by zero, the root of -1) there is an infinity or a nan, as in numpy.
- The length of an array is not known: an index is from zero up and inside, or memory is damaged. A negative
  constant is refused.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import Any, NoReturn

from llvmlite import ir

from fairlead.kernels import layout

DOUBLE, INT = ir.DoubleType(), ir.IntType(64)
F8, I8 = DOUBLE.as_pointer(), INT.as_pointer()
KERNEL = ("int", "I8", "int", "int", "F8", "I8", "F8", "F8")
KERNEL_TYPE = ir.FunctionType(ir.VoidType(), [{"int": INT, "I8": I8, "F8": F8}[kind] for kind in KERNEL])
INTRINSIC = {
    "exp": "llvm.exp",
    "log": "llvm.log",
    "sqrt": "llvm.sqrt",
    "sin": "llvm.sin",
    "cos": "llvm.cos",
    "abs": "llvm.fabs",
}
LIBRARY = ("tan", "tanh", "atan")  # from the C library of the process
CONSTANTS = {name: value for name, value in vars(layout).items() if name.isupper() and isinstance(value, int)}
COMPARISONS = {ast.Eq: "==", ast.NotEq: "!=", ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}
OF_WHOLE = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul"}
OF_FLOAT = {ast.Add: "fadd", ast.Sub: "fsub", ast.Mult: "fmul", ast.Div: "fdiv"}
MOST_PRODUCTS = 8
"""Powers of a float up to this exponent are products; beyond it `pow` is nearer to the truth."""
MOST_WHOLE_PRODUCTS = 63


class LoweringError(TypeError):
    """Text that would not do in machine code what it does in Python; the message names file and line."""


@dataclass(frozen=True)
class Where:
    """The lines of a source: its file, and the number of its first line there."""

    file: str
    lines: list[str]
    first: int = 1

    def refuse(self, node: ast.AST, why: str) -> NoReturn:
        """Raise LoweringError at a node of the text."""
        line = getattr(node, "lineno", 1)
        raise LoweringError(f"{self.file}:{self.first + line - 1}: {self.lines[line - 1].strip()}: {why}")


def kind_name(kind: ir.Type) -> str:
    """What a type is in plain words."""
    names = {DOUBLE: "a float", INT: "a whole number", F8: "an array of floats", I8: "an array of whole numbers"}
    return next((name for each, name in names.items() if each == kind), "nothing")


class Values:
    """Emits expressions. `arguments` are values; `variables` are places, of which those in `given` are filled."""

    def __init__(self, module: ir.Module, builder: ir.IRBuilder, entry: ir.Block, where: Where) -> None:
        self.module, self.builder, self.entry, self.where = module, builder, entry, where
        self.returns = entry.function.function_type.return_type
        self.arguments: dict[str, Any] = {}
        self.variables: dict[str, Any] = {}
        self.given: set[str] = set()
        self.latest: dict[str, tuple[ir.Block, Any]] = {}
        """Of a variable the value that it was last seen with, and the block that saw it. In that block it has it still:
        only what stands there can give it another. So most reads need no instruction."""

    def branch_on(self, test: ast.expr, yes: ir.Block, no: ir.Block) -> None:
        """Go on in one of two blocks."""
        if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
            self.branch_on(test.operand, no, yes)
        elif isinstance(test, ast.BoolOp):
            for part in test.values[:-1]:
                further = self.builder.append_basic_block()
                self.branch_on(part, *((further, no) if isinstance(test.op, ast.And) else (yes, further)))
                self.builder.position_at_end(further)
            self.branch_on(test.values[-1], yes, no)
        elif isinstance(test, ast.Compare):
            self._compare(test, yes, no)
        else:
            value = self.number(test)
            zero = value.type(0)
            different = self.builder.icmp_signed if value.type == INT else self.builder.fcmp_unordered
            self.builder.cbranch(different("!=", value, zero), yes, no)

    def _compare(self, test: ast.Compare, yes: ir.Block, no: ir.Block) -> None:
        """Each value is worked out once, and not at all where an earlier comparison fails."""
        left = self.number(test.left)
        for k, (op, node) in enumerate(zip(test.ops, test.comparators, strict=True)):
            if type(op) not in COMPARISONS:
                self.where.refuse(test, "numbers are compared by == != < <= > >=")
            right = self.number(node)
            further = yes if k == len(test.ops) - 1 else self.builder.append_basic_block()
            self.builder.cbranch(self._holds(COMPARISONS[type(op)], left, right), further, no)
            self.builder.position_at_end(further)
            left = right

    def _holds(self, sign: str, left: Any, right: Any) -> Any:
        if left.type == INT and right.type == INT:
            return self.builder.icmp_signed(sign, left, right)
        compare = self.builder.fcmp_unordered if sign == "!=" else self.builder.fcmp_ordered  # nan != nan
        return compare(sign, self.double(left), self.double(right))

    def value(self, node: ast.expr) -> Any:
        """Emit an expression."""
        if isinstance(node, ast.Constant):
            return self._constant(node)
        if isinstance(node, ast.Name):
            return self.named(node)
        if isinstance(node, ast.Subscript):
            return self.builder.load(self.place(node))
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
            inner = self.number(node.operand)
            if isinstance(node.op, ast.UAdd):
                return inner
            return self.builder.neg(inner) if inner.type == INT else self.builder.fneg(inner)
        if isinstance(node, ast.BinOp):
            return self.operate(node.op, self.number(node.left), node.right, node)
        if isinstance(node, ast.Call):
            return self.call(node)
        if isinstance(node, ast.Compare | ast.BoolOp | ast.UnaryOp):
            self.where.refuse(node, "a condition stands in `if` and `while` only")
        self.where.refuse(node, f"no such expression here ({type(node).__name__})")

    def number(self, node: ast.expr) -> Any:
        """Emit an expression that is a number."""
        value = self.value(node)
        if value.type not in (INT, DOUBLE):
            self.where.refuse(node, f"{ast.unparse(node)} is {kind_name(value.type)} where a number is wanted")
        return value

    def whole(self, node: ast.expr, what: str) -> Any:
        """Emit an expression that is a whole number."""
        value = self.value(node)
        if value.type != INT:
            self.where.refuse(node, f"{ast.unparse(node)} is {kind_name(value.type)}; {what} is a whole number")
        return value

    def named(self, node: ast.Name) -> Any:
        """The value of a variable, an argument or a position of layout.py."""
        if node.id in self.given:
            block, value = self.latest.get(node.id, (None, None))
            if block is not self.builder.block:
                value = self.builder.load(self.variables[node.id])
                self.latest[node.id] = (self.builder.block, value)
            return value
        if node.id in self.variables:
            self.where.refuse(node, f"{node.id} has a value on some ways to this place only; give it one before")
        if node.id in self.arguments:
            return self.arguments[node.id]
        if node.id not in CONSTANTS:
            self.where.refuse(node, f"{node.id} has no value here")
        return INT(CONSTANTS[node.id])

    def place(self, node: ast.expr) -> Any:
        """Address of an element of an array."""
        if not isinstance(node, ast.Subscript):
            self.where.refuse(node, "a value is given to a name or to an element such as x[i]")
        array = self.value(node.value)
        if array.type not in (F8, I8):
            self.where.refuse(node, f"{ast.unparse(node.value)} is {kind_name(array.type)}, not an array")
        index = _whole(node.slice)
        if index is not None and index < 0:
            self.where.refuse(node, "an array does not know its length; count from its beginning")
        return self.builder.gep(array, [self.whole(node.slice, "an index")])

    def operate(self, op: ast.operator, left: Any, node: ast.expr, at: ast.AST) -> Any:
        """`left op node`: whole numbers stay whole where they do in Python."""
        if left.type not in (INT, DOUBLE):
            self.where.refuse(at, f"{kind_name(left.type)} where a number is wanted")
        if isinstance(op, ast.Pow):
            return self._power(left, node, at)
        if isinstance(op, ast.FloorDiv | ast.Mod):
            return self._floor(op, left, node, at)
        if type(op) not in OF_FLOAT:
            self.where.refuse(at, "there are + - * / ** // and %")
        right = self.number(node)
        if left.type == INT and right.type == INT and type(op) in OF_WHOLE:
            return getattr(self.builder, OF_WHOLE[type(op)])(left, right)
        return getattr(self.builder, OF_FLOAT[type(op)])(self.double(left), self.double(right))

    def _floor(self, op: ast.operator, left: Any, node: ast.expr, at: ast.AST) -> Any:
        """The machine rounds towards zero, Python downwards."""
        divisor = _whole(node)
        if left.type != INT or divisor is None or divisor <= 0:
            self.where.refuse(at, "// and % are for whole numbers by a whole constant above zero")
        by, builder = INT(divisor), self.builder
        rest = builder.srem(left, by)
        below = builder.icmp_signed("<", rest, INT(0))
        if isinstance(op, ast.Mod):
            return builder.select(below, builder.add(rest, by), rest)
        towards_zero = builder.sdiv(left, by)
        return builder.select(below, builder.sub(towards_zero, INT(1)), towards_zero)

    def _power(self, base: Any, node: ast.expr, at: ast.AST) -> Any:
        """Small whole powers by multiplication, others by pow."""
        exponent = _whole(node)
        if base.type == INT and exponent is not None and exponent >= 0:
            if exponent > MOST_WHOLE_PRODUCTS:
                self.where.refuse(at, f"a whole number to the power {exponent} has more than 64 bit")
            return self._product(base, exponent, "mul")
        if exponent is not None and abs(exponent) <= MOST_PRODUCTS:
            product = self._product(self.double(base), abs(exponent), "fmul")
            return product if exponent >= 0 else self.builder.fdiv(DOUBLE(1.0), product)
        other = self.number(node)
        if exponent is None and base.type == INT and other.type == INT:
            self.where.refuse(at, "a whole number to a whole power is whole or not by its sign; write 1.0*...")
        return self._intrinsic("llvm.pow", [self.double(base), self.double(other)])

    def _product(self, base: Any, count: int, multiply: str) -> Any:
        result = base.type(1)
        for _ in range(count):
            result = getattr(self.builder, multiply)(result, base)
        return result

    def call(self, node: ast.Call) -> Any:
        """A function of the text: pointers from the block, mathematics, the least of several."""
        if not isinstance(node.func, ast.Name) or node.keywords or any(isinstance(a, ast.Starred) for a in node.args):
            self.where.refuse(node, "a function is called by its name, with plain arguments")
        name, builder = node.func.id, self.builder
        if name == "call_kernel":
            address = self.whole(node.args[0], "the address of a kernel")
            kernel = builder.inttoptr(address, KERNEL_TYPE.as_pointer())
            return builder.call(kernel, self._arguments(node, node.args[1:], KERNEL_TYPE))
        if name in self.module.globals and name not in LIBRARY:
            function = self.module.globals[name]
            return builder.call(function, self._arguments(node, node.args, function.function_type))
        if name in ("f8", "i8"):
            self._count(node, len(node.args) == 1)
            return builder.inttoptr(self.whole(node.args[0], "an address"), F8 if name == "f8" else I8)
        return self._mathematics(node, name, [self.number(argument) for argument in node.args])

    def _mathematics(self, node: ast.Call, name: str, values: list[Any]) -> Any:
        builder = self.builder
        if name in ("min", "max"):
            self._count(node, len(values) > 1)
            return self._extreme("<" if name == "min" else ">", values)
        if name not in (*INTRINSIC, *LIBRARY, "sign"):
            self.where.refuse(node, f"{name} is no function here")
        self._count(node, len(values) == 1)
        if name == "abs" and values[0].type == INT:
            return self._extreme(">", [values[0], builder.neg(values[0])])
        value = self.double(values[0])
        if name == "sign":
            above, below = (builder.fcmp_ordered(s, value, DOUBLE(0.0)) for s in "><")
            return builder.fsub(*(builder.uitofp(holds, DOUBLE) for holds in (above, below)))
        if name in INTRINSIC:
            return self._intrinsic(INTRINSIC[name], [value])
        found = self.module.globals.get(name) or ir.Function(self.module, ir.FunctionType(DOUBLE, [DOUBLE]), name)
        return builder.call(found, [value])

    def _extreme(self, sign: str, values: list[Any]) -> Any:
        """As Python does it, so that a nan is passed over or kept as it is there: another counts if it is beyond."""
        if any(value.type == DOUBLE for value in values):
            values = [self.double(value) for value in values]
        best = values[0]
        for value in values[1:]:
            best = self.builder.select(self._holds(sign, value, best), value, best)
        return best

    def _arguments(self, node: ast.Call, given: list[ast.expr], kind: ir.FunctionType) -> list[Any]:
        self._count(node, len(given) == len(kind.args))
        pairs = zip(given, kind.args, strict=True)
        return [self.fitted(self.value(each), wanted, node, ast.unparse(each)) for each, wanted in pairs]

    def _count(self, node: ast.Call, right: bool) -> None:
        if not right:
            self.where.refuse(node, f"{ast.unparse(node.func)} does not take {len(node.args)} arguments")

    def _intrinsic(self, name: str, values: list[Any]) -> Any:
        """A mathematical function that LLVM knows."""
        return self.builder.call(self.module.declare_intrinsic(name, [DOUBLE]), values)

    def double(self, number: Any) -> Any:
        """A number as double."""
        return self.builder.sitofp(number, DOUBLE) if number.type == INT else number

    def fitted(self, value: Any, wanted: ir.Type, at: ast.AST, what: str) -> Any:
        """A value as the type that a place has; a whole number may become a float, nothing else changes."""
        if value.type == INT and wanted == DOUBLE:
            return self.double(value)
        if value.type != wanted:
            self.where.refuse(at, f"{what} is {kind_name(wanted)} and cannot take {kind_name(value.type)}")
        return value

    def _constant(self, node: ast.Constant) -> Any:
        if isinstance(node.value, float):
            return DOUBLE(node.value)
        if isinstance(node.value, int) and abs(node.value) < 2**63:
            return INT(int(node.value))
        self.where.refuse(node, f"{node.value!r} is neither a float nor a whole number of 64 bit")


def _whole(node: ast.expr) -> int | None:
    """The value of a whole constant, with its sign."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        inner = _whole(node.operand)
        return -inner if inner is not None else None
    return int(node.value) if isinstance(node, ast.Constant) and isinstance(node.value, int) else None
