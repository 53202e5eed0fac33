"""All signals of a model, from what its components declare; nothing is compiled for it."""

from __future__ import annotations

from fairlead.component.assembly import Assembly
from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.numbering.unknowns import LEDGER


def signals_of(assembly: Assembly) -> list[OutputSignal]:
    """Of every instance, under the outer names of composites too, and the ledger; none knows its place yet."""
    found = [
        OutputSignal(f"{path}.{name}", output.unit, output.doc, 0)
        for path, instance in assembly.instances.items()
        for name, output in instance.type.declaration.outputs.items()
    ]
    by_name = {signal.name: signal for signal in found}
    outer = [(name, by_name[str(inner)]) for name, inner in assembly.aliases.items() if str(inner) in by_name]
    found += [OutputSignal(name, signal.unit, signal.doc, 0) for name, signal in outer]
    return found + [OutputSignal(f"energy.{line}", "J", "", 0) for line in LEDGER]
