"""Every mistake of the catalogue gets an answer with place, part and cure; those of known.py do not yet."""

import pytest

from tests.mistakes.bases import BASES
from tests.mistakes.catalogue import ALL, CATALOGUE
from tests.mistakes.entry import Mistake, Typed
from tests.mistakes.judge import Answer, faults
from tests.mistakes.known import KNOWN
from tests.mistakes.play import Desk, play


@pytest.fixture
def desk(tmp_path):
    return Desk(tmp_path)


def listed():
    """The names, with the known ones marked."""
    for name in ALL:
        known = [pytest.mark.xfail(strict=True, reason=KNOWN[name])] if name in KNOWN else []
        yield pytest.param(name, id=name, marks=known)


@pytest.mark.parametrize("name", list(listed()))
def test_a_mistake_is_answered_with_place_part_and_cure(name, desk):
    answer = play(ALL[name], desk)
    assert not faults(ALL[name], answer), answer.text


@pytest.mark.parametrize("base", BASES)
def test_a_netlist_that_is_damaged_later_is_right_before(base, desk):
    check = Mistake(base, Typed(("check", f"{base}.yaml")), (), (), ())
    assert play(check, desk) == Answer("")


def test_there_are_more_than_three_hundred_of_which_147_are_calls_from_python():
    assert sum(map(len, CATALOGUE.values())) == len(ALL) == 339
    assert len(CATALOGUE["python"]) == 147


def test_what_is_known_to_fail_is_in_the_catalogue():
    assert set(KNOWN) <= set(ALL)


def test_a_judge_misses_what_is_not_there():
    mistake = Mistake("a mistake", Typed(()), ("mine.yaml:3",), ("spring", "N/mtr"), ("N/m",))
    whole = "mine.yaml:3:4: spring: no unit N/mtr. Did you mean N/m?"
    assert faults(mistake, Answer(whole, refused=True)) == []
    assert faults(mistake, Answer(whole.replace(":3:", ":31:"), refused=True)) == ["place"]
    assert faults(mistake, Answer("mine.yaml:3: no unit N/mtr", refused=True)) == ["part", "cure"]
    assert faults(mistake, Answer(whole)) == ["only a warning"]
    assert faults(mistake, Answer("")) == ["silent"]
    assert faults(mistake, Answer("", crashed=True)) == ["traceback"]
