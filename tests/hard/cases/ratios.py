"""Numbers far apart in one scene: masses, stiffnesses, time constants."""

from __future__ import annotations

import numpy as np

from tests.hard.play import CREEP, PRESLIDING, RELAXATION, Play
from tests.hard.registry import case

PAIR = """
components:
  light: {type: Mass, mass: @LIGHT@ kg, position: 0 m, velocity: @V1@ m/s}
  heavy: {type: Mass, mass: @HEAVY@ kg, position: 0 m, velocity: @V2@ m/s}
  pad: {type: Contact, normal_force: @PRESS@ N, curve: 0.5}
connections: [[heavy.flange, pad.a], [pad.b, light.flange]]
friction: {method: hold}
run: {stop: 1 s, accuracy: 1e-6}
record: {every: 10 ms}
"""


@case({"light one thrown": {"thrown": "light"}, "heavy one thrown": {"thrown": "heavy"}})
def mass_ratio_of_1e8_rubs_to_one_speed(play: Play, thrown: str) -> None:
    """A mass of 1e-4 kg on one of 1e4 kg, one of them thrown at 1 m/s.

    Oracle: momentum is conserved to rounding; they go together after m_red v/F = 0.2 s with 0.5 m_red v^2 as heat.
    """
    light, heavy = 1e-4, 1e4
    reduced = light * heavy / (light + heavy)
    force = reduced / 0.2
    v1, v2 = (1.0, 0.0) if thrown == "light" else (0.0, 1.0)
    text = PAIR.replace("@LIGHT@", repr(light)).replace("@HEAVY@", repr(heavy)).replace("@PRESS@", repr(2 * force))
    result = play.run(text.replace("@V1@", repr(v1)).replace("@V2@", repr(v2)))
    momentum = light * result["light.v"] + heavy * result["heavy.v"]
    start = light * v1 + heavy * v2
    play.near("momentum over that at the start", momentum / start, 1.0, 1e-6)
    slip = result["light.v"] - result["heavy.v"]
    exact = (v1 - v2) * np.maximum(1 - result.t / 0.2, 0.0)
    play.near("slip", slip, exact, play.by(1e-5, 10 * CREEP, 2e-2))
    play.near("light beside heavy", result["light.x"][-1] - result["heavy.x"][-1], (v1 - v2) * 0.1,
              play.by(1e-6, 4 * CREEP, 1.5 * RELAXATION))  # fmt: skip


@case({f"1e{k}": {"ratio": 10.0**k} for k in (2, 4, 6, 8)})
def stiff_core_in_a_soft_hose(play: Play, ratio: float) -> None:
    """Eleven nodes of a stiff core in a hose softer by a ratio, held together by friction alone; the core is pulled.

    Oracle: momentum is the impulse of the pull; friction is enough, so all goes as one: a = 11 N/11 kg.
    """
    nodes = 11
    parts, joins = [], []
    for i in range(nodes):
        parts += [f"  core{i}: {{type: Mass, mass: 0.7 kg, position: {0.1 * i:.1f} m, velocity: 0 m/s}}",
                  f"  hose{i}: {{type: Mass, mass: 0.3 kg, position: {0.1 * i:.1f} m, velocity: 0 m/s}}",
                  f"  pad{i}: {{type: Contact, normal_force: 10 N, curve: 0.5}}"]  # fmt: skip
        core, hose = [f"core{i}.flange", f"pad{i}.a"], [f"hose{i}.flange", f"pad{i}.b"]
        if i:
            core.append(f"c{i}.b")
            hose.append(f"h{i}.b")
        if i < nodes - 1:
            core.append(f"c{i + 1}.a")
            hose.append(f"h{i + 1}.a")
            parts += [
                f"  c{i + 1}: {{type: SpringDamper, stiffness: 1e8 N/m, damping: 2e3 N*s/m, free_length: 0.1 m}}",
                f"  h{i + 1}: {{type: SpringDamper, stiffness: {1e8 / ratio!r} N/m, damping: {2e3 / ratio!r} N*s/m, "
                "free_length: 0.1 m}",
            ]
        if i == nodes - 1:
            core.append("pull.flange")
        joins += [f"  - [{', '.join(core)}]", f"  - [{', '.join(hose)}]"]
    parts.append("  pull: {type: ForceSource, force: {ramp: {to: 11 N, over: 0.1 s}}}")
    tail = ["friction: {method: hold}", "run: {stop: 1 s, accuracy: 1e-6}", "record: {every: 10 ms}"]
    result = play.run("\n".join(["components:", *parts, "connections:", *joins, *tail]))
    impulse = np.where(result.t < 0.1, 55 * result.t**2, 0.55 + 11 * (result.t - 0.1))
    momentum = sum(0.7 * result[f"core{i}.v"] + 0.3 * result[f"hose{i}.v"] for i in range(nodes))
    play.near("momentum", momentum, impulse, 1e-4)
    for i in (0, 5, 10):
        slipped = result[f"hose{i}.x"] - result[f"core{i}.x"]
        # 0.3 kg at 1 m/s^2 take 0.3 N of 5 N: creep of 0.8 creep 0.06 a second, or 6 % of presliding.
        play.near(f"slip of node {i}", slipped, 0.0, play.by(1e-9, CREEP, PRESLIDING))


