"""Loops of signals without delay: one signal of each becomes an algebraic unknown.

An output that depends at once on itself, through others, has no order in which it could be computed. Such a loop is cut
behind one output: what the others read is an unknown u, and

    0 = output - u

is one equation more. All signals are computed in order then; the engine solves for u as for any algebraic unknown.
The derivative of that equation is the gain round the loop less 1: a loop of gain 1 determines nothing.

Source: tearing of algebraic loops, e.g. Cellier and Kofman 2006, Continuous System Simulation, section 7.4.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from fairlead.component.assembly import Instance, PortRef
from fairlead.component.base import Component
from fairlead.component.declare import Input, Law, Output, Unknown
from fairlead.component.parameters import make
from fairlead.component.values import variant_of
from fairlead.errors import Fault
from fairlead.flatten.flat_model import FlatModel, SignalLoop
from fairlead.flatten.graph import ranks
from fairlead.kernels.kernel import Kernel, kernel
from fairlead.system.numbering.ranks import Links, circle


class Torn(Component, abstract=True):
    """signal = found,  0 = told - found:  where a loop of signals is cut."""

    def law(p: Any, told: Any, found: Any) -> Law:  # noqa: N805
        """The unknown is what comes in."""
        return Law(found=told - found, signal=found)


@functools.cache
def torn(unit: str) -> type[Component]:
    """The class that cuts a signal of a unit."""
    body = {"told": Input(unit, "The output.", signed=True), "found": Unknown(unit, "The same, as an unknown."),
            "signal": Output(unit, "The unknown."), "__module__": __name__, "__doc__": Torn.__doc__}  # fmt: skip
    return type("SignalLoop", (Torn,), body)


def without_loops(
    flat: FlatModel, kernels: dict[str, Kernel], links: Links
) -> tuple[FlatModel, dict[str, Kernel]]:
    """The model with a cut in every loop of signals (`links`, see `followed`), and the kernels of all its instances.

    A loop that nothing but a given motion closes is left as it is.
    """
    made = cut(flat, list(_loops(flat, links)))
    return made, kernels | {one.path: kernel(one.variant) for one in made.instances if one.path not in kernels}


def cut(flat: FlatModel, loops: Sequence[SignalLoop]) -> FlatModel:
    """The model with these cuts; itself without any."""
    if not loops:
        return flat
    instances, sources = dict(flat.assembly.instances), dict(flat.sources)
    added: list[Instance] = []
    for loop in loops:
        output = loop.output
        values = make(torn(instances[output.instance].type.declaration.outputs[output.port].unit))
        one = Instance(f"{output}.loop", values, instances[output.instance].where, variant_of(values))
        instances[one.path] = one
        added.append(one)
        readers = [target for target, source in sources.items() if source == output]
        sources |= dict.fromkeys(readers, PortRef(one.path, "signal")) | {PortRef(one.path, "told"): output}
    assembly = replace(flat.assembly, instances=instances)
    return replace(flat, assembly=assembly, instances=(*flat.instances, *added), sources=sources, loops=tuple(loops))


def _loops(flat: FlatModel, links: Links) -> Iterator[SignalLoop]:
    """Every loop, with the output behind which it is cut, one after the other until none is left."""
    cuttable = set(flat.sources.values())
    while len(ranks(links)) < len(links):
        found = circle(links)
        ways = zip(found, [*found[1:], found[0]], strict=True)
        output = next((one for a, b in ways for one in links[a][b] if one in cuttable), None)
        if output is None:
            return
        at = found.index(output.instance)
        yield SignalLoop(output, (*found[at:], *found[:at]))
        left = {b: {one: None for one in outputs if one != output} for b, outputs in links[output.instance].items()}
        links[output.instance] = {b: outputs for b, outputs in left.items() if outputs}


def loop_remarks(flat: FlatModel) -> Iterator[Fault]:
    """What `check` says of every loop."""
    for loop in flat.loops:
        way = " -> ".join([*loop.through, loop.through[0]])
        solved = flat.assembly.named(loop.output)
        what = f"signals run in a loop without delay: {way}; {solved} is solved for as an unknown."
        where = flat.assembly.instances[loop.output.instance].where
        yield Fault(where, what, "A state or a sampled part in the loop gives an order, and a run that costs less.")
