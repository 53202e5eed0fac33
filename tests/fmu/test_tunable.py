"""Parameters that are set while an FMU runs: as `run.set` between two advances does it, or refused by name."""

import numpy as np
import pytest

import fairlead
from fairlead.errors import UsageError
from fairlead.fmu import export
from fairlead.fmu.made import asked_of, made_of
from fairlead.fmu.tuned import ALWAYS, BEFORE
from tests.fmu.exported import fmpy, model, needs_compiler, once, slave

H = 0.02  # s
SCENE = """
parameters: {mu: 0.5, grip: 0.9}
components:
  wall: {type: Ground}
  floor: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 2 kg, position: 0.2 m}
  cart: {type: Mass, mass: 1 kg}
  joint: {type: RigidLink}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: "{grip}", coulomb: "{mu}"}}
  push: {type: ForceActuator}
  command: {type: SignalInput, start: 0}
connections:
  - [floor.flange, pad.a]
  - [wall.flange, spring.a]
  - [spring.b, pad.b, block.flange, push.flange, joint.a]
  - [joint.b, cart.flange]
  - [command.signal, push.force]
run: {stop: 1 s, accuracy: 1e-6}
interface:
  inputs: {pull: command.value}
  outputs: {speed: block.v, place: block.x, friction: pad.friction, lowest: "min(*.x)", highest: "max(*.x)"}
  tunable:
    load: {of: pad.normal_force, description: What presses on the pad., nominal: 10 N}
    stiffness: spring.stiffness
    mu: mu
    mass: cart.mass
    begin: block.position
"""
"""3 kg on a spring, which rub; two bodies that move as one, so a mass is a part of a sum."""
OUT = ["speed", "place", "friction", "lowest", "highest"]
PLAN = [
    ("load", 12.0),
    (None, 0.0),
    ("stiffness", 170.0),
    ("mass", 1.4),
    ("pull", 4.0),
    (None, 0.0),
    ("mu", 0.3),
    ("load", 70.0),
    (None, 0.0),
    (None, 0.0),
]
"""What is set before every fifth step."""


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    """The scene, and its FMU by version and engine."""
    folder = tmp_path_factory.mktemp("tunable")

    def made(version=3, engine="rodas"):
        return once(folder, f"scene_{engine}", version, SCENE, engine=engine)

    return made


