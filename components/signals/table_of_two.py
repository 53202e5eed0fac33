"""A signal by a table of two others."""

import csv
import itertools
import math

from fairlead.components.control.signal_gain import SignalGain
from fairlead.components.control.sum import Sum
from fairlead.components.signals.arithmetic import SignalProduct
from fairlead.components.signals.table import SignalTable

from fairlead.component import Composite, Expansion, File, Input, Output
from fairlead.component.piecewise import linear_table

SUMMANDS = "abcd"  # of a Sum


class SignalTable2(Composite):
    """signal = table(x, y):  a map in two dimensions from a CSV file, bilinear between its points.

    The first row of the file has the values of x, after a first cell that is not read. Every other row begins with its
    y. All numbers are in SI; x and y must grow. Beyond its borders the map keeps the value at the border. A map of n
    rows is made of n tables over x, each times its share at y. It has a corner at each x and each y, and a run locates
    them.

    Source: CombiTable2D of the Modelica Standard Library with linear segments. Limits: no cubic surface.
    """

    x = Input("1", "Along the first row.", signed=True)
    y = Input("1", "Down the first column.", signed=True)
    file = File("The map, relative to the netlist and in its folder or below.", ending=".csv")
    signal = Output("1", "Output signal.")

    def check(p):
        """The file is a map of numbers."""
        try:
            read(p.file)
        except ValueError as error:
            yield "file", f"{p.file.name}: {error}", "Write a first row of x, then rows of y and its values, by commas."

    def expand(p, scene):
        """Each row by its share, and the sum of all."""
        x, y, rows = read(p.file)
        children, joins, total = {}, [], None
        for k, values in enumerate(rows):
            near = [j for j in (k - 1, k, k + 1) if 0 <= j < len(y)]
            share = linear_table([y[j] for j in near], [float(j == k) for j in near])
            children[f"row{k}"] = scene.make(SignalTable, points=linear_table(x, values))
            children[f"share{k}"] = scene.make(SignalTable, points=share)
            children[f"part{k}"] = scene.make(SignalProduct)
            joins += [(f"row{k}.signal", f"part{k}.a"), (f"share{k}.signal", f"part{k}.b")]
        parts = [f"part{k}.signal" for k in range(len(rows))]
        for k in range(0, len(parts), len(SUMMANDS) - 1):
            children[f"sum{k}"] = scene.make(Sum)
            ahead = [total, *parts[k : k + len(SUMMANDS) - 1]] if total else parts[k : k + len(SUMMANDS) - 1]
            joins += [(one, f"sum{k}.{port}") for one, port in zip(ahead, SUMMANDS, strict=False)]
            total = f"sum{k}.signal"
        for name, kind in (("x", "row"), ("y", "share")):
            children[name] = scene.make(SignalGain, gain=1.0)
            joins.append((f"{name}.signal", *(f"{kind}{k}.value" for k in range(len(rows)))))
        return Expansion(children, joins, {}, {"signal": total, "x": "x.value", "y": "y.value"})


def read(file):
    """x, y and the rows of a map. Raises ValueError with what is wrong and where."""
    with file.open(encoding="utf-8-sig", newline="") as stream:
        lines = [(k, [cell.strip() for cell in row]) for k, row in enumerate(csv.reader(stream), 1) if any(row)]
    if len(lines) < 3:
        raise ValueError(f"it has {len(lines)} rows, and a map has three at least")
    (_, head), *body = lines
    x = numbers(1, head[1:])
    table = [numbers(k, row) for k, row in body]
    for (k, _), row in zip(body, table, strict=True):
        if len(row) != len(x) + 1:
            raise ValueError(f"row {k} has {len(row) - 1} values, and the first row {len(x)}")
    y = [row[0] for row in table]
    for name, values in (("x", x), ("y", y)):
        if len(values) < 2 or any(b <= a for a, b in itertools.pairwise(values)):
            raise ValueError(f"{name} does not grow from value to value")
    return x, y, [row[1:] for row in table]


def numbers(k, cells):
    """The cells of row k as finite numbers."""
    for j, cell in enumerate(cells, 1):
        try:
            if math.isfinite(float(cell)):
                continue
        except ValueError:
            pass
        raise ValueError(f"row {k}: {cell!r} is not a finite number (value {j})")
    return [float(cell) for cell in cells]
