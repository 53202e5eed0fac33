"""How `series.nc` is laid out: recorded signals over time, NetCDF-4 written with h5py.

The file has one dimension, `time` [s]. Time repeats at an event: the row with `side` -1 holds the
values on its left, the row with `side` +1 those on its right; `side` is 0 everywhere else.

    up to `MOST_VARIABLES` signals    one variable per signal, under the name of the signal
    more                              one matrix `values(time, signal)`, with the text variables
                                      `signal`, `units` and `long_name` along its second dimension

Readers of NetCDF spend a time on each variable that grows with the number of variables (h5netcdf
1.8 opens 500 in 3 s and 2000 in 40 s), hence the limit. They also look through all variables for
the length of an unlimited dimension (250 signals: 44 s), hence the bounded `MOST_ROWS`.

The earliest file format is used: newer ones mark a file as open for writing, and most readers
refuse a file that still has the mark because its writer was killed.
"""

from __future__ import annotations

import functools
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fairlead.results.signal import Signal

if TYPE_CHECKING:
    import h5py

MOST_VARIABLES = 500
MOST_ROWS = 2**40
TIME, SIDE, MATRIX = "time", "side", "values"
TIME_SIGNAL = Signal(TIME, "s", "time; an event's time occurs twice")
SIDE_SIGNAL = Signal(SIDE, "1", "-1 left of an event, +1 right of it, 2 inside a step, 0 elsewhere")
FORMAT = "fairlead-series-1"


def open_file(path: Path, mode: str) -> h5py.File:
    """Open an HDF5 file without locking it: a notebook may look at a run that goes on."""
    import h5py

    return h5py.File(path, mode, libver=("earliest", "v110"), locking=False)


def create(path: Path, signals: tuple[Signal, ...], rows_in_chunk: int) -> None:
    """Create a file without rows; the first `rows_in_chunk` rows will share one chunk per variable."""
    with open_file(path, "w") as file:
        file.attrs["Conventions"] = "CF-1.8"
        file.attrs["format"] = FORMAT
        file.attrs["layout"] = "matrix" if is_matrix(signals) else "columns"
        _add_columns(file, (TIME_SIGNAL,), "f8", rows_in_chunk)
        file[TIME].make_scale(TIME)
        _add_columns(file, (SIDE_SIGNAL,), "i1", rows_in_chunk)
        if is_matrix(signals):
            _add_matrix(file, signals, rows_in_chunk)
        else:
            _add_columns(file, signals, "f8", rows_in_chunk)


def is_matrix(signals: tuple[Signal, ...]) -> bool:
    """Return whether so many signals share one variable."""
    return len(signals) > MOST_VARIABLES


def value_variables(signals: tuple[Signal, ...]) -> list[str]:
    """Return the variables that hold the values of the signals."""
    return [MATRIX] if is_matrix(signals) else [variable_name(signal.name) for signal in signals]


def variable_name(signal: str) -> str:
    """Return the variable of a signal: its own name, but for the slash and the layout's own names."""
    name = signal.replace("%", "%25").replace("/", "%2F")
    return f"%{name}" if name in (TIME, SIDE) or name.startswith(".") else name


def read_signals(file: h5py.File) -> tuple[Signal, ...]:
    """Return the signals of a file in the order in which they were declared. Raises ValueError for another layout."""
    layout = file.attrs.get("layout")
    if file.attrs.get("format") != FORMAT or layout not in ("matrix", "columns"):
        raise ValueError("it holds no signals of fairlead")
    _require(file, TIME, "f", 1)
    _require(file, SIDE, "i", 1)
    signals = _read_matrix(file) if layout == "matrix" else _read_columns(file)
    if len({signal.name for signal in signals}) < len(signals):
        raise ValueError("two signals have the same name")
    if is_matrix(signals) != (layout == "matrix"):
        raise ValueError(f"{len(signals)} signals are not laid out as {layout}")
    return signals


def _read_matrix(file: h5py.File) -> tuple[Signal, ...]:
    names, units, meanings = (file[name].asstr()[:].tolist() for name in ("signal", "units", "long_name"))
    _require(file, MATRIX, "f", 2)
    if not len(names) == len(units) == len(meanings) == file[MATRIX].shape[1]:
        raise ValueError(f"{MATRIX} has not as many columns as there are signals")
    return tuple(map(Signal, names, units, meanings))


def _read_columns(file: h5py.File) -> tuple[Signal, ...]:
    from h5py import h5d

    found: dict[int, Signal] = {}
    for name in file:  # HDF5 lists them by name.
        if name in (TIME, SIDE):
            continue
        column = h5d.open(file.id, name.encode())
        signal = Signal(*(_text(column, key) for key in ("signal", "units", "long_name")))
        position = int(_attribute(column, "position", "i"))
        if variable_name(signal.name) != name or position in found or not _is_number(column, "f", 1):
            raise ValueError(f"{name} is no signal")
        found[position] = signal
    if sorted(found) != list(range(len(found))):
        raise ValueError(f"{len(found)} signals are left of {max(found) + 1}")
    return tuple(found[position] for position in range(len(found)))


