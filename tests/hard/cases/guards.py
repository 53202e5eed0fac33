"""Starts on a guard, and two guards in one instant."""

from __future__ import annotations

import numpy as np

from tests.hard.play import CREEP, RELAXATION, Play
from tests.hard.registry import NO_FRICTION, case

TETHERED = """
components:
  wall: {type: Ground}
  rope: {type: Tether, stiffness: 1000 N/m, length: 1 m}
  load: {type: Mass, mass: 10 kg, position: 1 m, velocity: @SPEED@ m/s}
  pull: {type: ForceSource, force: @FORCE@ N}
connections: [[wall.flange, rope.a], [rope.b, load.flange, pull.flange]]
run: {stop: 1 s, accuracy: 1e-6}
record: {every: 10 ms}
"""


@case(
    {
        "leaving": {"speed": -1.0, "force": 0.0}, "at rest": {"speed": 0.0, "force": 0.0},
        "arriving": {"speed": 1.0, "force": 0.0}, "pulled": {"speed": 0.0, "force": 50.0},
        "pushed": {"speed": 0.0, "force": -50.0},
    },
    treatments=NO_FRICTION,
)  # fmt: skip
def tether_that_starts_exactly_at_its_length(play: Play, speed: float, force: float) -> None:
    """The guard between slack and taut is zero at the start, with a speed or a force either way, or none.

    Oracle: free flight, rest, or a swing on the spring until slack; closed form.
    """
    result = play.run(TETHERED.replace("@SPEED@", repr(speed)).replace("@FORCE@", repr(force)))
    t, rate = result.t, 10.0  # sqrt(k/m)
    if force > 0:
        exact = force / 1000 * (1 - np.cos(rate * t))
    elif force < 0:
        exact = force / 20 * t**2
    elif speed > 0:
        exact = np.where(t < np.pi / rate, speed / rate * np.sin(rate * t), -speed * (t - np.pi / rate))
    else:
        exact = speed * t
    play.near("stretch", result["load.x"] - 1, exact, 2e-6)
    play.check(result["rope.tension"].min() >= -1e-6, "the tether pushes")


STOPPED = """
components:
  wall: {type: Ground}
  stop: {type: EndStop, lower: 0 m, upper: 1 m, stiffness: 1e6 N/m, damping: 0 s/m}
  load: {type: Mass, mass: 1 kg, position: @X@ m, velocity: @V@ m/s}
connections: [[wall.flange, stop.a], [stop.b, load.flange]]
run: {stop: 0.5 s, accuracy: 1e-6}
record: {every: 10 ms}
"""


@case(
    {
        "upper, inward": {"x": 1.0, "v": -1.0},
        "upper, outward": {"x": 1.0, "v": 1.0},
        "lower, at rest": {"x": 0.0, "v": 0.0},
    },
    treatments=NO_FRICTION,
)
def end_stop_touched_at_the_start(play: Play, x: float, v: float) -> None:
    """A mass that starts exactly at a stop of 1e6 N/m without damping, moving out of it, into it, or not at all.

    Oracle: free flight, at once or after half a swing of pi sqrt(m/k) = 3.14 ms.
    """
    result = play.run(STOPPED.replace("@X@", repr(x)).replace("@V@", repr(v)))
    back = np.pi * 1e-3 if v > 0 else 0.0
    free = result.t > back
    play.near("position", result["load.x"][free], x - abs(v) * (result.t[free] - back), 1e-5)


@case(
    {"just below": {"share": 1 - 1e-12}, "exactly": {"share": 1.0}, "just above": {"share": 1 + 1e-12}},
    treatments=("hold",),
)
def starts_with_the_slip_that_counts_as_none(play: Play, share: float) -> None:
    """The block starts with `stick_speed`, 1e-6 m/s: the guard that tears a held contact loose is zero.

    Oracle: stuck or sliding, it is at rest after 1e-6 m and stays.
    """
    text = f"""
    components:
      floor: {{type: Ground}}
      block: {{type: Mass, mass: 1 kg, position: 0 m, velocity: {1e-6 * share!r} m/s}}
      pad: {{type: Contact, normal_force: 10 N, curve: 0.5}}
    connections: [[floor.flange, pad.a], [pad.b, block.flange]]
    friction: {{method: hold}}
    run: {{stop: 1 s, accuracy: 1e-6}}
    """
    result = play.run(text, lenient={"closure": np.inf})  # 5e-13 J are taken out by the impulse of the capture
    play.near("position", result["block.x"][-1], 0.0, 2e-9)
    play.near("speed", result["block.v"][-1], 0.0, 1e-12)


@case()
def tether_taut_at_the_instant_of_the_stop(play: Play) -> None:
    """Thrown with 2 m/s against 4 N a block stops after 0.5 m, which is exactly where its tether becomes taut.

    Oracle: it rests at 0.5 m from 0.5 s on; the tether carries nothing.
    """
    text = """
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 2 m/s}
      pad: {type: Contact, normal_force: 10 N, curve: 0.4}
      rope: {type: Tether, stiffness: 1e4 N/m, length: 0.5 m}
    connections: [[floor.flange, pad.a, rope.a], [pad.b, block.flange, rope.b]]
    friction: {method: hold}
    run: {stop: 2 s, accuracy: 1e-6}
    record: {every: 10 ms}
    """
    result = play.run(text)
    exact = np.where(result.t < 0.5, 2 * result.t - 2 * result.t**2, 0.5)
    within = play.by(1e-6, 3 * CREEP, 1.5 * RELAXATION * 2)
    play.near("position", result["block.x"], exact, within)
    play.near("tension", result["rope.tension"], 0.0, 1e4 * within)


@case()
def two_unequal_pads_catch_one_block_at_once(play: Play) -> None:
    """A block slides on two pads of 3 N and 1 N side by side and is caught by both in the same instant.

    Oracle: stops after v^2/(2 x 4) = 0.5 m, and a load of 2 N from 1 s on is shared and held.
    """
    text = """
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 2 m/s}
      one: {type: Contact, normal_force: 30 N, curve: 0.1}
      two: {type: Contact, normal_force: 1 N, curve: 1.0}
      pull: {type: ForceSource, force: {step: {to: 1.5 N, at: 1 s}}}
    connections: [[floor.flange, one.a, two.a], [one.b, two.b, block.flange, pull.flange]]
    friction: {method: hold}
    run: {stop: 2 s, accuracy: 1e-6}
    record: {every: 10 ms}
    """
    result = play.run(text)
    exact = np.where(result.t < 0.5, 2 * result.t - 2 * result.t**2, 0.5)
    play.near("position", result["block.x"], exact, play.by(1e-6, 3 * CREEP, 1.5 * RELAXATION * 2))
    held = result.t > 1.5
    carried = result["one.friction"][held] + result["two.friction"][held]
    play.near("friction of both", carried, 1.5, play.by(1e-6, 1e-3, 1e-2))
    if play.treatment != "lugre":  # whose damping comes on top
        play.check((np.abs(result["two.friction"]) <= 1 + 1e-6).all(), "the small pad carries more than it can")
