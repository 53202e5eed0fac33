"""Sensitivities against closed forms, and what is told where an outcome jumps, has a corner, or is asked wrongly."""

import json
import math
import re
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.component.numbers import numbers
from fairlead.errors import FairleadError, ModelError, UsageError
from fairlead.fmu import export
from fairlead.studies.sensitivities.derivative import derivative

BELT = fairlead.load("belt", set={"run.accuracy": "1e-8", "run.stop": "4 s"})


def test_the_period_of_the_belt_has_the_derivatives_of_its_closed_form() -> None:
    """T = 2(L - c)/v + 2(pi - atan((L - c) w/v))/w with L = stiction/k, c = sliding/k (tests/reference/belt.py)."""
    to = ["pad.curve.stiction", "pad.curve.coulomb", "belt.velocity"]
    found = fairlead.sensitivity(BELT, {"period": "period(pad, held)"}, to)
    k, force, v, w = 100.0, 10.0, 0.2, 10.0
    stroke = (1.0 - 0.6) * force / k
    over = 1 + (stroke * w / v) ** 2
    by_stroke = 2 / v - 2 / v / over
    wanted = {"pad.curve.stiction": by_stroke * force / k, "pad.curve.coulomb": -by_stroke * force / k,
              "belt.velocity": -2 * stroke / v**2 + 2 * stroke / v**2 / over}  # fmt: skip
    assert wanted["pad.curve.stiction"] == pytest.approx(0.8, rel=1e-14)
    for name, value in wanted.items():
        one = found["period", name]
        assert one.value == pytest.approx(value, abs=1e-7)
        assert one.error < 1e-7
        assert one.elasticity == pytest.approx(value * found.parameters[name] / one.at, rel=1e-6)
    assert found["period", "belt.velocity"].unit == "s/(m/s)"


@pytest.mark.slow
def test_the_tension_of_a_capstan_grows_by_its_angle_for_each_unit_of_friction() -> None:
    """T = T_hold exp(mu theta). Of 6 elements on the bend the slope is off by (mu theta/6)^2 (1/4 + mu theta/12)."""
    still = {"element": "0.25 m", "rope.damping_ratio": "1", "rope.mass": "0.1 kg/m", "run.stop": "3 s"}
    found = fairlead.sensitivity(fairlead.load("capstan", set=still), "end(haul.force)", ["mu", "hold"])
    mesh = (0.35 * math.pi / 12) ** 2 * (1 / 4 + 0.35 * math.pi / 24)
    slope = -100 * math.pi / 2 * math.exp(0.35 * math.pi / 2)
    assert found["end(haul.force)", "mu"].value == pytest.approx(slope, rel=1.3 * mesh)
    assert found["end(haul.force)", "hold"].elasticity == pytest.approx(1, rel=1e-3)


SHAKEN = """schema: 1
name: shaken
parameters: {stiffness: 100 N/m, friction: 4 N, force: 10 N}
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: "{stiffness}"}
  block: {type: Mass, mass: 1 kg}
  pad: {type: Contact, normal_force: "{friction}", curve: 1.0}
  shaker: {type: ForceSource, force: {sine: {amplitude: "{force}", frequency: 2 Hz}}}
connections:
  - [wall.flange, spring.a, pad.a]
  - [spring.b, block.flange, pad.b, shaker.flange]
run: {stop: 20 s, accuracy: 1e-7}
record: {signals: [block.x]}
"""


def amplitude(result) -> float:
    """Of the last oscillation: where the block turns, the contact changes its zone."""
    return abs(result.at("block.x", result.events[-1].t))


