"""The callbacks by name, and their machine code: compiled once, not once per model."""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from fairlead.kernels.lowered_ahead import Given, find_module
from fairlead.native import Build, Native, Optimised, digest, load_or_compile
from fairlead.system.callbacks.algebraic_rates import add_rates, find_known, find_roots, off_balance, share_rates
from fairlead.system.callbacks.derivatives import assemble, fix, jacobian, mass, slopes
from fairlead.system.callbacks.evaluation import (
    accelerate,
    accelerate_shown,
    ahead,
    ask,
    average,
    divide,
    evaluate,
    follow,
    forces,
    gather,
    give_motions,
    look,
    make_calls,
    of_accelerations,
    put_average,
    react,
    rhs,
    take_samples,
)
from fairlead.system.callbacks.light_rows import eliminate_light, hold_light, support_light, weigh_supports
from fairlead.system.callbacks.recorded import expand, let_slip, outputs, show, spread
from fairlead.system.callbacks.rigid_clusters import add_shares, guard_shares, look_around, regroup, unite
from fairlead.system.callbacks.switching import (
    at_time,
    drift,
    follow_guards,
    gap,
    guards,
    next_time,
    sample_as_given,
    settle_told,
    slip,
    slips,
    swings,
    switch,
)

SPREAD = "spread"
"""The one that no engine calls."""
CALLBACKS: dict[str, tuple[Callable[..., Any], Sequence[str], str]] = {
    "rhs": (rhs, ("I8", "float", "F8", "F8"), "None"),
    "forces": (forces, ("I8", "float", "F8", "F8"), "None"),
    "jacobian": (jacobian, ("I8", "float", "F8", "F8", "F8"), "None"),
    "slopes": (slopes, ("I8", "float", "F8", "F8", "F8"), "None"),
    "mass": (mass, ("I8", "F8"), "None"),
    "guards": (guards, ("I8", "float", "F8", "F8"), "None"),
    "swings": (swings, ("I8", "float", "F8", "F8"), "None"),
    "switch": (switch, ("I8", "float", "F8", "I8", "int"), "int"),
    "slip": (slip, ("I8", "float", "F8", "F8"), "int"),
    "drift": (drift, ("I8", "float", "F8", "F8"), "None"),
    "gap": (gap, ("I8", "float", "F8", "F8"), "None"),
    "ahead": (ahead, ("I8", "float", "F8", "F8"), "None"),
    "next_time": (next_time, ("I8", "float"), "float"),
    "at_time": (at_time, ("I8", "float", "F8"), "int"),
    "outputs": (outputs, ("I8", "float", "F8", "F8"), "None"),
    SPREAD: (spread, ("I8", "float", "F8", "F8"), "None"),
}
"""Each with the types of its arguments and of what it returns."""
SHARED = (
    unite, look_around, regroup, add_shares, guard_shares, find_known, find_roots, share_rates, add_rates, off_balance,
    make_calls, give_motions, average, put_average, look, ask, gather, react, follow, of_accelerations,
    eliminate_light, weigh_supports, support_light, evaluate,
    divide, accelerate, accelerate_shown, slips, take_samples, follow_guards, settle_told, sample_as_given,
    fix, assemble, hold_light, expand, let_slip, show,
)  # fmt: skip
"""What callbacks call."""


@functools.cache
def callbacks() -> Native:
    """The compiled callbacks; `address` holds the C address of each."""
    return load_or_compile(digest(*_sources()), _build)


def _sources() -> list[str]:
    here, kernels = Path(__file__).parent, Path(__file__).parents[2] / "kernels"
    files = sorted(here.glob("*.py")) + [kernels / f"{name}.py" for name in ("lowering", "lowered_values", "layout")]
    return [file.read_text(encoding="utf-8") for file in files]


def name_ahead() -> str:
    """Under which a wheel holds the callbacks, optimised: a text that tells what they were made of."""
    return f"callbacks {hashlib.sha256(chr(0).join(_sources()).encode()).hexdigest()}"


def compiled_ahead(cpu: str) -> Given:
    """The callbacks for a wheel, in the vectors of the processor of that name."""
    import llvmlite.binding as llvm

    from fairlead.kernels.lowering import lower_together

    one, *_ = lower_together(CALLBACKS, SHARED, cpu=cpu).values()  # each tells the module of all
    return Given({}, llvm.parse_assembly(one.inspect_llvm()).as_bitcode())


def _build() -> Build:
    if (code := find_module(name_ahead())) is not None:
        return Build({}, {name: Optimised(name, code) for name in CALLBACKS})

    from fairlead.kernels.lowering import lower_together

    return Build({}, dict(lower_together(CALLBACKS, SHARED)))
