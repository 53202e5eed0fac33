"""A function of signals, written as an expression."""

import functools

from fairlead.components.control.signal_gain import SignalGain
from fairlead.components.control.sum import Sum
from fairlead.components.signals.arithmetic import SignalProduct, SignalSelect, SignalSize
from fairlead.components.signals.elementary import CURVES, ElementaryFunction, SignalMark, SignalQuotient
from fairlead.components.sources.signal_source import SignalSource

from fairlead.component import Component, Composite, Entries, Expansion, Input, Law, Output, Text
from fairlead.component.formula import FormulaError, formula


class Passing(Component, abstract=True):
    """signal = value, of signals with a unit; `passing` makes the class for one."""

    def law(p, value):
        """At once."""
        return Law(signal=value)


@functools.cache
def passing(taken, told):
    """The class that takes a signal in one unit and tells it in another, both in SI."""
    body = {"value": Input(taken, "What comes in.", signed=True), "signal": Output(told, "The same.")}
    return type("SignalPass", (Passing,), {"__module__": __name__, "__doc__": Passing.__doc__, **body})


class SignalFunction(Composite):
    """signal = an expression of its inputs, such as `expression: "a*sin(b) + 2"`; each name in it is an input.

    The operations are + - * / ** ( ), the functions sqrt, sin, cos, exp, log, abs, min, max, and the constants pi,
    rad, deg. This is the language of expressions in braces (docs/netlist.md), not Python. An exponent is a number.

    Without `inputs` everything is plain numbers in SI. With `inputs: {a: N, b: rad}` units must fit, and the signal
    has the unit that follows. Quantities are written in parentheses, `(2 N)`. `constants: {k: 3 N/m}` gives numbers by
    name.

    It is made of one block for each operation. abs, min and max have zones, so a run locates their corners. A step
    also ends where the base of a power inside an exponential or a divisor is zero. So a peak like
    `exp(-((x - 5)/0.01)**2)` or `1/(1 + x**4)` is not missed, however narrow (docs/integrator.md).

    Limits: a divisor must not come to zero. The arguments of roots and logarithms must stay above zero.

    Source: docs/netlist.md, Expressions.
    """

    asked_with = {"expression": "a*sin(b) + 2"}
    expression = Text("The expression; names in it are inputs.")
    inputs = Entries("Units of the inputs by name: {a: N, b: rad, c: 1}; plain numbers when not given.", default=None)
    constants = Entries("Numbers by name, which may have units.", default=())
    signal = Output("1", "The value.")

    def check(p):
        """It is arithmetic, its names are told, and its units go together."""
        try:
            step, _ = read(p)
        except FormulaError as error:
            yield error.of, error.what, error.way_out
            return
        unused = [name for name, _ in p.inputs or () if name not in step.names()]
        if unused:
            yield "inputs", f"{unused[0]} does not occur in the expression", "Leave it out."

    def expand(p, scene):
        """A block for every operation; what occurs twice is made once."""
        step, unit = read(p)
        blocks = Blocks(scene, dict(p.inputs or ()))
        end = blocks.end(blocks.whole(step))
        if unit != "1":
            blocks.children["out"] = scene.make(passing("1", unit))
            blocks.joins.append((end, "out.value"))
            end = "out.signal"
        joins = {}
        for one, other in blocks.joins:  # one connection for all that a block feeds
            joins.setdefault(one, []).append(other)
        handed = {name: f"in_{name}.value" for name in blocks.inputs}
        connections = [(one, *others) for one, others in joins.items()]
        return Expansion(blocks.children, connections, {}, {"signal": end, **handed})


def read(p):
    """The tree of the expression and the unit of its value. Raises FormulaError."""
    units = None if p.inputs is None else {name: str(unit) for name, unit in p.inputs}
    return formula(p.expression, units, dict(p.constants), output="signal")


def unsigned(step):
    """The same without the signs before it."""
    return unsigned(step.inner[0]) if step.operation in ("neg", "pos") else step