def _require(file: h5py.File, name: str, kind: str, dimensions: int) -> None:
    """Raise ValueError unless a variable holds such numbers."""
    from h5py import h5d

    if not _is_number(h5d.open(file.id, name.encode()), kind, dimensions):
        raise ValueError(f"{name} does not hold numbers as a run writes them")


def _is_number(variable: Any, kind: str, dimensions: int) -> bool:
    """Return whether a variable holds what `_add_columns` gives it: doubles, or signed bytes, in so many dimensions."""
    found = variable.dtype
    return found.kind == kind and found.itemsize == {"f": 8, "i": 1}[kind] and len(variable.shape) == dimensions


def _add_columns(file: h5py.File, signals: tuple[Signal, ...], kind: str, rows_in_chunk: int) -> None:
    """Add one empty variable per signal, through the low-level interface, which is 3 times as fast."""
    from h5py import h5d, h5ds, h5p, h5s, h5t

    creation = h5p.create(h5p.DATASET_CREATE)
    creation.set_chunk((rows_in_chunk,))
    if kind == "f8":
        creation.set_fill_value(np.array(np.nan))
    number, empty = h5t.py_create(np.dtype(kind)), h5s.create_simple((0,), (MOST_ROWS,))
    scale = file[TIME].id if TIME in file else None
    for position, signal in enumerate(signals):
        name = signal.name if signal in (TIME_SIGNAL, SIDE_SIGNAL) else variable_name(signal.name)
        column = h5d.create(file.id, name.encode(), number, empty, creation)
        if scale is not None:
            h5ds.attach_scale(column, scale, 0)
        _set_text(column, "units", signal.unit)
        _set_text(column, "long_name", signal.description)
        _set_text(column, "signal", signal.name)
        _set_number(column, "position", position)


def _add_matrix(file: h5py.File, signals: tuple[Signal, ...], rows_in_chunk: int) -> None:
    """Add the matrix. Room in its chunk is not filled before it is used: that took as long as writing twice as much."""
    from h5py import h5d, h5p, h5s, h5t

    count = len(signals)
    creation = h5p.create(h5p.DATASET_CREATE)
    creation.set_chunk((rows_in_chunk, count))
    creation.set_fill_value(np.array(np.nan))
    creation.set_fill_time(h5d.FILL_TIME_NEVER)
    empty = h5s.create_simple((0, count), (MOST_ROWS, count))
    h5d.create(file.id, MATRIX.encode(), h5t.py_create(np.dtype("f8")), empty, creation)
    values = file[MATRIX]
    names = _add_texts(file, "signal", [signal.name for signal in signals])
    names.make_scale("signal")
    values.dims[0].attach_scale(file[TIME])
    values.dims[1].attach_scale(names)
    _add_texts(file, "units", [signal.unit for signal in signals]).dims[0].attach_scale(names)
    _add_texts(file, "long_name", [signal.description for signal in signals]).dims[0].attach_scale(names)


def _add_texts(file: h5py.File, name: str, texts: list[str]) -> h5py.Dataset:
    import h5py

    return file.create_dataset(name, data=np.array(texts, dtype=object), dtype=h5py.string_dtype())


def _set_text(variable: Any, name: str, text: str) -> None:
    from h5py import h5a

    content = text.encode() or b"\0"
    kind = _text_type(len(content))
    h5a.create(variable, name.encode(), kind, _one_value()).write(np.array(content), mtype=kind)


def _set_number(variable: Any, name: str, number: int) -> None:
    from h5py import h5a, h5t

    kind = h5t.NATIVE_INT32
    h5a.create(variable, name.encode(), kind, _one_value()).write(np.array(number, "i4"), mtype=kind)


@functools.cache
def _one_value() -> Any:
    """The shape of an attribute; to make it anew, or the type of a text, takes as long as to write one."""
    from h5py import h5s

    return h5s.create(h5s.SCALAR)


@functools.cache
def _text_type(size: int) -> Any:
    """The type of a text of so many bytes."""
    from h5py import h5t

    kind = h5t.C_S1.copy()
    kind.set_size(size)
    kind.set_cset(h5t.CSET_UTF8)
    return kind


def _text(variable: Any, name: str) -> str:
    return bytes(_attribute(variable, name, "S")).rstrip(b"\0").decode()


def _attribute(variable: Any, name: str, kind: str) -> Any:
    """Return a text (kind S) or a whole number (i). Anything else would be written beyond the room for one."""
    from h5py import h5a

    attribute = h5a.open(variable, name.encode())
    if attribute.shape != () or attribute.dtype.kind != kind:
        raise ValueError(f"the attribute {name} of a signal is not as a run writes it")
    content = np.empty((), dtype=attribute.dtype)
    attribute.read(content, mtype=attribute.get_type())
    return content[()]
