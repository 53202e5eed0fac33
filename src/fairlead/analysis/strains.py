"""Strains of the elements of lines where a run ended: compressed beyond what their part allows, or turned inside out.

A class that says `spans = "length"` is an element between its ports a and b of that length without load, and
`compressible` is the share of it by which it may get shorter. At a strain of -1 its ends are at one place; below, it
is inside out, and no law of a line means that.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from fairlead.system.asking import guards_at
from fairlead.system.system import Instance
from fairlead.system.tolerances import Floats

MOST_NAMED = 10


def strains(problem: Instance, t: float, y: Floats) -> dict[str, Any] | None:
    """For run.json, at (t, y): `least` strain and its component, `too_short` and `inside_out` by name; None without.

    `y` are all unknowns, shape (n,).
    """
    found = _strains(problem, t, y)
    if not found:
        return None
    worst = min(found, key=lambda one: one[1])
    too_short = [path for path, strain, allowed in found if strain < -allowed]
    inside_out = [path for path, strain, _ in found if strain <= -1.0]
    return {
        "least": worst[1], "component": worst[0], "t": t,
        "too_short": too_short[:MOST_NAMED], "n_too_short": len(too_short),
        "inside_out": inside_out[:MOST_NAMED], "n_inside_out": len(inside_out),
    }  # fmt: skip


def remark(found: dict[str, Any] | None) -> str:
    """A sentence on them, and what to do; nothing where all is as it should be."""
    if not found or not (found["n_inside_out"] or found["n_too_short"]):
        return ""
    names, count = (found["inside_out"], found["n_inside_out"]) if found["n_inside_out"] else (
        found["too_short"], found["n_too_short"])  # fmt: skip
    what = "inside out, the ends have passed each other" if found["n_inside_out"] else "pressed together"
    named = ", ".join(names[:3]) + (f" and {count - 3} more" if count > 3 else "")
    worst = f"the least strain is {100 * found['least']:.3g} % in {found['component']}"
    cure = "Do not use what follows from them; give the line less friction or push, more stiffness, or a shorter run."
    return f"t = {found['t']:.6g} s: {named}: {what}; {worst}. {cure}"


def _strains(problem: Instance, t: float, y: Floats) -> list[tuple[str, float, float]]:
    """Path, strain and compression allowed of every element that says what it spans."""
    spanning = [block for block in problem.blocks if block.kernel.variant.type.answers.spans]
    if not spanning or not np.isfinite(y).all():
        return []
    guards_at(problem, t, y)  # puts y, and what is given in time, in z
    z, found = problem.memory["z"], list[tuple[str, float, float]]()
    for block in spanning:
        s, answers = block.kernel.structure, block.kernel.variant.type.answers
        a, b = (s.inputs.index(f"port:{port}:x") for port in ("a", "b"))
        x = block.in_coef * z[block.in_index] + block.in_offset
        strain = (x[:, b] - x[:, a]) / block.parameters[:, s.parameters.index(answers.spans)] - 1.0
        paths = [instance.path for instance in block.instances]
        found += zip(paths, strain.tolist(), [answers.compressible] * len(paths), strict=True)
    return found