@pytest.mark.slow
def test_the_amplitude_of_a_shaken_block_with_dry_friction_is_den_hartogs(tmp_path) -> None:
    """Den Hartog (1931): x = sqrt((P V/k)^2 - (F U/k)^2), V = 1/(1 - b^2), U = sin(pi/b)/(b (1 + cos(pi/b)))."""
    (tmp_path / "shaken.yaml").write_text(SHAKEN)
    model = fairlead.load(tmp_path / "shaken.yaml")
    found = fairlead.sensitivity(model, {"x": amplitude}, ["friction", "force"])
    b = 2 * math.pi * 2 / math.sqrt(100.0)
    v, u = 1 / (1 - b**2), math.sin(math.pi / b) / (b * (1 + math.cos(math.pi / b)))
    x = math.sqrt((10 * v) ** 2 - (4 * u) ** 2) / 100
    assert found.figures["x"] == pytest.approx(x, rel=1e-5)
    assert found["x", "friction"].value == pytest.approx(-4 * u**2 / (100**2 * x), rel=1e-4)
    assert found["x", "force"].value == pytest.approx(10 * v**2 / (100**2 * x), rel=1e-4)


PUSHED = """schema: 1
name: pushed
parameters: {push: 10 N, offset: 0 mm}
components:
  floor: {type: Ground}
  crate: {type: Mass, mass: 2 kg, position: "{offset}"}
  skid: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: STICTION, coulomb: 1}}
  hand: {type: ForceSource, force: "{push}"}
connections:
  - [floor.flange, skid.a]
  - [crate.flange, skid.b, hand.flange]
run: {stop: 2 s, accuracy: 1e-6}
record: {signals: [crate.x]}
"""


def pushed(folder, stiction: str, **values: str):
    (folder / "pushed.yaml").write_text(PUSHED.replace("STICTION", stiction))
    return fairlead.load(folder / "pushed.yaml", set=values)


def test_a_crate_at_the_verge_of_sliding_has_a_corner_with_both_slopes(tmp_path) -> None:
    """It stays below the limit of 10 N; above it goes (push - 10 N) t^2/(2 m)."""
    one = fairlead.sensitivity(pushed(tmp_path, "1"), "end(crate.x)", "push")["end(crate.x)", "push"]
    assert (one.status, one.value) == ("corner", None)
    assert one.below == pytest.approx(0, abs=1e-9)
    assert one.above == pytest.approx(2**2 / (2 * 2), rel=1e-4)
    assert "skid" in one.sentence


def test_where_the_outcome_jumps_the_switch_is_named_and_no_derivative_told(tmp_path) -> None:
    """With more stiction than sliding friction the crate stands at 11 N, and is metres away a little above."""
    one = fairlead.sensitivity(pushed(tmp_path, "1.1", push="11 N"), "end(crate.x)", "push")["end(crate.x)", "push"]
    assert (one.status, one.value) == ("jump", None)
    for part in ("jumps from", "skid, zone change 1", "held", "push = 11"):
        assert part in one.sentence, one.sentence


def test_a_jump_at_some_distance_is_told_beside_the_derivative(tmp_path) -> None:
    one = fairlead.sensitivity(pushed(tmp_path, "1.1", push="11.2 N"), "end(crate.x)", "push")["end(crate.x)", "push"]
    assert one.value == pytest.approx(2**2 / (2 * 2), rel=1e-5)
    ends = re.search(r"it jumps between push = ([\d.]+) and push = ([\d.]+); skid", one.sentence)
    assert ends
    assert 10.5 < float(ends[2]) <= 11 < float(ends[1]) < 11.1  # it lets go at 11 N


def test_a_corner_at_some_distance_is_no_jump(tmp_path) -> None:
    """Above 10 N the crate goes (push - 10 N) t^2/(2 m), below it stays: the figure itself is continuous."""
    one = fairlead.sensitivity(pushed(tmp_path, "1", push="10.01 N"), "end(crate.x)", "push")["end(crate.x)", "push"]
    assert one.value == pytest.approx(2**2 / (2 * 2), rel=1e-5)
    assert "it has a corner between push = " in one.sentence
    assert "jump" not in one.sentence


SLID = """schema: 1
name: slid
parameters: {m: 2 kg, g: 9.81 m/s^2, m2: "{2*m}"}
components:
  floor: {type: Ground}
  block: {type: Mass, mass: "{m}", velocity: 2 m/s}
  pad: {type: Contact, normal_force: "{m*g}", curve: 0.3}
  spring: {type: Spring, stiffness: 80 N/m}
connections: [[floor.flange, pad.a, spring.a], [pad.b, block.flange, spring.b]]
run: {stop: 1 s, accuracy: 1e-7}
interface: {outputs: {x: block.x}}
"""


