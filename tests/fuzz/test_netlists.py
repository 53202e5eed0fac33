"""A small sample of damaged netlists, always the same; any number by hand with `python -m tests.fuzz netlists`."""

import random
import signal

import pytest

from tests.fuzz.netlists import damaged, mutants
from tests.fuzz.verdict import judge

SOON = ("block_and_spring", "all_sorts")


@pytest.mark.parametrize("seed", range(4))
def test_a_damaged_netlist_is_answered_in_words_with_a_place(tmp_path, seed):
    found = [
        (str(mutant), verdict.complaints)
        for mutant in mutants(tmp_path, seed, 30, SOON)
        if (verdict := judge(mutant.file)).complaints
    ]
    assert not found


def test_the_same_seed_gives_the_same_damage(tmp_path):
    one, other = ([(str(m), m.file.read_bytes()) for m in mutants(tmp_path, 5, 20, SOON)] for _ in range(2))
    assert one == other
    assert len({data for _, data in one}) > 15


def test_a_bad_answer_is_told(tmp_path, monkeypatch):
    """The judge itself: a crash, and a mistake without a place."""
    import fairlead
    from fairlead.errors import Fault, ModelError

    def refuse(error):
        def load(*_, **__):
            raise error

        monkeypatch.setattr(fairlead, "load", load)
        return judge(tmp_path / "any.yaml").complaints

    assert "exit code 70: ZeroDivisionError" in refuse(ZeroDivisionError("x"))[0]
    assert refuse(ModelError([Fault(None, "it is wrong")])) == ["no place: it is wrong"]


def test_what_does_not_end_is_told(tmp_path, monkeypatch):
    import fairlead

    def load(*_, **__):
        signal.setitimer(signal.ITIMER_PROF, 0.01)  # it rings here, not in what is between; 30 s were too long to wait
        while True:
            pass

    monkeypatch.setattr(fairlead, "load", load)
    assert "took more than 30 s" in judge(tmp_path / "any.yaml").complaints[0]


def test_any_bytes_can_be_damaged():
    chance = random.Random(1)
    for _ in range(200):
        data, _ = damaged(chance, {"a": [1, {"b": "c"}]}, "a: [1, {b: c}]\n")
        assert isinstance(data, bytes)
