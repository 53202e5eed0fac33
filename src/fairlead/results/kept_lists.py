"""Lists of a result that may be very long: they show their size and their first entries, and are lists otherwise."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, SupportsIndex, overload

from fairlead.brief import brief
from fairlead.results.events import Event
from fairlead.results.signal import Signal

if TYPE_CHECKING:
    import pandas

    from fairlead.results.table import Table


class _AsTable:
    """Shows itself as its table."""

    __slots__ = ()

    def table(self) -> Table:
        """The same as a table."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return repr(self.table())

    def _repr_html_(self) -> str:
        return self.table()._repr_html_()


class Events(_AsTable, list[Event]):
    """Zone changes in order, each (t, component, zone_from, zone_to, guard); a text gives a column, as of a table."""

    @overload
    def __getitem__(self, which: SupportsIndex, /) -> Event: ...
    @overload
    def __getitem__(self, which: slice, /) -> list[Event]: ...
    @overload
    def __getitem__(self, which: str, /) -> list[Any]: ...

    def __getitem__(self, which: Any, /) -> Any:
        if isinstance(which, bool):
            return self.table()[which]
        try:
            return super().__getitem__(which)
        except (TypeError, IndexError):
            return self.table()[which]  # a column, or what a table says of one that it has not

    def table(self) -> Table:
        """The same as a table."""
        return _table(f"{len(self)} zone changes", Event._fields, ("s", "", "", "", ""), tuple(map(tuple, self)))

    def to_pandas(self) -> pandas.DataFrame:
        """The same with columns t, component, zone_from, zone_to, guard."""
        return self.table().to_pandas()


class Signals(_AsTable, tuple[Signal, ...]):
    """Recorded signals, in the order of recording."""

    __slots__ = ()

    def table(self) -> Table:
        """Names, units and descriptions."""
        rows = tuple((one.name, one.unit, one.description) for one in self)
        return _table(f"{len(self)} signals", ("signal", "unit", "description"), ("", "", ""), rows)

    def to_pandas(self) -> pandas.DataFrame:
        """The same with columns signal, unit, description."""
        return self.table().to_pandas()


class RunRecord(_AsTable, dict[str, Any]):
    """The contents of run.json."""

    def table(self) -> Table:
        """Its entries, long ones by kind and size."""
        rows = tuple((name, brief(value)) for name, value in self.items())
        return _table("run.json", ("entry", "value"), ("", ""), rows)


def _table(*given: Any) -> Table:
    from fairlead.results.table import Table  # a run that shows nothing does without

    return Table(*given)
