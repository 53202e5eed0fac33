"""How large results will be is told from how they grow, not from a start in which everything switches."""

import os
from types import SimpleNamespace

import pytest

from fairlead.cli.growing import Growing

LARGE = 1e6


def told(tmp_path, capsys, size) -> str:
    """What is said while a run writes `size(fraction)` bytes."""
    model = SimpleNamespace(netlist=SimpleNamespace(record=SimpleNamespace(every=None)))
    file = tmp_path / "series.nc"
    file.touch()
    growing = Growing(model, tmp_path, LARGE, None)
    for k in range(1, 1000):
        os.truncate(file, int(size(k / 1000)))
        growing(k / 1000, k / 100, None)
    return capsys.readouterr().err


def test_a_start_that_chatters_is_no_reason_to_expect_as_much(tmp_path, capsys) -> None:
    """2 % of the run write 0.3 MB, which would make 15 MB of the whole; all of it is 0.4 MB."""
    assert told(tmp_path, capsys, lambda f: 0.3e6 * min(f / 0.02, 1) + 0.1e6 * f) == ""


@pytest.mark.parametrize("start", [0.0, 0.2e6])
def test_what_grows_evenly_is_told_early_and_right(tmp_path, capsys, start) -> None:
    said = told(tmp_path, capsys, lambda f: start * min(f / 0.02, 1) + 20e6 * f)
    assert said.count("note:") == 1
    assert float(said.partition("about ")[2].partition(" MB")[0]) == pytest.approx(20, abs=1)
    assert 1 <= float(said.partition("t = ")[2].partition(" s")[0]) <= 1.5


def test_what_is_too_large_already_is_told_at_once(tmp_path, capsys) -> None:
    said = told(tmp_path, capsys, lambda f: 12e6)
    assert "about 12 MB and more (t = 0.01 s)" in said
