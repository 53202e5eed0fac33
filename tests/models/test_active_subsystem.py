"""Runs that compute only what moves: the same motion as that of a scene without the rest, and as that of the whole."""

import numpy as np
import pytest

from fairlead.integrate import Run, integrate, parts

ROD = """
    components:
      rod: {{type: RodOnGuides, blocks: {n}, mass: {mass} kg, axial_stiffness: {stiffness} N, damping_time: 2 ms,
            friction: {friction} N}}
      hook: {{type: SpringDamper, stiffness: 2000 N/m, damping: 4 N*s/m}}
      hand: {{type: MotionSource, position: {hand}}}
    connections:
      - [rod.end, hook.a]
      - [hook.b, hand.flange]
    friction: {{method: hold}}
    run: {{stop: {stop} s, accuracy: 1e-5}}
    record: {{every: 10 ms, signals: [hook.tension, "rod.block[*].x"]}}
"""
SWING = "{sine: {amplitude: 2.7 mm, frequency: 1 Hz}}"


def rod(blocks, hand=SWING, stop=2):
    """A rod whose blocks and springs are the same however many there are."""
    given = {"mass": 0.1 * blocks, "stiffness": 1e6 / blocks, "friction": 0.5 * blocks}
    return ROD.format(n=blocks, hand=hand, stop=stop, **given)


def row_with_stiction(blocks):
    """Blocks in a row, pulled to and fro at the first; each has 0.6 N of stiction and 0.5 N of sliding friction."""
    lines = [
        "ground: {type: Ground}",
        "hand: {type: MotionSource, position: {sine: {amplitude: 2.7 mm, frequency: 1 Hz}}}",
        "hook: {type: SpringDamper, stiffness: 2000 N/m, damping: 4 N*s/m}",
    ]
    joins = [["ground.flange", *(f"rub{k}.a" for k in range(blocks))], ["hand.flange", "hook.b"]]
    for k in range(blocks):
        lines.append(f"block{k}: {{type: Mass, mass: 0.1 kg}}")
        lines.append(
            f"rub{k}: {{type: Contact, normal_force: 1 N, curve: {{curve: coulomb, stiction: 0.6, coulomb: 0.5}}}}"
        )
        lines.append(f"tie{k}: {{type: SpringDamper, stiffness: 2000 N/m, damping: 4 N*s/m}}" if k else "")
        joins.append([f"block{k}.flange", f"rub{k}.b", f"tie{k}.b" if k else "hook.a"])
        joins[-1] += [f"tie{k + 1}.a"] if k + 1 < blocks else []
    wiring = "\n".join(f"  - [{', '.join(ports)}]" for ports in joins)
    return (
        "components:\n  " + "\n  ".join(filter(None, lines)) + f"\nconnections:\n{wiring}\n"
        "friction: {method: hold}\nrun: {stop: 3 s}\neffects: {energy: off}\n"
    )


