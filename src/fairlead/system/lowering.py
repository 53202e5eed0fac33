"""The text of a kernel made into LLVM code, without numba. Imported on a cache miss only.

Kernels are straight-line arithmetic inside loops and zone branches; type inference on such text cost
numba 3 to 12 s a class, this takes about 0.1 s. Understood is just what `kernel_text.py` writes:

    for i in range(a, b):      if a == b:  (or !=, <, <=, >, >=)      name = expression, name += expression
    while a == b:  (likewise)  if a == b and c == d:  (both sides are always looked at)
    out[index] = expression, out[index] += expression             return expression

with + - * / **, the functions below, and indexing of arrays. Floats are double, integers 64 bit; a
variable keeps the type it is first given. The driver of `driver.py` is written in the same subset.
"""

from __future__ import annotations

import ast
import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import llvmlite.binding as llvm
from llvmlite import ir

from fairlead.native import target_machine
from fairlead.system import layout

DOUBLE, INT = ir.DoubleType(), ir.IntType(64)
F8, I8 = DOUBLE.as_pointer(), INT.as_pointer()
TYPES = {"int": INT, "float": DOUBLE, "F8": F8, "I8": I8, "None": ir.VoidType()}
SHARED = {
    "ctx": "I8", "t": "float", "y": "F8", "mode": "int", "r": "F8", "g": "F8", "ledger": "int",
    "values": "F8", "ft": "F8", "of_whole": "F8", "out": "F8",
}  # fmt: skip
"""Arguments of shared functions."""
KERNEL = ("int", "I8", "int", "int", "F8", "I8", "F8", "F8")
INTRINSIC = {
    "exp": "llvm.exp",
    "log": "llvm.log",
    "sqrt": "llvm.sqrt",
    "sin": "llvm.sin",
    "cos": "llvm.cos",
    "abs": "llvm.fabs",
}
CONSTANTS = {name: value for name, value in vars(layout).items() if name.isupper() and isinstance(value, int)}
LIBRARY = ("tan", "tanh", "atan")  # from the C library of the process


@dataclass(frozen=True)
class Lowered:
    """Optimised LLVM text of one function, in the shape `native.Build` wants."""

    native_name: str
    text: str

    def inspect_llvm(self) -> str:
        """The LLVM text."""
        return self.text


def lower(
    source: str, name: str, kinds: Sequence[str] = KERNEL, returns: str = "None", shared: Sequence[str] = ()
) -> Lowered:
    """LLVM of the one function in `source`, under the symbol `name`, its arguments of the given kinds.

    `shared` holds the sources of functions it may call, in the order of their use.
    """
    module = ir.Module(name)
    for text in shared:
        names = [argument.arg for argument in ast.parse(text).body[0].args.args]  # type: ignore[attr-defined]
        _define(module, text, "", [SHARED[name] for name in names], "None").linkage = "internal"
    _define(module, source, name, kinds, returns)
    return Lowered(name, _optimised(str(module)))


def _define(module: ir.Module, source: str, name: str, kinds: Sequence[str], returns: str) -> ir.Function:
    tree = ast.parse(source).body[0]
    assert isinstance(tree, ast.FunctionDef)
    signature = ir.FunctionType(TYPES[returns], [TYPES[kind] for kind in kinds])
    function = ir.Function(module, signature, name or tree.name)
    entry = function.append_basic_block()
    arguments = {a.arg: value for a, value in zip(tree.args.args, function.args, strict=True)}
    start = function.append_basic_block()
    work = _Lowering(module, ir.IRBuilder(start), entry, arguments)
    work.body([s for s in tree.body if not isinstance(s, ast.Expr) or isinstance(s.value, ast.Call)])
    if not work.builder.block.is_terminated:
        work.builder.ret_void()
    ir.IRBuilder(entry).branch(start)
    return function


def _optimised(text: str) -> str:
    machine = target_machine()
    module = llvm.parse_assembly(text)
    module.verify()
    options = llvm.create_pipeline_tuning_options(speed_level=2)
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    return str(module)


