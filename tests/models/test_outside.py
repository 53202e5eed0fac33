"""Runs that are stepped from outside: where they land, what is set, early returns, copies, ends and messages."""

import numpy as np
import pytest

import fairlead
from tests.reference.belt import StickSlipBelt

FLOOR, BLOCK, WEIGHT = 5.0, 2.0, 10.0  # N of friction, kg, N
PUSHED = """
schema: 1
name: pushed
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 2 kg}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.5}}
  push: {type: ForceActuator}
  command: {type: SignalInput, start: 1}
  spare: {type: SignalInput}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, push.flange]
  - [command.signal, push.force]
run: {stop: 1 s}
interface:
  inputs: {pull: {of: command.value, unit: N}, other: spare.value}
  outputs: {speed: block.v, force: {of: push.power}}
"""
ENGINES = ["rodas", "stepping"]


@pytest.fixture(scope="module")
def pushed(tmp_path_factory):
    """A block on a floor, pushed from outside."""
    path = tmp_path_factory.mktemp("outside") / "pushed.yaml"
    path.write_text(PUSHED, encoding="utf-8")
    return fairlead.load(path)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_block_moves_as_what_is_set_says(pushed, engine):
    """At rest below the limit of 5 N; with 9 N beyond it 2 m/s^2, up to each point exactly, also past the stop."""
    run = pushed.start(engine=engine)
    run.set("pull", "3 N")
    assert run.advance(0.1) == 0.1
    assert run.get("block.x") == 0.0
    assert run.changes == []
    assert run.get("pad.friction") == pytest.approx(3.0, rel=1e-9)
    run.set("pull", "0.009 kN")
    assert run.advance("200 ms") == 0.2 == run.t
    assert [(change.t, change.before, change.after) for change in run.changes] == [(0.1, "held", "forward")]
    assert run.get("speed") == pytest.approx(0.2, rel=1e-9)
    assert run.advance(3.0) == 3.0
    assert run.get("speed") == pytest.approx(2.0 * 2.9, rel=1e-6)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_run_returns_at_a_zone_change_when_asked_to(pushed, engine):
    """From 0.2 m/s friction of 2.5 m/s^2 stops the block after 0.08 s; without being asked the run goes past it."""
    run = pushed.start(engine=engine)
    run.set("pull", 9.0)
    run.advance(0.1)
    state = run.save()
    run.set("pull", 0.0)
    assert run.advance(0.5, until_change=True) == pytest.approx(0.18, abs=1e-9)
    assert [change.component for change in run.changes] == ["pad"]
    assert run.advance(0.5, until_change=True) == 0.5
    assert run.changes == []
    there = run.get("block.x")
    assert there == pytest.approx(0.01 + 0.2**2 / (2 * FLOOR / BLOCK), rel=1e-6)
    other = pushed.start(engine=engine)
    other.restore(state)
    other.set("pull", 0.0)
    assert other.advance(0.5) == 0.5
    assert other.get("block.x") == there
    assert len(other.changes) == 1


def test_what_is_set_before_the_first_step_holds_from_the_start(pushed):
    """The start value is that of the source; what is set first is there at once, without a jump."""
    run = pushed.start()
    assert run.get("command.signal") == 1.0
    assert run.get("pad.friction") == pytest.approx(1.0)
    run = pushed.start()
    run.set("pull", 9.0)
    assert run.get("command.signal") == 9.0
    assert run.advance(0.1) == 0.1
    assert run.changes == []
    assert run.get("speed") == pytest.approx(0.2, rel=1e-9)


def test_two_runs_of_a_model_do_not_share_what_is_set(pushed):
    one, two = pushed.start(), pushed.start()
    one.set("pull", 9.0)
    two.set("pull", -9.0)
    one.advance(0.1), two.advance(0.1)
    assert one.get("speed") == pytest.approx(0.2, rel=1e-9)
    assert two.get("speed") == pytest.approx(-0.2, rel=1e-9)
    assert pushed.run(out=None).at("block.v", 1.0) == 0.0


