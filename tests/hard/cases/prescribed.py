"""Contacts on motions that are given."""

from __future__ import annotations

import numpy as np

from tests.hard.play import CREEP, PRESLIDING, RELAXATION, Broken, Play
from tests.hard.registry import case


@case({"carried": {"share": 0.99}, "slipping": {"share": 3.0}})
def block_on_a_shaken_table(play: Play, share: float) -> None:
    """A block of 2 kg on a table that swings with 2 Hz: friction gives it 5 m/s^2, the table has a share of that.

    Oracle: below, it goes with the table; above, friction never passes 10 N, and after some swings the speed repeats
    with the table.
    """
    rate = 4 * np.pi
    amplitude = share * 5.0 / rate**2
    text = f"""
    components:
      table: {{type: MotionSource, position: {{sine: {{amplitude: {amplitude!r} m, frequency: 2 Hz, phase: 90 deg}}}}}}
      block: {{type: Mass, mass: 2 kg, position: {amplitude!r} m, velocity: 0 m/s}}
      pad: {{type: Contact, normal_force: 20 N, curve: 0.5}}
    connections: [[table.flange, pad.a], [pad.b, block.flange]]
    friction: {{method: hold}}
    run: {{stop: 10 s, accuracy: 1e-6}}
    record: {{every: 5 ms}}
    """
    result = play.run(text)
    if share < 1:
        apart = result["block.x"] - amplitude * np.cos(rate * result.t)
        if play.treatment == "lugre":  # it drifts when shaken, and is started under load
            play.check(np.abs(apart).max() < 100 * PRESLIDING, "it drifts by more than presliding a swing")
            return
        play.near("block beside table", apart, 0.0, play.by(1e-8, CREEP * 0.5 * 10))
        return
    force = np.abs(result["pad.friction"][result.side == 0])
    play.check(force.max() <= 10 * (1 + play.by(1e-6, 1e-6, 0.5)), f"friction of {force.max():.8g} N, above 10 N")
    period = 100  # rows
    tail = result.side == 0
    v = result["block.v"][tail][-4 * period :]
    play.near("speed one swing later", v[period:], v[:-period], play.by(2e-4, 2e-3, 2e-2))


@case()
def surface_and_body_both_prescribed(play: Play) -> None:
    """A contact between ground and a motion that is given, to and fro: nothing can answer its force.

    Oracle: T = mu N sgn(v), heat is mu N times the path of 4 A f t; or the scene is refused with the name of the pad.
    """
    text = """
    components:
      floor: {type: Ground}
      slide: {type: MotionSource, position: {sine: {amplitude: 0.1 m, frequency: 1 Hz}}}
      pad: {type: Contact, normal_force: 10 N, curve: 0.5}
    connections: [[floor.flange, pad.a], [pad.b, slide.flange]]
    friction: {method: hold}
    run: {stop: 5 s, accuracy: 1e-6}
    """
    try:
        result = play.run(text)
    except Broken as broken:
        if broken.verdict == "stopped" and "pad" in broken.reason:
            return
        raise
    play.near("heat", result.run["energy"]["dissipated"], 5.0 * 0.4 * 5, play.by(1e-4, 5e-2, 5e-2))


@case({"up": {"jump": 0.5}, "back": {"jump": -0.5}})
def belt_that_jumps_in_speed(play: Play, jump: float) -> None:
    """A block rides on a belt of 0.2 m/s whose speed jumps by 0.5 m/s either way at 1 s.

    Oracle: friction is finite: the block follows with mu g = 5 m/s^2, for 0.1 s; the slip way is 25 mm.
    """
    text = f"""
    components:
      belt: {{type: MotionSource, velocity: {{step: {{from: 0.2 m/s, to: {0.2 + jump!r} m/s, at: 1 s}}}}}}
      block: {{type: Mass, mass: 2 kg, position: 0 m, velocity: 0.2 m/s}}
      pad: {{type: Contact, normal_force: 20 N, curve: 0.5}}
    connections: [[belt.flange, pad.a], [pad.b, block.flange]]
    friction: {{method: hold}}
    run: {{stop: 2 s, accuracy: 1e-6}}
    record: {{every: 10 ms}}
    """
    result = play.run(text)
    exact = 0.2 + np.sign(jump) * np.clip(5 * (result.t - 1), 0, 0.5)
    play.near("speed", result["block.v"], exact, play.by(1e-5, 5 * CREEP, 8 * RELAXATION))
