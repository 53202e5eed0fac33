"""Values between recorded rows, and extremes, against closed forms: a mass on a spring, x = cos(3 t)."""

import numpy as np
import pytest

import fairlead
from fairlead.analysis.record import event_rows, step_rows
from fairlead.analysis.record.event_rows import Rows
from fairlead.analysis.record.extremes import Extremes
from fairlead.integrate import codes

SWING = """
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 1 kg, position: 1 m}
      spring: {type: Spring, stiffness: 9 N/m}
      shaker: {type: MotionSource, velocity: {sine: {amplitude: 2 m/s, frequency: 0.5 Hz}}}
      idle: {type: Mass, mass: 1 kg}
    connections:
      - [ground.flange, spring.a]
      - [spring.b, block.flange]
      - [shaker.flange, idle.flange]
    run: {stop: 9.7 s}
    record: {signals: [block.x, block.v, shaker.v]EVERY}
"""
ENGINES = ["rodas", "stepping", pytest.param("ida", marks=pytest.mark.slow)]
ACCURACIES = [1e-3, pytest.param(1e-6, marks=pytest.mark.slow)]


def swing(simulate, engine, accuracy, every=""):
    if engine == "ida":
        pytest.importorskip("sksundae")
    return simulate(SWING.replace("EVERY", every), **{"run.engine": engine, "run.accuracy": accuracy})


def wrong(result, times):
    """Largest errors of position and speed, in those of the swing."""
    x, v = result.at("block.x", times), result.at("block.v", times)
    return max(np.abs(x - np.cos(3 * times)).max(), np.abs(v + 3 * np.sin(3 * times)).max() / 3)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("accuracy", ACCURACIES)
def test_values_between_rows_are_within_the_accuracy_and_that_of_the_rows(simulate, engine, accuracy):
    result = swing(simulate, engine, accuracy)
    at_rows = max(np.abs(result["block.x"] - np.cos(3 * result.t)).max(), 1e-9)
    times = np.random.default_rng(1).uniform(0.0, 9.7, 3000)
    assert wrong(result, times) < accuracy + 1.5 * at_rows
    shaken = 2 * np.sin(np.pi * times)  # nothing that moves by itself follows it
    np.testing.assert_allclose(result.at("shaker.v", times), shaken, atol=2 * accuracy)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_on_a_grid_values_between_rows_are_those_of_cubics(simulate, engine):
    """Rows 0.06 rad apart: straight lines are off by 0.06^2/8 = 4.5e-4, cubics by (3/128) 0.06^4 = 3e-7."""
    result = swing(simulate, engine, 1e-6, ", every: 20 ms")
    times = np.random.default_rng(1).uniform(0.2, 9.5, 3000)
    assert wrong(result, times) < 2e-5  # where a curve has no bend four rows may be taken for none
    assert np.abs(np.interp(times, result.t, result["block.x"]) - np.cos(3 * times)).max() > 4e-4


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("every", ["", ", every: 0.25 s", ", every: 5 s"])
def test_extremes_are_those_of_the_motion_whatever_is_recorded(simulate, engine, every):
    result = swing(simulate, engine, 1e-4, every)
    error = 1e-9 + np.abs(result["block.x"] - np.cos(3 * result.t)).max()
    for name, size in (("block.x", 1.0), ("block.v", 3.0), ("shaker.v", 2.0)):
        low, t_low, high, t_high = result.extremes(name)
        assert low == pytest.approx(-size, abs=size * (1e-4 + 2 * error))
        assert high == pytest.approx(size, abs=size * (1e-4 + 2 * error))
        assert 0.0 <= min(t_low, t_high) <= max(t_low, t_high) <= 9.7
    assert abs(np.sin(3 * result.extremes("block.x").t_lowest)) < 0.03


@pytest.mark.parametrize(
    ("model", "signal"), [("capstan", "rope.line[47].tension"), ("hundred_blocks", "rod.guide[0].slip")]
)
def test_nor_do_those_of_many_contacts_on_stepping_depend_on_the_grid(model, signal):
    """Also where a contact is captured inside a step: no slip turns round there."""
    found = []
    for every in ("null", "1 ms", "0.5 s"):
        settings = {"run.engine": "stepping", "record.every": every, "run.stop": "0.5 s"}
        found.append(fairlead.load(model, set=settings).run(out=None, check=False).extremes(signal))
    size = found[0].highest - found[0].lowest
    for one in found[1:]:
        assert one.lowest == pytest.approx(found[0].lowest, abs=1e-3 * size)
        assert one.highest == pytest.approx(found[0].highest, abs=1e-3 * size)


