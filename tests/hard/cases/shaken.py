"""Small scenes that are shaken, at every accuracy."""

from __future__ import annotations

import numpy as np

from tests.hard.play import Play
from tests.hard.registry import case

PAIR = """
components:
  wall: {type: Ground}
  belt: {type: MotionSource, velocity: {sine: {amplitude: 0.1 m/s, frequency: 0.7 Hz, offset: 0.2 m/s}}}
  one: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
  two: {type: Mass, mass: 0.7 kg, position: 0 m, velocity: 0 m/s}
  hook: {type: Spring, stiffness: 100 N/m}
  tie: {type: SpringDamper, stiffness: 300 N/m, damping: 0.5 N*s/m}
  shake: {type: ForceSource, force: {sine: {amplitude: 4 N, frequency: 3.1 Hz}}}
  pad_one: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 1.0, coulomb: 0.6}}
  pad_two: {type: Contact, normal_force: 7 N, curve: {curve: coulomb, stiction: 1.0, coulomb: 0.6}}
connections:
  - [wall.flange, hook.a]
  - [hook.b, one.flange, pad_one.b, tie.a]
  - [tie.b, two.flange, pad_two.b, shake.flange]
  - [belt.flange, pad_one.a, pad_two.a]
friction: {method: hold}
run: {stop: 3 s, accuracy: @ACCURACY@}
record: {every: 0.2 ms}
"""


@case({f"1e-{k}": {"accuracy": 10.0**-k} for k in (3, 5, 7, 9)}, treatments=("hold", "binding"))
def two_blocks_on_a_belt_that_are_shaken(play: Play, accuracy: float) -> None:
    """Two blocks tied by a spring on a belt of changing speed, one shaken: some fifty switches in no order.

    Oracle: each contact is within its stiction and at its sliding friction while it slides; momentum changes by the
    impulse of all forces (quadrature of the recorded ones); energy adds up.
    """
    result = play.run(PAIR.replace("@ACCURACY@", repr(accuracy)))
    for pad, limit in (("pad_one", 10.0), ("pad_two", 7.0)):
        force, slip = result[f"{pad}.friction"], result[f"{pad}.slip"]
        play.check(
            np.abs(force).max() <= limit * (1 + 1e-6) + 3 * accuracy, f"{pad} carries {np.abs(force).max():.8g} N"
        )
        slides = (np.abs(slip) > play.by(1e-4, 5 * play.creep)) & (result.side == 0)
        play.near(f"friction of {pad}", (force * np.sign(slip))[slides], 0.6 * limit, 1e-6 * limit)
    t = result.t
    forces = -result["hook.tension"] - result["pad_one.friction"] - result["pad_two.friction"] + result["shake.force"]
    impulse = np.concatenate([[0], np.cumsum(np.diff(t) * (forces[1:] + forces[:-1]) / 2)])
    momentum = result["one.v"] + 0.7 * result["two.v"]
    # The trapezoid rule on 0.2 ms misses up to 0.1 ms of a change by 10 N at each of some 70 switches.
    # The speed at a binding contact is known to a tenth of its creep, hence its friction to a tenth, at loose accuracy.
    play.near("momentum", momentum - momentum[0], impulse, 2e-2 + play.by(0.0, 100 * accuracy))
