"""Modes against closed forms: oscillators, chains, a clutch, friction that falls with speed; and mistakes."""

import json
import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import linalg
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.errors import ModelError
from fairlead.studies.modes.linear import equations
from fairlead.studies.modes.spectrum import modes_of

OSCILLATOR = """schema: 1
name: oscillator
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 400 N/m}
  damper: {type: Damper, damping: 6 N*s/m}
  block: {type: Mass, mass: 4 kg}
connections: [[wall.flange, spring.a, damper.a], [spring.b, damper.b, block.flange]]
run: {stop: 1 s}
"""
K, M, C = 400.0, 4.0, 6.0


def made(folder, text: str, name: str = "scene.yaml", **values: str):
    (folder / name).write_text(text)
    return fairlead.load(folder / name, set=values)


def test_an_oscillator_has_its_frequency_and_damping(tmp_path) -> None:
    (mode,) = found = fairlead.modes(made(tmp_path, OSCILLATOR))
    ratio = C / (2 * math.sqrt(K * M))
    assert mode.damping == pytest.approx(ratio, rel=1e-12)
    assert mode.frequency == pytest.approx(math.sqrt(K / M * (1 - ratio**2)) / (2 * math.pi), rel=1e-12)
    assert mode.participation == {"block": pytest.approx(1)}
    assert (found.at_rest, found.held) == (0, 0)


def test_the_response_of_an_oscillator_is_that_of_its_equation(tmp_path) -> None:
    found = fairlead.modes(made(tmp_path, OSCILLATOR), acting="block", out="block.x", frequencies=("0.1 Hz", 20))
    w = 2 * math.pi * found.response.frequencies
    assert found.response.values == pytest.approx(1 / (K - M * w**2 + 1j * C * w), rel=1e-8)
    assert found.response.unit == "m/N"
    assert (found.response.frequencies[0], found.response.frequencies[-1]) == pytest.approx((0.1, 20))


TWO = """schema: 1
name: clutch
components:
  wall: {type: Ground}
  left: {type: Spring, stiffness: 300 N/m}
  right: {type: Spring, stiffness: 500 N/m}
  one: {type: Mass, mass: 1 kg}
  two: {type: Mass, mass: 3 kg}
  clutch: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.6, coulomb: 0.4}}
connections:
  - [wall.flange, left.a, right.a]
  - [left.b, one.flange, clutch.a]
  - [right.b, two.flange, clutch.b]
run: {stop: 1 s}
"""


def frequencies(found) -> list[float]:
    return [mode.frequency for mode in found]


def test_a_clutch_between_two_springs_has_modes_of_its_own_in_each_zone(tmp_path) -> None:
    model = made(tmp_path, TWO)
    apart = fairlead.modes(model, zones={"clutch": "sliding"})
    assert frequencies(apart) == pytest.approx([math.sqrt(500 / 3) / (2 * math.pi), math.sqrt(300) / (2 * math.pi)])
    assert [max(mode.participation, key=mode.participation.get) for mode in apart] == ["two", "one"]
    together = fairlead.modes(model, zones={"clutch": "held"})
    assert frequencies(together) == pytest.approx([math.sqrt(800 / 4) / (2 * math.pi)])
    shares = {"two": (3 / 4 + 500 / 800) / 2, "one": (1 / 4 + 300 / 800) / 2}  # half by inertia, half by stiffness
    assert together[0].participation == pytest.approx(shares)
    assert (together.at_rest, together.held) == (1, 1)  # the offset at which the clutch took hold stays
    assert together.pattern == "held: clutch"


def test_a_force_on_parts_that_hold_together_moves_them_as_one(tmp_path) -> None:
    found = fairlead.modes(made(tmp_path, TWO), zones={"clutch": "held"}, acting="one", out="two.x", frequencies=(1, 9))
    w = 2 * math.pi * found.response.frequencies
    assert found.response.values == pytest.approx(1 / (800 - 4 * w**2), rel=1e-8)
    borne = fairlead.modes(made(tmp_path, TWO), zones={"clutch": "held"}, acting="one", out="clutch.friction",
                           frequencies=(1, 9)).response.values  # fmt: skip
    assert np.abs(borne) == pytest.approx(np.abs((500 - 3 * w**2) / (800 - 4 * w**2)), rel=1e-8)


