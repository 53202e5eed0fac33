"""Names in a netlist that no signal has because the user switched an effect off.

A contact that rubs no more, a valve without dynamics: their signals go with the effect. What was written for the whole
scene, `record`, plots and `limits`, should not have to be rewritten for each switch, so a name that would be one with
all effects as their parts have them is left out with a remark. Any other name is a mistake, see names.py.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping

from fairlead.component.instantiate import Assembly, survey
from fairlead.flatten.flatten import survey as flatten
from fairlead.netlist.netlist import Netlist, Value
from fairlead.patterns import picked
from fairlead.system.numbering.unknowns import LEDGER

EFFECTS = "effects"


def gone(assembly: Assembly, patterns: Iterable[str]) -> list[str]:
    """Those of `patterns` that no signal has, and that one would have if no effect were switched."""
    if not switched_off(assembly.netlist):
        return []
    names = _names(assembly)
    unknown = [one for one in patterns if not picked(names, one)]
    if not unknown:
        return []
    if assembly.before_effects is None:  # laid on its route as well, for contacts with its devices
        whole, _ = survey(as_declared(assembly.netlist), assembly.types)
        flatten(whole)
        assembly.before_effects = _names(whole)
    return [one for one in unknown if picked(assembly.before_effects, one)]


def without_gone(assembly: Assembly, given: Mapping[str, Value]) -> dict[str, Value]:
    """A map by pattern without those of `gone`."""
    left_out = set(gone(assembly, given))
    return {pattern: value for pattern, value in given.items() if pattern not in left_out}


def switched_off(netlist: Netlist) -> str:
    """What the netlist switches, for messages; nothing where it switches nothing."""
    found = [f"{EFFECTS}.{name}: {value.content}" for name, value in netlist.effects.items()]
    found += [
        f"{entry.name}.{EFFECTS}.{name}: {value.content}"
        for entry in netlist.components.values() if EFFECTS in entry.parameters
        for name, value in entry.parameters[EFFECTS].entries.items()
    ]  # fmt: skip
    return ", ".join(found)


def _names(assembly: Assembly) -> dict[str, None]:
    """Of all signals, from what the components declare."""
    found = {
        f"{path}.{name}": None
        for path, instance in assembly.instances.items() for name in instance.type.declaration.outputs
    }  # fmt: skip
    outer = [name for name, inner in assembly.aliases.items() if str(inner) in found]
    return found | dict.fromkeys([*outer, *(f"energy.{line}" for line in LEDGER)])


def as_declared(netlist: Netlist) -> Netlist:
    """The netlist with all effects as their parts have them."""
    plain = {
        name: dataclasses.replace(entry, parameters={k: v for k, v in entry.parameters.items() if k != EFFECTS})
        for name, entry in netlist.components.items()
    }
    return dataclasses.replace(netlist, effects={}, components=plain)
