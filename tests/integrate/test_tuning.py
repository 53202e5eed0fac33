"""Parameters that change while a run is stepped from outside: closed forms, and runs that nothing changes."""

import numpy as np
import pytest

import fairlead
from fairlead.errors import ModelError, UsageError

ENGINES = ("rodas", "stepping")

PUSHED = """
schema: 1
name: pushed
parameters: {mu: 0.5, weight: 10 N}
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 2 kg, velocity: 0 m/s}
  pad: {type: Contact, normal_force: "{weight}", curve: {curve: coulomb, stiction: "{mu}", coulomb: "{mu}"}}
  push: {type: ForceSource, force: 9 N}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, push.flange]
run: {stop: 1 s, accuracy: 1e-8}
"""
"""9 N against mu N on 2 kg."""

SPRUNG = """
schema: 1
name: sprung
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  body: {type: Mass, mass: 1 kg, position: 0.1 m, velocity: 0 m/s}
connections:
  - [wall.flange, spring.a]
  - [spring.b, body.flange]
run: {stop: 1 s, accuracy: 1e-9}
"""


def load(folder, text):
    file = folder / "scene.yaml"
    file.write_text(text, encoding="utf-8")
    return fairlead.load(file)


@pytest.mark.parametrize("method", ["hold", "binding", "lugre"])
@pytest.mark.parametrize("engine", ENGINES)
def test_friction_and_mass_change_under_way(tmp_path, engine, method):
    """v' = (9 N - mu N)/m with what holds from each point on.

    What a treatment does before it slides is over by 0.1 s; bristles go over to another load in a thousandth of the
    impulse.
    """
    model = load(tmp_path, PUSHED + f"friction: {{method: {method}}}\n")
    tolerance = 1e-7 if method == "hold" else 1e-3 * 0.275
    run = model.start(tunable=["weight", "mu", "block.mass"], engine=engine)
    run.advance(0.1)
    first = run.get("block.v")
    assert first == pytest.approx(0.2, rel=1e-7 if method == "hold" else 0.03)
    run.set("weight", "14 N")
    assert run.get("block.v") == first  # nothing has happened yet
    run.advance(0.2)
    second = run.get("block.v")
    assert second - first == pytest.approx(0.1 * (9 - 7) / 2, abs=tolerance)
    run.set("block.mass", 1)
    run.set("mu", 0.25)  # both at once
    run.advance(0.3)
    assert run.get("block.v") - second == pytest.approx(0.1 * (9 - 3.5) / 1, abs=2 * tolerance)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_contact_that_holds_lets_go_when_less_holds_it(tmp_path, engine):
    model = load(tmp_path, PUSHED)
    run = model.start(tunable=["mu"], engine=engine)
    run.set("mu", 1.0)  # before the first step: from the start
    run.advance(0.5)
    assert run.get("block.v") == 0.0
    run.set("mu", 0.5)
    run.advance(0.7)
    assert run.get("block.v") == pytest.approx(0.2 * (9 - 5) / 2, abs=1e-7)
    run.set("mu", 1.0)
    run.advance(3.0, until_change=True)
    assert run.t == pytest.approx(0.7 + 0.4 / 0.5, abs=1e-6)  # stopped by 1 N on 2 kg
    assert [change.component for change in run.changes] == ["pad"]


def test_a_spring_that_gets_stiffer_swings_on_from_where_it_is(tmp_path):
    """x = x1 cos(w t) + v1/w sin(w t) with the new w, from the point at which it changed."""
    run = load(tmp_path, SPRUNG).start(tunable=["spring.stiffness"], engine="rodas")
    run.advance(0.05)
    x, v = 0.1 * np.cos(0.5), -1.0 * np.sin(0.5)
    run.set("spring.stiffness", "400 N/m")
    run.advance(0.2)
    assert run.get("body.x") == pytest.approx(x * np.cos(3.0) + v / 20 * np.sin(3.0), abs=1e-8)


def test_a_state_from_before_a_change_takes_the_former_value_back(tmp_path):
    run = load(tmp_path, PUSHED).start(tunable=["weight"], engine="rodas")
    run.advance(0.1)
    before = run.save()
    run.set("weight", 14)
    pending = run.save()
    run.advance(0.2)
    after = run.save()
    for _ in range(2):
        run.restore(before)
        run.advance(0.2)
        assert run.get("block.v") == pytest.approx(0.4, abs=1e-7)
        run.restore(pending)
        run.advance(0.2)
        assert run.get("block.v") == pytest.approx(0.3, abs=1e-7)
        run.restore(after)
        run.advance(0.3)
        assert run.get("block.v") == pytest.approx(0.4, abs=1e-7)
    other = load(tmp_path, PUSHED).start()
    with pytest.raises(UsageError, match="loaded apart from this one"):
        other.restore(after)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("name", "value"), [("drum.moment", 1150.0), ("control.gain", 0.3)])
def test_under_sampled_control_a_value_set_anew_changes_nothing_but_the_steps(engine, name, value):
    """Samples, integrals and inputs go along: the run differs from an untouched one by its accuracy."""
    model = fairlead.load("winch_drive")
    touched, untouched = model.start(tunable=[name], engine=engine), model.start(engine=engine)
    for k in range(1, 61):
        if k % 7 == 0:
            touched.set(name, value * (1 + 1e-13))
        for run in (touched, untouched):
            run.advance(0.033 * k)
    for signal in ("drive.speed", "drive.opening", "line.v"):
        assert touched.get(signal) == pytest.approx(untouched.get(signal), rel=1e-3, abs=1e-6), signal


