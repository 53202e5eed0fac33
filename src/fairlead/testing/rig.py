"""Instances of one class variant wired to nothing: every input can be set, everything they say be read.

The same question can be put to the machine code and to the Python text it was made from.
"""

from __future__ import annotations

import ctypes
import functools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fairlead.component.trace import TracedZone
from fairlead.component.values import Values, Variant, parameter, polynomial, variant_of
from fairlead.kernels import layout
from fairlead.kernels.kernel import kernel, plain
from fairlead.kernels.structure import Structure
from fairlead.system.arrays.blocks import Tables

TAU = 1e-2  # s; the time constant of hold rows, any will do
FIXED = {
    layout.PARTIALS_SIGNALS: layout.FIXED_SIGNALS,
    layout.PARTIALS_FLOWS: layout.FIXED_FLOWS,
    layout.PARTIALS_LEDGER: layout.FIXED_LEDGER,
}
POINTER, WHOLE = ctypes.c_void_p, ctypes.c_int64


@functools.lru_cache(maxsize=16)  # several properties ask several instances of one variant
def traced_zones(variant: Variant) -> Mapping[str, TracedZone]:
    """The traced zones of a variant."""
    from fairlead.component.trace import trace

    return trace(variant).zones


class Rig:
    """n instances of one variant. Inputs are (n, inputs), zones (n, machines); answers are arrays by instance."""

    def __init__(self, instances: Sequence[Values], inverse_masses: Sequence[Mapping[str, float]]) -> None:
        """`inverse_masses`: per instance and port, for laws that ask for them."""
        self.variant = variant_of(instances[0])
        self.count = len(instances)
        self.text, self.structure = plain(self.variant)
        s = self.structure
        tables = Tables()
        self.pieces = [[polynomial(v.path(name)) for name in s.tables] for v in instances]
        bases = [[tables.place(table) for table in row] for row in self.pieces]
        self.tables = tables.vector()
        parameters = [
            [_parameter(s, v, name, m) for name in s.parameters] for v, m in zip(instances, inverse_masses, strict=True)
        ]
        self._arrays = self._block(parameters, bases)

    def _block(self, parameters: list[list[float]], bases: list[list[int]]) -> list[Any]:
        s, n = self.structure, self.count
        width = len(s.inputs)

        def numbered(columns: int, first: int = 0) -> Any:
            return first + np.arange(n * columns, dtype=np.int64)

        return [
            np.array(parameters, dtype=float).ravel(), numbered(width), np.ones(n * width), np.zeros(n * width),
            numbered(s.machines), np.array(bases, dtype=np.int64).ravel(), numbered(len(s.outputs), n * width),
            numbered(len(s.targets)), np.ones(n * len(s.targets)), np.arange(2, dtype=np.int64),
        ]  # fmt: skip

    def ask(self, mode: int, inputs: Any, zones: Any, *, machine: bool = False) -> Any:
        """What the kernel says in a mode, in the shape of that mode (see `widths`). Text keeps complex numbers."""
        rows, columns = self._shape(mode)
        first = self.count * len(self.structure.inputs) if mode == layout.SIGNALS else 0
        size = first + rows * columns
        if mode in FIXED:  # the two modes share out the derivatives between them
            moving, fixed = (self._answer(each, inputs, zones, size, machine) for each in (mode, FIXED[mode]))
            return (moving + fixed).reshape(rows, columns)
        return self._answer(mode, inputs, zones, size, machine)[first:size].reshape(rows, columns)

    def _answer(self, mode: int, inputs: Any, zones: Any, size: int, machine: bool) -> Any:
        if machine:
            out: Any = self._machine(mode, inputs, zones, max(size, 1))
        else:
            out = [0.0] * size
            flat, places = (one if isinstance(one, list) else np.ravel(one).tolist() for one in (inputs, zones))
            self.text(mode, self._listed, 0, self.count, flat, places, self._rows, out)
        return np.array(out)[:size]

    def _machine(self, mode: int, inputs: Any, zones: Any, size: int) -> Any:
        z = np.concatenate([np.ravel(np.array(inputs, dtype=float)), [0.0]])
        piece = np.concatenate([np.ravel(np.array(zones, dtype=np.int64)), [0]]).astype(np.int64)
        out = np.zeros(size)
        block = self._addresses.ctypes.data
        self._code(mode, block, 0, self.count, *(a.ctypes.data for a in (z, piece, self.tables, out)))
        return out

    @functools.cached_property
    def _code(self) -> Any:
        """The machine code, to be called."""
        return ctypes.CFUNCTYPE(None, WHOLE, POINTER, WHOLE, WHOLE, POINTER, POINTER, POINTER, POINTER)(
            kernel(self.variant).address
        )

    @functools.cached_property
    def _listed(self) -> list[Any]:
        """The block for the text, which reads lists three times as fast; their numbers remain those of numpy."""
        return [list(array) if array.dtype == float else array.tolist() for array in self._arrays] + [0] * (
            layout.BLOCK - len(self._arrays)
        )

    @functools.cached_property
    def _rows(self) -> list[Any]:
        """The tables for the text."""
        return list(self.tables)

    @functools.cached_property
    def _addresses(self) -> Any:
        """Where the arrays of the block lie."""
        block = np.zeros(layout.BLOCK, dtype=np.int64)
        block[: len(self._arrays)] = [array.ctypes.data for array in self._arrays]
        return block

    @functools.cached_property
    def _widths(self) -> dict[int, int]:
        return widths(self.structure)

    def _shape(self, mode: int) -> tuple[int, int]:
        columns = self._widths[mode]
        return (1, columns) if mode == layout.LEDGER else (self.count, columns)


def widths(s: Structure) -> dict[int, int]:
    """How many numbers an instance says in each mode; the ledger is one sum over all."""
    return {
        layout.SIGNALS: len(s.outputs), layout.FLOWS: len(s.targets), layout.LEDGER: 2, layout.SLIP: len(s.targets),
        layout.GAP: len(s.targets),
        layout.PARTIALS_SIGNALS: len(s.d_signals), layout.PARTIALS_FLOWS: len(s.d_flows),
        layout.PARTIALS_LEDGER: len(s.d_ledger), layout.MASS: len(s.mass), layout.GUARD: s.slots,
        layout.OUTPUT: len(s.outputs) + 3,
    }  # fmt: skip



def _parameter(s: Structure, values: Values, name: str, inverse_masses: Mapping[str, float]) -> float:
    if name == "@tau":
        return TAU
    if name in s.inverse_masses:
        return inverse_masses[s.inverse_masses[name]]
    return parameter(values, name)
