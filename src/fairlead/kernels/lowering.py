"""The text of a kernel made into LLVM code, without numba. Imported on a cache miss only.

Kernels are straight-line arithmetic inside loops and zone branches; type inference on such text cost
numba 3 to 12 s a class, this takes about 0.1 s. `text.py` writes such text, and the callbacks of
`system/callbacks` are written in it. Understood are

    for i in range(a, b):     while condition:     if condition: ... elif condition: ... else: ...
    name = expression         x[i] = expression    a, b = b, a          each also with += -= *= /= **= //= %=
    call(x, y)                return expression    return

with the expressions and conditions of `lowered_values.py`. Every program of this subset does what Python
does with it, but for what is said there about numbers. Anything else is refused by file and line:

- A variable keeps the type that it is first given: a whole number, a float, or an array.
- A variable is read only where it is certain to have a value, whichever branches were taken.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import llvmlite.binding as llvm
from llvmlite import ir

from fairlead.kernels.lowered_values import DOUBLE, F8, INT, KERNEL, LoweringError, Values, Where, kind_name
from fairlead.native import target_machine

TYPES = {"int": INT, "float": DOUBLE, "F8": F8, "I8": INT.as_pointer(), "None": ir.VoidType()}
SHARED = {
    "ctx": "I8", "t": "float", "y": "F8", "mode": "int", "r": "F8", "g": "F8", "ledger": "int",
    "w": "F8", "values": "F8", "ft": "F8", "of_whole": "F8", "out": "F8", "first": "int",
    "end": "int", "table": "int", "part": "int", "fired": "I8", "n_fired": "int",
}  # fmt: skip
"""Arguments of shared functions."""

Source = str | Callable[..., Any]


@dataclass(frozen=True)
class Lowered:
    """One function in optimised LLVM text, in the shape `native.Build` wants."""

    native_name: str
    text: str

    def inspect_llvm(self) -> str:
        """The LLVM text."""
        return self.text


def lower(
    source: Source,
    name: str,
    kinds: Sequence[str] = KERNEL,
    returns: str = "None",
    shared: Sequence[Source] = (),
    file: str = "<text>",
) -> Lowered:
    """LLVM of the one function in `source`, under the symbol `name`, its arguments of the given kinds.

    A source is the text of a function, of which `file` is said to hold it, or the function itself. `shared`
    are the functions it may call, in the order of their use. Its loops are not unrolled: those of kernels go over
    long laws, and code of four times the length is no faster. Raises LoweringError, with file and line, for
    text that would not do what it does in Python.
    """
    return lower_together({name: (source, kinds, returns)}, shared, file, unrolled=False)[name]


def lower_together(
    functions: Mapping[str, tuple[Source, Sequence[str], str]],
    shared: Sequence[Source] = (),
    file: str = "<text>",
    *,
    unrolled: bool = True,
    cpu: str = "",
) -> dict[str, Lowered]:
    """LLVM of several functions in one module, by name: of each its source, arguments and result, as `lower` has them.

    What they share is compiled once, and short loops are written out several times if they may be `unrolled`. Vectors
    are those of the processor that is named, else of the chosen one. Raises LoweringError.
    """
    text = _optimised(llvm.parse_assembly(written(functions, shared, file)), unrolled, cpu)
    return {name: Lowered(name, text) for name in functions}


def optimised(name: str, bitcode: bytes) -> Lowered:
    """What `lower` gives for the function of this name, of which `written` gave the code before, now in bitcode."""
    return Lowered(name, _optimised(llvm.parse_bitcode(bitcode), unrolled=False))


def written(
    functions: Mapping[str, tuple[Source, Sequence[str], str]], shared: Sequence[Source] = (), file: str = "<text>"
) -> str:
    """LLVM text of a module with these functions, as `lower_together` takes them, before any pass of LLVM."""
    module = ir.Module("fairlead")
    for text in shared:
        tree, where = _parsed(text, file)
        names = [argument.arg for argument in tree.args.args]
        _define(module, tree, where, "", [SHARED[name] for name in names], "None").linkage = "internal"
    for name, (source, kinds, returns) in functions.items():
        tree, where = _parsed(source, file)
        _define(module, tree, where, name, kinds, returns)
    return str(module)


def _parsed(source: Source, file: str) -> tuple[ast.FunctionDef, Where]:
    """The one function of a source, and where its lines stand."""
    first = 1
    if not isinstance(source, str):
        file, first = source.__code__.co_filename, source.__code__.co_firstlineno
        source = textwrap.dedent(inspect.getsource(source))
    where = Where(file, source.splitlines(), first)
    tree, *beside = ast.parse(source).body
    if beside or not isinstance(tree, ast.FunctionDef):
        raise LoweringError(f"{file}:{first}: one function is wanted here, and nothing beside it")
    plain = ast.arguments([], tree.args.args, None, [], [], None, [])
    if tree.decorator_list or ast.dump(tree.args) != ast.dump(plain):
        where.refuse(tree, "a function has plain arguments, without defaults, and no decorators")
    return tree, where


def _define(
    module: ir.Module, tree: ast.FunctionDef, where: Where, name: str, kinds: Sequence[str], returns: str
) -> ir.Function:
    signature = ir.FunctionType(TYPES[returns], [TYPES[kind] for kind in kinds])
    function = ir.Function(module, signature, name or tree.name)
    entry = function.append_basic_block()
    start = function.append_basic_block()
    work = _Lowering(module, ir.IRBuilder(start), entry, where)
    work.take({a.arg: value for a, value in zip(tree.args.args, function.args, strict=True)}, _stored(tree))
    work.body(tree.body)
    work.end(tree)
    ir.IRBuilder(entry).branch(start)
    return function


def _stored(tree: ast.FunctionDef) -> set[str]:
    """Names that the text gives a value somewhere; only statements do, so expressions are not looked through."""
    found: set[str] = set()
    left: list[Any] = [tree]
    while left:
        statement = left.pop()
        left += [*getattr(statement, "body", ()), *getattr(statement, "orelse", ())]
        for target in getattr(statement, "targets", None) or [getattr(statement, "target", None)]:
            places = target.elts if isinstance(target, ast.Tuple) else [target]
            found |= {place.id for place in places if isinstance(place, ast.Name)}
    return found


def _optimised(module: llvm.ModuleRef, unrolled: bool, cpu: str = "") -> str:
    machine = target_machine(cpu)
    module.verify()
    options = llvm.create_pipeline_tuning_options(speed_level=2)
    options.loop_unrolling = unrolled
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    return str(module)


class _Lowering(Values):
    """Walks the statements and emits. Whatever is given a value lives on the stack until optimised."""

    @property
    def ended(self) -> bool:
        """True behind a return, where nothing is done any more."""
        return bool(self.builder.block.is_terminated)

    def take(self, arguments: dict[str, Any], stored: set[str]) -> None:
        """The arguments; those that the text gives another value are variables from the start."""
        for name, value in arguments.items():
            if name in stored:
                self.store(name, value, None)
            else:
                self.arguments[name] = value

    def end(self, tree: ast.FunctionDef) -> None:
        """What happens behind the last statement."""
        if not self.ended and not isinstance(self.returns, ir.VoidType):
            self.where.refuse(tree, f"{tree.name} may end without a value; let it return one in the end")
        if not self.ended:
            self.builder.ret_void()

    def body(self, statements: list[ast.stmt]) -> None:
        """Statements in order; what follows a return is not looked at."""
        for statement in statements:
            if self.ended:
                return
            emit = getattr(self, "_" + type(statement).__name__, None)
            if emit is None:
                self.where.refuse(statement, "no such statement here; there are for, while, if, = and return")
            emit(statement)

    def _Pass(self, statement: ast.Pass) -> None:
        pass

    def _For(self, loop: ast.For) -> None:
        """The variable of a loop is one like the others: it keeps its last value, or what it was without a turn."""
        builder = self.builder
        if not isinstance(loop.target, ast.Name) or loop.orelse:
            self.where.refuse(loop, "a loop is `for name in range(start, stop):`, without else")
        start, stop = self._range(loop)
        before = builder.block
        test, body, done = (builder.append_basic_block() for _ in range(3))
        builder.branch(test)
        builder.position_at_end(test)
        index = builder.phi(INT)
        index.add_incoming(start, before)
        builder.cbranch(builder.icmp_signed("<", index, stop), body, done)
        builder.position_at_end(body)
        given = set(self.given)
        self.store(loop.target.id, index, loop)
        self.body(loop.body)
        if not self.ended:
            index.add_incoming(builder.add(index, INT(1)), builder.block)
            builder.branch(test)
        self.given = given
        builder.position_at_end(done)

    def _range(self, loop: ast.For) -> tuple[Any, Any]:
        call = loop.iter
        if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Name) or call.func.id != "range":
            self.where.refuse(loop, "a loop runs over range(start, stop)")
        if call.keywords or len(call.args) not in (1, 2):
            self.where.refuse(loop, "range takes a start and a stop; a loop goes up by one")
        ends = [self.whole(argument, "an end of range") for argument in call.args]
        return (INT(0), ends[0]) if len(ends) == 1 else (ends[0], ends[1])

    def _While(self, loop: ast.While) -> None:
        builder = self.builder
        if loop.orelse:
            self.where.refuse(loop, "a loop has no else here")
        test, body, done = (builder.append_basic_block() for _ in range(3))
        builder.branch(test)
        builder.position_at_end(test)
        self.branch_on(loop.test, body, done)
        builder.position_at_end(body)
        given = set(self.given)
        self.body(loop.body)
        if not self.ended:
            builder.branch(test)
        self.given = given
        builder.position_at_end(done)

    def _If(self, branch: ast.If) -> None:
        builder = self.builder
        then, done = builder.append_basic_block(), builder.append_basic_block()
        otherwise = builder.append_basic_block() if branch.orelse else done
        self.branch_on(branch.test, then, otherwise)
        before = set(self.given)
        ways = [(then, branch.body)] + ([(otherwise, branch.orelse)] if branch.orelse else [])
        left: list[set[str]] = [] if branch.orelse else [before]  # what has a value where this way goes on
        for block, statements in ways:
            self.given = set(before)
            builder.position_at_end(block)
            self.body(statements)
            if not self.ended:
                left.append(self.given)
                builder.branch(done)
        self.given = set.intersection(*left) if left else before
        builder.position_at_end(done)
        if not left:
            builder.unreachable()

    def _Expr(self, statement: ast.Expr) -> None:
        if isinstance(statement.value, ast.Call):
            self.value(statement.value)
        elif not (isinstance(statement.value, ast.Constant) and isinstance(statement.value.value, str)):
            self.where.refuse(statement, "an expression alone does nothing")

    def _Return(self, statement: ast.Return) -> None:
        nothing = isinstance(self.returns, ir.VoidType)
        if nothing != (statement.value is None):
            self.where.refuse(statement, f"this function returns {'nothing' if nothing else 'a value'}")
        if statement.value is None:
            self.builder.ret_void()
        else:
            value = self.fitted(self.value(statement.value), self.returns, statement, "what is returned")
            self.builder.ret(value)

    def _Assign(self, assignment: ast.Assign) -> None:
        for target in assignment.targets:
            if isinstance(target, ast.Tuple) != isinstance(assignment.value, ast.Tuple):
                self.where.refuse(assignment, "several names on the left want as many values on the right")
        if isinstance(assignment.value, ast.Tuple):
            values = [self.value(each) for each in assignment.value.elts]
        else:
            values = [self.value(assignment.value)]
        for target in assignment.targets:
            places = target.elts if isinstance(target, ast.Tuple) else [target]
            if len(places) != len(values):
                self.where.refuse(assignment, f"{len(places)} names on the left, {len(values)} values on the right")
            for place, value in zip(places, values, strict=True):
                self._give(place, value, assignment)

    def _AugAssign(self, assignment: ast.AugAssign) -> None:
        target = assignment.target
        if isinstance(target, ast.Name):
            present = self.named(target)
            value = self.operate(assignment.op, present, assignment.value, assignment)
            self.store(target.id, value, assignment)
        else:
            place = self.place(target)
            value = self.operate(assignment.op, self.builder.load(place), assignment.value, assignment)
            self.builder.store(self.fitted(value, place.type.pointee, assignment, "the element"), place)

    def _give(self, target: ast.expr, value: Any, statement: ast.stmt) -> None:
        if isinstance(target, ast.Name):
            self.store(target.id, value, statement)
        else:
            place = self.place(target)
            self.builder.store(self.fitted(value, place.type.pointee, statement, "the element"), place)

    def store(self, name: str, value: Any, statement: ast.stmt | None) -> None:
        """Give a variable a value; it keeps the type that it is first given."""
        if statement is not None and isinstance(value.type, ir.VoidType):
            self.where.refuse(statement, f"{name} is given {kind_name(value.type)}")
        if name not in self.variables:
            self.variables[name] = ir.IRBuilder(self.entry).alloca(value.type)
        place = self.variables[name]
        if statement is not None:
            value = self.fitted(value, place.type.pointee, statement, name)
        self.builder.store(value, place)
        self.latest[name] = (self.builder.block, value)
        self.given.add(name)