def native(tmp_path, engine, before=()):
    """The same by `run.set` and `run.advance`."""
    run, rows = model(tmp_path, "scene", SCENE).start(engine=engine), []
    for name, value in before:
        run.set(name, value)
    for k in range(5 * len(PLAN)):
        name, value = PLAN[k // 5]
        if k % 5 == 0 and name:
            run.set(name, value)
        run.advance(run.t + H)
        rows.append([run.get(one) for one in OUT])
    return rows


@pytest.mark.slow
@pytest.mark.parametrize(("version", "engine"), [(3, "rodas"), (2, "rodas"), (3, "stepping")])
def test_what_is_tuned_moves_as_in_fairlead_to_the_last_bit(scene, tmp_path, version, engine):
    fmpy()
    from fmpy.validation import validate_fmu

    assert validate_fmu(str(scene(version, engine))) == []
    with slave(scene(version, engine), tmp_path) as one:
        one.set("begin", 0.25)
        one.fmu.exitInitializationMode()
        rows = []
        for k in range(5 * len(PLAN)):
            name, value = PLAN[k // 5]
            if k % 5 == 0 and name:
                one.set(name, value)
            one.step(H)
            rows.append(one.get(*OUT))
    own = native(tmp_path, engine, [("begin", 0.25)])
    assert rows == own
    assert len({row[0] == 0.0 for row in rows}) == 2  # it sticks, and slips


@pytest.mark.slow
def test_a_parameter_acts_from_the_point_where_it_is_set_and_a_state_takes_it_back(scene, tmp_path):
    """Held by the spring alone at the start: 20 N; sliding friction 5 N, and 3 N with another load; 3 kg."""
    fmpy()
    with slave(scene(), tmp_path) as one:
        one.set("load", 20.0)  # 18 N of stiction hold 20 N not
        assert one.get("load", "speed") == [20.0, 0.0]
        one.set("load", 80.0)  # 72 N do
        one.fmu.exitInitializationMode()
        one.step(0.1)
        assert one.get("speed") == [0.0]
        state = one.fmu.getFMUState()
        one.set("load", 10.0)
        pending = one.fmu.getFMUState()
        one.step(1e-3)
        first = one.get("speed", "load")
        assert first[0] == pytest.approx(-1e-3 * (20 - 5) / 3, rel=1e-4)
        one.fmu.setFMUState(pending)
        one.t = 0.1
        assert one.get("load") == [10.0]
        one.step(1e-3)
        assert one.get("speed", "load") == first
        one.fmu.setFMUState(state)
        one.t = 0.1
        one.step(0.1)
        assert one.get("speed", "load") == [0.0, 80.0]


@pytest.mark.slow
@pytest.mark.parametrize(("version", "engine"), [(3, "rodas"), (2, "rodas"), (3, "stepping")])
def test_an_input_and_a_parameter_set_at_one_point_do_not_pass_the_next(scene, tmp_path, version, engine):
    fmpy()
    changes = {20: {"load": 12.0, "pull": 3.0}, 21: {"pull": 5.0, "mass": 1.5}, 24: {"mu": 0.2, "pull": 5.0}}
    with slave(scene(version, engine), tmp_path) as one:
        one.fmu.exitInitializationMode()
        rows = []
        for k in range(30):
            for name, value in changes.get(k, {}).items():
                one.set(name, value)
            one.step(H)
            rows.append(one.get(*OUT))
    run, own = model(tmp_path, "scene", SCENE).start(engine=engine), []
    for k in range(30):
        for name, value in changes.get(k, {}).items():
            run.set(name, value)
        assert run.advance((k + 1) * H) == (k + 1) * H
        own.append([run.get(one) for one in OUT])
    np.testing.assert_allclose(rows, own, rtol=0, atol=1e-6)


@pytest.mark.slow
def test_where_nothing_is_left_an_fmu_ends_with_the_words_of_a_run(tmp_path):
    fmpy()
    web = """
components:
  roll: {type: Unwinder, radius: 0.3 m, core_radius: 50 mm, width: 0.5 m, thickness: 2 mm, density: 800 kg/m^3,
         moment: 0.2 kg*m^2}
  hand: {type: ForceSource, force: 40 N}
connections: [[roll.rim, hand.flange]]
run: {stop: 60 s}
interface: {outputs: {radius: roll.radius}}
"""
    end = model(tmp_path, "web", web).run(out=None, check=False)
    assert "roll is used up" in end.run["sentence"]
    with slave(once(tmp_path, "web_fmu", 3, web), tmp_path) as one:
        one.fmu.exitInitializationMode()
        while one.t < end.t[-1] - 0.2:
            one.step(0.1)
        with pytest.raises(Exception, match="error"):
            one.step(0.4)


def test_the_description_tells_range_start_and_when_a_parameter_can_be_set(scene):
    fmpy()
    from fmpy import read_model_description

    told = {one.name: one for one in read_model_description(str(scene())).modelVariables}
    load = told["load"]
    assert (load.causality, load.variability, load.unit, load.start) == ("parameter", "tunable", "N", "10.0")
    assert (float(load.min), float(load.max), load.nominal) == (1.25, 80.0, "10.0")
    assert load.description == "What presses on the pad."
    assert [told[name].variability for name in ("begin", "mass")] == ["fixed", "tunable"]
    assert float(told["mu"].max) == 0.75  # not above stiction


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("load", 81.0, "beyond its range"),
        ("load", float("nan"), "not a finite number"),
        ("begin", 0.1, "how a run begins"),
    ],
)
def test_a_value_that_cannot_be_set_is_an_error_that_says_why(scene, tmp_path, capsys, name, value, said):
    fmpy()
    with slave(scene(), tmp_path) as one:
        one.fmu.exitInitializationMode()
        with pytest.raises(Exception, match=r"(?i)status|error"):
            one.set(name, value)
        assert said in capsys.readouterr().out
        one.step(H)
        assert one.get("load") == [10.0]


def test_the_speed_of_what_moves_as_given_is_set_before_the_start_only(tmp_path):
    """After it the place, its integral since the start, would jump."""
    text = """
components:
  hand: {type: MotionSource, velocity: 0.1 m/s}
  rope: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg}
connections: [[hand.flange, rope.b], [rope.a, block.flange]]
run: {stop: 2 s}
interface: {outputs: {place: hand.x}, tunable: {speed: hand.velocity, stiffness: rope.stiffness}}
"""
    found = made_of(asked_of(model(tmp_path, "hand", text), (), (), (), {}, "export")).tuned
    assert {one.name: one.when for one in found} == {"speed": BEFORE, "stiffness": ALWAYS}


def test_a_parameter_beside_its_bound_can_be_set(tmp_path):
    """A tenth more than an efficiency of 0.95 is none: the model is asked for values that it takes."""
    text = """
components:
  motor: {type: Inertia, moment: 0.1 kg*m^2}
  gear: {type: LossyGear, ratio: 0.5, efficiency: 0.95}
  load: {type: Inertia, moment: 0.1 kg*m^2}
  torque: {type: TorqueSource, torque: 1 N*m}
connections: [[motor.shaft, gear.a, torque.shaft], [gear.b, load.shaft]]
run: {stop: 1 s}
interface: {outputs: {speed: load.speed}, tunable: {share: gear.efficiency}}
"""
    (found,) = made_of(asked_of(model(tmp_path, "gear", text), (), (), (), {}, "export")).tuned
    assert found.when == ALWAYS
    assert found.low < 0.95 == found.high


