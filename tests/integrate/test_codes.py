"""What compiled functions return: no number says two things; Python, sentences and FMUs have the same statuses."""

import pathlib
import re

import pytest

import fairlead.integrate.codes as codes
from fairlead.integrate.problem import Status
from fairlead.integrate.sentences import sentence_of
from fairlead.integrate.underway import SERVED

LINEAR = ("DONE", "SINGULAR", "INACCURATE")
OF_A_SETTLEMENT = ("NOT_CONSISTENT", "TOO_MANY_PASSES", "NO_ROOM", "RELEASED", "RUBBED", "APART")
OF_A_STEP = ("CYCLES", "DIVERGES", "JUMPS", "ONCE_MORE", "AFRESH")
STATUSES = {"SINGULAR_MATRIX" if status.name == "SINGULAR" else status.name: status for status in Status}
ONLY_PYTHON = {Status.FINISHED, Status.RESTRICT, Status.REACTIVATE, Status.MAX_WALL, Status.INTERRUPTED}
"""Statuses that the loop of an FMU never returns: it has no end, no parts, and no clock."""
ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_no_two_things_that_functions_return_have_one_number():
    names = [*STATUSES, *LINEAR, *OF_A_SETTLEMENT, *OF_A_STEP, "GO_ON"]
    assert len({getattr(codes, name) for name in names}) == len(names)


def test_statuses_have_the_numbers_that_compiled_code_returns():
    assert {name: int(status) for name, status in STATUSES.items()} == {name: getattr(codes, name) for name in STATUSES}


def test_statuses_that_were_given_out_keep_their_numbers():
    """They leave the engine: FMUs, saved runs and callers of `integrate` know them."""
    assert [Status(number).name for number in range(-5, 14)] == [
        "REACTIVATE", "RESTRICT", "REPLAN", "BUFFER_FULL", "PAUSED", "FINISHED", "STEP_FLOOR", "NOT_FINITE",
        "NOT_SETTLED", "INCONSISTENT", "SINGULAR", "CHATTER", "MAX_STEPS", "MAX_EVENTS", "MAX_WALL", "INTERRUPTED",
        "REBOUND_RUBS",
        "ENDED", "GIVEN_APART",
    ]  # fmt: skip


@pytest.mark.parametrize("module", ["linear/systems", "events/consistent", "events/settling", "stepping/theta_step"])
def test_outcomes_are_defined_in_one_place(module):
    text = (ROOT / "src" / "fairlead" / "integrate" / f"{module}.py").read_text(encoding="utf-8")
    names = "|".join((*LINEAR, *OF_A_SETTLEMENT, *OF_A_STEP))
    assert not re.findall(rf"^(?:[A-Z_]+, )*(?:{names})(?:, [A-Z_]+)* = ", text, flags=re.MULTILINE)


def test_every_status_that_ends_a_run_has_a_sentence():
    text = pathlib.Path(sentence_of.__code__.co_filename).read_text(encoding="utf-8")
    told = set(re.findall(r"^        Status\.([A-Z_]+): ", text, flags=re.MULTILINE))
    assert told == {status.name for status in Status if status not in SERVED} - {"ENDED"}  # which brings its own


def test_the_wrapper_of_fmus_knows_every_status_that_its_loop_returns():
    text = (ROOT / "src" / "fairlead" / "fmu" / "c" / "run.c").read_text(encoding="utf-8")
    assert set(re.findall(r"\bSTATUS_([A-Z_]+)\b", text)) == {status.name for status in set(Status) - ONLY_PYTHON}
