"""What `Model.run` does with a run that does not finish, and with what a run remarks."""

import pickle
import signal
import warnings

import numpy as np
import pytest

import fairlead
from fairlead import RunError, RunInterrupted, RunWarning

BLOCK = """
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg, position: 0.1 m}
connections: [[wall.flange, spring.a], [spring.b, block.flange]]
run: {stop: 1 s, accuracy: 1e-6}
record: {signals: [block.x], every: 10 ms}
"""
LIMITED = BLOCK + "limits: {block.x: {below: 50 mm}}\n"
TORN = """
components:
  wall: {type: Ground}
  line: {type: Hose, axial_stiffness: 100 N, length: 2 m}
  hand: {type: MotionSource, position: {table: [[0 s, 2 m], [1 s, -1 m]]}}
connections: [[wall.flange, line.a], [hand.flange, line.b]]
run: {stop: 1 s}
"""


def test_a_run_that_uses_up_a_budget_raises_what_it_computed(scene, tmp_path):
    with pytest.raises(RunError, match=r"scene: budget: .*\n    What was computed is in `\.result`") as caught:
        scene(BLOCK).run(out=tmp_path / "run", max_steps=5)
    result = caught.value.result
    assert (result.ok, result.status, caught.value.exit_code) == (False, "budget", 4)
    assert result["block.x"][0] == pytest.approx(0.1)
    assert 0.0 < result.t[-1] < 1.0
    assert str(tmp_path / "run") in str(caught.value)


def test_a_run_that_fails_raises_what_it_computed(scene):
    """The hose is as long as no hose can be when the hand comes to 0 m, at 2/3 s."""
    with pytest.raises(RunError, match="inside out") as caught:
        scene(TORN).run(out=None)
    assert caught.value.exit_code == 3
    assert 2 / 3 <= caught.value.result.run["end_time"] < 1.0  # the end of the step in which it came to that


def test_without_the_check_the_result_is_returned(scene):
    result = scene(BLOCK).run(out=None, max_steps=5, check=False)
    assert (result.ok, result.status) == (False, "budget")
    assert "5 steps" in result.run["sentence"]


def test_a_run_that_finishes_is_ok_and_says_nothing(scene):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = scene(BLOCK).run(out=None)
    assert (result.ok, result.status, result.remarks) == (True, "finished", ())
    assert result["block.x"][-1] == pytest.approx(0.1 * np.cos(10.0), abs=1e-5)


def test_a_broken_limit_is_warned_of_in_the_line_of_the_caller(scene):
    with pytest.warns(RunWarning, match=r"limit broken: block\.x = 0\.1 m at t = .* s, allowed: below 50 mm") as caught:
        result = scene(LIMITED).run(out=None)
    assert caught[0].filename == __file__
    assert result.ok  # it reached its stop
    assert result.remarks == tuple(str(one.message) for one in caught)


@pytest.mark.slow
def test_what_check_remarks_is_warned_of_and_read_again_from_the_folder(tmp_path):
    model = fairlead.load("weak_clamp", set={"run.stop": "10 ms"})
    remarks = tuple(map(str, model.check()))
    with pytest.warns(RunWarning, match="They will slip"):
        result = model.run(out=tmp_path / "run")
    assert remarks
    assert fairlead.Result.open(tmp_path / "run").remarks == result.remarks == remarks


def test_warnings_of_runs_can_be_silenced_by_their_category(scene):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", RunWarning)
        assert scene(LIMITED).run(out=None).remarks


def test_ctrl_c_is_a_run_error_and_a_keyboard_interrupt_with_the_rows_so_far(scene):
    model = scene(BLOCK, **{"run.stop": "1000 s", "run.max_steps": "100000000", "record.every": "1 s"})

    pressed = []

    def press(*_):
        if not pressed:
            pressed.append(True)
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt) as caught:
        model.run(out=None, progress=press)
    assert isinstance(caught.value, RunInterrupted)
    assert isinstance(caught.value, RunError)
    assert caught.value.result.status == "interrupted"
    assert caught.value.exit_code == 130
    assert len(caught.value.result.t)


def test_the_error_of_a_run_comes_back_from_another_process(scene):
    with pytest.raises(RunError) as caught:
        scene(BLOCK).run(out=None, max_steps=5)
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value)
    assert np.array_equal(again.result["block.x"], caught.value.result["block.x"])
