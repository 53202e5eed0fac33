"""What follows time: the pieces of quantities given in time, and sample times."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from fairlead.component.piecewise import PiecewisePolynomial
from fairlead.component.values import polynomial
from fairlead.kernels import layout
from fairlead.system.arrays.blocks import Block, Integers, Memory

OPEN = "off"
"""The zone in which a contact is open."""


class PlacedTable(NamedTuple):
    """A table of one instance: its machine in `zones`, and where its rows begin."""

    path: str
    polynomial: PiecewisePolynomial
    machine: int
    base: int
    timed: bool  # read at t, so that time moves its pieces and no guard does


def tables(blocks: Sequence[Block]) -> Iterator[PlacedTable]:
    """The tables of all instances; their machines come after that of the zone."""
    for block in blocks:
        s = block.kernel.structure
        first = s.machines - len(s.tables)
        for column, path in enumerate(s.tables):
            known: dict[int, PiecewisePolynomial] = {}  # nodes of a line share their values
            machines, bases = block.machines[:, first + column].tolist(), block.table_base[:, column].tolist()
            for instance, machine, base in zip(block.instances, machines, bases, strict=True):
                values = instance.values
                if id(values) not in known:
                    known[id(values)] = polynomial(values.path(path))
                yield PlacedTable(path, known[id(values)], machine, base, path in s.time_tables)


def time_places(blocks: Sequence[Block]) -> Integers:
    """(machine, where its rows begin, how many pieces) of everything given in time."""
    found = [(table.machine, table.base, len(table.polynomial.rows)) for table in tables(blocks) if table.timed]
    return np.array(found, dtype=np.int64).reshape(-1, layout.TIME)


def first_pieces(blocks: Sequence[Block], zones: Integers, open_first: Collection[str]) -> list[PlacedTable]:
    """Put parts into the zones in which they begin, and tables of unknowns into a piece from which they settle.

    What is given in time waits for the start: those. `open_first` are contacts that begin open (determinacy.py).
    """
    timed = []
    for block in blocks:
        for instance, machines in zip(block.instances, block.machines, strict=True) if open_first else ():
            if instance.path in open_first:
                zones[machines[0]] = block.kernel.structure.zones.index(OPEN)
        begins = block.instances[0].type.answers.begins_in if block.count else None
        if begins is not None:
            for instance, machines in zip(block.instances, block.machines, strict=True):
                zones[machines[0]] = block.kernel.structure.zones.index(begins(instance.values))
    for table in tables(blocks):
        if table.timed:
            timed.append(table)
        else:
            zones[table.machine] = table.polynomial.begin
    return timed


def samplers(blocks: Sequence[Block]) -> Memory:
    """Instances with sample times, in the order of the blocks; the first sample is at the start."""
    sampled, periods, kernels = [], [], []
    for b, block in enumerate(blocks):
        period = block.kernel.structure.period
        if period:
            sampled += [(b, i) for i in range(block.count)]
            periods += [float(getattr(instance.values, period)) for instance in block.instances]
            kernels += [block.kernel.address] * block.count
    return {
        "sampled": np.array(sampled, dtype=np.int64).reshape(-1, layout.SAMPLED_ROW),
        "sample_period": np.array(periods, dtype=float),
        "sample_count": np.zeros(len(sampled), dtype=np.int64),
        "sample_start": np.zeros(1),
        "sample_kernels": np.array(kernels, dtype=np.int64),
    }
