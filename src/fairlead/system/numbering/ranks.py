"""In which order signals are computed: an output after the outputs its value depends on."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from fairlead.component.assembly import PortRef, asked_by_two
from fairlead.component.keys import INPUT, PORT, key
from fairlead.errors import Fault, ModelError
from fairlead.flatten.flat_model import FlatModel
from fairlead.flatten.graph import ranks
from fairlead.kernels.kernel import Kernel
from fairlead.kernels.structure import Structure

Links = dict[str, dict[str, dict[PortRef, None]]]
"""For every instance that gives a signal those whose signals its own decide at once, and by which outputs."""


def signal_ranks(flat: FlatModel, kernels: dict[str, Kernel], followers: Links) -> dict[str, int]:
    """Rank of every instance that gives a signal. Raises ModelError for a loop that `loops.py` does not cut."""
    _refuse_unfit(flat, kernels, _needed(flat))
    known = ranks(followers)
    if len(known) == len(followers):
        return known
    loop = circle(followers)
    where = flat.assembly.instances[loop[0]].where
    what = f"signals run in a loop without delay: {' -> '.join([*loop, loop[0]])}."
    raise ModelError([Fault(where, what, "Break it with a State or a sampled component.")])


def followed(flat: FlatModel, kernels: dict[str, Kernel]) -> Links:
    """Who follows whom in a model."""
    followers: Links = {}
    deciding: dict[tuple[int, str], list[tuple[str, str]]] = {}
    given = _prescribing(flat)
    sources = asked_by_two(flat.sources)
    for output in _needed(flat):
        path, port = output
        followers.setdefault(path, {})
        s = kernels[path].structure
        if (id(s), port) not in deciding:  # once a class: a long line has thousands of instances
            deciding[id(s), port] = _deciding(s, port)
        for kind, name in deciding[id(s), port]:
            if kind == INPUT:
                source = sources.get((path, name))
                read = [] if source is None else [source]
            else:  # a motion that an instance gives itself is no loop
                read = [one for one in given.get((path, name), ()) if one.instance != path]
            for one in read:
                followers.setdefault(one.instance, {}).setdefault(path, {})[one] = None
    return followers


def circle(followers: Mapping[str, Iterable[str]]) -> list[str]:
    """A loop among instances that follow one another."""
    import networkx as nx

    return [a for a, *_ in nx.find_cycle(nx.DiGraph((a, b) for a, found in followers.items() for b in found))]


def _needed(flat: FlatModel) -> dict[PortRef, None]:
    """Outputs that feed an input or prescribe a motion."""
    needed = dict.fromkeys(flat.sources.values())
    for group in flat.groups:
        if group.prescribed is not None and group.prescribed.outputs is not None:
            needed |= dict.fromkeys(PortRef(group.prescribed.by.instance, name) for name in group.prescribed.outputs)
    return needed


def _refuse_unfit(flat: FlatModel, kernels: dict[str, Kernel], needed: Iterable[PortRef]) -> None:
    """Some outputs can be recorded but not fed to a law: they come too late, or their derivative jumps."""
    faults = []
    if not any({id(one): one.structure.unfit for one in kernels.values()}.values()):
        return
    unfit = {one: why for one in needed if (why := kernels[one.instance].structure.unfit.get(one.port))}
    for output, why in sorted(unfit.items(), key=lambda item: str(item[0])):
        readers = [str(target) for target, source in flat.sources.items() if source == output]
        way_out = "Record it, or feed a component whose own state follows what you want to know."
        what = f"{output} cannot feed {', '.join(readers) or 'a prescribed motion'}: {why}."
        faults.append(Fault(flat.assembly.instances[output.instance].where, what, way_out))
    if faults:
        raise ModelError(faults)


def _deciding(structure: Structure, output: str) -> list[tuple[str, str]]:
    """Kind and name of the inputs and ports whose values decide an output; a port once, whatever is read there."""
    wanted = structure.outputs.index(output)
    keys = [key(structure.inputs[j]) for k, j in structure.d_signals if k == wanted]
    return list(dict.fromkeys((one.kind, one.name) for one in keys if one.kind in (INPUT, PORT)))


def _prescribing(flat: FlatModel) -> dict[tuple[str, str], list[PortRef]]:
    """By port whose motion is prescribed, the outputs that say how it moves."""
    found: dict[tuple[str, str], list[PortRef]] = {}
    for group in flat.groups:
        if group.prescribed is not None and group.prescribed.outputs is not None:
            given = [PortRef(group.prescribed.by.instance, name) for name in group.prescribed.outputs]
            found |= {port: given for node in group.nodes for port in flat.nodes[node].ports}
    return found