def first_peak(m: float, g: float = 9.81) -> float:
    """Where k x^2/2 + mu m g x = m v^2/2."""
    k, push = 80.0, 0.3 * m * g
    return (math.sqrt(push**2 + k * m * 2.0**2) - push) / k


def test_a_parameter_with_a_unit_has_derivatives_in_an_expression_with_others(tmp_path) -> None:
    (tmp_path / "slid.yaml").write_text(SLID)
    found = fairlead.sensitivity(fairlead.load(tmp_path / "slid.yaml"), {"peak": "peak(block.x)"}, ["m", "g"])
    h = 1e-4
    slopes = {"m": (first_peak(2 + h) - first_peak(2 - h)) / (2 * h),
              "g": (first_peak(2, 9.81 + h) - first_peak(2, 9.81 - h)) / (2 * h)}  # fmt: skip
    for name, slope in slopes.items():
        assert found["peak", name].value == pytest.approx(slope, rel=1e-6)


def test_where_no_other_value_is_possible_the_refusal_is_told(tmp_path) -> None:
    (tmp_path / "slid.yaml").write_text(SLID.replace("curve: 0.3", 'curve: "{0.3+sqrt(-(m/(2 kg)-1)**2)}"'))
    one = fairlead.sensitivity(fairlead.load(tmp_path / "slid.yaml"), "peak(block.x)", "m")["peak(block.x)", "m"]
    assert (one.status, one.value) == ("untold", None)
    assert "is refused" in one.sentence
    assert "does not happen" not in one.sentence


def test_an_event_that_comes_on_one_side_only_is_a_jump(tmp_path) -> None:
    figure = "time(skid, forward)"
    found = fairlead.sensitivity(pushed(tmp_path, "1.1", push="11 N"), figure, "push")[figure, "push"]
    assert found.status in ("jump", "untold")
    assert found.value is None


def test_a_parameter_that_is_zero_needs_a_size(tmp_path) -> None:
    model = pushed(tmp_path, "1", push="12 N")
    with pytest.raises(ModelError, match=r"offset is 0.*\n.*offset=0.1 m"):
        fairlead.sensitivity(model, "end(crate.x)", "offset")
    found = fairlead.sensitivity(model, "end(crate.x)", {"offset": "1 mm"})["end(crate.x)", "offset"]
    assert found.value == pytest.approx(1, rel=1e-6)
    assert found.elasticity is None


def test_every_mistake_of_what_is_asked_comes_at_once_with_a_suggestion() -> None:
    with pytest.raises(ModelError) as raised:
        fairlead.sensitivity(BELT, ["peek(block.x)", "peak(blok.x)"], ["pad.normal_forze", "pad.method", "pda.x"])
    told = str(raised.value)
    for part in ("no figure peek", "Did you mean peak", "blok.x", "Did you mean block.x", "no parameter pda.x",
                 "Did you mean pad.normal_force", "pad has no number normal_forze", "no number method"):  # fmt: skip
        assert part in told, f"{part} is missing in\n{told}"


def test_a_model_that_does_not_run_is_told_with_its_reason() -> None:
    with pytest.raises(FairleadError, match=r"as it is is budget: .*5 steps"):
        fairlead.sensitivity(BELT, "end(block.x)", "block.mass", max_steps=5)


@pytest.mark.slow
def test_the_command_prints_a_table_a_record_and_csv(tmp_path) -> None:
    words = ["sensitivity", "belt", "--set", "run.stop=2", "--of", "T=period(pad, held)", "--to", "pad.curve.stiction"]
    answer = CliRunner().invoke(app, [*words, "--csv", str(tmp_path / "table.csv")])
    assert answer.exit_code == 0, answer.output
    assert "elasticity" in answer.output
    head, line = (tmp_path / "table.csv").read_text().splitlines()
    assert head.startswith("figure,parameter,status,at,value,unit,elasticity,error")
    told = json.loads(CliRunner().invoke(app, [*words, "--json"]).stdout)
    (one,) = told["derivatives"]
    assert one["value"] == pytest.approx(0.8, abs=1e-5)
    assert float(line.split(",")[4]) == one["value"]
    wrong = CliRunner().invoke(app, [*words, "--to", "pad.curve.stiction"])
    assert wrong.exit_code == 2
    assert "twice" in wrong.output


