"""Linear dynamics of any order and any number of inputs, by four matrices."""

from fairlead.components.control.signal_gain import SignalGain
from fairlead.components.signals.combined import combined

from fairlead.component import Component, Composite, Expansion, Input, Law, Matrix, Output, Parameter, State


class SpaceState(Component):
    """One state:  d(signal)/dt = rate."""

    rate = Input("1/s", "What it gathers.", 0.0, signed=True)
    initial = Parameter("1", "State at the start.", default=0.0, physics=False)
    gathered = State("1", "The state.", start="initial", nominal=0.1)
    signal = Output("1", "The state.")

    def law(p, rate, gathered):
        """One integral."""
        return Law(gathered=rate, signal=gathered)


class StateSpace(Composite):
    """dx/dt = A x + B u,  y = C x + D u:  linear dynamics by their matrices, from `initial` on.

    A is n by n, B n by m, C q by n, D q by m, each a list of rows in SI. A list of numbers is one row. It is a column
    if the matrix must be a column, such as B of one input. With one input and one output the signals are `value` and
    `signal`. With several they are `value1`, `value2` and so on, and `signal1`, `signal2`. A factor of zero adds no
    term. With D an output follows its inputs at once.

    Source: e.g. Kailath 1980, Linear Systems, section 2.2.

    Limits: the dynamics are linear, and the same at all times; n, m and q are at most 50. If the operating point is
    not zero, add it before and behind the block.
    """

    asked_with = {"a": ((0.0, 1.0), (-4.0, -0.5)), "b": ((0.0, 1.0),), "c": ((1.0, 0.0),)}
    a = Matrix("A, rates of the states per state [1/s].")
    b = Matrix("B, rates of the states per input.")
    c = Matrix("C, outputs per state.")
    d = Matrix("D, outputs per input, at once; zero when not given.", default=None)
    initial = Matrix("The states at the start, a list; zero when not given.", default=None)
    value = Input("1", "What comes in.", signed=True)
    signal = Output("1", "Output signal.")

    def check(p):
        """The matrices fit together."""
        n = len(p.a)
        if len(p.a[0]) != n:
            yield "a", f"a has {n} rows and {len(p.a[0])} columns", "A is square: a row and a column for each state."
            return
        if len(column(p.b, n)) != n:
            yield "b", f"b has {len(p.b)} rows, and a {n}", "Give b a row for each state, of a number for each input."
        if len(p.c[0]) != n:
            yield "c", f"c has {len(p.c[0])} columns, and a {n}", "Give c a row for each output, as long as a."
        m, q = len(column(p.b, n)[0]), len(p.c)
        if p.d is not None and shape(column(p.d, q)) != (q, m):
            rows, columns = shape(p.d)
            yield "d", f"d has {rows} rows and {columns} columns", f"Give it {q} by {m}: a row for each output."
        if p.initial is not None and len(column(p.initial, n)) != n:
            yield "initial", f"initial has {len(p.initial[0])} numbers, and a {n} rows", "Give a number for each state."

    def expand(p, scene):
        """A sum before each state, and one for each output."""
        n, q = len(p.a), len(p.c)
        b = column(p.b, n)
        m = len(b[0])
        d = column(p.d, q) if p.d is not None else ((0.0,) * m,) * q
        first = column(p.initial, n) if p.initial is not None else ((0.0,),) * n
        states, inputs = [f"x{i + 1}" for i in range(n)], numbered("value", m)
        children = {f"in_{name}": scene.make(SignalGain, gain=1.0) for name in inputs}
        joins, outputs = [], {name: f"in_{name}.value" for name in inputs}
        ends = [*(f"{name}.signal" for name in states), *(f"in_{name}.signal" for name in inputs)]
        for i, name in enumerate(states):
            children[name] = scene.make(SpaceState, initial=first[i][0])
            if any((*p.a[i], *b[i])):
                made, found, total = combined(scene, f"{name}_rate", zip(ends, (*p.a[i], *b[i]), strict=True))
                children |= made
                joins += [*found, (total, f"{name}.rate")]
        for k, name in enumerate(numbered("signal", q)):
            made, found, total = combined(scene, name, zip(ends, (*p.c[k], *d[k]), strict=True))
            children |= made
            joins += found
            outputs[name] = total
        return Expansion(children, joins, {}, outputs)


def shape(matrix):
    """Rows and columns."""
    return len(matrix), len(matrix[0])


def column(matrix, rows):
    """A single row turned into a column, where there are to be as many rows as it has numbers."""
    turned = len(matrix) == 1 and rows > 1 and len(matrix[0]) == rows
    return tuple((one,) for one in matrix[0]) if turned else matrix


def numbered(name, count):
    """The names of several signals; one alone has no number."""
    return [name] if count == 1 else [f"{name}{k + 1}" for k in range(count)]
