"""Parts of which nothing is left during a run, such as a roll of web: the run ends at that row.

An output of role `used_up` is 1 from there on. Where another part listens to the output `of` that tells what is
left, it knows what follows, as a span of web whose end comes off: then the run goes on until the output is 2.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.treatments.stepping_table import few
from fairlead.component.assembly import PortRef
from fairlead.component.declare import USED_UP
from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.compiled.system import System

CURE = "Begin with more on it, or let the run stop before that."
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class UsedUp:
    """Watches the parts `names`, in columns `columns` of the rows of a run."""

    names: Sequence[str]
    columns: NDArray[np.int64]
    most: Floats
    """How much each may say before the run ends."""

    @classmethod
    def of(cls, system: System, recorded: Sequence[OutputSignal]) -> UsedUp:
        """Those among the recorded signals, by the names that the netlist has for them."""
        found = {s.name.rpartition(".")[0]: k for k, s in enumerate(recorded) if s.role == USED_UP}
        outputs = {one.path: one.type.declaration.outputs for one in system.flat.instances} if found else {}
        told = {PortRef(path, one.of) for path in found for one in outputs[path].values() if one.role == USED_UP}
        names = [_as_written(path, system.flat.assembly.entries) for path in found]
        heard = {source.instance for source in system.flat.sources.values() if source in told}
        most = np.array([1.0 if path in heard else 0.0 for path in found])
        return cls(names, np.array([*found.values()], dtype=np.int64), most)

    def end(self, t: Floats, rows: Floats) -> tuple[int, str, tuple[str, ...]] | None:
        """The first recorded row in which one is used up, with a sentence and who; None if in none."""
        empty = rows[:, self.columns] > self.most
        if not empty.any():
            return None
        row = int(empty.any(axis=1).argmax())
        names = tuple(dict.fromkeys(self.names[k] for k in np.flatnonzero(empty[row]).tolist()))
        return row, f"t = {t[row]:.6g} s: {self.sentence(names)}", names

    def sentence(self, names: Sequence[str]) -> str:
        """Why these end a run."""
        return f"{few(names)} {'is' if len(names) == 1 else 'are'} used up, and no law says what follows. {CURE}"


def _as_written(path: str, entries: Iterable[str]) -> str:
    """The outermost part of a netlist that has this one inside it."""
    return min((name for name in entries if path == name or path.startswith(f"{name}.")), key=len, default=path)
