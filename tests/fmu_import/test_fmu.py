"""FMUs of other makers inside a model: exact results, signals in SI, and every failure named with its way out."""

import math
import re
import time

import numpy as np
import pytest

from fairlead.errors import RunError, UsageError
from fairlead.foreign import process
from fairlead.foreign.process import ForeignProcess
from tests.fmu_import.build import ONE

FEED3 = {"Float64": 0.1, "Float32": 0.1, "Int8": -128, "UInt8": 255, "Int16": -32768, "UInt16": 65535,
         "Int32": -(2**31), "UInt32": 2**32 - 1, "Int64": 2**53, "UInt64": 2**53, "Boolean": 1}  # fmt: skip
FEED2 = {"Real": 0.1, "Integer": -7, "Boolean": 1}


def through(kinds):
    """Variables of a feed-through: for each type one input and the output that follows it."""
    listed = [
        {"name": f"{kind}_{side}", "ref": number + 16 * (side == "out"), "causality": f"{side}put", "kind": kind,
         **({"start": "false" if kind == "Boolean" else 0} if side == "in" else {})}
        for number, kind in enumerate(kinds) for side in ("in", "out")
    ]  # fmt: skip
    text = {"name": "text", "ref": 0, "causality": "parameter", "kind": "String", "variability": "fixed", "start": ""}
    return [*listed, text, {"name": "length", "ref": 31, "causality": "output", "kind": "Int32"}]


def fall(t, height=1.0, restitution=0.5, g=10.0):
    """(height, bounces) of a ball dropped from rest: flights of 2 v/g, each begun at `restitution` times the speed."""
    at, speed, bounces = math.sqrt(2 * height / g), math.sqrt(2 * height * g), 1
    if t < at:
        return height - g * t**2 / 2, 0
    while True:
        speed *= restitution
        if t < at + 2 * speed / g:
            return speed * (t - at) - g * (t - at) ** 2 / 2, bounces
        at, bounces = at + 2 * speed / g, bounces + 1


def test_fmus_of_both_versions_step_from_point_to_point_and_hold_in_between(make, load, started):
    """At t_k the FMU is where its own equation is at t_k; names, parameters and units as the netlist says."""
    make("decay", 3)
    make("ball", 2)
    make("counter", 3, step=0.05)
    make("talks", 3)
    result = load("""
        components:
          decay: {type: Fmu, file: decay3.fmu, period: 10 ms, parameters: {rate: 180 1/min}}
          ball: {type: Fmu, file: ball2.fmu, period: 7 ms, outputs: {height: h, hits: bounces}}
          counter: {type: Fmu, file: counter3.fmu}
          talks: {type: Fmu, file: talks3.fmu, period: 0.1 s}
        run: {stop: 1.25 s}
        record: {signals: ["*"]}
    """).run(out=None)
    points = 0.01 * np.arange(125)
    np.testing.assert_allclose(result.at("decay.x", points + 0.004), 1e-3 * np.exp(-3 * points), rtol=1e-13)
    units = {signal.name: signal.unit for signal in result.signals}
    assert (units["decay.x"], units["ball.height"], units["ball.hits"]) == ("m", "m", "1")
    points = 0.007 * np.arange(178)
    heights, bounces = np.transpose([fall(t) for t in points])
    np.testing.assert_allclose(result.at("ball.height", points + 0.003), heights, atol=1e-12)
    np.testing.assert_allclose(result.at("ball.hits", points + 0.003), bounces, atol=1e-12)
    assert "ball.v" not in units
    points = 0.05 * np.arange(25)
    counted = [result.at(f"counter.{name}", points + 0.02) for name in ("count", "odd", "last_t", "last_step")]
    wanted = [np.arange(25), np.arange(25) % 2, np.maximum(points - 0.05, 0), [0.0, *[0.05] * 24]]
    np.testing.assert_allclose(counted, wanted, atol=1e-12)
    assert result.at("talks.x", 0.95) == pytest.approx(9)  # what it prints is taken for no answer
    assert all(one.poll() is not None for one in started)


