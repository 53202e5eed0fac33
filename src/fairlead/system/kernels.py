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
from dataclasses import asdict, dataclass
from typing import Any

from fairlead.component.dependencies import dependencies
from fairlead.component.values import Variant
from fairlead.native import Build, digest, load_or_compile
from fairlead.system import layout

TABLE_FIELDS = {"left": 0, "right": 1}  # then reference and coefficients, see component/piecewise.py


@dataclass(frozen=True)
class Structure:
    """What a kernel reads and writes, by position. Keys of inputs are those of `component/trace.py`."""

    inputs: list[str]
    parameters: list[str]
    tables: list[str]
    time_tables: list[str]
    zones: list[str]
    machines: int
    outputs: list[str]
    targets: list[str]  # "port:a", "own:force": where flows, rates and balances go
    ledger: list[str]
    d_signals: list[tuple[int, int]]  # (output, input) of every derivative that may be non-zero
    d_flows: list[tuple[int, int]]
    d_ledger: list[tuple[int, int]]
    mass: list[tuple[str, int]]  # (unknown, input) of the mass entries of hold rows
    holds: dict[str, list[str]]  # unknown -> zones that hold
    guards: dict[str, list[dict[str, Any]]]  # zone -> its guards in slot order
    slots: int
    equations: dict[str, list[str]]  # zone -> its laws as text
    flow_inputs: dict[str, dict[str, list[str]]]  # zone -> target -> input keys it depends on
    reaches: dict[str, dict[str, str]]  # zone -> table -> input or expression it is read at


@dataclass(frozen=True)
class Kernel:
    """Compiled code of a class variant."""

    variant: Variant
    structure: Structure
    address: int
    cached: bool


@functools.cache
def kernel(variant: Variant) -> Kernel:
    """The kernel of a class variant, from the cache or traced and compiled. Raises TraceError."""
    native = load_or_compile(digest(dependencies(variant)), lambda: _build(variant))
    return Kernel(variant, Structure(**native.meta), native.address["kernel"], native.cached)


def _build(variant: Variant) -> Build:
    import numba

    from fairlead.system import addresses

    source, structure = write_source(variant)
    functions = _functions("math") | {"f8": addresses.f8, "i8": addresses.i8}
    exec(compile(source, f"<kernel {variant.label}>", "exec"), functions)  # noqa: S102 - our own text, from SymPy
    made = numba.cfunc(addresses.KERNEL, error_model="numpy")(functions["kernel"])
    return Build(asdict(structure), {"kernel": made})


def _functions(module: str) -> dict[str, Any]:
    import importlib

    source = importlib.import_module(module)
    return {n: getattr(source, n) for n in ("exp", "log", "sqrt", "sin", "cos", "tan", "tanh", "atan")}


def write_source(variant: Variant) -> tuple[str, Structure]:
    """Python text of the kernel (numba compiles it) and its structure."""
    from fairlead.component.trace import trace
    from fairlead.system.kernel_text import KernelText

    return KernelText(trace(variant)).write()


def evaluate(variant: Variant, **arrays: Any) -> Callable[..., None]:
    """The kernel as a plain Python function with complex numbers allowed: for complex-step checks."""
    source, _ = write_source(variant)
    names = _functions("cmath") | {"f8": lambda a: arrays["f8"][a], "i8": lambda a: arrays["i8"][a], "abs": abs}
    exec(compile(source, f"<kernel {variant.label}>", "exec"), names)  # noqa: S102
    return names["kernel"]


def block_offsets() -> dict[str, int]:
    """Positions of a kernel's block by name, for listings."""
    return {name: value for name, value in vars(layout).items() if name.isupper() and isinstance(value, int)}