@pytest.mark.parametrize("engine", ENGINES)
def test_cutting_a_run_into_steps_keeps_the_stick_slip_of_the_belt(engine):
    """Eleven breakaways and catches; ten accuracies of the largest position about the closed form."""
    belt, oracle = fairlead.load("belt"), StickSlipBelt()
    run, accuracy, largest = belt.start(engine=engine), 1e-6, 0.1
    rng, t = np.random.default_rng(3), 0.0
    while t < 4.0:
        t = min(t + float(rng.uniform(1e-3, 0.05)), 4.0)
        run.advance(t)
        assert run.get("block.x") == pytest.approx(float(oracle.position(t)), abs=10 * accuracy * largest)


@pytest.mark.parametrize("engine", ENGINES)
def test_saving_and_restoring_at_random_gives_the_same_run(engine):
    """Bit for bit, after going astray each time, with inputs, contacts and sampled control."""
    model = fairlead.load("winch_drive")
    points = [0.004 * k for k in range(1, 26)]
    names = [signal.name for signal in model.system.signals][::7]
    straight, cut = model.start(engine=engine), model.start(engine=engine)
    rng = np.random.default_rng(1)
    for t in points:
        straight.advance(t)
        if rng.random() < 0.5:
            state = cut.save()
            cut.advance(t + float(rng.uniform(0.0, 0.01)))
            (cut if rng.random() < 0.5 else (cut := model.start(engine=engine))).restore(state)
        cut.advance(t)
        assert [cut.get(name) for name in names] == [straight.get(name) for name in names]


def test_a_thousand_ways_astray_and_back_leave_no_trace(pushed):
    """States of any age are gone back to at random, also by another run; what follows is the same bit for bit."""
    rng, rounds, points = np.random.default_rng(7), 1000, 60
    pulls = rng.uniform(-12.0, 12.0, points)

    def forward(run, k):
        run.set("pull", pulls[k])
        run.advance(0.01 * (k + 1))
        return run.get("block.x"), run.get("speed"), run.get("pad.friction"), len(run.changes)

    straight, states, seen = pushed.start(), [], []
    for k in range(points):
        states.append(straight.save())
        seen.append(forward(straight, k))
    assert sum(row[-1] for row in seen) > 10
    runs = [pushed.start(), pushed.start()]
    for _ in range(rounds):
        k, run = int(rng.integers(points)), runs[int(rng.integers(2))]
        run.restore(states[k])
        assert forward(run, k) == seen[k]
        if rng.random() < 0.2:
            run.set("pull", float(rng.uniform(-50.0, 50.0)))
            run.advance(run.t + float(rng.uniform(0.0, 0.03)))


def test_the_interface_tells_units_starts_and_sizes(tmp_path):
    """As a master needs them; what the netlist gives as a start is pulled from the start, in place of the source's."""
    path = tmp_path / "scene.yaml"
    block = """interface:
  inputs: {pull: {of: command.value, unit: N, start: 0.009 kN, nominal: 10 N, description: Force.}}
  outputs: {speed: {of: block.v, nominal: 100 mm/s}, x: block.x}
"""
    path.write_text(PUSHED[: PUSHED.index("interface:")] + block, encoding="utf-8")
    run = fairlead.load(path).start()
    assert [tuple(one) for one in run.variables] == [
        ("pull", "input", "command.value", "N", "Force.", pytest.approx(9.0), 10.0),
        ("speed", "output", "block.v", "m/s", "", None, pytest.approx(0.1)),
        ("x", "output", "block.x", "m", "", None, 1.0),
    ]
    assert run.get("command.signal") == pytest.approx(9.0)
    run.advance(0.1)
    assert run.get("speed") == pytest.approx(0.2, rel=1e-9)
    assert fairlead.load(path).start().variables == run.variables


def test_the_source_gives_the_start_where_the_interface_gives_none(pushed):
    assert [(one.name, one.unit, one.start) for one in pushed.start().variables if one.causality == "input"] == [
        ("pull", "N", 1.0),
        ("other", "1", 0.0),
    ]


