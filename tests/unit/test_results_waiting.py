"""Rows that wait come back in order and whole, from memory and from the file alike."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import fairlead.results.waiting as waiting
from fairlead.results.sink import Block
from fairlead.results.waiting import Waiting


@pytest.fixture
def blocks() -> list[Block]:
    throws = np.random.default_rng(5)
    sizes = (3, 0, 1, 7, 2)
    return [(throws.random(n), throws.random((n, 2)), throws.integers(-1, 3, n).astype("i1")) for n in sizes]


def joined(blocks: list[Block]) -> list[np.ndarray]:
    return [np.concatenate(parts) for parts in zip(*blocks, strict=True)]


@pytest.mark.parametrize("aside_after", [(), (0,), (1, 3), (0, 1, 2, 3, 4)])
def test_what_was_added_comes_back_in_order(tmp_path: Path, blocks: list[Block], aside_after: tuple[int, ...]) -> None:
    rows = Waiting(tmp_path)
    for index, block in enumerate(blocks):
        rows.add(block)
        if index in aside_after:
            rows.set_aside()
    assert rows.rows == 13
    for part, back in zip(joined(blocks), joined(list(rows.give_back())), strict=True):
        np.testing.assert_array_equal(part, back)
        assert part.dtype == back.dtype
    assert rows.rows == 0
    assert not list(rows.give_back())


def test_a_portion_that_could_not_be_written_is_given_back_again(tmp_path: Path, blocks: list[Block]) -> None:
    rows = Waiting(tmp_path)
    for block in blocks:
        rows.add(block)
        rows.set_aside()
    portions = rows.give_back()
    taken = [next(portions) for _ in range(3)]
    next(portions)  # this one could not be written
    rows.add(blocks[0])
    taken += rows.give_back()
    for part, back in zip(joined([*blocks, blocks[0]]), joined(taken), strict=True):
        np.testing.assert_array_equal(part, back)


def test_the_file_has_no_name_and_is_gone_when_all_is_given_back(tmp_path: Path, blocks: list[Block]) -> None:
    rows = Waiting(tmp_path)
    rows.add(blocks[0])
    rows.set_aside()
    list(rows.give_back())
    assert not list(tmp_path.iterdir())


def test_memory_is_full_when_it_holds_more_than_it_should(
    tmp_path: Path, blocks: list[Block], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(waiting, "MOST_BYTES_IN_MEMORY", 8 * 2 * 4)
    rows, full = Waiting(tmp_path), []
    for block in blocks:
        rows.add(block)
        full.append(rows.memory_is_full)
    assert full == [False, False, False, True, True]
    rows.set_aside()
    assert not rows.memory_is_full
