"""In which order signals are computed: an output after the outputs its value depends on."""

from __future__ import annotations

from fairlead.component.instantiate import PortRef
from fairlead.component.keys import INPUT, PORT, key
from fairlead.errors import Fault, ModelError
from fairlead.flatten.flat_model import FlatModel
from fairlead.flatten.graph import ranks
from fairlead.kernels.kernel import Kernel
from fairlead.kernels.structure import Structure


def signal_ranks(flat: FlatModel, kernels: dict[str, Kernel]) -> dict[str, int]:
    """Rank of every instance that gives a signal. Raises ModelError for a loop of signals without delay."""
    followers: dict[str, dict[str, None]] = {}
    needed = set(flat.sources.values())
    for group in flat.groups:
        if group.prescribed is not None and group.prescribed.outputs is not None:
            needed |= {PortRef(group.prescribed.by.instance, name) for name in group.prescribed.outputs}
    _refuse_unfit(flat, kernels, needed)
    deciding: dict[tuple[int, str], list[str]] = {}
    for output in needed:
        followers.setdefault(output.instance, {})
        s = kernels[output.instance].structure
        if (id(s), output.port) not in deciding:  # once a class: a long line has thousands of instances
            deciding[id(s), output.port] = _deciding(s, output.port)
        for source in _read_by(flat, output, deciding[id(s), output.port]):
            followers.setdefault(source.instance, {})[output.instance] = None
    known = ranks(followers)
    if len(known) == len(followers):
        return known
    import networkx as nx

    loop = [a for a, _ in nx.find_cycle(nx.DiGraph((a, b) for a, found in followers.items() for b in found))]
    where = flat.assembly.instances[loop[0]].where
    what = f"signals run in a loop without delay: {' -> '.join([*loop, loop[0]])}."
    raise ModelError([Fault(where, what, "Break it with a State or a sampled component.")])


def _refuse_unfit(flat: FlatModel, kernels: dict[str, Kernel], needed: set[PortRef]) -> None:
    """Some outputs can be recorded but not fed to a law: they come too late, or their derivative jumps."""
    faults = []
    for output in sorted(needed, key=str):
        why = kernels[output.instance].structure.unfit.get(output.port)
        if why:
            readers = [str(target) for target, source in flat.sources.items() if source == output]
            way_out = "Record it, or feed a component whose own state follows what you want to know."
            what = f"{output} cannot feed {', '.join(readers) or 'a prescribed motion'}: {why}."
            faults.append(Fault(flat.assembly.instances[output.instance].where, what, way_out))
    if faults:
        raise ModelError(faults)


def _deciding(structure: Structure, output: str) -> list[str]:
    """Keys of the inputs whose values decide an output."""
    wanted = structure.outputs.index(output)
    return [structure.inputs[j] for k, j in structure.d_signals if k == wanted]


def _read_by(flat: FlatModel, output: PortRef, keys: list[str]) -> list[PortRef]:
    """Outputs whose values decide this one, through the signal inputs and prescribed motions among `keys`."""
    found = []
    for one in map(key, keys):
        if one.kind == INPUT:
            source = flat.sources.get(PortRef(output.instance, one.name))
            found += [source] if source else []
        elif one.kind == PORT:
            found += _prescribing(flat, PortRef(output.instance, one.name))
    return [source for source in found if source.instance != output.instance]


def _prescribing(flat: FlatModel, port: PortRef) -> list[PortRef]:
    group = flat.groups[flat.place(port)[0]]
    if group.prescribed is None or group.prescribed.outputs is None:
        return []
    return [PortRef(group.prescribed.by.instance, name) for name in group.prescribed.outputs]
