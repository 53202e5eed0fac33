"""What a reader of results gets: signals by name, values beside events, exports."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from fairlead.errors import FairleadError, UsageError
from fairlead.results import Event, Result, RunDirectory, Signal, UnknownSignalError

SIGNALS = (
    Signal("block.v", "m/s", "speed of the block"),
    Signal("line.core[2].tension", "N", "pull in the core"),
    Signal("line.core[12].tension", "N", "pull in the core"),
    Signal("line.registration", "m", "shift of the hose against the core"),
)


@pytest.fixture
def result(tmp_path: Path) -> Result:
    """A run whose block speed is t before the event at 1 s, and 5 + t after it."""
    with RunDirectory.create(tmp_path / "run", SIGNALS, {"name": "belt"}) as run:
        run.append([0.0, 0.5, 1.0], [[t, 2.0, 12.0, 0.0] for t in (0.0, 0.5, 1.0)], [0, 0, -1])
        run.append([1.0, 2.0], [[5 + t, 2.0, 12.0, 0.0] for t in (1.0, 2.0)], [1, 0])
        run.event(1.0, "pad", "stuck", "forward", "slides, forward")
    return Result.open(tmp_path / "run")


def test_a_signal_is_found_by_the_name_that_a_user_types(result: Result) -> None:
    np.testing.assert_array_equal(result["block.v"], [0, 0.5, 1, 6, 7])
    np.testing.assert_array_equal(result["line.core[12].tension"], np.full(5, 12.0))
    assert result.unit("line.core[12].tension") == "N"
    assert "block.v" in result
    assert "block.w" not in result


def test_signals_keep_their_order_and_description(result: Result) -> None:
    assert result.signals == SIGNALS


def test_an_unknown_name_is_answered_with_the_nearest_one(result: Result) -> None:
    with pytest.raises(UnknownSignalError, match=r"Did you mean block\.v\?") as caught:
        result["block.vv"]
    assert isinstance(caught.value, KeyError)
    assert isinstance(caught.value, FairleadError)


def test_a_name_that_stands_for_elements_says_how_to_get_them(result: Result) -> None:
    with pytest.raises(UnknownSignalError, match=r"stands for 2 signals"):
        result["line.core.tension"]


@pytest.mark.parametrize(
    ("pattern", "names"),
    [
        ("line.*.tension", ["line.core[2].tension", "line.core[12].tension"]),
        ("line.core[*].tension", ["line.core[2].tension", "line.core[12].tension"]),
        ("line.core.tension", ["line.core[2].tension", "line.core[12].tension"]),
        ("line.core[2].tension", ["line.core[2].tension"]),
        ("line.core[?].tension", ["line.core[2].tension"]),
        ("*.v", ["block.v"]),
        ("block", []),
    ],
)
def test_a_pattern_takes_brackets_literally(result: Result, pattern: str, names: list[str]) -> None:
    assert result.match(pattern) == names


def test_between_rows_a_value_is_interpolated_linearly(result: Result) -> None:
    assert result.at("block.v", 0.25) == pytest.approx(0.25, rel=1e-15)
    np.testing.assert_allclose(result.at("block.v", [0.75, 1.25]), [0.75, 6.25], rtol=1e-15)


def test_nothing_is_interpolated_across_an_event(result: Result) -> None:
    just_before, just_after = np.nextafter(1.0, 0.0), np.nextafter(1.0, 2.0)
    assert result.at("block.v", just_before) == pytest.approx(1.0, rel=1e-14)
    assert result.at("block.v", just_after) == pytest.approx(6.0, rel=1e-14)


def test_at_an_event_the_side_chooses_the_value(result: Result) -> None:
    assert result.at("block.v", 1.0, side="left") == 1.0
    assert result.at("block.v", 1.0, side="right") == 6.0
    np.testing.assert_array_equal(result.at("block.v", [0.5, 1.0], side="both"), [[0.5, 0.5], [1.0, 6.0]])


def test_the_first_and_the_last_row_are_within_reach_from_both_sides(result: Result) -> None:
    np.testing.assert_array_equal(result.at("block.v", [0.0, 2.0], side="both"), [[0, 0], [7, 7]])


@pytest.mark.parametrize("t", [-0.1, 2.1, float("nan")])
def test_a_time_that_was_not_reached_is_refused(result: Result, t: float) -> None:
    with pytest.raises(FairleadError, match="from 0 s to 2 s"):
        result.at("block.v", t)


def test_events_are_read_back_as_they_were_logged(result: Result) -> None:
    assert result.events == [Event(1.0, "pad", "stuck", "forward", "slides, forward")]
    assert list(result.events_table().columns) == ["t", "component", "zone_from", "zone_to", "guard"]


def test_what_was_read_cannot_be_changed_by_accident(result: Result) -> None:
    with pytest.raises(ValueError, match="read-only"):
        result["block.v"][0] = 1.0


def test_xarray_gets_units_and_the_side_of_each_row(result: Result) -> None:
    data = result.to_xarray()
    assert data["line.core[12].tension"].attrs["units"] == "N"
    np.testing.assert_array_equal(data["side"], [0, 0, -1, 1, 0])
    np.testing.assert_array_equal(data["block.v"], result["block.v"])


def test_pandas_gets_one_column_per_signal_over_time(result: Result) -> None:
    frame = result.to_pandas(["block.v"])
    np.testing.assert_array_equal(frame["block.v"], result["block.v"])
    np.testing.assert_array_equal(frame.index, result.t)
    assert frame.attrs["units"] == {"block.v": "m/s"}


def test_csv_has_units_in_its_header_and_loses_no_digit(result: Result, tmp_path: Path) -> None:
    result.to_csv(tmp_path / "out.csv")
    with (tmp_path / "out.csv").open(newline="") as file:
        header, *rows = list(csv.reader(file))
    assert header[:3] == ["time [s]", "side", "block.v [m/s]"]
    assert [float(row[2]) for row in rows] == result["block.v"].tolist()


def test_a_result_shows_itself(result: Result) -> None:
    assert "belt, finished" in repr(result)
    assert "line.core[*].tension" in result._repr_html_()


def test_a_folder_without_a_run_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"there is no run\.json in it"):
        Result.open(tmp_path)


def test_a_run_without_rows_can_be_opened(tmp_path: Path) -> None:
    RunDirectory.create(tmp_path / "run", SIGNALS, {}).finish("failed", {})
    result = Result.open(tmp_path / "run")
    assert len(result["block.v"]) == 0
    assert result.status == "failed"
    assert "no rows" in repr(result)
    with pytest.raises(FairleadError, match="at no time"):
        result.at("block.v", 0.0)
