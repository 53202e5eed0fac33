"""Names in a netlist that no signal has because the user switched an effect, or gave a value that leaves a part out.

A contact that rubs no more, a valve without dynamics: their signals go with the effect. What was written for the whole
scene, `record`, plots and `limits`, should not have to be rewritten for each switch, so a name that would be one with
all effects as their parts have them is left out with a remark. So is an output that the class of a part declares, and
that the part does not have with its values, as the friction of a slide that does not rub. Any other name is a mistake,
see names.py.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping

from fairlead.analysis.record.declared_signals import signals_of
from fairlead.component.assembly import Assembly
from fairlead.component.instantiate import instantiate
from fairlead.flatten.flatten import survey as flatten
from fairlead.netlist.netlist import Netlist, Value
from fairlead.patterns import picked

EFFECTS = "effects"


def gone(assembly: Assembly, patterns: Iterable[str]) -> list[str]:
    """Those of `patterns` that no signal has, and that one would have with other effects or values of its part."""
    unknown = _unfit(assembly, patterns)
    without = set(unvalued(assembly, unknown))
    if not switched(assembly.netlist) or len(without) == len(unknown):
        return [one for one in unknown if one in without]
    whole, _ = instantiate(as_declared(assembly.netlist), assembly.types)
    flatten(whole)  # lays lines on their routes, which makes the contacts with devices
    still = set(_unfit(whole, unknown))
    return [one for one in unknown if one not in still or one in without]


def unvalued(assembly: Assembly, patterns: Iterable[str]) -> list[str]:
    """Those that are outputs which the class of a part declares, and which the part does not have as it is."""
    names = {
        f"{path}.{name}": None
        for path, values in assembly.entries.items()
        if path in assembly.expansions
        for name in values.type.declaration.outputs
        if f"{path}.{name}" not in assembly.aliases
    }
    return [one for one in patterns if picked(names, one)]


def _unfit(assembly: Assembly, patterns: Iterable[str]) -> list[str]:
    """Those that no signal has."""
    names = {signal.name: None for signal in signals_of(assembly)}
    return [one for one in patterns if not picked(names, one)]


def without_gone(assembly: Assembly, given: Mapping[str, Value]) -> dict[str, Value]:
    """A map by pattern without those of `gone`."""
    left_out = set(gone(assembly, given))
    return {pattern: value for pattern, value in given.items() if pattern not in left_out}


def switched(netlist: Netlist) -> list[str]:
    """What the netlist switches, for messages: `effects.gravity: off`, `gear.effects.backlash: on`."""
    told = [f"{EFFECTS}.{name}: {value.content}" for name, value in netlist.effects.items()]
    for entry in netlist.components.values():
        own = entry.parameters[EFFECTS].entries if EFFECTS in entry.parameters else {}
        told += [f"{entry.name}.{EFFECTS}.{name}: {value.content}" for name, value in own.items()]
    return told


def as_declared(netlist: Netlist) -> Netlist:
    """The netlist with all effects as their parts have them."""
    plain = {
        name: dataclasses.replace(entry, parameters={k: v for k, v in entry.parameters.items() if k != EFFECTS})
        for name, entry in netlist.components.items()
    }
    return dataclasses.replace(netlist, effects={}, components=plain)
