"""Very slow and very long: hour-long holds, drives slower than the creep, a hundred thousand cycles."""

from __future__ import annotations

import numpy as np

from tests.hard.cases.stiction import creeping, loaded
from tests.hard.play import CREEP, PRESLIDING, Play, scene
from tests.hard.registry import case
from tests.reference.belt import StickSlipBelt

SHARES = {"half": {"share": 0.5}, "99 %": {"share": 0.99}}


# Bristles nearer to their limit than that are so soft that the block swings on them.
@case({"all but 1e-4": {"share": 1 - 1e-4}}, treatments=("hold", "binding"))
@case(SHARES)
def load_is_held_for_an_hour(play: Play, share: float) -> None:
    """A load of 5 N times a share, on a contact that holds 5 N, for an hour.

    Oracle: held exactly it has not moved; binding has crept load/g0 times the hour; LuGre has bent by -z ln(1 - q).
    """
    load = 5.0 * share
    # A slow ramp: a load that comes fast lets bristles, which are springs, overshoot.
    result = play.run(loaded(f"{{ramp: {{to: {load!r} N, over: 100 s}}}}", sliding=5.0, stop=3600.0))
    end = result["block.x"][-1]
    if play.treatment == "lugre":
        play.near("presliding", end, -PRESLIDING * np.log(1 - share), 5e-2 * PRESLIDING)
        return
    crept = play.by(0.0, creeping(load, 3600.0 - 50, 5.0, 5.0))
    # On the last percent it goes to and fro between plateau and ramp, whose border has 1 % of hysteresis.
    play.near("position after an hour", end, crept, play.by(1e-9, 1e-2 * crept))
    play.near("speed", result["block.v"][-1], play.by(0.0, crept / 3550), play.by(1e-12, 1e-2 * crept / 3550))


@case(treatments=("hold", "binding"), cost="fair", budget=120.0)
def load_swings_for_an_hour(play: Play) -> None:
    """A load that swings at 1 Hz up to 90 % of what holds, for an hour: 3600 cycles.

    Oracle: held exactly it has not moved; binding creeps to and fro by 0.9 x 0.8 creep/(pi f) and does not drift.
    """
    text = loaded("{sine: {amplitude: 4.5 N, frequency: 1 Hz}}", sliding=5.0, stop=3600.0)
    result = play.run(text + "record: {every: 1.37 s}\n")
    swing = creeping(4.5, 1 / np.pi, 5.0, 5.0)
    play.check(not [e for e in result.events if e.zone_to in ("forward", "backward")], "it slid")
    play.near("position", result["block.x"], play.by(0.0, swing / 2), play.by(1e-9, 0.51 * swing + 1e-6))


SLOW = """
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}}
  spring: {type: Spring, stiffness: 100 N/m}
  pull: {type: MotionSource, velocity: @SPEED@ m/s}
connections: [[floor.flange, pad.a], [pad.b, block.flange, spring.a], [spring.b, pull.flange]]
friction: {method: hold}
run: {stop: @STOP@ s, accuracy: 1e-6}
record: {signals: [block.x, spring.tension, pad.slip], every: @EVERY@ s}
"""


@case(
    {"1e-4 m/s": {"speed": 1e-4}, "1e-6 m/s": {"speed": 1e-6}, "1e-8 m/s": {"speed": 1e-8}},
    treatments=("hold", "binding"),
)
def drive_slower_than_the_creep(play: Play, speed: float) -> None:
    """A block is pulled through a spring by a drive of 1e-4, 1e-6 and 1e-8 m/s; the creep of binding is 1e-5 m/s.

    Oracle: held exactly it lets go at F_s/(k v) again and again (period of the cycle in closed form). Binding
    does so too when the drive is faster than its creep at the limit, 0.87 x 1e-5 m/s; when slower it is dragged
    along for ever at the force g0 v.
    """
    first = 5.0 / (100 * speed)
    stop = 2.5 * first
    text = SLOW.replace("@SPEED@", repr(speed)).replace("@STOP@", repr(stop)).replace("@EVERY@", repr(stop / 1000))
    result = play.run(text)
    slope = (5.0 + 3.0 / 4) / CREEP
    if play.treatment == "binding" and speed < 5.0 / slope:
        play.near("force", result["spring.tension"][-1], slope * speed, 1e-4 * slope * speed)
        play.check(not [e for e in result.events if "break" in e.zone_to or "slide" in e.zone_to], "it broke away")
        return
    exact = StickSlipBelt(stiffness=100.0, speed=speed, stiction=5.0, coulomb=3.0)
    found = [e.t for e in result.events if e.zone_to in ("forward", "break_forward") and e.t > 0]
    want = exact.breakaways(10)
    want = want[want < stop]
    play.check(len(found) == len(want), f"{len(found)} break-aways, must be {len(want)}")
    late = play.by(1e-5, 0.1)  # of the first; binding leaks while the spring is loaded, at most by creep over drive
    play.near("break-aways", np.array(found) / first, want / first, late)


# ida takes 25 minutes for 1e5 cycles, since it begins anew at every switch; it has the thousand.
@case({"1e3": {"cycles": 1_000}}, treatments=("hold",), cost="fair", budget=60.0)
@case(
    {"1e5": {"cycles": 100_000}},
    engines=("rodas", "rodas3p", "stepping"),
    treatments=("hold",),
    cost="slow",
    budget=240.0,
)
def stick_slip_cycles_without_drift(play: Play, cycles: int) -> None:
    """The belt at accuracy 1e-6 for a thousand and a hundred thousand cycles.

    Oracle: the period between the first and the last break-away is that of the closed form to 1e-6, and the scatter of
    the periods is no larger at the end than at the beginning.
    """
    exact = StickSlipBelt()
    stop = exact.first_breakaway + cycles * exact.period + 0.5 * exact.stick_time
    result = play.run(scene("belt_cycles"), run__stop=stop, record__every=stop / 1000, run__max_events=10 * cycles)
    found = np.array([e.t for e in result.events if e.zone_from == "held" and e.t > 0.1])
    play.check(len(found) == cycles + 1, f"{len(found)} break-aways, must be {cycles + 1}")
    play.near("mean period", (found[-1] - found[0]) / cycles, exact.period, 1e-6 * exact.period)
    scatter = [np.ptp(np.diff(part)) for part in (found[: cycles // 10], found[-cycles // 10 :])]
    play.check(
        scatter[1] <= 2 * scatter[0] + 1e-9 * stop, f"periods scatter by {scatter[0]:.2g} s, then {scatter[1]:.2g} s"
    )
