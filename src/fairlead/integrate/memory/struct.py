"""What a struct of the memory of a run has."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np


class Struct(NamedTuple):
    """Fields of one owner, all eight bytes wide; `at_<name>` is the address of the array <name>."""

    calls: tuple[str, ...] = ()
    """Addresses of C functions of the problem, and of their context."""
    integers: tuple[str, ...] = ()
    numbers: tuple[str, ...] = ()
    reals: Mapping[str, str] = {}
    """Arrays of doubles, by the name of their length."""
    indices: Mapping[str, str] = {}
    """Arrays of whole numbers, by the name of their length."""
    copies: tuple[str, ...] = ()
    """Sizes and arrays of another owner that this one has as well; no run changes them."""

    def fields(self, arrays: Mapping[str, str]) -> list[tuple[str, str]]:
        """Names and types; `arrays` are all there are, by which a copy is told from a size."""
        addresses = [f"at_{name}" for name in (*self.reals, *self.indices, *self.copies) if name in arrays]
        whole = [name for name in (*self.calls, *self.integers, *self.copies) if name not in arrays]
        return [(name, "i8") for name in (*addresses, *whole)] + [(name, "f8") for name in self.numbers]

    def record(self, arrays: Mapping[str, str]) -> np.dtype:
        """The struct as a type of numpy."""
        return np.dtype(self.fields(arrays))