def test_wall_time_is_a_budget_of_every_call(pushed):
    """A nanosecond is over after the first step; what was reached stays, and the next call goes on from there."""
    run = pushed.start(max_wall="1 ns", max_step=0.01)
    run.set("pull", 9.0)
    with pytest.raises(fairlead.SteppingError, match="the budget of 1e-09 s is used up") as told:
        run.advance(0.1)
    first = told.value.t
    assert 0.0 < first == run.t < 0.1
    for _ in range(1000):
        try:
            assert run.advance(0.1) == 0.1
            break
        except fairlead.SteppingError:
            assert run.t > first
            first = run.t
    assert run.get("speed") == pytest.approx(0.2, rel=1e-9)


def test_a_run_that_fails_says_what_model_run_would(pushed):
    """A budget that is used up, with the time; what was reached can be read, and gone back from."""
    run = pushed.start(max_steps=3, max_step=0.01)
    state = run.save()
    with pytest.raises(fairlead.SteppingError, match="the budget of 3 steps is used up") as told:
        run.advance(0.9)
    assert told.value.t == run.t > 0
    assert run.get("speed") == 0.0
    run.restore(state)
    assert run.t == 0.0
    assert run.advance(0.01) == 0.01


IDLE = """
from fairlead.component import Controller, Output


class Idle(Controller):
    \"\"\"Fails at its third sample, and nothing follows what it says.\"\"\"

    said = Output("1", "Nobody listens.")

    def begin(self):
        self.count = 0

    def sample(self):
        self.count += 1
        return {"said": 1.0 if self.count < 3 else 1.0 / 0.0}
"""


def test_a_controller_that_fails_ends_a_run_though_nothing_follows_it(tmp_path):
    """Its output would be no number from then on, without a word."""
    (tmp_path / "idle.py").write_text(IDLE, encoding="utf-8")
    end = "connections:\n"
    text = PUSHED.replace(end, f"  idle: {{type: Idle, period: 10 ms}}\n{end}")
    (tmp_path / "idle.yaml").write_text(text, encoding="utf-8")
    run = fairlead.load(tmp_path / "idle.yaml", libraries=[tmp_path / "idle.py"]).start(engine="rodas")
    assert run.advance(0.015) == 0.015
    state = run.save()
    with pytest.raises(fairlead.SteppingError, match=r"t = 0.02 s: idle: ZeroDivisionError.*idle.py:15") as told:
        run.advance(0.5)
    assert told.value.t == pytest.approx(0.02)
    run.restore(state)
    assert run.get("idle.said") == 1.0


MISTAKES = {
    "set: there is no input pul. Did you mean pull?": lambda run: run.set("pul", 1.0),
    "set: pull = 1 m is a length, not a force": lambda run: run.set("pull", "1 m"),
    "set: pull = nan": lambda run: run.set("pull", float("nan")),
    "get: no signal has the name spee. Did you mean speed?": lambda run: run.get("spee"),
    "advance: t = 0.05 s is before 0.1 s": lambda run: run.advance(0.05),
    "advance: t = 1 m is a length": lambda run: run.advance("1 m"),
    "restore: a NoneType is not of a run of this model": lambda run: run.restore(None),
}


@pytest.mark.parametrize("said", MISTAKES)
def test_a_call_that_cannot_be_meant_is_refused(pushed, said):
    run = pushed.start()
    run.advance(0.1)
    with pytest.raises(fairlead.UsageError) as told:
        MISTAKES[said](run)
    assert said in str(told.value)


def test_an_engine_whose_past_cannot_be_saved_is_refused(pushed):
    with pytest.raises(fairlead.UsageError, match="ida keeps the past of a run in memory of SUNDIALS"):
        pushed.start(engine="ida")