def test_patterns_of_contacts_come_with_the_least_damped_first(tmp_path) -> None:
    curve = "{curve: tustin, stiction: 0.6, coulomb: 0.3, velocity: 0.1 m/s}"
    drag = f"  drag: {{type: Contact, normal_force: 2 N, curve: {curve}}}\nconnections:"
    text = TWO.replace("connections:", drag).replace("[wall.flange, left.a", "[wall.flange, drag.a, left.a")
    text = text.replace("[left.b, one.flange,", "[left.b, one.flange, drag.b,")
    found = fairlead.modes(made(tmp_path, text), zones={"*": "held"}, change=2)
    assert len(found.patterns) == 4
    assert [one.damping for one in found.patterns] == sorted(one.damping for one in found.patterns)
    first, (held,) = found.patterns[0], [one for one in found.patterns if one.changes == ("drag forward",)]
    assert any("drag" in word for word in first.changes)
    growth = 2 * 0.3 / 0.1 / (2 * 1)  # Tustin's fall at rest over twice the mass of `one`, which slides alone
    assert first.mode.growth == pytest.approx(growth, rel=1e-6)
    assert held.mode.growth < growth  # with `two` along it grows more slowly
    assert [one.changes for one in found.patterns if one.mode is None] == [()]  # with both held nothing moves


FALLING = """schema: 1
name: squealing
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg, velocity: 0 m/s}
  belt: {type: MotionSource, velocity: 0.3 m/s}
  pad:
    {type: Contact, normal_force: 10 N, curve: {curve: stribeck, stiction: 0.6, coulomb: 0.3, velocity: 0.2 m/s}}
connections: [[wall.flange, spring.a], [spring.b, block.flange, pad.b], [belt.flange, pad.a]]
run: {stop: 1 s}
"""


def stribeck_slope(v: float) -> float:
    """Of mu = 0.3 + 0.3 exp(-(v/0.2)^2), physics.md."""
    return 0.3 * math.exp(-((v / 0.2) ** 2)) * -2 * v / 0.2**2


def test_friction_that_falls_with_speed_makes_a_mode_that_grows(tmp_path) -> None:
    (mode,) = found = fairlead.modes(made(tmp_path, FALLING))
    growth = -10 * stribeck_slope(0.3) / 2
    assert growth > 0
    assert mode.growth == pytest.approx(growth, rel=1e-6)
    assert mode.frequency == pytest.approx(math.sqrt(100 - growth**2) / (2 * math.pi), rel=1e-6)
    assert found.unstable == (mode,)
    assert "swings up" in str(found)


@pytest.mark.parametrize("n", [1, 8, 40])
def test_a_chain_held_at_one_end_has_the_frequencies_of_its_closed_form(tmp_path, n: int) -> None:
    """w_j = 2 sqrt(k/m) sin((2j - 1) pi/(2 (2n + 1))) of n equal masses (Timoshenko, Vibration Problems)."""
    one = "  s{0}: {{type: Spring, stiffness: 1 kN/m}}\n  m{0}: {{type: Mass, mass: 2 kg}}\n"
    parts = "  wall: {type: Ground}\n" + "".join(one.format(k) for k in range(n))
    joints = "  - [wall.flange, s0.a]\n" + "".join(
        f"  - [s{k}.b, m{k}.flange{f', s{k + 1}.a' if k < n - 1 else ''}]\n" for k in range(n)
    )
    text = f"schema: 1\ncomponents:\n{parts}connections:\n{joints}run: {{stop: 1 s}}\n"
    found = fairlead.modes(made(tmp_path, text))
    j = np.arange(1, n + 1)
    wanted = 2 * math.sqrt(1000 / 2) * np.sin((2 * j - 1) * math.pi / (2 * (2 * n + 1))) / (2 * math.pi)
    assert frequencies(found) == pytest.approx(wanted, rel=1e-9)


LINE = """schema: 1
name: hanging
components:
  rope: {type: Cable, length: 8 m, element: 0.5 m, tension: 100 N, mass: 0.5 kg/m, stiffness: 1 MN, damping_ratio: 0.02}
  route: {type: Route, stations: [{type: Straight, length: 20 m}]}
  haul: {type: MotionSource, velocity: 0 m/s}
  weight: {type: ForceSource, force: 100 N}
connections: [[rope.path, route.path], [haul.flange, rope.inboard], [weight.flange, rope.outboard]]
run: {stop: 1 s}
"""


def test_a_line_of_n_elements_has_the_modes_of_a_rod_cut_into_as_many(tmp_path) -> None:
    """Half an element's mass at the free end: w_j = 2 sqrt(k/m) sin((2j - 1) pi/(4n)), and damping w_j c/(2k)."""
    found, n = fairlead.modes(made(tmp_path, LINE)), 16
    k, m = 1e6 / 0.5 * (1 + 100 / 1e6), 0.5 * 0.5  # its length is that under tension
    w = 2 * math.sqrt(k / m) * np.sin((2 * np.arange(1, n + 1) - 1) * math.pi / (4 * n))
    assert [abs(mode.value) for mode in found] == pytest.approx(w, rel=1e-7)
    c = 2 * 0.02 * math.sqrt(k * m)
    assert [mode.damping for mode in found] == pytest.approx(w * c / (2 * k), rel=1e-3)