@pytest.mark.parametrize("engine", ENGINES)
def test_what_is_given_in_time_goes_on(tmp_path, engine):
    """A ramp of 90 N/s up to 9 N; 5 N hold until, at 0.05 s, 1 N does: v' = (90 t - 1)/2, later (9 - 1)/2."""
    model = load(tmp_path, PUSHED.replace("force: 9 N", "force: {ramp: {to: 9 N, over: 0.1 s}}"))
    run = model.start(tunable=["weight"], engine=engine)
    run.advance(0.05)
    assert run.get("block.v") == pytest.approx(0.0, abs=1e-15)
    run.set("weight", "2 N")
    run.advance(0.1)
    assert run.get("block.v") == pytest.approx(0.14375, abs=1e-6)
    run.set("weight", "2.5 N")
    run.advance(0.2)
    assert run.get("block.v") == pytest.approx(0.14375 + 0.1 * (9 - 1.25) / 2, abs=1e-6)


def test_what_cannot_be_set_is_told_with_what_can(tmp_path):
    model = load(tmp_path, PUSHED)
    with pytest.raises(ModelError, match=r"no parameter pad.normal_forc.*\n.*pad.normal_force"):
        model.start(tunable=["pad.normal_forc"])
    with pytest.raises(ModelError, match=r"no parameter nu\. Did you mean mu"):
        model.start(tunable=["nu"])
    with pytest.raises(ModelError, match="is not a list"):
        model.start(tunable="mu")
    run = model.start(tunable=["weight", "block.velocity"])
    with pytest.raises(UsageError, match="Tunable are weight"):
        run.set("pad.normal_force", 3)
    with pytest.raises(ModelError, match="at least 0 N"):
        run.set("weight", -3)
    other = model.start(tunable=["block.velocity"])
    other.set("block.velocity", 0.4)
    assert other.get("block.v") == 0.4  # before the start it says how to begin
    run.advance(0.1)
    with pytest.raises(UsageError, match="says how a run begins"):
        run.set("block.velocity", 3)
    run.advance(0.2)  # what was refused has left nothing behind
    assert run.get("block.v") == pytest.approx(0.4, abs=1e-4)


def test_a_value_that_stays_is_no_event_and_one_that_nothing_follows_is_told(tmp_path):
    one, other = (load(tmp_path, PUSHED).start(tunable=["mu", "pad.curve.coulomb", "pad.curve.stiction"]) for _ in "ab")
    one.advance(0.1)
    one.set("mu", 0.5)
    one.advance(0.2)
    other.advance(0.1)
    other.advance(0.2)
    assert one.get("block.x") == other.get("block.x")
    other.set("pad.curve.stiction", 0.6)
    other.set("pad.curve.coulomb", 0.6)
    with pytest.raises(UsageError, match="nothing follows mu: another value stands where it is read"):
        other.set("mu", 0.7)


def test_a_state_of_a_run_with_other_tunables_is_gone_on_from_with_those_of_this_one(tmp_path):
    """9 N against 5 N, and from the state on against 7 N or 9 N, on 2 kg."""
    model = load(tmp_path, PUSHED)
    one, other = model.start(tunable=["weight"], engine="rodas"), model.start(tunable=["mu"], engine="rodas")
    one.advance(0.1)
    one.set("weight", 14)
    other.restore(one.save())
    other.advance(0.2)
    assert other.get("block.v") == pytest.approx(0.2 + 0.1, abs=1e-7)
    other.set("mu", 9 / 14)
    other.advance(0.3)
    assert other.get("block.v") == pytest.approx(0.3, abs=1e-7)
    with pytest.raises(UsageError, match="Tunable are mu"):
        other.set("weight", 3)


def test_the_start_of_an_input_is_no_parameter_beside_it(tmp_path):
    text = PUSHED.replace(
        "push: {type: ForceSource, force: 9 N}", "push: {type: ForceActuator}\n  cmd: {type: SignalInput, start: 9}"
    )
    text = text.replace("run:", "  - [cmd.signal, push.force]\nrun:") + "interface: {inputs: {pull: cmd.value}}\n"
    with pytest.raises(ModelError, match=r"cmd\.start is what the input pull is until it is set"):
        load(tmp_path, text).start(tunable=["cmd.start"])


def test_parameters_of_a_device_on_a_route_go_by_its_name():
    """As `--set` and the signals call it."""
    run = fairlead.load("single_bend").start(tunable=["route.stations.bend.radius", "route.stations.bend.friction"])
    told = {one.name: (one.start, one.unit) for one in run.variables if one.causality == "parameter"}
    assert told == {"route.stations.bend.radius": (1.0, "m"), "route.stations.bend.friction": (0.35, "1")}
    run.set("route.stations.bend.friction", 0.5)
    assert run.advance(0.01) == 0.01


@pytest.mark.parametrize(
    ("value", "says"),
    [
        (-1, "set: block.mass = -1 is out of range."),
        ("3 N", "set: block.mass = 3 N is a force, not a mass."),
        (None, "set: block.mass = None is neither a text nor a number"),
        (float("nan"), "set: block.mass = nan is not a number"),
        ([1], "set: block.mass = [1] is neither a text nor a number"),
    ],
)
def test_a_value_that_does_not_fit_is_told_as_of_the_call_that_gave_it(tmp_path, value, says):
    run = load(tmp_path, PUSHED).start(tunable=["block.mass"])
    with pytest.raises(ModelError) as caught:
        run.set("block.mass", value)
    assert str(caught.value).startswith(says)


def test_a_value_by_its_outer_name_is_told_with_both(tmp_path):
    run = load(tmp_path, PUSHED + "interface: {tunable: {load: block.mass}}\n").start()
    with pytest.raises(ModelError, match=r"set: load: block\.mass = -1 is out of range"):
        run.set("load", -1)