INTERFACES = {
    "{inputs: {pull: comand.value}}": ["comand.value is no input that is free. Did you mean command.value?"],
    "{inputs: {pull: push.force}}": ["push.force is connected to a signal already"],
    "{inputs: {pull: {of: command.value, unit: newtonne}}}": ["interface.inputs.pull.unit", "newtonne"],
    "{inputs: {pull: {of: command.value, unit: kN}}}": ["interface.inputs.pull.unit: kN is 1000 of the SI unit"],
    "{inputs: {pull: {of: command.value, unit: N, start: 1 m}}}": ["interface.inputs.pull.start: 1 m is a length"],
    "{inputs: {pull: {of: command.value, start: .nan}}}": ["interface.inputs.pull.start"],
    "{outputs: {b: {of: block.v, nominal: 0}}}": ["interface.outputs.b.nominal = 0 is not above zero"],
    "{outputs: {b: {of: block.v, nominal: -1 m/s}}}": ["interface.outputs.b.nominal = -1 m/s is not above zero"],
    "{outputs: {b: {of: block.v, unit: N}}}": ["interface.outputs.b.unit: N is no unit of a signal in m/s"],
    "{outputs: {b: {of: block.v, start: 1 m/s}}}": ["start"],
    "{inputs: {a: command.value, b: command.value}}": ["interface.inputs.b: command.value is a already"],
    "{inputs: {a: nothing}, outputs: {b: block.w}}": ["interface.inputs.a", "interface.outputs.b", "block gives x, v"],
    "{input: {a: command.value}}": ["Did you mean inputs"],
    "{outputs: {b: max(block.*)}}": ["interface.outputs.b: max(block.*) is of signals in m, m/s"],
    "{outputs: {b: max(blok.v)}}": ["interface.outputs.b: no signal has the name blok.v. Did you mean block.v?"],
    "{tunable: {load: pad.normal_forc}}": ["interface.tunable.load", "Did you mean pad.normal_force?"],
    "{tunable: {load: pad}}": ["interface.tunable.load: there is no parameter pad that is a number"],
    "{tunable: {load: {of: pad.normal_force, unit: m}}}": ["interface.tunable.load.unit: m is no unit"],
    "{inputs: {load: command.value}, tunable: {load: pad.normal_force}}": ["an input has this name already"],
}


@pytest.mark.parametrize("block", INTERFACES)
def test_an_interface_that_fits_no_signal_is_told_with_its_place(tmp_path, block):
    path = tmp_path / "scene.yaml"
    path.write_text(PUSHED[: PUSHED.index("interface:")] + f"interface: {block}\n", encoding="utf-8")
    with pytest.raises(fairlead.ModelError) as told:
        fairlead.load(path).check()
    assert all(text in str(told.value) for text in INTERFACES[block])
    line = 1 + PUSHED[: PUSHED.index("interface:")].count("\n")
    assert f"scene.yaml:{line}:" in str(told.value)


@pytest.mark.parametrize(("of", "value"), [("max(*.v)", 0.2), ("min( *.v )", 0.0), ("max(block.v)", 0.2)])
def test_an_output_may_be_the_largest_or_the_smallest_of_several_signals(tmp_path, of, value):
    """9 N against 5 N on 2 kg for 0.1 s, beside a body that rests."""
    path = tmp_path / "scene.yaml"
    text = PUSHED.replace(
        "  spare:", "  other: {type: Mass, mass: 1 kg}\n  rope: {type: Spring, stiffness: 1 N/m}\n  spare:"
    )
    text = text.replace("run:", "  - [floor.flange, rope.a]\n  - [rope.b, other.flange]\nrun:")
    text = text.replace("speed: block.v", f'speed: "{of}"')
    path.write_text(text, encoding="utf-8")
    run = fairlead.load(path).start()
    run.set("pull", 9.0)
    run.advance(0.1)
    assert run.get("speed") == pytest.approx(value, abs=1e-9)
    assert [one.unit for one in run.variables if one.name == "speed"] == ["m/s"]


def test_the_interface_names_what_is_tunable(tmp_path):
    """9 N against 5 N, and then against 7 N, on 2 kg."""
    path = tmp_path / "scene.yaml"
    path.write_text(f"{PUSHED}  tunable: {{load: pad.normal_force, more: block.mass}}\n", encoding="utf-8")
    model = fairlead.load(path)
    run = model.start(tunable=["pad.curve.coulomb"])
    assert run.tunable == ("load", "more", "pad.curve.coulomb")
    assert [one.start for one in run.variables if one.causality == "parameter"] == [10.0, 2.0, 0.5]
    run.set("pull", 9.0)
    run.advance(0.1)
    run.set("load", "14 N")
    run.advance(0.2)
    assert run.get("speed") == pytest.approx(0.2 + 0.1, abs=1e-7)
    with pytest.raises(fairlead.UsageError, match="Tunable are load, more, pad"):
        run.set("pad.normal_force", 3.0)


