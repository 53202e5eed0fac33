"""Steps of one length (`run.real_time`): errors against closed forms, what overruns, what is refused, and stepping."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.errors import ModelError, RunWarning, UsageError
from fairlead.quantities import si

pytestmark = pytest.mark.filterwarnings("ignore::fairlead.RunWarning")
SLIDES = """
schema: 1
name: slides
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 2 kg, velocity: 1 m/s}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.5}}
  push: {type: ForceActuator}
  command: {type: SignalInput, start: 0}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, push.flange]
  - [command.signal, push.force]
run: {stop: 0.5 s}
interface: {inputs: {pull: {of: command.value, unit: N}}, outputs: {speed: block.v}}
"""
SLOWS = 5.0 / 2.0
"""m/s^2: 5 N of friction on 2 kg."""
SWINGS = """
schema: 1
name: swings
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 1 kg, position: 1 m}
  spring: {type: Spring, stiffness: 100 N/m}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.8, coulomb: 0.8}}
connections:
  - [floor.flange, pad.a, spring.a]
  - [pad.b, block.flange, spring.b]
run: {stop: 2.5 s}
"""


def model(tmp_path, text, name="scene", **values):
    path = tmp_path / f"{name}.yaml"
    path.write_text(text)
    return fairlead.load(path, values)


@pytest.mark.parametrize("step", [10e-3, 7e-3, 1e-3, 0.1e-3])
def test_a_block_that_slides_to_rest_is_off_by_no_more_than_one_switch_inside_a_step(tmp_path, step):
    """It rests after v/a = 0.4 s and v^2/(2 a) = 0.2 m. In the step of length h in which it does, s h after its
    beginning, the speed falls evenly to zero over all of h: that is a h^2 s (1 - s)/2 too far."""
    result = model(tmp_path, SLIDES).run(out=None, real_time=step)
    s = 0.4 / step - math.floor(0.4 / step + 1e-9)
    off = SLOWS * step**2 * s * (1 - s) / 2
    assert result["block.v"][-1] == pytest.approx(0.0, abs=1e-15)
    assert result["block.x"][-1] - 0.2 == pytest.approx(off, abs=1e-3 * SLOWS * step**2 + 1e-14)
    assert result.run["real_time"]["overruns"] == 0


def test_the_error_of_a_block_whose_slip_turns_round_falls_with_the_step(tmp_path):
    """Each half swing, of pi/10 s, takes 2 * 8 N/(100 N/m) of the amplitude: 1, -0.84, 0.68, -0.52, 0.36, -0.2, 0.04 m,
    where the spring no longer moves it. With t/T half swings done, x = c + (a - c) cos(10 t), c = +-0.08 m. A turn in
    the step misses up to half of what friction does while it changes by 16 N, which is 0.8 s times h of the place."""
    t = np.arange(1, 26) * 0.1
    half = np.floor(t / (np.pi / 10))
    side = np.where(half % 2 == 0, 1.0, -1.0)
    exact = side * (0.08 + (1.0 - 0.16 * half - 0.08) * np.cos(10 * t - half * np.pi))
    exact = np.where(half >= 6, 0.04, exact)
    errors = []
    for step in ("20 ms", "2 ms", "0.2 ms"):
        result = model(tmp_path, SWINGS).run(out=None, real_time=step)
        errors.append(np.abs(result.at("block.x", t) - exact).max())
        assert result.run["real_time"]["overruns"] == 0
        assert errors[-1] < 6 * 0.8 * si(step, "s")
    assert errors[2] < errors[1] / 3 < errors[0] / 9


def test_steps_end_with_frames_and_with_time_events_between(tmp_path):
    text = SLIDES.replace("run: {stop: 0.5 s}", "run: {stop: 10.4 ms}").replace(
        "command: {type: SignalInput, start: 0}",
        "command: {type: SampledSensor, period: 2.5 ms}\n  zero: {type: SignalInput, start: 0}",
    ).replace("[command.signal, push.force]", "[zero.signal, command.value]\n  - [command.signal, push.force]")
    text = text[: text.index("interface")]
    result = model(tmp_path, text).run(out=None, real_time="1 ms")
    ends = sorted({*range(11), 2.5, 5.0, 7.5, 10.0, 10.4})
    found = np.unique(np.round(result.t * 1e3, 9))
    assert set(ends) <= set(found.tolist())
    assert result.run["counters"]["steps"] == len(ends) - 1


def test_a_step_that_does_not_divide_the_run_is_followed_by_a_shorter_one(tmp_path):
    result = model(tmp_path, SLIDES).run(out=None, real_time="0.15 s")
    assert np.unique(np.round(result.t, 12)).tolist()[-1] == 0.5
    assert result.run["counters"]["steps"] == 4


def test_two_runs_and_renamed_parts_give_the_same_rows(tmp_path):
    one = model(tmp_path, SWINGS).run(out=None, real_time="3 ms")
    two = model(tmp_path, SWINGS).run(out=None, real_time="3 ms")
    other = model(tmp_path, SWINGS.replace("block", "aaa").replace("pad", "zzz")).run(out=None, real_time="3 ms")
    assert np.array_equal(one.t, two.t)
    assert np.array_equal(one["block.x"], two["block.x"])
    assert np.array_equal(one["block.x"], other["aaa.x"])


@pytest.mark.parametrize("every", [1, 5])
def test_a_run_that_is_stepped_from_outside_goes_the_same_way(tmp_path, every):
    """Where nothing is set, an `advance` to the end of a frame is no event."""
    scene = model(tmp_path, SWINGS)
    result = scene.run(out=None, real_time="1 ms", stop="1 s")
    run = scene.start(real_time="1 ms", stop="1 s")
    for k in range(every, 1001, every):
        run.advance(k * 1e-3)
        assert run.get("block.x") == result.at("block.x", np.array([k * 1e-3]))[0]
    assert run.overruns == 0


def test_an_input_is_taken_at_the_frame_at_which_it_is_set(tmp_path):
    """From 0.1 s on 9 N pull on 2 kg against 5 N: 2 m/s^2, exact since the force is constant."""
    run = model(tmp_path, SLIDES).start(real_time="10 ms")
    run.advance(0.1)
    assert run.get("speed") == pytest.approx(1.0 - 0.1 * SLOWS, abs=1e-12)
    run.set("pull", 9.0)
    run.advance(0.2)
    assert run.get("speed") == pytest.approx(1.0 - 0.1 * SLOWS + 0.1 * 2.0, abs=1e-12)
    state = run.save()
    run.advance(0.3)
    there = run.get("block.x")
    run.restore(state)
    run.advance(0.3)
    assert run.get("block.x") == there


def test_steps_that_meet_the_bound_are_counted_and_told_and_the_run_ends(tmp_path):
    """Two contacts of the treatment `binding` that creep on each other have zones that no step of 10 ms finds."""
    with pytest.warns(RunWarning, match="overran the bound on their work, first at t = 0 s"):
        result = fairlead.load("sandwich").run(out=None, real_time="10 ms", stop="0.2 s")
    kept = result.run["real_time"]
    assert result.ok
    assert kept["steps"] == 20
    assert 0 < kept["overruns"] <= 20
    assert kept["first"]["t"] == 0.0
    assert kept["first"]["what"].endswith("was to change its zone once more")
    assert all(np.isfinite(result[one.name]).all() for one in result.signals)
    counters = result.run["counters"]
    assert counters["overruns"] == kept["overruns"]
    assert counters["solves"] <= 20 * 36  # sixteen a step, twice, some for its end of order three, and the start


def test_overruns_are_told_while_a_run_is_stepped():
    run = fairlead.load("sandwich").start(real_time="10 ms")
    run.advance("10 ms")
    seen, state = run.overruns, run.save()
    assert seen == 1
    run.advance("0.1 s")
    assert seen < run.overruns <= 10
    run.restore(state)
    assert run.overruns == seen


@pytest.mark.parametrize(
    ("settings", "says"),
    [
        ({"real_time": 0}, "run.real_time = 0 is not above 0"),
        ({"real_time": "-1 ms"}, "run.real_time = -1 ms"),
        ({"real_time": float("nan")}, "run.real_time = nan"),
        ({"real_time": "1 mm"}, "run.real_time = 1 mm is a length, not a time"),
        ({"real_time": "11 s"}, "real_time = 11 s is longer than the run, which lasts"),
        ({"real_time": "1e-12 s"}, "real_time = 1e-12 s is too short for a run to"),
        ({"real_time": "1 ms", "engine": "rodas"}, "and engine = rodas, which has no steps of one length"),
        ({"real_time": "1 ms", "max_step": "0.1 ms"}, "and max_step = 0.0001 s"),
        ({"real_time": "1 ms", "first_step": "1 ms"}, "All steps are alike: leave first_step out."),
    ],
)
def test_steps_that_no_run_could_have_are_refused(settings, says):
    with pytest.raises(ModelError) as caught:
        fairlead.load("belt").run(out=None, stop="10 s", **settings)
    assert says in str(caught.value)
    assert "\n    " in str(caught.value)  # a way out


def test_a_netlist_is_told_file_and_line(tmp_path):
    with pytest.raises(ModelError, match=r"scene\.yaml:\d+:.*real_time = 1 s is longer than the run"):
        model(tmp_path, SLIDES.replace("run: {stop: 0.5 s}", "run: {stop: 0.5 s, real_time: 1 s}")).check()


def test_what_stepping_does_not_take_is_refused_by_name():
    with pytest.raises(UsageError, match=r"run\.real_time: stepping does not bring positions back to what drum"):
        fairlead.load("machines/traction_winch").run(out=None, real_time="1 ms")
    with pytest.raises(UsageError, match=r"Leave run\.real_time out: only stepping"):
        fairlead.load("machines/traction_winch").start(real_time="1 ms")


def test_auto_takes_stepping_and_says_why(tmp_path):
    result = model(tmp_path, SLIDES).run(out=None, real_time="1 ms")
    assert result.run["engine"] == "stepping"
    assert "steps of one length" in result.run["engine_reason"]


def test_the_command_keeps_time_and_tells_how_that_went(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "slides.yaml").write_text(SLIDES)
    said = CliRunner().invoke(app, ["run", "slides.yaml", "--real-time", "1ms", "--set", "run.stop=0.05"])
    assert said.exit_code == 0, said.output
    assert "0 of 50 steps of 1 ms overran the bound on their work" in said.output
    assert "the longest step took" in said.output
    kept = json.loads((tmp_path / "results" / "slides" / "run.json").read_text())["real_time"]
    assert kept["clock"]["frames"] == 50
    assert 0 <= kept["clock"]["late"] <= 50
    paced = fairlead.Result.open("results/slides")
    plain = fairlead.load("slides.yaml", {"run.stop": "0.05"}).run(out=None, real_time="1 ms")
    assert np.array_equal(paced["block.x"], plain["block.x"])


def test_the_command_names_its_option_where_the_step_is_wrong(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "slides.yaml").write_text(SLIDES)
    said = CliRunner().invoke(app, ["run", "slides.yaml", "--real-time", "1mm"])
    assert said.exit_code != 0
    assert "--real-time: run.real_time = 1 mm is a length, not a time" in said.output
    twice = CliRunner().invoke(app, ["run", "slides.yaml", "--real-time", "1ms", "--set", "run.real_time=2ms"])
    assert "Leave one of them out" in twice.output.replace("\n", " ").replace("│ ", "")