def on_the_grid(result, name):
    """Values [k] of a signal at the recorded times that belong to the grid, which runs have in common."""
    grid = np.isclose(result.t / 0.01, np.round(result.t / 0.01), atol=1e-6)
    _, first = np.unique(np.round(result.t[grid] / 0.01), return_index=True)
    return np.asarray(result[name])[grid][first]


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_what_stands_still_is_left_out_and_nothing_else_changes(simulate, engine):
    """A pull of 5.4 N at most moves ten blocks of 0.5 N each: it cannot matter whether 10 or 140 more stand behind."""
    few, many = (simulate(rod(n, stop=4), **{"run.engine": engine}) for n in (20, 150))
    counters = many.run["counters"]
    assert few.run["counters"]["partial_steps"] == 0
    assert counters["partial_steps"] > 0.4 * counters["steps"]
    scale = {"rodas": 1e-4, "stepping": 2e-2}[engine]  # of 5 N; each engine against itself, at its accuracy
    assert on_the_grid(many, "hook.tension") == pytest.approx(on_the_grid(few, "hook.tension"), abs=scale)
    assert np.ptp(np.asarray(many["rod.block[0].x"])) == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_what_was_left_out_wakes_when_the_motion_reaches_it(simulate, engine, monkeypatch):
    """Ten blocks move for two seconds; then a pull three times as strong moves thirty, and lets them go again."""
    pull = "{table: {t: [0 s, 0.3 s, 0.6 s, 0.9 s, 1.2 s, 1.5 s, 1.8 s, 2.1 s, 3 s, 3.4 s], " \
           "y: [0 mm, 3 mm, 0 mm, 3 mm, 0 mm, 3 mm, 0 mm, 3 mm, 22 mm, 2 mm]}}"  # fmt: skip
    part = simulate(rod(150, pull, 3.4), **{"run.engine": engine})
    monkeypatch.setattr(parts, "LEAST", 10**9)
    whole = simulate(rod(150, pull, 3.4), **{"run.engine": engine})
    assert whole.run["counters"]["partial_steps"] == 0
    assert part.run["counters"]["partial_steps"] > 50
    moved = [k for k in range(150) if np.ptp(np.asarray(whole[f"rod.block[{k}].x"])) > 0]
    assert min(moved) < 120  # more than the margin behind the ten
    scale = {"rodas": 1e-7, "stepping": 1e-5}[engine]  # m, of 2 cm
    for k in (*range(0, 150, 10), 149):
        name = f"rod.block[{k}].x"
        assert on_the_grid(part, name) == pytest.approx(on_the_grid(whole, name), abs=scale), name


def test_a_load_that_comes_by_the_clock_wakes_nobody_too_late(simulate):
    """One rod swings; another stands until a force that is zero for a second pulls it with twice its friction."""
    text = """
        components:
          rod: {type: RodOnGuides, blocks: 80, mass: 8 kg, axial_stiffness: 1e4 N, damping_time: 2 ms, friction: 40 N}
          hook: {type: SpringDamper, stiffness: 2000 N/m, damping: 4 N*s/m}
          hand: {type: MotionSource, position: {sine: {amplitude: 2.7 mm, frequency: 1 Hz}}}
          other: {type: RodOnGuides, blocks: 80, mass: 8 kg, axial_stiffness: 1e4 N, damping_time: 2 ms, friction: 40 N}
          pull: {type: ForceSource, force: {table: {t: [0 s, 1 s, 1.001 s, 2 s], y: [0 N, 0 N, 80 N, 80 N]}}}
        connections:
          - [rod.end, hook.a]
          - [hook.b, hand.flange]
          - [other.end, pull.flange]
        friction: {method: hold}
        run: {stop: 2 s, accuracy: 1e-5, engine: rodas}
        record: {every: 10 ms, signals: ["other.block[*].x"]}
    """
    result = simulate(text)
    last = np.asarray(result["other.block[79].x"])[-1]
    first = np.asarray(result["other.block[0].x"])[-1]
    assert result.run["counters"]["partial_steps"] > 0
    mean = np.mean([np.asarray(result[f"other.block[{k}].x"])[-1] for k in range(80)])
    assert abs(mean) == pytest.approx(0.5 * (40.0 / 8.0) * 1.0**2, rel=0.02)  # 40 N of excess on 8 kg for 1 s
    assert abs(last) > abs(first) > 0


def test_a_part_of_few_machines_puts_jumps_of_friction_right_as_the_whole_of_many_does(scene, monkeypatch):
    """Six of 60 blocks move. The part has less than 40 contacts; switches stay inside steps, and their ends damped."""
    system = scene(row_with_stiction(60)).system
    runs = []
    for least in (1, 10**9):
        for name, value in {"LEAST": least, "LOOK_COST": 0, "LOOK_BASE": 3}.items():
            monkeypatch.setattr(parts, name, value)
        runs.append(integrate(system, Run(stop=3.0, accuracy=1e-6, engine="stepping")))
    part, whole = runs
    assert part.counters.partial_steps > 0.9 * part.counters.steps
    assert whole.counters.partial_steps == 0
    assert (part.counters.steps, part.counters.switches) == (whole.counters.steps, whole.counters.switches)
    np.testing.assert_allclose(part.y, whole.y, rtol=0, atol=1e-12)  # the parts differ by rounding