def test_a_speed_at_the_start_is_set_before_it_only():
    """It is the size of its own error as well, which is that of the start."""
    needs_compiler()
    asked = asked_of(fairlead.load("belt"), [], ["block.x"], ["block.velocity", "block.mass"], {"engine": "rodas"},
                     "export")
    assert [one.when for one in made_of(asked).tuned] == [BEFORE, ALWAYS]


LAWS = {
    "30*x^3": lambda x: 30 * x**3, "20*x^1.5 + 7": lambda x: 20 * x**1.5 + 7,
    "100*(x - 0.4)^2": lambda x: 100 * (x - 0.4) ** 2,
    "5*x^4 - 1": lambda x: 5 * x**4 - 1, "900/x^3": lambda x: 900 / x**3, "90/x^1.5": lambda x: 90 / x**1.5,
    "70/x^4 + 3": lambda x: 70 / x**4 + 3, "(2*x - 7)^2": lambda x: (2 * x - 7) ** 2,
}  # fmt: skip


def test_powers_with_a_factor_and_an_offset_and_squares_of_lines_are_followed(tmp_path):
    """Springs that hold 1 N: each is stretched by 1 N over its stiffness, whatever x is set to."""
    needs_compiler()
    fmpy()
    parts, joins, out = [], [], []
    for k, law in enumerate(LAWS):
        law = law.replace("^", "**")
        parts.append(f"""  s{k}: {{type: SpringDamper, stiffness: "{{{law}}} N/m", damping: 40 N*s/m}}
  m{k}: {{type: Mass, mass: 1 kg}}
  f{k}: {{type: ForceSource, force: 1 N}}""")
        joins.append(f"[wall.flange, s{k}.a], [s{k}.b, m{k}.flange, f{k}.flange]")
        out.append(f"m{k}.x")
    text = f"""parameters: {{x: 3}}
components:
  wall: {{type: Ground}}
{chr(10).join(parts)}
connections: [{", ".join(joins)}]
run: {{stop: 200 s, accuracy: 1e-8}}
"""
    file = export(model(tmp_path, "laws", text), tmp_path / "laws.fmu", outputs=out, tunable=["x"])
    with slave(file, tmp_path) as one:
        one.fmu.exitInitializationMode()
        one.step(1.0)
        one.set("x", 2.2)
        one.step(150.0)
        assert one.get(*out) == pytest.approx([1 / law(2.2) for law in LAWS.values()], rel=1e-4)


@pytest.mark.parametrize("value", ["100*x**2 + 50*x", "100 + 20*sin(x)", "30*x**2.5", "100*abs(x - 2)"])
def test_other_laws_are_refused(tmp_path, value):
    text = f"""parameters: {{x: 3}}
components:
  wall: {{type: Ground}}
  s: {{type: Spring, stiffness: "{{{value}}} N/m"}}
  m: {{type: Mass, mass: 1 kg}}
connections: [[wall.flange, s.a], [s.b, m.flange]]
run: {{stop: 1 s}}
"""
    with pytest.raises(UsageError, match="by a law that the FMU cannot work out"):
        made_of(asked_of(model(tmp_path, "other", text), (), ["m.x"], ["x"], {}, "export"))


REFUSED = {
    "line.element": "the structure depends on it",
    "line.bulkhead_friction.velocity": "by a law that the FMU cannot work out",
    "line.diameter": "nothing in this model follows it",
    "line.weight": "is 0, from which no range follows",
    "line.hose.masss": "there is no parameter line.hose.masss that is a number. Did you mean line.hose.mass?",
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_parameter_that_follows_no_law_is_refused_by_name(tmp_path, name):
    with pytest.raises(UsageError) as told:
        export(
            fairlead.load("single_bend"), tmp_path / "no.fmu", outputs=["haul.force"], tunable=[name], engine="rodas"
        )
    assert REFUSED[name] in str(told.value)
    assert not (tmp_path / "no.fmu").exists()


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_friction_and_load_of_a_line_are_tuned_as_in_fairlead_to_the_last_bit(tmp_path, engine):
    fmpy()
    needs_compiler()
    loaded, out = fairlead.load("single_bend"), ["line.hose_node[9].x", "line.core_node[9].v"]
    tunable, plan = ["mu", "tow.force"], {0: ("mu", 0.5), 20: ("tow.force", 900.0), 40: ("mu", 0.2)}
    file = export(loaded, tmp_path / "line.fmu", engine=engine, outputs=out, tunable=tunable)
    run, rows, own = loaded.start(engine=engine, tunable=tunable), [], []
    run.get(out[0])
    with slave(file, tmp_path / "unpacked") as one:
        one.fmu.exitInitializationMode()
        for k in range(60):
            if k in plan:
                one.set(*plan[k])
                run.set(*plan[k])
            one.step(0.05)
            run.advance(one.t)
            rows.append(one.get(*out))
            own.append([run.get(name) for name in out])
    assert rows == own