def test_inputs_may_be_named_when_a_run_is_started(tmp_path):
    path = tmp_path / "scene.yaml"
    path.write_text(PUSHED[: PUSHED.index("interface:")], encoding="utf-8")
    run = fairlead.load(path).start(inputs=["command.value"])
    assert run.inputs == ("command.value",)
    assert run.outputs == ()
    run.set("command.value", 9.0)
    run.advance(0.1)
    assert run.get("block.v") == pytest.approx(0.2, rel=1e-9)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("names", [("pull", "more"), ("more", "pull"), ("pull", "more", "pull", "load")])
@pytest.mark.parametrize("points", [(0.0, 0.05), (0.06, 0.08), (0.5, 2.5)])
def test_an_input_and_parameters_set_at_one_point_do_not_pass_the_next(tmp_path, engine, names, points):
    """9 N against 5 N on 4 kg: the settlement on the parameter forgot the point to which the step was to go."""
    path = tmp_path / "scene.yaml"
    path.write_text(f"{PUSHED}  tunable: {{load: pad.normal_force, more: block.mass}}\n", encoding="utf-8")
    run = fairlead.load(path).start(engine=engine)
    run.advance(points[0])
    for name in names:
        run.set(name, {"pull": 9.0, "more": 4.0, "load": 10.0}[name])
    assert run.advance(points[1]) == points[1] == run.t
    assert run.get("speed") == pytest.approx((points[1] - points[0]) * (9.0 - 5.0) / 4.0, rel=1e-6)


ROCKET = """
from fairlead.component import Component, Law, Output, Parameter, State, Translational


class Rocket(Component):
    \"\"\"Pushes its flange as long as it has fuel.\"\"\"

    flange = Translational("what it pushes")
    fuel = Parameter("kg", "Fuel at the start.", above=0)
    burnt = State("kg", "What it has burnt.")
    left = Output("kg", "Fuel left.")
    empty = Output("kg", "Above zero where none is left.", role="used_up")

    def law(p, flange, burnt):
        return Law(flange=-5.0, burnt=0.5, left=p.fuel - burnt, empty=burnt - p.fuel, supplied=5.0 * flange.v)
"""
WITHOUT_LAW = {
    "fuel": ("""
components:
  body: {type: Mass, mass: 10 kg}
  rocket: {type: Rocket, fuel: 1 kg}
connections: [[body.flange, rocket.flange]]
""", "rocket is used up, and no law says what follows", 2.0, ENGINES),
    "hose": ("""
components:
  wall: {type: Ground}
  line: {type: Hose, axial_stiffness: 100 N, length: 2 m}
  hand: {type: MotionSource, position: {table: [[0, 2], [1, -0.2], [2, 3]]}}
connections: [[wall.flange, line.a], [hand.flange, line.b]]
""", "line: inside out, the ends have passed each other", 2.0 / 2.2, ENGINES),
    "web": ("""
components:
  roll: {type: Unwinder, radius: 0.3 m, core_radius: 50 mm, width: 0.5 m, thickness: 2 mm, density: 800 kg/m^3,
         moment: 0.2 kg*m^2}
  hand: {type: ForceSource, force: 40 N}
connections: [[roll.rim, hand.flange]]
""", "roll is used up, and no law says what follows", None, ["rodas"]),
}  # fmt: skip
"""What ends, with which words, when (None: as long as `run` says), and on which engines."""