@pytest.mark.parametrize("accuracy", ["1e-3", "1e-4"])
def test_inside_steps_of_stepping_neighbours_on_a_line_move_alike(accuracy):
    """No force between them is that of the way in which rows are shown: from 100 N the held end falls to 96.3 N."""
    settings = {"run.engine": "stepping", "run.accuracy": accuracy, "record.every": "null", "run.stop": "0.1 s"}
    result = fairlead.load("capstan", set=settings).run(out=None, check=False)
    tension = np.array([result[f"rope.line[{k}].tension"] for k in range(44, 60)])
    assert np.abs(np.diff(tension, axis=0)).max() < 2.0
    assert min(result.extremes(f"rope.line[{k}].tension").lowest for k in range(44, 56)) > 95.0


FALLS_INTO_A_ROPE = """
    components:
      floor: {type: Ground}
      body: {type: Mass, mass: 1 kg}
      weight: {type: ForceSource, force: 9.81 N}
      rope: {type: Tether, stiffness: 1e4 N/m, length: 0.1 m}
      pad: {type: Contact, normal_force: 10 N, curve: 0.1}
    connections:
      - [floor.flange, rope.a, pad.a]
      - [body.flange, rope.b, weight.flange, pad.b]
    run: {stop: 0.16 s, engine: ENGINE, accuracy: ACCURACY}
    record: {every: EVERY, signals: [body.v]}
"""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("accuracy", [1e-3, 1e-4, 1e-5])
@pytest.mark.parametrize("every", ["null", "20 ms"])
def test_a_peak_in_the_first_step_after_an_event_is_found(simulate, engine, accuracy, every):
    """Pulled by F = 8.81 N it is fastest where the rope bears that: v^2 = 2 F 0.1 m + F^2/k."""
    text = FALLS_INTO_A_ROPE.replace("ENGINE", engine).replace("ACCURACY", f"{accuracy:g}").replace("EVERY", every)
    fastest = np.sqrt(2 * 8.81 * 0.1 + 8.81**2 / 1e4)
    assert simulate(text).extremes("body.v").highest == pytest.approx(fastest, abs=2 * accuracy)


GRIDS = [None, "20 ms", "0.37 s", "5 s", "100 s"]
BELT = """
    components:
      wall: {type: Ground}
      spring: {type: Spring, stiffness: 100 N/m}
      block: {type: Mass, mass: 1 kg, velocity: 0.2 m/s}
      belt: {type: MotionSource, velocity: 0.2 m/s}
      pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 1.0, coulomb: 0.6}}
    connections:
      - [wall.flange, spring.a]
      - [spring.b, block.flange, pad.b]
      - [belt.flange, pad.a]
    run: {stop: 40 s, accuracy: 1e-6}
    record: {signals: [block.x, block.v]}
"""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("every", GRIDS)
def test_the_peaks_of_short_phases_in_a_long_run_do_not_depend_on_the_grid(simulate, engine, every):
    """A phase of slip is a hundredth of the run: x = 0.06 + 0.04 cos 10 t + 0.02 sin 10 t from 0.5 s on."""
    result = on_the_grid(simulate, BELT, engine, every)
    low, _, high, t_high = result.extremes("block.x")
    amplitude, slip = np.hypot(0.04, 0.02), (2 * np.pi - 2 * np.arctan(2)) / 10
    assert low == pytest.approx(0.0, abs=1e-9)
    assert high == pytest.approx(0.06 + amplitude, abs=2e-7)
    assert (t_high - 0.5) % (slip + 0.4) == pytest.approx(np.arctan(0.5) / 10, abs=2e-3)
    assert result.extremes("block.v").lowest == pytest.approx(-10 * amplitude, abs=2e-6)
    assert result.extremes("block.v").highest == pytest.approx(0.2, abs=2e-6)
    phase = (40.0 - 0.5) % (slip + 0.4)  # it rides at the end
    assert result.t[-1] == 40.0
    assert result["block.x"][-1] == pytest.approx(0.02 + 0.2 * (phase - slip), abs=2e-5)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("every", GRIDS)