@pytest.mark.parametrize(("version", "kinds"), [(3, FEED3), pytest.param(2, FEED2, marks=pytest.mark.slow)])
def test_every_type_passes_through_unchanged(make, load, version, kinds):
    make("feed", version, through(kinds))
    sources = "\n".join(f"  {kind.lower()}: {{type: SignalSource, value: {kinds[kind]}}}" for kind in kinds)
    joined = "\n".join(f"  - [{kind.lower()}.signal, feed.{kind}_in]" for kind in kinds)
    scene = f"""
components:
  feed: {{type: Fmu, file: feed{version}.fmu, period: 0.1 s, parameters: {{text: pässe}}}}
{sources}
connections:
{joined}
run: {{stop: 0.15 s}}
"""
    result = load(scene).run(out=None)
    for kind, value in kinds.items():
        wanted = float(np.float32(value)) if kind == "Float32" else value
        assert result.at(f"feed.{kind}_out", 0.05) == wanted, kind  # at the point itself, not one later
    assert result.at("feed.length", 0.05) == len("pässe".encode())


PUSHED = """
    components:
      cart: {type: Mass, mass: 2 kg, position: 0 m, velocity: 1 m/s}
      seen: {type: MotionSensor}
      gain: {type: SignalGain, gain: -8}
      control: {type: Fmu, file: feed3.fmu, period: 50 ms, inputs: {speed: {of: u, unit: mm/s}},
                outputs: {force: {of: y, unit: mN}}}
      push: {type: ForceActuator}
    connections:
      - [cart.flange, seen.flange, push.flange]
      - [seen.v, control.speed]
      - [control.force, gain.value]
      - [gain.signal, push.force]
    run: {stop: 1 s}
"""
ONE_THROUGH = [
    {"name": "u", "ref": 0, "causality": "input", "start": 0},
    {"name": "y", "ref": 16, "causality": "output"},
]


@pytest.mark.parametrize("engine", ["rodas", pytest.param("stepping", marks=pytest.mark.slow)])
def test_a_loop_through_an_fmu_is_the_exact_recursion_of_a_held_force(make, load, engine):
    """v' = -8 v(t_k)/2 between points:  v_{k+1} = v_k (1 - 4 T). The scales of u and y are undone on both sides."""
    make("feed", 3, ONE_THROUGH)
    result = load(PUSHED, set={"run.engine": engine}).run(out=None)
    np.testing.assert_allclose(result.at("cart.v", 0.05 * np.arange(20)), 0.8 ** np.arange(20), rtol=1e-8)


@pytest.fixture
def patiently(monkeypatch):
    """Calls that come back have the time that a busy machine takes; the one that hangs has its limit."""
    ask = ForeignProcess.ask

    def asked(self, question, limit):
        return ask(self, question, limit if question.get("to", 0.0) > 0.055 else 120.0)

    monkeypatch.setattr(ForeignProcess, "ask", asked)


@pytest.mark.parametrize(
    ("kind", "told"),
    [
        ("crash", r"the process of crash3.fmu ended by SIGSEGV in doStep\. .*ask its maker"),
        pytest.param(
            "leave", r"leave3.fmu ended with exit code 3 in doStep.*It printed: no licence", marks=pytest.mark.slow
        ),
        ("hang", r"hang3.fmu did not come back from doStep within 2 s, .*longer time_limit"),
        ("nan", r"nan3.fmu gives x = -?nan\. Look at its inputs"),
        pytest.param(
            "error", r"error3.fmu: FMICallException: fmi3DoStep failed with status 3 \(error\)", marks=pytest.mark.slow
        ),
        pytest.param("ends", r"ends3.fmu: it asks to end the simulation at 0\.06 s", marks=pytest.mark.slow),
        pytest.param("ends2", r"ends2.fmu: it asks to end the simulation at 0\.0\d s", marks=pytest.mark.slow),
    ],
)
def test_what_goes_wrong_in_an_fmu_is_told_with_its_time_and_results_are_kept(
    make, load, started, patiently, kind, told
):
    file = make(kind.rstrip("2"), 2 if kind.endswith("2") else 3).name
    limit = "2 s" if kind == "hang" else "60 s"
    scene = f"""
        components:
          fmu: {{type: Fmu, file: {file}, period: 10 ms, time_limit: {limit}}}
          ramp: {{type: SignalSource, value: {{ramp: {{to: 1, over: 1 s}}}}}}
        run: {{stop: 1 s}}
        record: {{every: 10 ms}}
    """
    with pytest.raises(RunError, match=told) as ended:
        load(scene).run(out=None)
    result = ended.value.result
    assert re.search(r"t = 0\.06 s: fmu", result.run["sentence"])
    assert result.status == "failed"
    assert result.t[-1] >= 0.05
    assert all(one.poll() is not None for one in started)


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "told"), [("leave", "ended with exit code 3"), ("scold", "failed with status 3")])
def test_what_was_printed_before_a_failure_is_told_however_late_it_is_read(make, load, monkeypatch, kind, told):
    """On a busy machine the thread that reads it has its turn when the failure has been known for long."""
    read = process._words
    monkeypatch.setattr(process, "_words", lambda *given: (time.sleep(1.5), read(*given)))
    make(kind, 3)
    scene = f"components: {{fmu: {{type: Fmu, file: {kind}3.fmu, period: 10 ms}}}}\nrun: {{stop: 1 s}}"
    with pytest.raises(RunError, match=f"{told}.*It printed: no licence"):
        load(scene).run(out=None)