class _Lowering:
    """Walks the text and emits. Arguments are values; other variables live on the stack until optimised."""

    def __init__(self, module: ir.Module, builder: ir.IRBuilder, entry: ir.Block, names: dict[str, Any]) -> None:
        self.module, self.builder, self.entry, self.names = module, builder, entry, names
        self.variables: dict[str, Any] = {}

    def body(self, statements: list[ast.stmt]) -> None:
        """Statements in order."""
        for statement in statements:
            getattr(self, "_" + type(statement).__name__)(statement)

    def _For(self, loop: Any) -> None:
        builder = self.builder
        start, stop = (self.value(argument) for argument in loop.iter.args)
        before = builder.block
        test, body, done = (builder.append_basic_block() for _ in range(3))
        builder.branch(test)
        builder.position_at_end(test)
        index = builder.phi(INT)
        index.add_incoming(start, before)
        builder.cbranch(builder.icmp_signed("<", index, stop), body, done)
        builder.position_at_end(body)
        self.variables.pop(loop.target.id, None)
        self.names[loop.target.id] = index
        self.body(loop.body)
        index.add_incoming(builder.add(index, INT(1)), builder.block)
        builder.branch(test)
        builder.position_at_end(done)

    def _While(self, loop: Any) -> None:
        builder = self.builder
        test, body, done = (builder.append_basic_block() for _ in range(3))
        builder.branch(test)
        builder.position_at_end(test)
        builder.cbranch(self.holds(loop.test), body, done)
        builder.position_at_end(body)
        self.body(loop.body)
        builder.branch(test)
        builder.position_at_end(done)

    def _If(self, branch: Any) -> None:
        with self.builder.if_then(self.holds(branch.test)):
            self.body(branch.body)

    def holds(self, test: Any) -> Any:
        """A comparison of two whole numbers or two others, or several that must all hold."""
        if isinstance(test, ast.BoolOp):
            assert isinstance(test.op, ast.And), ast.dump(test)
            return functools.reduce(self.builder.and_, map(self.holds, test.values))
        left, right = self.value(test.left), self.value(test.comparators[0])
        signs = {ast.Eq: "==", ast.NotEq: "!=", ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}
        sign = signs[type(test.ops[0])]
        if left.type == INT and right.type == INT:
            return self.builder.icmp_signed(sign, left, right)
        return self.builder.fcmp_ordered(sign, self.double(left), self.double(right))

    def _Expr(self, statement: Any) -> None:
        self.value(statement.value)

    def _Return(self, statement: Any) -> None:
        self.builder.ret(self.value(statement.value))

    def _Assign(self, assignment: Any) -> None:
        target = assignment.targets[0]
        if isinstance(target, ast.Tuple):
            names = [name.id for name in target.elts if isinstance(name, ast.Name)]
            for name, value in zip(names, [self.value(each) for each in assignment.value.elts], strict=True):
                self._store(name, value)
            return
        value = self.value(assignment.value)
        if isinstance(target, ast.Name):
            self._store(target.id, value)
        else:
            place = self.place(target)
            self.builder.store(value if place.type.pointee == value.type else self.double(value), place)

    def _AugAssign(self, assignment: Any) -> None:
        added = self.value(assignment.value)
        place = (
            self.variables[assignment.target.id]
            if isinstance(assignment.target, ast.Name)
            else self.place(assignment.target)
        )
        if place.type.pointee == INT:
            self.builder.store(self.builder.add(self.builder.load(place), added), place)
        else:
            self.builder.store(self.builder.fadd(self.builder.load(place), self.double(added)), place)

    def _store(self, name: str, value: Any) -> None:
        if name not in self.variables:
            self.variables[name] = ir.IRBuilder(self.entry).alloca(value.type)
        place = self.variables[name]
        self.builder.store(self.double(value) if place.type.pointee == DOUBLE else value, place)

    def place(self, subscript: Any) -> Any:
        """Address of an element of an array."""
        return self.builder.gep(self.value(subscript.value), [self.value(subscript.slice)])

    def value(self, node: ast.expr) -> Any:
        """Emit an expression."""
        if isinstance(node, ast.Constant):
            return INT(node.value) if isinstance(node.value, int) else DOUBLE(node.value)
        if isinstance(node, ast.Name):
            if node.id in self.variables:
                return self.builder.load(self.variables[node.id])
            return self.names[node.id] if node.id in self.names else INT(CONSTANTS[node.id])
        if isinstance(node, ast.Subscript):
            return self.builder.load(self.place(node))
        if isinstance(node, ast.UnaryOp):
            inner = self.value(node.operand)
            return self.builder.neg(inner) if inner.type == INT else self.builder.fneg(inner)
        if isinstance(node, ast.BinOp):
            return self.operation(node)
        assert isinstance(node, ast.Call), ast.dump(node)
        assert isinstance(node.func, ast.Name), ast.dump(node)
        return self.call(node.func.id, [self.value(argument) for argument in node.args])

    def operation(self, node: ast.BinOp) -> Any:
        """Integers stay integers under + and *; everything else is double."""
        left = self.value(node.left)
        if isinstance(node.op, ast.Pow):
            return self.power(self.double(left), node.right)
        right = self.value(node.right)
        whole = {ast.Add: "add", ast.Mult: "mul", ast.Sub: "sub"}
        if left.type == INT and right.type == INT and type(node.op) in whole:
            return getattr(self.builder, whole[type(node.op)])(left, right)
        emit = {ast.Add: "fadd", ast.Sub: "fsub", ast.Mult: "fmul", ast.Div: "fdiv"}[type(node.op)]
        return getattr(self.builder, emit)(self.double(left), self.double(right))

    def power(self, base: Any, exponent: ast.expr) -> Any:
        """Small whole powers by multiplication, others by pow."""
        whole = _whole(exponent)
        if whole is None or abs(whole) > 8:
            return self.intrinsic("llvm.pow", [base, self.double(self.value(exponent))])
        result = DOUBLE(1.0)
        for _ in range(abs(whole)):
            result = self.builder.fmul(result, base)
        return result if whole >= 0 else self.builder.fdiv(DOUBLE(1.0), result)

    def call(self, name: str, arguments: list[Any]) -> Any:
        """A function of the text: pointers from the block, mathematics, the least of several."""
        if name == "call_kernel":
            kernel = ir.FunctionType(ir.VoidType(), [TYPES[kind] for kind in KERNEL])
            return self.builder.call(self.builder.inttoptr(arguments[0], kernel.as_pointer()), arguments[1:])
        if name in self.module.globals and name not in LIBRARY:
            return self.builder.call(self.module.globals[name], arguments)
        if name in ("f8", "i8"):
            return self.builder.inttoptr(arguments[0], F8 if name == "f8" else I8)
        values = [self.double(argument) for argument in arguments]
        if name in ("min", "max"):
            best = values[0]
            for value in values[1:]:
                best = self.builder.select(
                    self.builder.fcmp_ordered("<" if name == "min" else ">", value, best), value, best
                )
            return best
        if name == "sign":
            above, below = (self.builder.fcmp_ordered(s, values[0], DOUBLE(0.0)) for s in "><")
            return self.builder.fsub(*(self.builder.uitofp(holds, DOUBLE) for holds in (above, below)))
        if name in INTRINSIC:
            return self.intrinsic(INTRINSIC[name], values)
        assert name in LIBRARY, name
        found = self.module.globals.get(name) or ir.Function(self.module, ir.FunctionType(DOUBLE, [DOUBLE]), name)
        return self.builder.call(found, values)

    def intrinsic(self, name: str, values: list[Any]) -> Any:
        """A mathematical function that LLVM knows."""
        return self.builder.call(self.module.declare_intrinsic(name, [DOUBLE]), values)

    def double(self, value: Any) -> Any:
        """An integer as double."""
        return self.builder.sitofp(value, DOUBLE) if value.type == INT else value


def _whole(node: ast.expr) -> int | None:
    """The value of a whole constant exponent, with its sign."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        inner = _whole(node.operand)
        return -inner if inner is not None else None
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, int) else None
