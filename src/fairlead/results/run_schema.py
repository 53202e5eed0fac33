"""What `run.json` has to hold for those who read it: the head of every run, and what margins are told from.

Entries that nobody reads back (counters, energy, effects) may be anything. A fault is told by the path of the entry,
`routes.0.nodes`, with what stands there.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, TypeAdapter, ValidationError

from fairlead.errors import shown
from fairlead.results.damage import DamagedResultsError

MOST_NODES = 10**6
T = TypeVar("T")


class _Entry(BaseModel):
    model_config = ConfigDict(strict=True, extra="allow", frozen=True, defer_build=True)


class Head(_Entry):
    """What every run says of itself."""

    format: Literal["fairlead-run-1"]
    status: Annotated[str, Field(min_length=1)]
    id: str | None = None
    name: str | None = None
    started: str | None = None
    ended: str | None = None
    process: int | None = None
    host: str | None = None
    boot: str | None = None
    locked: bool = False


class Left(_Entry):
    """A file as the run left it (see `seal.py`)."""

    bytes: Annotated[int, Field(ge=0)]
    sha256: str


class Station(_Entry):
    """A place on a route, and what touches the line there (see `analysis/statics/route_record.py`). Lengths in m."""

    name: str
    type: str
    begin: FiniteFloat | None
    end: FiniteFloat | None
    curvature: FiniteFloat | None
    contact: str | None
    moves: bool
    friction: Annotated[tuple[FiniteFloat, FiniteFloat], Field(strict=False)] | None = None
    squeeze: FiniteFloat | None = None


class Route(_Entry):
    """A line on a route: its layers and nodes, what it bears, its stations."""

    line: str
    route: str
    layers: Annotated[list[str], Field(min_length=1)]
    outer: str
    nodes: Annotated[int, Field(ge=2, le=MOST_NODES)]
    ruck_force: FiniteFloat | None
    side_wall: FiniteFloat | None
    stations: list[Station]
    rigid_from: FiniteFloat | None = None
    places: Annotated[list[FiniteFloat], Field(max_length=MOST_NODES)] = []
    stiffnesses: list[FiniteFloat] = []
    inner_friction: Annotated[tuple[FiniteFloat, FiniteFloat], Field(strict=False)] | None = None


class Limit(_Entry):
    """A limit of the netlist, and what came nearest to it: signal, value, time."""

    signal: str
    sense: FiniteFloat
    bound: FiniteFloat
    unit: str
    text: str
    nearest: Annotated[tuple[str, FiniteFloat, FiniteFloat], Field(strict=False)] | None = None


FourNumbers = Annotated[tuple[FiniteFloat, FiniteFloat, FiniteFloat, FiniteFloat], Field(strict=False)]


def check_head(file: Path, record: Mapping[str, Any]) -> None:
    """Refuse a run.json, `file`, whose head is damaged. Raises DamagedResultsError."""
    _valid(Head, file, record, ())


def files(file: Path, record: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the files of a run as it left them, from its run.json, `file`. Raises DamagedResultsError."""
    left = _valid(dict[str, Left], file, record.get("files") or {}, ("files",))
    return {name: one.model_dump() for name, one in left.items()}


def routes(file: Path, record: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the lines on routes of a run from its run.json, `file`. Raises DamagedResultsError."""
    return [one.model_dump() for one in _valid(list[Route], file, record.get("routes") or [], ("routes",))]


def limits(file: Path, record: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the limits of a run from its run.json, `file`. Raises DamagedResultsError."""
    return [one.model_dump() for one in _valid(list[Limit], file, record.get("limits") or [], ("limits",))]


def extremes(file: Path, record: Mapping[str, Any]) -> dict[str, tuple[float, float, float, float]]:
    """Return lowest value, when, highest, when, by signal, of a run from its run.json, `file`. DamagedResultsError."""
    return _valid(dict[str, FourNumbers], file, record.get("extremes") or {}, ("extremes",))


def _valid(kind: type[T], file: Path, value: Any, above: tuple[str, ...]) -> T:
    try:
        return TypeAdapter(kind).validate_python(value)
    except ValidationError as error:
        first = error.errors()[0]
        more = f" ({error.error_count() - 1} more)" if error.error_count() > 1 else ""
        place = ".".join(str(part) for part in (*above, *first["loc"])) or "the file"
        found = "" if first["type"] == "missing" else f" = {shown(first['input'])}"
        what = f"{place}{found}: {first['msg'][0].lower()}{first['msg'][1:]}{more}."
        raise DamagedResultsError(file, what) from error