def test_a_value_that_the_type_of_an_input_does_not_hold_is_refused(make, load):
    make("feed", 3, through(FEED3))
    scene = """
        components:
          feed: {type: Fmu, file: feed3.fmu, period: 0.1 s}
          source: {type: SignalSource, value: %s}
        connections: [[source.signal, feed.%s_in]]
        run: {stop: 0.15 s}
    """
    with pytest.raises(RunError, match=r"the input Int8_in = 1\.5 is no whole number. Int8_in is Int8 in the FMU: a w"):
        load(scene % (1.5, "Int8")).run(out=None)


def test_an_fmu_runs_only_where_it_is_allowed(make, load, started, folder):
    from typer.testing import CliRunner

    from fairlead.cli import app

    make("decay", 3)
    model = load(
        "components: {decay: {type: Fmu, file: decay3.fmu, period: 10 ms}}\nrun: {stop: 0.1 s}", allow_fmu=False
    )
    assert model.check() == []
    for way in (lambda: model.run(out=None), model.start, lambda: model.with_values({"run.stop": 0.2}).run(out=None)):
        with pytest.raises(UsageError, match=r"decay \(decay3\.fmu\) is an FMU and not run.*--allow-fmu"):
            way()
    answer = CliRunner().invoke(app, ["run", str(model.netlist.path), "--out", str(folder / "refused")])
    assert answer.exit_code == 2
    assert "--allow-fmu" in answer.output
    assert not started


@pytest.mark.slow
def test_a_run_with_an_fmu_is_saved_and_restored(make, load):
    make("counter", 3)
    make("decay", 2)
    text = """
        components:
          counter: {type: Fmu, file: counter3.fmu, period: 0.1 s}
          decay: {type: Fmu, file: decay2.fmu, period: 0.1 s, parameters: {rate: 2}}
        run: {stop: 1 s}
    """
    run = load(text).start()
    run.advance(0.35)
    state = run.save()
    run.advance(0.75)
    assert run.get("counter.count") == 7
    run.restore(state)
    assert run.get("counter.count") == 3
    for goal in (0.55, 0.75):
        run.advance(goal)
    assert run.get("counter.count") == 7
    assert run.get("decay.x") == pytest.approx(1e-3 * math.exp(-1.4), rel=1e-13)
    other = run.save()
    run.restore(state)  # a state serves more than once
    run.advance(0.45)
    assert run.get("counter.count") == 4
    run.restore(other)
    assert run.get("counter.count") == 7


def test_a_run_with_an_fmu_that_keeps_no_state_is_not_saved(make, load):
    from fairlead.errors import FairleadError

    make("decay", 3, state=False, name="stateless")
    run = load("components: {fmu: {type: Fmu, file: stateless3.fmu, period: 0.1 s}}\nrun: {stop: 1 s}").start()
    run.advance(0.15)
    with pytest.raises(FairleadError, match=r"stateless3\.fmu cannot give its state \(canGetAndSetFMUState\)"):
        run.save()
    assert run.get("fmu.x") == pytest.approx(1e-3 * math.exp(-0.1))


@pytest.mark.slow
def test_cases_of_a_sweep_each_have_a_process_of_their_own(make, load, started):
    make("decay", 3, ONE)
    model = load("components: {fmu: {type: Fmu, file: decay3.fmu, period: 0.1 s}}\nrun: {stop: 1 s}")
    for k in range(5):
        model.with_values({"run.stop": 1 + 0.1 * k}).run(out=None)
    assert len(started) == 5
    assert all(one.poll() is not None for one in started)
