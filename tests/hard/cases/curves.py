"""Steep falling curves, and one that rises and falls."""

from __future__ import annotations

import numpy as np

from tests.hard.play import Play
from tests.hard.registry import case
from tests.reference.belt import StickSlipBelt

BELT = """
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0.2 m/s}
  belt: {type: MotionSource, velocity: 0.2 m/s}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: @CURVE@, stiction: 1.0, coulomb: 0.6, velocity: @V@ m/s}}
connections: [[wall.flange, spring.a], [spring.b, block.flange, pad.b], [belt.flange, pad.a]]
friction: {method: hold}
run: {stop: 8.4 s, accuracy: 1e-6}
record: {every: 5 ms}
"""
STEEP = {f"{curve} over {v:g} m/s": {"curve": curve, "velocity": v} for curve in ("tustin", "stribeck")
         for v in (1e-3, 1e-5, 1e-7)}  # fmt: skip


@case(STEEP)
def steep_falling_curve(play: Play, curve: str, velocity: float) -> None:
    """Friction falls from 10 to 6 N over a slip speed of 1e-3, 1e-5 or 1e-7 m/s: growth rates up to 4e7 1/s.

    Oracle: as steep as that it is the belt with a jump: ten break-aways at its closed form within the curve's width.
    """
    creep = velocity / 20
    result = play.run(BELT.replace("@CURVE@", curve).replace("@V@", repr(velocity)), **(
        {"friction__creep": creep} if play.treatment == "binding" else {}))  # fmt: skip
    exact = StickSlipBelt()
    if play.treatment == "lugre":  # its break-away depends on the rate of loading: only the cycle's limits
        x = result["block.x"][result.t > 1]
        play.check(x.max() <= 0.1 * 1.05 and x.min() >= exact.lowest_position * 1.1 - 0.01, "the cycle is too wide")
        return
    x = result["block.x"]
    lowest, highest = exact.lowest_position, 0.06 + np.hypot(0.04, 0.2 / 10)
    within = 2e-4 + 3 * velocity  # 5 ms between records see a turn within 1/2 a t^2 = 5e-5 m
    play.near("lowest position", x[result.t > 1].min(), lowest, within)
    play.near("highest position", x[result.t > 1].max(), highest, within)
    # At break-away nothing pulls yet, and the sign of the slip is one of rounding: a few tries at one instant are fine.
    tries = np.array([e.t for e in result.events if e.zone_to in ("backward", "break_backward") and e.t > 0.1])
    found = tries[np.diff(tries, prepend=-1.0) > 0.1]
    play.check(len(found) == 10, f"{len(found)} break-aways, must be 10")
    # A slip is late: v' = r t + 4 v/v_s (tustin) or r t + 4 (v/v_s)^2 (stribeck), r = 20 N/s/kg, leaves v = 0 within
    # some 30 e-folds, or the 1.99 (r c)^(-1/3) of the Riccati equation; the load grows meanwhile, so twice that.
    delay = 30 * velocity / 4 if curve == "tustin" else 2 * (20 * 4 / velocity**2) ** (-1 / 3)
    play.near("tenth break-away", found[9], exact.breakaways(10)[9], 20 * (delay + velocity) + 1e-4)
