"""One compiled kernel per class variant: it loops over all instances and does what it is asked.

    kernel(mode, block, start, stop, z, zones, tables, out)

The traced expressions of every zone become one `if zone == ...` chain per mode, with common
subexpressions shared; derivatives are SymPy's, so they are exact. `Structure` records what a driver
must know about the kernel (inputs, targets, which derivative is where) and is stored with the
machine code: a warm start needs neither SymPy nor numba.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields
from typing import Any

from fairlead.brief import in_a_line
from fairlead.component.dependencies import dependencies
from fairlead.component.values import Variant
from fairlead.kernels.lowered_ahead import Given, find
from fairlead.kernels.structure import Structure
from fairlead.native import Build, Native, digest, load_or_compile


@dataclass(frozen=True)
class Kernel:
    """Compiled code of a class variant; `native` owns the memory it lies in."""

    __repr__ = in_a_line

    variant: Variant
    structure: Structure
    native: Native

    @property
    def address(self) -> int:
        """Where the code begins."""
        return self.native.address["kernel"]


@functools.cache
def kernel(variant: Variant, rated: int = 0) -> Kernel:
    """The kernel of a class variant, from the cache or traced and compiled. Raises TraceError.

    A `rated` one adds up the rates of its flows too, for nodes without inertia; one rated 2 tells those of its outputs
    (algebraic_nodes.py).
    """
    facts = " ".join(field.name for field in fields(Structure))  # of this process, whatever the files say by now
    marked = f"{facts} rated {rated}" if rated else facts
    native = load_or_compile(digest(dependencies(variant), marked), lambda: _build(variant, rated))
    return Kernel(variant, Structure(**native.meta), native)


def _build(variant: Variant, rated: int = 0) -> Build:
    from fairlead.kernels.lowering import lower, optimised

    if (given := find(variant, rated)) is not None:
        return Build(given.facts, {"kernel": optimised("kernel", given.bitcode)})
    source, structure = write_source(variant, rated)
    return Build(asdict(structure), {"kernel": lower(source, "kernel", file=f"<kernel of {variant.label}>")})


def lowered(variant: Variant, rated: int) -> Given:
    """The kernel of a variant, traced and lowered, before any pass of LLVM: for any processor."""
    import llvmlite.binding as llvm

    from fairlead.kernels.lowered_values import KERNEL
    from fairlead.kernels.lowering import written

    source, structure = write_source(variant, rated)
    text = written({"kernel": (source, KERNEL, "None")}, file=f"<kernel of {variant.label}>")
    return Given(asdict(structure), llvm.parse_assembly(text).as_bitcode())


@functools.lru_cache(maxsize=256)  # both the machine code and the Python function of a class are made of it
def write_source(variant: Variant, rated: int) -> tuple[str, Structure]:
    """Python text of the kernel, in the subset that `lowering.py` understands, and its structure."""
    from fairlead.component.trace import trace
    from fairlead.kernels.text import KernelText

    return KernelText(trace(variant), rated=rated).write()


@functools.cache
def plain(variant: Variant) -> tuple[Callable[..., None], Structure]:
    """The kernel as a Python function that takes complex numbers, for derivatives by complex step.

    Its `block` holds the arrays themselves where the machine code wants their addresses. `abs` and `min`
    go by the real part, so that they stay analytic beside their kinks.
    """
    import cmath

    source, structure = write_source(variant, 0)
    names: dict[str, Any] = {
        name: getattr(cmath, name) for name in ("exp", "log", "sqrt", "sin", "cos", "tan", "tanh", "atan")
    }
    names |= {"f8": _same, "i8": _same, "abs": _magnitude, "min": _least, "max": _greatest, "sign": _direction}
    exec(compile(source, f"<kernel {variant.label}>", "exec"), names)
    return names["kernel"], structure


def _same(array: Any) -> Any:
    return array


def _magnitude(x: Any) -> Any:
    return x if x.real >= 0 else -x


def _least(*values: Any) -> Any:
    return min(values, key=lambda value: value.real)


def _greatest(*values: Any) -> Any:
    return max(values, key=lambda value: value.real)


def _direction(x: Any) -> Any:
    return int(x.real > 0) - int(x.real < 0)  # of numpy too, whose booleans cannot be subtracted
