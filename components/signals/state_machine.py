"""A state machine: its states are zones, what leads from one to the other are guards."""

import functools

from fairlead.components.signals.function import Blocks

from fairlead.component import Component, Composite, Entries, Expansion, Input, Law, Output, Zones, guard, zone
from fairlead.component.conditions import alternatives
from fairlead.component.formula import FormulaError, formula

NUMBER = "state"  # the output that tells which state is in force
MOST = 4  # comparisons that `and` joins
READ = (lambda p, a: a, lambda p, a, b: (a, b), lambda p, a, b, c: (a, b, c), lambda p, a, b, c, d: (a, b, c, d))


class StateMachine(Composite):
    """States with outputs, and conditions over inputs that lead from one to the other; it begins in the first.

        states: {idle: {valve: 0}, filling: {valve: 1}}
        transitions: {idle: {filling: "level < 0.2"}, filling: {idle: "level > 0.8 or stop > 0.5"}}

    A state gives its outputs. An output that only other states name is 0. A condition compares expressions of inputs,
    as in `SignalFunction`, by < and >. `and` joins up to four comparisons, and `or` stands between such groups. Names
    are inputs. They are plain numbers unless `inputs: {level: m}` gives units. The output `state` is the number of the
    present state, from 0.

    Each state is a zone, so a run locates the instant at which a condition begins to hold. If a condition holds as its
    state is entered, the state is left at once.

    Limits: two states that lead to each other at one instant do not settle, so leave a gap between their conditions.
    Conditions take no time; a `SignalTimer` measures it.

    Source: sequential function charts, IEC 61131-3, with one state active.
    """

    asked_with = {"states": (("off", {"power": 0}), ("on", {"power": 1})),
                  "transitions": (("off", {"on": "a > 1"}), ("on", {"off": "a < 0"}))}  # fmt: skip
    states = Entries("States by name, each with its outputs: {idle: {valve: 0}, filling: {valve: 1}}.")
    transitions = Entries("For each state: the states that may follow it, each with its condition.")
    inputs = Entries("Units of the inputs by name; plain numbers when not given.", default=None)
    constants = Entries("Numbers by name, which may have units.", default=())
    state = Output("1", "Number of the state in force, from 0.")

    def check(p):
        """States and outputs are what they should be, and every condition can be read."""
        wrong = [*wrong_states(p.states), *wrong_transitions(p)]
        yield from wrong
        if not wrong:
            try:
                conditions(p)
            except FormulaError as error:
                yield "inputs" if error.of == "inputs" else "transitions", error.what, error.way_out

    def expand(p, scene):
        """Blocks for the expressions, and the automaton."""
        found = conditions(p)
        blocks = Blocks(scene, dict(p.inputs or ()))
        joins, ways, place = {}, [], 0
        for left, entered, parts in found:
            ends = [blocks.end(blocks.whole(step)) for step, _ in parts]
            if len(parts) > 1:  # none of them may come and go within a step
                ends = [blocks.mark(end) for end in ends]
            names = tuple(f"condition_{place + k}" for k in range(len(ends)))
            place += len(ends)
            units = {unit for _, unit in parts}
            ways.append((left, entered, names, units.pop() if len(units) == 1 else "1"))
            for end, name in zip(ends, names, strict=True):
                joins.setdefault(end, []).append(f"machine.{name}")
        outputs = list(dict.fromkeys(name for _, given in p.states for name in given))
        told = tuple((name, tuple(float(given.get(one, 0)) for one in outputs)) for name, given in p.states)
        blocks.children["machine"] = scene.make(automaton(tuple(outputs), told, tuple(ways)))
        for end, target in blocks.joins:
            joins.setdefault(end, []).append(target)
        handed = {name: f"in_{name}.value" for name in blocks.inputs}
        handed |= {name: f"machine.{name}" for name in (NUMBER, *outputs)}
        return Expansion(blocks.children, [(end, *targets) for end, targets in joins.items()], {}, handed)


def wrong_states(states):
    """(parameter, what is wrong, way out) of states and their outputs."""
    form = "Write {idle: {valve: 0}, filling: {valve: 1}}."
    if len(states) < 2:
        yield "states", f"there are {len(states)} states, and a machine has two at least", form
    for name, given in states:
        if not isinstance(given, dict):
            yield "states", f"{name} is no map of outputs", form
            continue
        for output, value in given.items():
            if isinstance(value, bool) or not isinstance(value, int | float):
                yield "states", f"{name}.{output} is {value!r}, and no number", form
            if output == NUMBER or not str(output).isidentifier():
                yield "states", f"{output!r} cannot be the name of an output", f"Take a word other than {NUMBER}."


def wrong_transitions(p):
    """(parameter, what is wrong, way out) of transitions: between states that there are, by a condition."""
    known = [name for name, _ in p.states]
    for left, entered in p.transitions:
        for name in (left, *(entered if isinstance(entered, dict) else ())):
            if name not in known:
                yield "transitions", f"there is no state {name}", f"There are {', '.join(map(str, known))}."
        if not isinstance(entered, dict):
            yield "transitions", f"{left} leads to no map of states", 'Write {idle: {filling: "level < 0.2"}}.'
        elif left in entered:
            yield "transitions", f"{left} leads to itself", "Leave it out."


def conditions(p):
    """(state left, state entered, [(step, unit) of what must rise above zero]). Raises FormulaError."""
    units = None if p.inputs is None else {name: str(unit) for name, unit in p.inputs}
    taken = {NUMBER, *(name for _, given in p.states for name in given)}
    found = []
    for left, entered in p.transitions:
        for to, condition in entered.items():
            for parts in alternatives(str(condition), MOST):
                steps = [formula(part, units, dict(p.constants), output=NUMBER) for part in parts]
                for clash in taken.intersection(*[[name for step, _ in steps for name in step.names()]]):
                    raise FormulaError("inputs", f"{clash} is an output and an input", "Rename one of them.")
                found.append((left, to, steps))
    return found


@functools.cache
def automaton(outputs, states, ways):
    """The class of a machine: a zone for each state, a guard for each way, an input for each comparison."""
    body = {"__module__": __name__, "__doc__": "The states of a StateMachine."}
    body["exempt"] = {"settles": "Its conditions are given from outside, and may contradict each other."}
    body["zones"] = Zones(*(name for name, _ in states))
    body["number"] = Output("1", "Number of the state in force.", name=NUMBER)
    body |= {f"told_{k}": Output("1", "As the state says.", name=name) for k, name in enumerate(outputs)}
    for k, (name, values) in enumerate(states):
        body[f"law_{k}"] = zone(name)(telling({NUMBER: k, **dict(zip(outputs, values, strict=True))}))
    for k, (left, entered, names, unit) in enumerate(ways):
        body |= {name: Input("1", "Above zero where it holds.", signed=True) for name in names}
        body[f"way_{k}"] = guard(left, to=entered, unit=unit)(reading(names))
    return type("States", (Component,), body)


def telling(values):
    """The law of a state."""

    def law(p):
        return Law(**values)

    return law


def reading(names):
    """A guard that is its inputs. A law is asked by the names of its arguments, so they get those of the inputs."""
    function = READ[len(names) - 1]
    made = type(function)(function.__code__.replace(co_varnames=("p", *names)), function.__globals__, "reading")
    made.__doc__ = "The condition holds."
    return made
