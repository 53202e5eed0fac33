"""The elements of a line side by side: one array by time and element, with their places along the line.

    tension = result.elements("line.hose[*].tension")       an xarray.DataArray
    tension.sel(time=2.0, along=12.0, method="nearest")     with side="right", in which every time occurs once
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

import fairlead.results.run_file as run_file
import fairlead.results.run_schema as run_schema
from fairlead.errors import UsageError, listing
from fairlead.results.export import Record, Side, rows_of
from fairlead.results.layout import SIDE, SIDE_SIGNAL, TIME
from fairlead.results.signal import family
from fairlead.results.table import Table

if TYPE_CHECKING:
    import xarray

ELEMENT, ALONG, PLACE = "element", "along", "place"


def families(result: Record) -> Table:
    """A row for each family of signals: `line.hose[*].tension`, its unit, how many there are, which."""
    found: dict[str, list[int]] = {}
    units = {}
    for signal in result.signals:
        name, number = family(signal.name)
        if number is not None:
            found.setdefault(name, []).append(number)
            units[name] = signal.unit
    rows = tuple((name, units[name], len(each), min(each), max(each)) for name, each in found.items())
    return Table("elements", ("family", "unit", "count", "first", "last"), ("",) * 5, rows)


def elements(result: Record, pattern: str, side: Side = "both") -> xarray.DataArray:
    """The signals of one family by `time` and `element`.

    Coordinates: `element`, the numbers; of a line on a route also `along` [m], the place along the line without load
    from its inboard end, which serves as index in their stead, and `place` [m] (time, element), where each is on the
    route, when the positions of the line were recorded. Raises UsageError for a pattern of several families.
    """
    import xarray

    name, members = _members(result, pattern)
    rows, numbers = rows_of(result, side), np.array([*members])
    t = result.t[rows]
    coordinates: dict[str, Any] = {
        TIME: (TIME, t, {"units": "s", "long_name": "time"}), SIDE: (TIME, result.side[rows]),
        ELEMENT: (ELEMENT, numbers, {"long_name": "number along the line"}),
    }  # fmt: skip
    coordinates[SIDE] = (*coordinates[SIDE], {"long_name": SIDE_SIGNAL.description})
    coordinates |= _places(result, name, numbers, rows)
    about = next(signal for signal in result.signals if signal.name == members[int(numbers[0])])
    values = result.columns(list(members.values()))[rows]
    attributes = {"units": about.unit, "long_name": about.description or name}
    made = xarray.DataArray(values, coordinates, (TIME, ELEMENT), name, attributes)
    return made.set_xindex(ALONG) if ALONG in coordinates else made


def _members(result: Record, pattern: str) -> tuple[str, dict[int, str]]:
    """The family that a pattern picks, and its signals by number in rising order."""
    found: dict[str, dict[int, str]] = {}
    for name in result.chosen(pattern):
        one, number = family(name)
        if number is not None:
            found.setdefault(one, {})[number] = name
    if len(found) != 1:
        what = f"{pattern} stands for {len(found)} families of elements: {listing(found)}" if found else (
            f"{pattern} stands for no elements: no signal of that name has a number")  # fmt: skip
        raise UsageError(f"{what}.\n    Name one; result.families() lists them.")
    (name, members), = found.items()  # fmt: skip
    return name, dict(sorted(members.items()))


def _places(result: Record, name: str, numbers: NDArray[np.int64], rows: NDArray[np.int64]) -> dict[str, Any]:
    """Coordinates along the line and on its route, as far as they are known."""
    for record in run_schema.routes(result.named(run_file.RUN_FILE), result.run):
        child = name.removeprefix(f"{record['line']}.").partition("[")[0]
        if name.startswith(f"{record['line']}.") and record.get("places"):
            nodes = np.array(record["places"])
            of_elements = child in record["layers"]
            places = (nodes[1:] + nodes[:-1]) / 2 if of_elements else nodes
            if len(numbers) == 0 or numbers[-1] >= len(places):
                return {}
            along = {ALONG: (ELEMENT, places[numbers], {"units": "m", "long_name": "along the line, without load"})}
            return along | _on_route(result, record, numbers, rows, of_elements)
    return {}


def _on_route(
    result: Record, record: dict[str, Any], numbers: NDArray[np.int64], rows: NDArray[np.int64], of_elements: bool
) -> dict[str, Any]:
    """Where elements (their middles) or nodes are on the route at every time; nothing when that was not recorded."""
    ends = (numbers, numbers + 1) if of_elements else (numbers,)
    names = [[f"{record['line']}.{record['outer']}[{k}].x" for k in each] for each in ends]
    if not all(one in result for each in names for one in each):
        return {}
    x = np.mean([result.columns(each)[rows] for each in names], axis=0)
    return {PLACE: ((TIME, ELEMENT), x, {"units": "m", "long_name": "place on the route"})}
