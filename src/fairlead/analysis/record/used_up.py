"""Parts of which nothing is left during a run, such as a roll of web: the run ends at that row.

An output of role `used_up` is 1 from there on. Where another part listens to the output `of` that tells what is
left, it knows what follows, as a span of web whose end comes off: then the run goes on until the output is 2.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.treatments.stepping_table import few
from fairlead.component.assembly import PortRef
from fairlead.component.declare import USED_UP
from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.compiled.system import System

USED_UP_WORDS = "is used up", "Begin with more on it, or let the run stop before that."
"""What is so of a part, and a way out, where its output says nothing else."""
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class UsedUp:
    """Watches the parts `names`, in columns `columns` of the rows of a run."""

    names: Sequence[str]
    columns: NDArray[np.int64]
    most: Floats
    """How much each may say before the run ends."""
    words: Mapping[str, tuple[str, str]]
    """What is so of each then, and a way out."""

    @classmethod
    def of(cls, system: System, recorded: Sequence[OutputSignal]) -> UsedUp:
        """Those among the recorded signals, by the names that the netlist has for them."""
        found = {s.name.rpartition(".")[0]: k for k, s in enumerate(recorded) if s.role == USED_UP}
        outputs = {one.path: one.type.declaration.outputs for one in system.flat.instances} if found else {}
        roles = {path: next(one for one in outputs[path].values() if one.role == USED_UP) for path in found}
        told = {PortRef(path, one.of) for path, one in roles.items()}
        names = [_as_written(path, system.flat.assembly.entries) for path in found]
        words = {name: one.gone or USED_UP_WORDS for name, one in zip(names, roles.values(), strict=True)}
        heard = {source.instance for source in system.flat.sources.values() if source in told}
        most = np.array([1.0 if path in heard else 0.0 for path in found])
        return cls(names, np.array([*found.values()], dtype=np.int64), most, words)

    def end(self, t: Floats, rows: Floats) -> tuple[int, str, tuple[str, ...]] | None:
        """The first recorded row in which one is used up, with a sentence and who; None if in none."""
        empty = rows[:, self.columns] > self.most
        if not empty.any():
            return None
        row = int(empty.any(axis=1).argmax())
        names = tuple(dict.fromkeys(self.names[k] for k in np.flatnonzero(empty[row]).tolist()))
        return row, f"t = {t[row]:.6g} s: {self.sentence(names)}", names

    def sentence(self, names: Sequence[str]) -> str:
        """Why these end a run; those of which the same is so as of the first."""
        what, cure = self.words[names[0]]
        alike = [name for name in names if self.words[name] == (what, cure)]
        what = f"are {what.removeprefix('is ')}" if what.startswith("is ") and len(alike) > 1 else what
        return f"{few(alike)} {what}, and no law says what follows. {cure}"


def _as_written(path: str, entries: Iterable[str]) -> str:
    """The outermost part of a netlist that has this one inside it."""
    return min((name for name in entries if path == name or path.startswith(f"{name}.")), key=len, default=path)