@case()
def time_constants_over_ten_decades(play: Play) -> None:
    """Masses on dampers whose speeds decay with time constants from 1e-7 to 1e3 s, and a block that stops by friction.

    Oracle: v = exp(-t/tau) for every one of them, 1 - t for the block; 2000 s.
    """
    decades = range(-7, 4)
    parts, wall, joins = [], ["wall.flange", "pad.a"], ["  - [pad.b, block.flange]"]
    for k in decades:
        name = f"d{k + 7}"
        parts += [f"  m{name}: {{type: Mass, mass: 1 kg, position: 0 m, velocity: 1 m/s}}",
                  f"  {name}: {{type: Damper, damping: {10.0**-k!r} N*s/m}}"]  # fmt: skip
        wall.append(f"{name}.a")
        joins.append(f"  - [{name}.b, m{name}.flange]")
    parts += ["  wall: {type: Ground}", "  block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 1 m/s}",
              "  pad: {type: Contact, normal_force: 10 N, curve: 0.1}"]  # fmt: skip
    joins.append(f"  - [{', '.join(wall)}]")
    tail = ["friction: {method: hold}", "run: {stop: 2000 s, accuracy: 1e-6}"]
    result = play.run("\n".join(["components:", *parts, "connections:", *joins, *tail]))
    for k in decades:
        tau, name = 10.0**k, f"md{k + 7}"
        play.near(f"speed with {tau:g} s", result[f"{name}.v"], np.exp(-result.t / tau), 1e-4)
        play.near(f"travel with {tau:g} s", result[f"{name}.x"][-1] / tau, 1 - np.exp(-2000 / tau), 1e-3)
    play.near("travel of the block", result["block.x"][-1], 0.5, play.by(1e-5, 1e-4, 1.5 * RELAXATION))


@case({"into a tether of 1e8 N/m": {"stiffness": 1e8}, "into a tether of 1e4 N/m": {"stiffness": 1e4}})
def slack_to_taut_with_a_snap(play: Play, stiffness: float) -> None:
    """A block slides 1 m over the floor into a stiff tether, is thrown back and comes to rest by friction.

    Oracle: v^2 = 9 - 2 on arrival; the peak of tension v sqrt(k m) less friction (quadrature of the half swing with
    F = 1 N); back at rest after v'^2/2 m; all energy is heat.
    """
    text = f"""
    components:
      floor: {{type: Ground}}
      block: {{type: Mass, mass: 1 kg, position: 0 m, velocity: 3 m/s}}
      pad: {{type: Contact, normal_force: 10 N, curve: 0.1}}
      rope: {{type: Tether, stiffness: {stiffness!r} N/m, length: 1 m}}
    connections: [[floor.flange, pad.a, rope.a], [pad.b, block.flange, rope.b]]
    friction: {{method: hold}}
    run: {{stop: 4 s, accuracy: 1e-6}}
    """
    result = play.run(text)
    arrival = 9.0 - 2.0  # v^2
    # k s^2/2 + F s = v^2/2 gives the deepest stretch s; on the way back friction takes F s once more.
    deepest = (-1 + np.sqrt(1 + stiffness * arrival)) / stiffness
    away = (arrival / 2 - 2 * deepest) / 1.0
    play.near("position at rest", result["block.x"][-1], 1 - away, play.by(1e-4, 2e-4, 6 * RELAXATION))
    play.near("heat", result.run["energy"]["dissipated"], 4.5, play.by(1e-4, 1e-4, 1e-2))
    play.check(result["rope.tension"].min() > -1e-6, "the tether pushes")
    play.check(
        result["rope.tension"].max() < stiffness * deepest * (1 + 1e-3),
        "the tether pulls harder than the energy allows",
    )
