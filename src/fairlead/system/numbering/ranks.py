"""In which order signals are computed: an output after the outputs its value depends on."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from fairlead.component.assembly import PortRef
from fairlead.component.keys import INPUT, PORT, key
from fairlead.errors import Fault, ModelError
from fairlead.flatten.flat_model import FlatModel
from fairlead.flatten.graph import ranks
from fairlead.kernels.kernel import Kernel
from fairlead.kernels.structure import Structure


def signal_ranks(flat: FlatModel, kernels: dict[str, Kernel]) -> dict[str, int]:
    """Rank of every instance that gives a signal. Raises ModelError for a loop that `loops.py` does not cut."""
    followers = followed(flat, kernels)
    _refuse_unfit(flat, kernels, _needed(flat))
    known = ranks(followers)
    if len(known) == len(followers):
        return known
    loop = circle(followers)
    where = flat.assembly.instances[loop[0]].where
    what = f"signals run in a loop without delay: {' -> '.join([*loop, loop[0]])}."
    raise ModelError([Fault(where, what, "Break it with a State or a sampled component.")])


def followed(flat: FlatModel, kernels: dict[str, Kernel]) -> dict[str, dict[str, dict[PortRef, None]]]:
    """For every instance that gives a signal those whose signals its own decide at once, and by which outputs."""
    followers: dict[str, dict[str, dict[PortRef, None]]] = {}
    deciding: dict[tuple[int, str], list[tuple[str, str]]] = {}
    given = _prescribing(flat)
    for output in _needed(flat):
        followers.setdefault(output.instance, {})
        s = kernels[output.instance].structure
        if (id(s), output.port) not in deciding:  # once a class: a long line has thousands of instances
            deciding[id(s), output.port] = _deciding(s, output.port)
        for source in _read_by(flat, given, output, deciding[id(s), output.port]):
            followers.setdefault(source.instance, {}).setdefault(output.instance, {})[source] = None
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


def _read_by(
    flat: FlatModel, given: Mapping[PortRef, list[PortRef]], output: PortRef, deciding: list[tuple[str, str]]
) -> list[PortRef]:
    """Outputs whose values decide this one, through the signal inputs and prescribed motions that do."""
    found = []
    for kind, name in deciding:
        ref = PortRef(output.instance, name)
        if kind == INPUT:
            source = flat.sources.get(ref)
            found += [source] if source else []
        else:  # a motion that an instance gives itself is no loop
            found += [source for source in given.get(ref, ()) if source.instance != output.instance]
    return found


def _prescribing(flat: FlatModel) -> dict[PortRef, list[PortRef]]:
    """By port whose motion is prescribed, the outputs that say how it moves."""
    found: dict[PortRef, list[PortRef]] = {}
    for group in flat.groups:
        if group.prescribed is not None and group.prescribed.outputs is not None:
            given = [PortRef(group.prescribed.by.instance, name) for name in group.prescribed.outputs]
            found |= {port: given for node in group.nodes for port in flat.nodes[node].ports}
    return found