def test_eigenvalues_are_the_finite_ones_of_the_pencil_that_the_engine_solves() -> None:
    """Independently by QZ of (J, M), which has an infinite eigenvalue for every unknown without a derivative."""
    model = fairlead.load("winch_drive")
    found = fairlead.modes(model, at=0.5)
    t, y, instance = _standing(model, 0.5)
    given = equations(instance, t, y, instance.zones)
    values = linalg.eigvals(given.j, given.m)
    finite = values[np.isfinite(values) & (np.abs(values) < 1e9)]
    wanted = sorted(abs(value) for value in finite if value.imag >= 0 and abs(value) > 1e-6)
    assert [abs(mode.value) for mode in found] == pytest.approx(wanted, rel=1e-6)


def _standing(model, t: float):
    run = model.start()
    run.advance(t)
    return run.standing()


def test_an_instant_of_a_run_has_the_zones_of_that_instant() -> None:
    model = fairlead.load("belt")
    held, slipping = fairlead.modes(model, at="0.3 s"), fairlead.modes(model, at="0.6 s")
    assert (held.zones["pad"], len(held)) == ("held", 0)
    assert slipping.zones["pad"] == "backward"
    assert frequencies(slipping) == pytest.approx([10 / (2 * math.pi)])


def test_a_pattern_is_for_those_of_its_parts_that_have_the_zone() -> None:
    """A line is hoses, joints and contacts: what may hold is held, one of them slides, a typing error is told."""
    model = fairlead.load("single_bend")
    held = fairlead.modes(model, zones={"line.*": "held"})
    contacts = [name for name in held.zones if name.startswith(("line.outer[", "line.inner["))]
    assert len(contacts) > 10
    assert {held.zones[name] for name in contacts} == {"held"}
    assert len(held) == 0  # every node of hose and core is in a contact that holds
    assert len(fairlead.modes(model, zones={"line.*": "held", contacts[5]: "sliding"})) == 1
    with pytest.raises(ModelError, match=r"line\.\* has no zone hold\. Did you mean held"):
        fairlead.modes(model, zones={"line.*": "hold"})
    with pytest.raises(ModelError, match=r"line\.hose\[1\] has no zone held\.\n"):  # and not that held was meant
        fairlead.modes(model, zones={"line.hose[1]": "held"})


def test_every_mistake_of_what_is_asked_comes_at_once_with_a_suggestion(tmp_path) -> None:
    with pytest.raises(ModelError) as raised:
        fairlead.modes(made(tmp_path, TWO), zones={"cluch": "held", "clutch": "slipping"}, acting="onne", out="two.y")
    told = str(raised.value)
    for part in ("Did you mean clutch", "clutch has no zone slipping", "forward", "nothing can act on onne",
                 "Did you mean one", "no signal has the name two.y"):  # fmt: skip
        assert part in told, f"{part} is missing in\n{told}"
    with pytest.raises(ModelError, match="response needs both"):
        fairlead.modes(made(tmp_path, TWO), out="two.x")
    with pytest.raises(ModelError, match="not above 0"):
        fairlead.modes(made(tmp_path, TWO), frequencies=(0, 3))


@pytest.mark.slow
def test_the_command_prints_a_table_draws_and_writes(tmp_path) -> None:
    made(tmp_path, TWO)
    words = ["modes", str(tmp_path / "scene.yaml"), "--zones", "clutch=sliding", "--in", "one", "--out", "one.x",
             "--change", "1", "--plot", str(tmp_path / "m.svg"), "--csv", str(tmp_path / "m.csv")]  # fmt: skip
    answer = CliRunner().invoke(app, words)
    assert answer.exit_code == 0, answer.output
    for part in ("forward: clutch", "who takes part", "two 100%", "clutch held", "one.x over one", "m.svg"):
        assert part in answer.output, answer.output
    assert (tmp_path / "m.svg").read_text().startswith("<?xml")
    assert len((tmp_path / "m.csv").read_text().splitlines()) == 3
    told = json.loads(CliRunner().invoke(app, [*words, "--json"]).stdout)
    assert [one["frequency"] for one in told["modes"]] == pytest.approx([2.0546, 2.7566], rel=1e-4)
    wrong = CliRunner().invoke(app, [*words, "--zones", "clutch"])
    assert wrong.exit_code == 2
    assert "PART=ZONE" in wrong.output