def test_a_peak_early_in_a_long_run_is_found_on_any_grid(simulate, engine, every):
    """A damped swing, started at 1 m/s: its first peak is in the first 0.15 s of 1000 s, and the only one so high."""
    result = on_the_grid(simulate, """
        components:
          ground: {type: Ground}
          block: {type: Mass, mass: 1 kg, velocity: 1 m/s}
          spring: {type: Spring, stiffness: 100 N/m}
          damper: {type: Damper, damping: 2 N*s/m}
        connections:
          - [ground.flange, spring.a, damper.a]
          - [spring.b, block.flange, damper.b]
        run: {stop: 1000 s, accuracy: 1e-5}
        record: {signals: [block.x, block.v]}
    """, engine, every if every != "20 ms" else "0.2 s")  # fmt: skip
    pace = np.sqrt(99.0)
    top, bottom = (np.arctan(pace) + np.array([0.0, np.pi])) / pace
    low, t_low, high, t_high = result.extremes("block.x")
    assert high == pytest.approx(np.exp(-top) * np.sin(pace * top) / pace, rel=1e-3)
    assert low == pytest.approx(np.exp(-bottom) * np.sin(pace * bottom) / pace, rel=1e-3)
    assert (t_high, t_low) == pytest.approx((top, bottom), abs=5e-3)
    assert abs(result["block.x"][-1]) < 1e-4


def on_the_grid(simulate, text, engine, every):
    if engine == "ida":
        pytest.importorskip("sksundae")
    given = {} if every is None else {"record.every": every}
    return simulate(text, **{"run.engine": engine}, **given)


def test_a_limit_is_broken_between_two_recorded_rows(simulate, scene):
    """Rows at t = 0 and 5 s only; the speed passes 2.9 m/s meanwhile."""
    text = SWING.replace("EVERY", ", every: 5 s") + "    limits: {block.v: {below: 2.9 m/s}}\n"
    result = simulate(text)
    assert np.abs(result["block.v"]).max() < 2.9
    (said,) = result.run["limits_broken"]
    assert "2.99" in said or "3" in said


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_no_extreme_is_beyond_the_friction_there_is(simulate, engine):
    """A contact that slips to and fro: its friction is +-2 N and jumps, and no curve goes over the jumps."""
    result = simulate("""
        components:
          ground: {type: Ground}
          block: {type: Mass, mass: 1 kg, position: 1 m}
          spring: {type: Spring, stiffness: 9 N/m}
          pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.2, coulomb: 0.2}}
        connections:
          - [ground.flange, spring.a, pad.a]
          - [spring.b, block.flange, pad.b]
        run: {stop: 4 s}
        record: {signals: [pad.friction, block.x]}
    """, **{"run.engine": engine})
    low, _, high, _ = result.extremes("pad.friction")
    assert low >= -2.0 * (1 + 1e-6)
    assert high <= 2.0 * (1 + 1e-6)
    times = np.linspace(0.0, 4.0, 5001)
    assert np.abs(result.at("pad.friction", times)).max() <= 2.0 * (1 + 1e-6)


def test_rows_are_numbered_as_the_engine_numbers_them():
    names = ("ORDINARY", "INSIDE", "PASSED", "INSIDE_PASSED", "GRID")
    assert [getattr(step_rows, name) for name in names] == [getattr(codes, name) for name in names]
    assert (event_rows.BEFORE, event_rows.AFTER) == (codes.BEFORE, codes.AFTER)


def test_the_extreme_of_a_quartic_is_found_between_the_rows_of_its_step():
    t = np.linspace(0.0, 1.0, 5)
    side = np.array([0, codes.INSIDE, codes.INSIDE, codes.INSIDE, 0], np.int8)
    values = np.stack([t * (1 - t) ** 3, -t * (1 - t)], axis=1)
    extremes = Extremes(2)
    extremes.watch(Rows(t, values, side))
    np.testing.assert_allclose(extremes.highest, [27 / 256, 0.0], atol=1e-6)
    np.testing.assert_allclose(extremes.lowest, [0.0, -0.25], atol=1e-9)
    np.testing.assert_allclose(extremes.t_highest[0], 0.25, atol=5e-3)