@pytest.mark.parametrize("ask", [fairlead.modes, fairlead.sensitivity, export])
def test_the_name_of_a_model_is_no_model(ask) -> None:
    with pytest.raises(ModelError, match=r"model = belt is not a Model\n +Load it: fairlead\.load\('belt'\)\."):
        ask("belt")


def test_a_list_of_parameters_may_give_sizes() -> None:
    """As the message for a parameter of zero has it: NAME=SIZE, among others or alone."""
    from fairlead.cli.sensitivity import _parameters

    assert _parameters(["m, k", "zero=0.1 mm,n"]) == {"m": None, "k": None, "zero": "0.1 mm", "n": None}
    with pytest.raises(UsageError, match="--to names m twice"):
        _parameters(["m", "m=1 kg"])


@pytest.mark.parametrize("name", ["single_bend", "belt", "winch_drive"])
def test_every_number_that_is_offered_is_set_by_its_name(name):
    """That of a part written as a bare number is the part: `route.stations.bend.friction`, with nothing inside it."""
    model = fairlead.load(name)
    offered = numbers(model.netlist, model.assembly.entries)
    for one, (value, _) in offered.items():
        changed = model.beside({one: 0.99 * value}, None)
        assert numbers(changed.netlist, changed.assembly.entries)[one][0] == pytest.approx(0.99 * value), one
    assert name != "single_bend" or offered["route.stations.bend.friction"] == (0.35, "1")


class Rough:
    """Runs of one parameter whose figure has given slopes at every step, below and above."""

    accuracy = 1e-4
    varied = (SimpleNamespace(name="push", value=1.0, scale=1.0, at=lambda change: 1.0 + change),)

    def __init__(self, slope):
        self.slope, self.made = slope, {}

    def step(self, index, change):
        return np.array([change])

    def at(self, z):
        value = 1.0 + z[0] * self.slope(z[0])
        point = SimpleNamespace(figure=lambda name: value, row=SimpleNamespace(ok=True), events=())
        return self.made.setdefault(tuple(z.tolist()), point)

    def along(self, index, change):
        return self.at(self.step(index, change))

    def figure(self, name):
        return lambda z: np.array([self.at(z).figure(name)])


def told_of(slope):
    runs, far = Rough(slope), np.array([0.05])
    runs.at(np.zeros(1))
    return derivative(runs, "peak", 0, (-far, far), 1e-12, "1")


def scattered(seed, size):
    """A function of the step that has another value at each, within +- size."""
    return lambda z: float(np.random.default_rng([seed, *np.array([z]).view(np.uint32)]).uniform(-size, size))


@pytest.mark.parametrize("seed", range(30))
def test_slopes_that_scatter_are_no_corner_and_what_they_differ_by_is_error(seed) -> None:
    """Slopes of 1 +- 4 % on both sides, another at each step: the noise of runs whose steps differ."""
    noise = scattered(seed, 0.04)
    one = told_of(lambda z: 1.0 + noise(z))
    assert one.status == "smooth"
    assert one.value == pytest.approx(1.0, abs=0.041)


@pytest.mark.parametrize("seed", range(10))
def test_a_corner_under_noise_of_a_tenth_of_it_is_one(seed) -> None:
    """Slopes of 0.9 and 1.1, each with a scatter of +- 0.02."""
    noise = scattered(seed, 0.02)
    one = told_of(lambda z: (0.9 if z < 0 else 1.1) + noise(z))
    assert one.status == "corner"
    assert (one.below, one.above) == (pytest.approx(0.9, abs=0.021), pytest.approx(1.1, abs=0.021))