@pytest.mark.parametrize(
    ("name", "engine"), [(name, engine) for name, one in WITHOUT_LAW.items() for engine in one[3]]
)
def test_where_no_law_says_what_follows_a_run_ends_with_the_words_of_model_run(tmp_path, name, engine):
    """Fuel burns for 2 s, a hand passes through a wall, a roll runs out: and the end is told again when asked again."""
    text, said, end, _ = WITHOUT_LAW[name]
    (tmp_path / "rocket.py").write_text(ROCKET, encoding="utf-8")
    (tmp_path / "scene.yaml").write_text(f"schema: 1{text}run: {{stop: 60 s, max_step: 20 ms}}\n", encoding="utf-8")
    model = fairlead.load(tmp_path / "scene.yaml", libraries=[tmp_path / "rocket.py"])
    whole = model.run(out=None, check=False, engine=engine)
    assert said in whole.run["sentence"]
    end = whole.t[-1] if end is None else end
    for step in (0.01, 7.0):
        run = model.start(engine=engine)
        while run.t + step < end - 0.05:
            run.advance(run.t + step)
        for _ in range(2):
            with pytest.raises(fairlead.SteppingError, match=said) as told:
                run.advance(end + 7.0)
            assert told.value.t == run.t == pytest.approx(end, abs=0.02)


@pytest.mark.parametrize("what", ["velocity", "velocity.sine.amplitude", "position.sine.frequency"])
def test_what_moves_as_given_does_not_jump(tmp_path, what):
    """Its place is the integral since the start: another speed would move it at once, so that is refused."""
    given = {
        "velocity": "velocity: 0.1 m/s",
        "velocity.sine.amplitude": "velocity: {sine: {amplitude: 0.1 m/s, frequency: 1 Hz}}",
        "position.sine.frequency": "position: {sine: {amplitude: 0.1 m, frequency: 1 Hz}}",
    }[what]
    path = tmp_path / "scene.yaml"
    path.write_text(f"""
schema: 1
components:
  hand: {{type: MotionSource, {given}}}
  rope: {{type: Spring, stiffness: 100 N/m}}
  block: {{type: Mass, mass: 1 kg}}
connections: [[hand.flange, rope.b], [rope.a, block.flange]]
run: {{stop: 2 s}}
""", encoding="utf-8")  # fmt: skip
    run = fairlead.load(path).start(tunable=[f"hand.{what}", "rope.stiffness"])
    run.set(f"hand.{what}", 0.05)  # before the start nothing has moved
    run.advance(0.7)
    place = run.get("hand.x")
    with pytest.raises(fairlead.UsageError, match=r"hand.*would move hand from .* at once.*VelocityActuator"):
        run.set(f"hand.{what}", 0.11)
    run.set("rope.stiffness", "50 N/m")
    run.advance(0.7 + 1e-9)
    assert run.get("hand.x") == pytest.approx(place, abs=1e-8)


def test_the_place_of_a_rigid_stop_does_not_jump(scene):
    text = """
    components:
      wall: {type: Ground}
      stop: {type: RigidStop, length: 1 m}
      block: {type: Mass, mass: 1 kg, position: 1.5 m}
      weight: {type: ForceSource, force: -20 N}
    connections: [[wall.flange, stop.a], [stop.b, block.flange, weight.flange]]
    run: {stop: 2 s}
    """
    run = scene(text).start(tunable=["stop.length"])
    run.set("stop.length", 0.9)  # before the start it may be anywhere
    run.advance(1.0)
    with pytest.raises(fairlead.UsageError, match=r"what stop stops at once.*EndStop"):
        run.set("stop.length", 1.1)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize(("limit", "sign"), [("high", 1.0), ("low", -1.0)])
def test_an_integral_at_its_limit_goes_on_when_that_is_moved_away(scene, engine, limit, sign):
    text = f"""
    components:
      rate: {{type: SignalSource, value: {sign}}}
      sum: {{type: Integrator, {limit}: {0.5 * sign}}}
    connections: [[rate.signal, sum.value]]
    run: {{stop: 4 s, engine: {engine}}}
    """
    run = scene(text).start(tunable=[f"sum.{limit}"])
    run.advance(1.0)
    assert run.get("sum.signal") == pytest.approx(0.5 * sign)
    run.set(f"sum.{limit}", 1.5 * sign)
    run.advance(1.4)
    assert run.get("sum.signal") == pytest.approx(0.9 * sign)
    run.advance(3.0)
    assert run.get("sum.signal") == pytest.approx(1.5 * sign)
