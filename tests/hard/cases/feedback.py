"""Friction that raises its own normal force, up to where it locks itself."""

from __future__ import annotations

import numpy as np

from tests.hard.play import CREEP, Broken, Play
from tests.hard.registry import case

WEDGED = """
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 1 kg, position: 0 m, velocity: @SPEED@ m/s}
  pad: {type: Contact, curve: 0.5}
  pull: {type: ForceSource, force: @LOAD@}
  wedge: {type: SignalGain, gain: @GAIN@, offset: 10}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, pull.flange]
  - [pad.friction, wedge.value]
  - [wedge.signal, pad.normal]
friction: {method: hold}
run: {stop: 2 s, accuracy: 1e-6}
"""
GAINS = {f"mu k = {share}": {"share": share} for share in (0.5, 0.9, 0.99, 0.999)}


@case(GAINS, treatments=("hold",))
def sliding_friction_that_presses_harder(play: Play, share: float) -> None:
    """N = 10 N + k T: the block thrown forward is braked by T = mu N_0/(1 - mu k), up to 1000 times mu N_0.

    Oracle: stops after v^2/(2 T/m) at v/(T/m), and stays.
    """
    gain, force = share / 0.5, 5.0 / (1 - share)
    speed = np.sqrt(2 * force * 0.1)
    text = WEDGED.replace("@GAIN@", repr(gain)).replace("@LOAD@", "0 N").replace("@SPEED@", repr(float(speed)))
    result = play.run(text)
    play.near("way to rest", result["block.x"][-1], 0.1, 1e-6)
    play.near("speed at rest", result["block.v"][-1], 0.0, 1e-9)


@case(GAINS, treatments=("hold",))
def holding_friction_that_presses_harder(play: Play, share: float) -> None:
    """The same at rest: what holds is mu N_0/(1 - mu k); the load grows to 1.5 times that within 1 s and stays.

    Oracle: lets go at 2/3 s; then m v' = load - what holds.
    """
    gain, force = share / 0.5, 5.0 / (1 - share)
    load = f"{{ramp: {{to: {1.5 * force!r} N, over: 1 s}}}}"
    result = play.run(WEDGED.replace("@GAIN@", repr(gain)).replace("@LOAD@", load).replace("@SPEED@", "0.0"))
    t = result.t
    ramp = np.clip(t - 2 / 3, 0, 1 / 3)
    rest = np.maximum(t - 1, 0)
    exact = force * (1.5 * ramp**3 / 6 + 0.25 / 3 * rest + 0.5 * rest**2 / 2)
    play.near("position over force", result["block.x"] / force, exact / force, 1e-5)


@case({"at the limit": {"share": 1.0}, "beyond it": {"share": 1.2}}, treatments=("hold",))
def self_locking(play: Play, share: float) -> None:
    """mu k = 1 and above: the harder it is pulled the harder it holds; sliding forward has no solution.

    Oracle: under any load it stays; or the run ends with a message that names the pad.
    """
    text = (
        WEDGED.replace("@GAIN@", repr(share / 0.5))
        .replace("@LOAD@", "{drift: {rate: 100 N/s}}")
        .replace("@SPEED@", "0.0")
    )
    result = play.ended(text)
    if result.status != "finished":
        named = "pad" in result.run["sentence"]
        if not named:
            raise Broken("stopped", f"without naming the pad: {result.run['sentence']}")
        return
    play.near("position", result["block.x"][-1], 0.0, 1e-9)


LAGGING = WEDGED.replace("wedge.value]", "lag.value]\n  - [lag.signal, wedge.value]").replace(
    "connections:", "  lag: {type: SignalLag, lag: 0.1 ms}\nconnections:"
)


@case({f"mu k = {share}": {"share": share} for share in (0.5, 0.9)}, treatments=("hold", "binding"))
def feedback_through_a_lag(play: Play, share: float) -> None:
    """The same with 0.1 ms between friction and normal force, which binding needs: its loop must not be immediate.

    Oracle: T follows mu N_0/(1 - mu k) with a lag of 0.1 ms/(1 - mu k); the way to rest grows by the speed times that.
    """
    gain, force = share / 0.5, 5.0 / (1 - share)
    speed = float(np.sqrt(2 * force * 0.1))
    text = LAGGING.replace("@GAIN@", repr(gain)).replace("@LOAD@", "0 N").replace("@SPEED@", repr(speed))
    result = play.run(text)
    lag = 1e-4 / (1 - share)
    play.near("way to rest", result["block.x"][-1], 0.1 + 0.5 * speed * lag, 0.5 * speed * lag + 1e-4)
    play.near("speed at rest", result["block.v"][-1], 0.0, play.by(1e-9, CREEP))