def test_a_signal_from_outside_has_the_response_of_the_force_that_it_makes(tmp_path) -> None:
    parts = "  knob: {type: SignalInput}\n  push: {type: ForceActuator}\n"
    text = OSCILLATOR.replace("connections:", f"{parts}connections:")
    text = text.replace("block.flange]]", "block.flange, push.flange], [knob.signal, push.force]]")
    model = made(tmp_path, text)
    by_signal = fairlead.modes(model, acting="knob.value", out="block.v", frequencies=(1, 9)).response
    w = 2 * math.pi * by_signal.frequencies
    assert by_signal.values == pytest.approx(1j * w / (K - M * w**2 + 1j * C * w), rel=1e-8)
    assert by_signal.unit == "m/s"
    given = fairlead.modes(model, acting="knob.value", out="knob.signal", frequencies=(1, 9)).response
    assert given.values == pytest.approx(1, rel=1e-8)  # it acts at once


def test_free_motion_is_counted_among_the_zeros_and_not_told_as_a_mode(tmp_path) -> None:
    """Two masses and a spring that nothing holds: sqrt(k (1/m1 + 1/m2)), and two zeros."""
    text = """schema: 1
components:
  one: {type: Mass, mass: 1 kg}
  two: {type: Mass, mass: 3 kg}
  spring: {type: Spring, stiffness: 300 N/m}
connections: [[one.flange, spring.a], [two.flange, spring.b]]
run: {stop: 1 s}
"""
    found = fairlead.modes(made(tmp_path, text))
    assert frequencies(found) == pytest.approx([math.sqrt(300 * (1 + 1 / 3)) / (2 * math.pi)])
    assert (found.at_rest, found.unstable) == (2, ())


EYED = OSCILLATOR.replace("connections: [", "  eye: {type: MotionSensor}\nconnections: [").replace(
    "block.flange]", "block.flange, eye.flange]"
)


def test_the_response_of_an_acceleration_has_what_the_force_does_at_once(tmp_path) -> None:
    """-w^2 times that of the place, so that it tends to 1/M."""
    found = fairlead.modes(made(tmp_path, EYED), acting="block", out="eye.a", frequencies=(0.1, 200)).response
    w = 2 * math.pi * found.frequencies
    assert found.values == pytest.approx(-(w**2) / (K - M * w**2 + 1j * C * w), rel=1e-7)
    assert found.values[-1].real == pytest.approx(1 / M, rel=1e-3)


@pytest.mark.parametrize("zone", ["held", "sliding"])
def test_an_acceleration_of_the_other_body_feels_the_force_through_what_holds(tmp_path, zone: str) -> None:
    text = TWO.replace("connections:", "  eye: {type: MotionSensor}\nconnections:").replace(
        "two.flange, clutch.b]", "two.flange, clutch.b, eye.flange]"
    )
    found = fairlead.modes(made(tmp_path, text), zones={"clutch": zone}, acting="one", out="eye.a", frequencies=(1, 9))
    w = 2 * math.pi * found.response.frequencies
    expected = -(w**2) / (800 - 4 * w**2) if zone == "held" else 0 * w
    assert found.response.values == pytest.approx(expected, rel=1e-7, abs=1e-9)


def test_zeros_are_told_by_what_they_belong_to(tmp_path) -> None:
    """A clutch that holds has one; a body on a drag of 1e12 N s/m creeps back at 1e-9/s, which rounding hides."""
    text = TWO.replace("connections:", """  tar: {type: Damper, damping: 1e12 N*s/m}
  soft: {type: Spring, stiffness: 1000 N/m}
  slow: {type: Mass, mass: 1 kg}
connections:
  - [tar.b, soft.b, slow.flange]""").replace("left.a, right.a", "left.a, right.a, tar.a, soft.a")  # fmt: skip
    found = fairlead.modes(made(tmp_path, text), zones={"clutch": "held"})
    assert (found.zeros.count, found.zeros.offsets, found.at_rest) == (2, 1, 2)
    assert "slow" in found.zeros.others
    told = str(found)
    assert "1 for a contact that holds, which stays where it took hold." in told
    assert "1 for what moves freely, stays put, or creeps too slowly to tell: " in told


@pytest.mark.parametrize(("at", "says"), [
    ("50 s", r'50 s is beyond the end of the run, run.stop = 40 s.\n    Give an earlier .* run.stop = "50 s"'),
    (-1, "-1 s is before the start of the run at 0 s"),
])  # fmt: skip
def test_an_instant_that_the_run_does_not_reach_is_refused(at, says) -> None:
    model = fairlead.load("belt")
    with pytest.raises(ModelError, match=says):
        fairlead.modes(model, at=at)
    assert fairlead.modes(model.with_values({"run.stop": 1}), at=1).t == 1.0


