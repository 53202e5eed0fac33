"""Loads at, just below and just above what holds."""

from __future__ import annotations

import numpy as np

from tests.hard.play import CREEP, PRESLIDING, Play
from tests.hard.registry import case

NEARLY = {"exactly": {"share": 0.0}, "1e-12 below": {"share": -1e-12}, "1e-12 above": {"share": 1e-12}}
LIMIT, SLIDING = 5.0, 3.0  # N


def loaded(load: str, stiction: float = LIMIT, sliding: float = SLIDING, stop: float = 10.0) -> str:
    """A block of 1 kg on the floor under a load."""
    curve = f"{{curve: coulomb, stiction: {stiction / 10!r}, coulomb: {sliding / 10!r}}}"
    return f"""
    components:
      floor: {{type: Ground}}
      block: {{type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}}
      pad: {{type: Contact, normal_force: 10 N, curve: {curve}}}
      pull: {{type: ForceSource, force: {load}}}
    connections: [[floor.flange, pad.a], [pad.b, block.flange, pull.flange]]
    friction: {{method: hold}}
    run: {{stop: {stop!r} s, accuracy: 1e-6}}
    """


def creeping(load: float, time: float, limit: float = LIMIT, sliding: float = SLIDING) -> float:
    """How far a binding contact creeps under a load [m] (physics 1.4): g0 = F_s/v_c + F_k/(4 v_c)."""
    return load / ((limit + sliding / 4) / CREEP) * time


@case(NEARLY, treatments=("hold", "binding"))
def load_comes_up_to_stiction_and_stays(play: Play, share: float) -> None:
    """A load grows to stiction within 1 s and stays there for 9 s, exactly, or 1e-12 of it below or above.

    Oracle: either the block holds, or it slides from 1 s on with (5 N - 3 N)/1 kg. At a difference that is beyond the
    last digit of the load both are right; what lies between is wrong.
    """
    top = LIMIT * (1 + share)
    result = play.run(loaded(f"{{ramp: {{to: {top!r} N, over: 1 s}}}}"))
    slid, crept = LIMIT - SLIDING, play.by(1e-9, creeping(LIMIT, 10.0))
    end = result["block.x"][-1]
    if abs(end) > 2 * crept:
        late = np.maximum(result.t - 1.0, 0.0)
        play.near("position while it slides", result["block.x"], slid * late**2 / 2, 1e-3)
    else:
        play.check(abs(end) <= 1.01 * crept, f"the block is at {end:.3g} m: it neither holds nor slides")
    if share < 0:
        play.check(abs(end) <= 1.01 * crept, f"the block is at {end:.3g} m under a load that holds")


@case(NEARLY)
def load_comes_up_to_sliding_friction_and_stays(play: Play, share: float) -> None:
    """The same where stiction and sliding friction are both 5 N, so that nothing jumps.

    Oracle: sliding or not, 1e-12 of 5 N moves 1 kg by 2e-10 m in 9 s. Bristles give it sqrt(2 F z/m) at most.
    """
    top = LIMIT * (1 + share)
    result = play.run(loaded(f"{{ramp: {{to: {top!r} N, over: 1 s}}}}", sliding=LIMIT))
    end = result["block.x"][-1]
    crept = play.by(1e-9, creeping(LIMIT, 10.0, LIMIT, LIMIT))
    if play.treatment == "lugre":
        # While the bristles bend they carry less than the load: by z_s F at most in energy, which it keeps as speed.
        fastest = np.sqrt(2 * LIMIT * PRESLIDING)
        play.check(0 <= end < 10 * fastest, f"the block is at {end:.3g} m, faster than bristles let it be")
        return
    play.check(abs(end) <= 2 * crept, f"the block is at {end:.3g} m, of a force of 5e-12 N on 1 kg")


@case(NEARLY, treatments=("hold",))
def load_at_stiction_from_the_start(play: Play, share: float) -> None:
    """The load is there at the start, so that no guard rises through zero: it begins on it.

    Oracle: the block holds or slides with (5 N - 3 N)/1 kg from the start; just below stiction it holds.
    """
    result = play.run(loaded(f"{LIMIT * (1 + share)!r} N", stop=2.0))
    end = result["block.x"][-1]
    holds, slides = abs(end) < 1e-9, abs(end - 4.0) < 1e-3
    play.check(holds or slides, f"the block is at {end:.3g} m: it neither holds (0) nor slides (4 m)")
    play.check(holds or share >= 0, "it slides under a load that holds")


@case()
def load_grows_for_an_hour_until_it_lets_go(play: Play) -> None:
    """A load that grows by 1.4 mN/s reaches stiction after an hour.

    Oracle: it creeps or bends as its treatment says (hold: not at all; binding: at load/g0; LuGre: -z ln(1 - q) of
    presliding z), lets go at 3600 s and slides on with 2 N: 1 m after 1 s.
    """
    bristles = play.treatment == "lugre"  # which know no stiction but that of a curve
    text = loaded(f"{{drift: {{rate: {LIMIT / 3600!r} N/s}}}}", sliding=LIMIT if bristles else SLIDING, stop=3601.0)
    result = play.run(text + "record: {every: 0.1 s}\n")
    early = result.t <= 3590
    share = result.t[early] / 3600
    held, x = -PRESLIDING * np.log1p(-share) if bristles else 0.0, result["block.x"][early]
    play.near("position while it holds", x, held, play.by(1e-9, 1.01 * creeping(LIMIT, 1800.0), 1e-6))
    if not bristles:
        slid = 1.0 + LIMIT / 3600 / 6 + play.by(0.0, x[-1])
        play.near("position at the end", result["block.x"][-1], slid, play.by(1e-4, 2e-2))
