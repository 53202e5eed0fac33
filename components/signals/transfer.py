"""Linear dynamics of any order up to four, by the coefficients of a transfer function."""

import itertools

from fairlead.component import Component, Composite, Expansion, Input, Law, Output, Parameter, State

MOST = 4  # order


class TransferStage(Component):
    """One state of a transfer function in observer form:  dz/dt = before + forward value - back told.

    The last one has a way past all of them: signal = z + through value.
    """

    value = Input("1", "What comes in.", signed=True)
    told = Input("1", "What goes out of the whole.", signed=True)
    before = Input("1/s", "The state before this one.", 0.0, signed=True)
    forward = Parameter("1/s", "Factor of what comes in.")
    back = Parameter("1/s", "Factor of what goes out.")
    gathered = State("1", "The state.", nominal=0.1)
    signal = Output("1", "The state.")
    rate = Output("1/s", "The same, as what the next one gathers.")

    exempt = {"units": "States of a chain differ by a second each; as numbers in SI they are passed on."}

    def law(p, value, told, before, gathered):
        """One integral."""
        return Law(gathered=before + p.forward * value - p.back * told, signal=gathered, rate=gathered)


class TransferThrough(Component):
    """signal = state + through value:  what goes out of a transfer function."""

    value = Input("1", "What comes in.", signed=True)
    state = Input("1", "The last state.", 0.0, signed=True)
    through = Parameter("1", "Factor of what goes through at once.")
    signal = Output("1", "Output signal.")
    heard = Output("1", "What comes in.")

    def law(p, value, state):
        """At once."""
        return Law(signal=state + p.through * value, heard=value)


def power(letter, k, default):
    """The coefficient of s^k."""
    unit = {0: "1", 1: "s"}.get(k, f"s^{k}")
    where = "numerator" if letter == "b" else "denominator"
    return Parameter(unit, f"Coefficient of s^{k} in the {where}.", default=default)


class TransferFunction(Composite):
    """signal/value = (b0 + b1 s + b2 s^2 + b3 s^3 + b4 s^4)/(a0 + a1 s + a2 s^2 + a3 s^3 + a4 s^4), from rest.

    A coefficient of s^k has the unit s^k:  `a1: 20 ms`. The numerator is of no higher order than the denominator; it
    has as many states as the denominator has order. The states begin at zero.

    Source: observer form, e.g. Kailath 1980, Linear Systems, section 2.1. Limits: for an order above four, or for poles
    that are close together, put several in a row.
    """

    value = Input("1", "What comes in.", signed=True)
    b0, b1, b2, b3, b4 = (power("b", k, 1.0 if k == 0 else 0.0) for k in range(MOST + 1))
    a0, a1, a2, a3, a4 = (power("a", k, 1.0 if k == 0 else 0.0) for k in range(MOST + 1))
    signal = Output("1", "Output signal.")

    def check(p):
        """A denominator, of at least the order of the numerator."""
        order, above = order_of(p, "a"), order_of(p, "b")
        if order < 0:
            yield "a0", "the denominator is zero", "Give a0."
        elif above > order:
            yield f"b{above}", f"the numerator has order {above}, the denominator {order}", f"Give a{above}."

    def expand(p, scene):
        """A chain of integrals, each fed by both ends."""
        order = order_of(p, "a")
        a, b = ([getattr(p, f"{letter}{k}") / getattr(p, f"a{order}") for k in range(order + 1)] for letter in "ab")
        through = b[order]
        children = {"out": scene.make(TransferThrough, through=through)}
        joins, names = [], [f"stage{k}" for k in range(order)]
        for k, name in enumerate(names):
            children[name] = scene.make(TransferStage, forward=b[k], back=a[k])
        if names:
            joins += [("out.signal", *(f"{name}.told" for name in names)), (f"{names[-1]}.signal", "out.state"),
                      ("out.heard", *(f"{name}.value" for name in names))]  # fmt: skip
        joins += [(f"{one}.rate", f"{other}.before") for one, other in itertools.pairwise(names)]
        return Expansion(children, joins, {}, {"signal": "out.signal", "value": "out.value"})


def order_of(p, letter):
    """The highest power whose coefficient is not zero; -1 if there is none."""
    return max((k for k in range(MOST + 1) if getattr(p, f"{letter}{k}") != 0), default=-1)