TURNED = """
    components:
      j: {{type: Inertia, moment: 0.05 kg*m^2, angle: 1 rad, speed: 0}}
      c: {{type: {kind}}}
      m: {{type: Mass, mass: 2 kg}}
      g: {{type: Ground}}
      s: {{type: SpringDamper, stiffness: 1000 N/m, damping: 5 N*s/m, free_length: {free!r} m}}
      t: {{type: TorqueSource, torque: {torque!r} N*m}}
    connections: [[j.shaft, c.shaft, t.shaft], [c.slider, m.flange, s.b], [g.flange, s.a]]
    run: {{stop: 1 s, accuracy: 1e-8}}
"""
PLACES = {
    "Crank, radius: 0.1 m, rod: 0.3 m": lambda a: 0.1 * np.cos(a) + np.sqrt(0.3**2 - (0.1 * np.sin(a)) ** 2),
    "Cam, lift: 0.2 m": lambda a: 0.1 * (1 - np.cos(a)),
}


@pytest.mark.parametrize("kind", PLACES)
@pytest.mark.parametrize("stretch", [0.0, 0.02, -0.03])
def test_a_relation_of_positions_leaves_one_motion_and_its_bend_counts(scene, kind, stretch):
    """Of V = k/2 (x(a) - x0)^2 - T a at rest: V'' = k x'^2 + k (x - x0) x'', with J + m x'^2 and c x'^2."""
    place, e = PLACES[kind], 1e-4
    first = (place(1 + e) - place(1 - e)) / (2 * e)
    second = (place(1 + e) - 2 * place(1.0) + place(1 - e)) / e**2
    text = TURNED.format(kind=kind, free=float(place(1.0) - stretch), torque=float(1000 * stretch * first))
    found = fairlead.modes(scene(text))
    inertia, stiffness, damping = 0.05 + 2 * first**2, 1000 * (first**2 + stretch * second), 5 * first**2
    (mode,) = found
    assert abs(mode.value) ** 2 == pytest.approx(stiffness / inertia, rel=1e-5)
    assert -2 * mode.value.real == pytest.approx(damping / inertia, rel=1e-5)
    assert (found.at_rest, found.held) == (0, 1)


def test_equal_lags_one_after_the_other_are_two_modes_and_no_zeros() -> None:
    """x' = -x, y' = x - y: -1 twice, with left and right vectors that are exactly orthogonal."""
    whole = np.eye(2)
    of = SimpleNamespace(names=("one.z", "two.z"), differential=np.array([True, True]))
    matrix = np.array([[-1.0, 0.0], [1.0, -1.0]])
    linear = SimpleNamespace(matrix=matrix, pace=1.0, onto=whole, basis=whole, spread=whole, equations=of)
    found, zeros = modes_of(linear)
    assert zeros.count == 0
    assert [mode.value for mode in found] == pytest.approx([-1.0, -1.0], abs=1e-7)  # the root of eps


def test_the_bound_of_what_is_zero_is_told_as_a_speed_below_those_of_the_modes(tmp_path) -> None:
    """Four springs of a contact and the body on them: one oscillates, and each spring keeps what it had."""
    text = """
schema: 1
components:
  belt: {type: MotionSource, velocity: -0.08 m/s}
  wall: {type: Ground}
  block: {type: Mass, mass: 1 kg, position: -0.04 m}
  spring: {type: Spring, stiffness: 100 N/m}
  damper: {type: Damper, damping: 0.3 N*s/m}
  pad: {type: Contact, normal_force: 10 N, method: maxwell_slip, curve: 0.5, viscous: 0.2}
connections: [[belt.flange, pad.a], [block.flange, pad.b, spring.b, damper.b], [wall.flange, spring.a, damper.a]]
run: {stop: 1 s}
"""
    found = fairlead.modes(made(tmp_path, text))
    stiffness = 100 + 0.5 * 10 / 2e-5 / 4 * (4 / 1 + 4 / 2 + 4 / 3 + 1)  # N/m, of y_i = i/4 of 20 um
    assert found.zeros.count == 4
    assert found.zeros.below < 1e-3 * math.sqrt(stiffness)
    assert found.modes[0].growth == pytest.approx(-(0.3 + 0.2) / 2, rel=1e-6)
    assert found.modes[0].frequency == pytest.approx(math.sqrt(stiffness) / (2 * math.pi), rel=1e-6)