class Blocks:
    """The blocks of an expression, step by step."""

    def __init__(self, scene, units):
        """Nothing is made yet."""
        self.scene, self.units = scene, units
        self.children, self.joins, self.inputs, self.known = {}, [], [], {}
        self.marks, self.narrowed = {}, set()

    def whole(self, step):
        """What an expression gives."""
        self.narrowed.update(step.narrowed())
        return self.made(step)

    def made(self, step):
        """What a step of it gives: a number, or the end that tells it."""
        if step.number is not None:
            return step.number
        if step not in self.known:
            self.known[step] = self.read(step.name) if step.operation == "input" else self.operation(step)
        return self.known[step]

    def read(self, name):
        """A signal that comes in."""
        unit = str(self.units.get(name, "1"))
        self.inputs.append(name)
        self.children[f"in_{name}"] = self.scene.make(passing(unit, "1"))
        return f"in_{name}.signal"

    def block(self, kind, joined, **given):
        """One more block, with what is joined to its inputs."""
        name = f"step{len(self.children) - len(self.inputs) + 1}"
        self.children[name] = self.scene.make(kind, **given)
        self.joins += [(end, f"{name}.{port}") for port, end in joined.items()]
        return f"{name}.signal"

    def end(self, value):
        """A number as a signal."""
        return self.block(SignalSource, {}, value=value) if isinstance(value, float) else value

    def operation(self, step):
        """The block of an operation or of a function."""
        values = [self.made(one) for one in step.inner]
        self.mark_extreme(step, values)
        if step.operation in CURVES:
            return self.block(ElementaryFunction, {"value": values[0]}, curve=step.operation)
        if step.operation in ("min", "max"):
            pick = "least" if step.operation == "min" else "greatest"
            ends = map(self.end, values)
            return functools.reduce(lambda a, b: self.block(SignalSelect, {"a": a, "b": b}, pick=pick), ends)
        return getattr(self, NAMES[step.operation])(*values)

    def mark_extreme(self, step, values):
        """Mark where an even power, a sine, or an exponential beside a 1 may make something narrow of its value.

        That is in what is exponentiated or divided by; a power above the square is flat so near its zero that nothing
        else tells of it.
        """
        of, value, narrow = step.operation, values[0], step in self.narrowed
        if isinstance(value, float):
            return
        square = of == "*" and unsigned(step.inner[0]) == unsigned(step.inner[1])
        even = square or (of == "**" and values[1] % 2 == 0)
        flat = even and not square and values[1] > 2
        swings = any(one.operation in EXTREME for one in step.parts())  # so that all steps are short against it
        if narrow and of in EXTREME:
            self.mark(self.block(ElementaryFunction, {"value": value}, curve=EXTREME[of]))
        elif (narrow and (even or of == "exp")) or (flat and not swings):
            self.mark(value)

    def mark(self, end):
        """What an end tells, with a mark where it goes through zero; one for all."""
        if end not in self.marks:
            self.marks[end] = self.block(SignalMark, {"value": end})
        return self.marks[end]

    def size(self, a):
        """|a|."""
        return self.block(SignalSize, {"value": a})

    def same(self, a):
        """+a."""
        return a

    def opposite(self, a):
        """-a."""
        return self.scaled(a, -1.0)

    def scaled(self, a, gain=1.0, offset=0.0):
        """A times a gain, plus an offset."""
        if isinstance(a, float):
            return gain * a + offset
        return self.block(SignalGain, {"value": a}, gain=gain, offset=offset)

    def sum(self, a, b, sign=1.0):
        """A + sign B."""
        if isinstance(b, float):
            return self.scaled(a, 1.0, sign * b)
        return self.scaled(b, sign, a) if isinstance(a, float) else self.block(Sum, {"a": a, "b": b}, gain_b=sign)

    def difference(self, a, b):
        """A - B."""
        return self.sum(a, b, -1.0)

    def product(self, a, b):
        """A times B."""
        if isinstance(a, float) or isinstance(b, float):
            return self.scaled(b, a) if isinstance(a, float) else self.scaled(a, b)
        return self.block(SignalProduct, {"a": a, "b": b})

    def quotient(self, a, b):
        """A by B."""
        if isinstance(b, float):
            return self.scaled(a, 1 / b)
        return (self.block(SignalQuotient, {"b": b}, gain=a) if isinstance(a, float)
                else self.block(SignalQuotient, {"a": a, "b": b}))  # fmt: skip

    def power(self, a, exponent):
        """To a power: products for a whole one, with a root for a half, else exp(exponent log(a))."""
        if exponent < 0:
            return self.quotient(1.0, self.power(a, -exponent))
        if not (2 * exponent).is_integer():
            logarithm = self.block(ElementaryFunction, {"value": a}, curve="log")
            return self.block(ElementaryFunction, {"value": self.scaled(logarithm, exponent)}, curve="exp")
        whole = int(exponent)
        result = 1.0 if whole == exponent else self.block(ElementaryFunction, {"value": a}, curve="sqrt")
        while whole:
            if whole % 2:
                result = a if result == 1.0 else self.product(result, a)
            whole //= 2
            a = self.product(a, a) if whole else a
        return result


EXTREME = {"sin": "cos", "cos": "sin"}
"""By function: what is zero where it has an extreme."""
NAMES = {"+": "sum", "-": "difference", "*": "product", "/": "quotient", "**": "power", "abs": "size",
         "neg": "opposite", "pos": "same"}  # fmt: skip
