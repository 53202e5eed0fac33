"""What happens inside a step, or a hair before its end, is not missed: break-aways, peaks, starts at a limit."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate import Run, integrate
from fairlead.integrate.linear import ordering
from tests.conftest import Scene

ENGINES = pytest.mark.parametrize("engine", ["rodas", "stepping"])

LET_GO = """
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      pad: {type: Contact, normal_force: 10 N, curve: 0.4}
      pull: {type: ForceSource, force: {drift: {rate: 5 N/s}}}
    connections: [[floor.flange, pad.a], [pad.b, block.flange, pull.flange]]
    friction: {method: hold}
    run: {stop: 1.5 s}
    """

SWING = """
    components:
      slow: {type: Mass, mass: 1 kg}
      soft: {type: SpringDamper, stiffness: 1 N/m, damping: 0 N*s/m}
      base: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      pad: {type: Contact, normal_force: 100 N, curve: 0.1}
      load: {type: ForceSource, force: {sine: {amplitude: 10.5 N, frequency: 5 Hz}}}
      floor: {type: Ground}
    connections:
      - [slow.flange, soft.a]
      - [soft.b, base.flange]
      - [block.flange, pad.b, load.flange]
      - [pad.a, floor.flange]
    friction: {method: hold}
    initial: {slow.v: 1 m/s}
    run: {stop: 10 s}
    """


@ENGINES
@pytest.mark.parametrize("accuracy", [1e-3, 1e-5, 1e-7])
def test_a_contact_that_lets_go_inside_a_step_loses_none_of_its_speed(scene: Scene, engine: str, accuracy) -> None:
    """The load 5 t passes 4 N at 0.8 s; from there on x = 5 (t - 0.8)^3/6. Before, nothing bends and steps are long."""
    system = scene(LET_GO, **{"run.accuracy": accuracy}).system
    outcome = integrate(system, Run(stop=1.5, engine=engine, record=["block.x"]))
    assert outcome.values[-1][0] == pytest.approx(5 * 0.7**3 / 6, abs=20 * accuracy * 0.1)


@ENGINES
@pytest.mark.parametrize("accuracy", [1e-3, 1e-5])
def test_a_load_that_swings_just_above_the_limit_breaks_away_every_time(scene: Scene, engine: str, accuracy) -> None:
    """In fifty periods it is above the limit a hundred times, each time for 0.02 s; beside it something slow moves."""
    system = scene(SWING, **{"run.accuracy": accuracy}).system
    outcome = integrate(system, Run(stop=10.0, engine=engine))
    machine = next(k for k, name in enumerate(system.machine_names) if name == "pad")
    names, events = list(system.zone_names(machine)), outcome.events[outcome.events["machine"] == machine]
    left = events[(events["before"] == names.index("held")) & (events["after"] != names.index("held"))]
    half_periods = np.unique(np.floor(left["t"] / 0.1))
    assert len(half_periods) == 100


@pytest.mark.parametrize("speed", [0.0, 1.0])
@ENGINES
def test_an_undamped_tether_that_starts_exactly_taut(simulate: Scene, engine: str, speed: float) -> None:
    """omega = 10/s: x = 1 + 0.05 (1 - cos 10 t) + v/10 sin 10 t, while it pulls; nothing damps it."""
    text = """
    components:
      wall: {type: Ground}
      rope: {type: Tether, stiffness: 1000 N/m, length: 1 m}
      load: {type: Mass, mass: 10 kg, position: 1 m, velocity: SPEED m/s}
      pull: {type: ForceSource, force: 50 N}
    connections: [[wall.flange, rope.a], [rope.b, load.flange, pull.flange]]
    run: {stop: 0.3 s, accuracy: 1e-6, engine: ENGINE}
    """.replace("ENGINE", engine).replace("SPEED", str(speed))
    result = simulate(text)
    exact = 1 + 0.05 * (1 - np.cos(10 * result.t)) + speed / 10 * np.sin(10 * result.t)
    assert result["load.x"] == pytest.approx(exact, abs=3e-6)


def test_a_switch_a_hair_before_a_time_event_does_not_end_the_run(simulate: Scene) -> None:
    """A ramp that ends exactly at stiction: the crossing is one rounding error before the end of the ramp.

    Then 5 N pull against 3 N: x = (t - 1)^2 but for the creep before, 9e-6 m/s at most.
    """
    result = simulate("""
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}}
      pull: {type: ForceSource, force: {ramp: {to: 5.0 N, over: 1 s}}}
    connections: [[floor.flange, pad.a], [pad.b, block.flange, pull.flange]]
    friction: {method: binding, creep: 1e-5 m/s}
    run: {stop: 10 s, accuracy: 1e-6, engine: rodas}
    """)
    assert result["block.x"][-1] == pytest.approx(81, abs=1e-5 * 10)


def test_rows_between_steps_show_no_motion_that_stiff_parts_never_made(simulate: Scene) -> None:
    """A stiff core in a soft hose, pulled over contacts: the momentum of all is the impulse of the pull."""
    nodes, core, hose = 6, 0.7, 0.3
    parts = [f"core{k}: {{type: Mass, mass: {core} kg}}" for k in range(nodes)]
    parts += [f"hose{k}: {{type: Mass, mass: {hose} kg}}" for k in range(nodes)]
    parts += [f"pad{k}: {{type: Contact, normal_force: 10 N, curve: 0.5}}" for k in range(nodes)]
    parts += [f"c{k}: {{type: SpringDamper, stiffness: 1e8 N/m, damping: 2e3 N*s/m}}" for k in range(1, nodes)]
    parts += [f"h{k}: {{type: SpringDamper, stiffness: 1e4 N/m, damping: 0.2 N*s/m}}" for k in range(1, nodes)]
    wires = [f"[core{k}.flange, pad{k}.a]" for k in range(nodes)]
    wires += [f"[hose{k}.flange, pad{k}.b]" for k in range(nodes)]
    for line, mass in (("c", "core"), ("h", "hose")):
        for k in range(1, nodes):
            wires += [f"[{mass}{k - 1}.flange, {line}{k}.a]", f"[{line}{k}.b, {mass}{k}.flange]"]
    text = "components:\n" + "\n".join("  " + part for part in parts)
    text += "\n  pull: {type: ForceSource, force: {ramp: {to: 6 N, over: 0.1 s}}}\nconnections:\n"
    text += "\n".join("  - " + wire for wire in [*wires, f"[core{nodes - 1}.flange, pull.flange]"])
    text += "\nfriction: {method: hold}\nrun: {stop: 1 s, accuracy: 1e-5, engine: stepping}\nrecord: {every: 10 ms}\n"
    result = simulate(text)
    momentum = sum(core * result[f"core{k}.v"] + hose * result[f"hose{k}.v"] for k in range(nodes))
    impulse = np.where(result.t < 0.1, 30 * result.t**2, 0.3 + 6 * (result.t - 0.1))
    assert momentum == pytest.approx(impulse, abs=1e-3 * impulse[-1])


def test_factors_of_a_line_on_a_belt_that_moves_grow_with_its_length_only(scene: Scene) -> None:
    """Every node has a contact with the one belt: that must not join all nodes with each other."""

    def entries(nodes: int) -> int:
        parts = [f"pad{k}: {{type: Contact, normal_force: 10 N, curve: 0.5}}" for k in range(nodes)]
        parts += [f"node{k}: {{type: Mass, mass: 0.1 kg}}" for k in range(nodes)]
        parts += [f"s{k}: {{type: SpringDamper, stiffness: 1e4 N/m, damping: 1 N*s/m}}" for k in range(1, nodes)]
        wires = [f"[belt.flange, pad{k}.a]" for k in range(nodes)]
        wires += [f"[pad{k}.b, node{k}.flange]" for k in range(nodes)]
        wires += [f"[node{k - 1}.flange, s{k}.a]" for k in range(1, nodes)]
        wires += [f"[s{k}.b, node{k}.flange]" for k in range(1, nodes)]
        text = "components:\n  belt: {type: Mass, mass: 50 kg}\n" + "\n".join("  " + part for part in parts)
        text += "\nconnections:\n" + "\n".join("  - " + wire for wire in wires) + "\nfriction: {method: hold}\n"
        plan = ordering.plan(scene(text + "run: {stop: 1 s}\n").system)
        return len(plan.arrays["lower_rows"]) + len(plan.arrays["upper_rows"])

    assert entries(80) < 2.3 * entries(40)


def test_a_bristle_that_is_bent_to_its_end_on_both_sides_of_a_reversal_is_followed(simulate: Scene) -> None:
    """Coulomb friction of 5 N over twenty half strokes of 0.2 m, but for what the bristle gives at each end."""
    result = simulate("""
    components:
      floor: {type: Ground}
      slide: {type: MotionSource, position: {sine: {amplitude: 0.1 m, frequency: 1 Hz}}}
      pad: {type: Contact, normal_force: 10 N, curve: 0.5}
    connections: [[floor.flange, pad.a], [pad.b, slide.flange]]
    friction: {method: lugre}
    run: {stop: 5 s, accuracy: 1e-3}
    """)
    assert result.run["energy"]["dissipated"] == pytest.approx(5 * 0.4 * 5, rel=5e-3)


@pytest.mark.parametrize("accuracy", [1e-3, 1e-5])
def test_what_carries_a_block_on_a_shaken_table_is_its_mass_times_acceleration(simulate: Scene, accuracy) -> None:
    """Bound at 80 % of stiction: between the steps, too, the force is m a but for the little the block creeps."""
    result = simulate("""
    components:
      table: {type: MotionSource, position: {sine: {amplitude: 10 mm, frequency: 3 Hz, phase: 90 deg}}}
      block: {type: Mass, mass: 2 kg, position: 10 mm}
      pad: {type: Contact, normal_force: 20 N, curve: 0.444}
    connections: [[table.flange, pad.a], [pad.b, block.flange]]
    friction: {method: binding, creep: 1e-5 m/s}
    run: {stop: 3 s}
    record: {every: 3 ms, signals: [pad.friction]}
    """, **{"run.accuracy": accuracy})  # fmt: skip
    omega = 2 * np.pi * 3
    force = 2 * 0.01 * omega**2 * np.cos(omega * result.t)
    later = result.t > 0.1
    assert np.abs(result["pad.friction"] - force)[later].max() < {1e-3: 0.2, 1e-5: 0.02}[accuracy] * 8.88


def test_forces_so_large_that_their_rounding_is_above_the_tolerance_have_a_start(scene: Scene) -> None:
    """Two held contacts in line carry 3e5 N; a weight of 1e-8 N is less than that number can resolve."""
    text = """
    components:
      wall: {type: Ground}
      left: {type: Mass, mass: 1 kg}
      right: {type: Mass, mass: 3 kg}
      pull: {type: ForceSource, force: 3e5 N}
      one: {type: Contact, method: hold, normal_force: 1e6 N, curve: 0.5}
      two: {type: Contact, method: hold, normal_force: 1e6 N, curve: 0.5}
      three: {type: Contact, method: hold, normal_force: 1e6 N, curve: 0.5}
    connections:
      - [wall.flange, one.a, three.a]
      - [left.flange, one.b, two.a]
      - [two.b, right.flange, three.b, pull.flange]
    run: {stop: 1 s, accuracy: 1e-9}
    """
    outcome = integrate(scene(text).system, Run(stop=1.0))
    assert outcome.ok, outcome.sentence


TAUT = """
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      pad: {type: Contact, normal_force: 10 N, curve: 0.8}
      rope: {type: Tether, stiffness: 1e5 N/m, length: LENGTH mm}
      hand: {type: MotionSource, velocity: 0.1 m/s}
    connections: [[floor.flange, pad.a], [pad.b, block.flange, rope.a], [rope.b, hand.flange]]
    run: {stop: 2 s, accuracy: 1e-6}
    record: {every: 10 ms, signals: [block.x]}
    """


@ENGINES
@pytest.mark.parametrize("length", [1.9, 2.0, 2.1])
def test_a_rope_that_comes_taut_in_the_middle_of_a_long_step(simulate: Scene, engine: str, length: float) -> None:
    """Its force is zero in the middle and 200 N at the end: that energy came from nowhere, at any accuracy."""
    result = simulate(TAUT.replace("LENGTH", str(length)), **{"run.engine": engine})
    taut, free = (next(e.t for e in result.events if e.component == name and e.t > 0) for name in ("rope", "pad"))
    bound, missing = {"rodas": (1e-6, 1e-6), "stepping": (1e-3, 1e-2)}[engine]  # stepping rounds a switch to its step
    assert taut == pytest.approx(10 * length * 1e-3, abs=bound)
    assert free == pytest.approx(10 * length * 1e-3 + 8.0 / 1e5 / 0.1, abs=bound)  # 8 N hold the block
    assert result.run["energy"]["closure"] < missing  # it was 0.13


def test_the_ledger_of_a_step_that_ends_at_a_jump(simulate: Scene) -> None:
    """Stiction above sliding friction ends steps of stepping where contacts let go; their energy is counted too."""
    rows = [(1, 30, 1000), (1, 30, 5000), (0.2, 8, 5000), (1, 30, 5000), (0.2, 8, 1000), (1, 8, 100)]  # kg, N, N/m
    blocks = "".join(
        f"\n      b{i}: {{type: Mass, mass: {mass} kg}}"
        f"\n      c{i}: {{type: Contact, normal_force: {pressed} N, curve: {{stiction: 0.6, coulomb: 0.3}}}}"
        f"\n      s{i}: {{type: Spring, stiffness: {stiffness} N/m}}"
        for i, (mass, pressed, stiffness) in enumerate(rows)
    )  # fmt: skip
    joins = "".join(f"\n      - [b{i}.flange, c{i}.b, s{i}.a]" for i in range(6))
    text = f"""
    components:
      floor: {{type: Ground}}
      hand: {{type: MotionSource, position: {{sine: {{amplitude: 100 mm, frequency: 1 Hz}}}}}}{blocks}
    connections:
      - [floor.flange, {", ".join(f"c{i}.a" for i in range(6))}]
      - [hand.flange, {", ".join(f"s{i}.b" for i in range(6))}]{joins}
    run: {{stop: 1 s, accuracy: 1e-4, engine: stepping}}
    record: {{every: 10 ms, signals: [b0.x]}}
    """
    assert simulate(text).run["energy"]["closure"] < 1e-3
