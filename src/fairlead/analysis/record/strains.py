"""Strains of elements during a run: compressed beyond what their part allows, or turned inside out.

An output of role `strain` is the stretch of an element over its length without load, and `compressible` is the share
of that length by which it may get shorter. At a strain of -1 its ends are at one place; below, it is inside out, and
no law of a line that bears pressure means that: the run ends at that row. What is loose at any length, a rope or a
core, goes on, with a remark. The end of every step is looked at, whatever is recorded.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.treatments.stepping_table import few
from fairlead.component.declare import STRAIN
from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.compiled.system import System

MOST_NAMED = 10
INSIDE_OUT = -1.0
PASSED = "inside out, the ends have passed each other"
CURE = "Give the line less friction or push, more stiffness, or a shorter run."
Floats = NDArray[np.float64]


@dataclass
class Strains:
    """Watches the strains of m elements, in columns `columns` of the rows of a run."""

    names: Sequence[str]
    columns: NDArray[np.int64]
    allowed: Floats
    """[m]: how far below zero is no remark."""
    least: Floats = field(init=False)
    at: Floats = field(init=False)
    """[m]: when it was least, s."""
    too_short_from: Floats = field(init=False)
    """[m]: when it was first beyond what is allowed, s; infinite if never."""
    inside_out_from: Floats = field(init=False)
    """[m]: likewise first at -1 or below."""

    def __post_init__(self) -> None:
        """Nothing seen yet."""
        m = len(self.names)
        self.least, self.at = np.full(m, np.inf), np.zeros(m)
        self.too_short_from, self.inside_out_from = np.full(m, np.inf), np.full(m, np.inf)

    @classmethod
    def of(cls, system: System, recorded: Sequence[OutputSignal]) -> Strains:
        """Those among the recorded signals; an element that has two names counts once."""
        allowed = {one.path: one.type.answers.compressible for one in system.flat.instances}
        found: dict[str, int] = {}
        for column, signal in enumerate(recorded):
            path = signal.name.rpartition(".")[0]
            if signal.role == STRAIN and path in allowed:
                found[path] = column
        return cls(list(found), np.array([*found.values()], dtype=np.int64), np.array([allowed[p] for p in found]))

    def end(self, t: Floats, rows: Floats) -> tuple[int, str, tuple[str, ...]] | None:
        """The first recorded row in which an element is inside out, with a sentence and who; None if in none."""
        inside_out = (rows[:, self.columns] <= INSIDE_OUT) & (self.allowed < 1.0)
        if not inside_out.any():
            return None
        row = int(inside_out.any(axis=1).argmax())
        names = tuple(self.names[k] for k in np.flatnonzero(inside_out[row]).tolist())
        return row, f"t = {t[row]:.6g} s: {self.sentence(names)}", names

    def sentence(self, names: Sequence[str]) -> str:
        """Why these end a run."""
        return f"{few(names)}: {PASSED}, and no law of a line means that. {CURE}"

    def watch(self, t: Floats, rows: Floats) -> None:
        """Take recorded rows, shape (k, recorded)."""
        if not len(t) or not len(self.names):
            return
        strain = rows[:, self.columns]
        strain = np.where(np.isnan(strain), np.inf, strain)  # says nothing, and must not hide the others
        k = strain.argmin(axis=0)
        now = strain[k, np.arange(len(k))]
        lower = now < self.least
        self.least[lower], self.at[lower] = now[lower], t[k[lower]]
        for since, beyond in (
            (self.too_short_from, strain < -self.allowed),
            (self.inside_out_from, strain <= INSIDE_OUT),
        ):
            first = beyond.any(axis=0) & np.isinf(since)
            since[first] = t[beyond.argmax(axis=0)[first]]

    def summary(self) -> dict[str, Any] | None:
        """For run.json: `least` strain, its component and time; `too_short`, `inside_out`: names in order of time."""
        if not len(self.names) or not np.isfinite(self.least).any():
            return None
        k = int(self.least.argmin())
        return {
            "least": float(self.least[k]), "component": self.names[k], "t": float(self.at[k]),
            **self._those("too_short", self.too_short_from), **self._those("inside_out", self.inside_out_from),
        }  # fmt: skip

    def _those(self, word: str, since: Floats) -> dict[str, Any]:
        """Names in the order in which it came to it, how many, and when the first did."""
        which = [k for k in np.argsort(since, kind="stable").tolist() if np.isfinite(since[k])]
        named = [self.names[k] for k in which[:MOST_NAMED]]
        return {word: named, f"n_{word}": len(which), f"{word}_from": float(since[which[0]]) if which else None}


def remark(found: Mapping[str, Any] | None) -> str:
    """A sentence on them, and what to do; nothing where all is as it should be."""
    if not found or not (found["n_inside_out"] or found["n_too_short"]):
        return ""
    word = "inside_out" if found["n_inside_out"] else "too_short"
    what = PASSED if found["n_inside_out"] else "pressed together"
    names, count = found[word], found[f"n_{word}"]
    named = ", ".join(names[:3]) + (f" and {count - 3} more" if count > 3 else "")
    worst = f"the least strain is {100 * found['least']:.3g} % in {found['component']} at t = {found['t']:.6g} s"
    since = f"from t = {found[f'{word}_from']:.6g} s"
    return f"{since}: {named}: {what}; {worst}. Do not use what follows from them. {CURE}"
