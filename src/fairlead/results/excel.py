"""A result as an Excel workbook: sheets for signals, zone changes and the run. Wants openpyxl (`fairlead[excel]`)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from fairlead.errors import UsageError, printable
from fairlead.results.export import Record, Side, rows_of
from fairlead.results.placing import placing

MOST_ROWS, MOST_COLUMNS, LONGEST_TEXT = 1_048_576, 16_384, 32_767
"""What a sheet holds (Microsoft, Excel specifications and limits)."""
ENDINGS = (".xlsx", ".xlsm")


def to_excel(result: Record, path: str | Path, names: Sequence[str], side: Side = "both") -> None:
    """Write the sheets `signals` (time and side first, units in the header), `events` and `run`.

    Raises UsageError when openpyxl is missing, the file has another ending, or the signals do not fit on a sheet.
    """
    if Path(path).suffix.lower() not in ENDINGS:
        raise UsageError(f"{path} is no name of a workbook. End it in .xlsx, or write text with to_csv.")
    openpyxl = _package()
    rows = rows_of(result, side)
    if len(rows) + 1 > MOST_ROWS or len(names) + 2 > MOST_COLUMNS:
        raise UsageError(
            f"{len(rows)} rows of {len(names)} signals do not fit on a sheet, which has {MOST_ROWS} rows of "
            f"{MOST_COLUMNS} columns.\n    Choose signals, to_excel(path, names), or write them with to_csv."
        )
    book = openpyxl.Workbook(write_only=True)
    header = ["time [s]", "side", *(f"{name} [{result.unit(name)}]" for name in names)]
    values = result.columns(names)[rows] if names else [()] * len(rows)
    times = zip(result.t[rows].tolist(), result.side[rows].tolist(), strict=True)
    _sheet(book, "signals", header, ((*when, *map(float, row)) for when, row in zip(times, values, strict=True)))
    events = result.events.table()
    _sheet(book, "events", events.columns, events.rows[: MOST_ROWS - 1])
    record = result.run_table()
    _sheet(book, "run", record.columns, record.rows)
    with placing(Path(path)) as part:
        book.save(part)


def _package() -> Any:
    try:
        import openpyxl
    except ImportError as missing:
        raise UsageError(
            f"An Excel workbook needs the package openpyxl, which cannot be imported ({missing}).\n"
            "    Install it with  pip install 'fairlead[excel]', or write the signals with to_csv."
        ) from None
    return openpyxl


def _sheet(book: Any, title: str, header: Iterable[str], rows: Iterable[Iterable[Any]]) -> None:
    sheet = book.create_sheet(title)
    sheet.freeze_panes = "B2"
    sheet.append([_cell(sheet, name) for name in header])
    for row in rows:
        sheet.append([_cell(sheet, value) for value in row])


def _cell(sheet: Any, value: Any) -> Any:
    """A number, or nothing for what is none; a text as text, also where it looks like a formula."""
    from openpyxl.cell import WriteOnlyCell

    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if not isinstance(value, str):
        return value
    cell = WriteOnlyCell(sheet, printable(value)[:LONGEST_TEXT])
    cell.data_type = "s"
    return cell
