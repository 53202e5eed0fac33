"""Loads that jump: several contacts are beyond their limits in one instant, and an order or a symmetry decides."""

from __future__ import annotations

from tests.hard.play import Play
from tests.hard.registry import case

STACK = """
components:
  ground: {type: Ground}
  low: {type: Mass, mass: 1 kg}
  middle: {type: Mass, mass: 1 kg}
  top: {type: Mass, mass: 1 kg}
  c0: {type: Contact, normal_force: 30 N, curve: {curve: coulomb, coulomb: 0.20, stiction: 0.21}}
  c1: {type: Contact, normal_force: 20 N, curve: {curve: coulomb, coulomb: 0.30, stiction: 0.32}}
  c2: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, coulomb: 0.50, stiction: 0.65}}
  push: {type: ForceSource, force: {@GOES@}}
connections:
  - [ground.flange, c0.a]
  - [c0.b, low.flange, c1.a]
  - [c1.b, middle.flange, c2.a]
  - [c2.b, top.flange, push.flange]
run: {stop: 1.1 s, accuracy: 1e-6}
record: {every: 10 ms}
"""
SHAFTS = """
components:
  r1: {type: Inertia, moment: 0.7 kg*m^2}
  r2: {type: Inertia, moment: 0.7 kg*m^2}
  r3: {type: Inertia, moment: 0.7 kg*m^2}
  left: {type: Clutch, radius: 0.13 m, normal_force: 97 N, curve: {curve: coulomb, coulomb: 0.4, stiction: 0.5}}
  right: {type: Clutch, radius: 0.13 m, normal_force: 97 N, curve: {curve: coulomb, coulomb: 0.4, stiction: 0.5}}
  drive: {type: TorqueSource, torque: {@GOES@: {to: 10 N*m, @WHEN@}}}
  load: {type: TorqueSource, torque: {@GOES@: {to: -10 N*m, @WHEN@}}}
connections:
  - [r1.shaft, left.a, drive.shaft]
  - [left.b, r2.shaft, right.a]
  - [right.b, r3.shaft, load.shaft]
run: {stop: 1 s, accuracy: 1e-5}
record: {every: 10 ms}
"""


@case(
    {
        "step": {"goes": "step: {to: 6.45 N, at: 0.1 s}"},
        "ramp": {"goes": "ramp: {to: 6.45 N, over: 1 us, start: 0.1 s}"},
    },
    treatments=("hold",),
)
def stack_of_three_under_a_load_that_jumps(play: Play, goes: str) -> None:
    """The load passes the limits of two of three contacts at once; a build-up meets the lowest first.

    Oracle: its limit is 6.3 N; 6 N are left there, the others stay below theirs: all three go at 0.45 N / 3 kg.
    """
    result = play.run(STACK.replace("@GOES@", goes))
    play.near("ends", [result[f"{body}.x"][-1] for body in ("low", "middle", "top")], [0.075] * 3, 1e-6)


@case(
    {"step": {"goes": "step", "when": "at: 0.3 s"}, "ramp": {"goes": "ramp", "when": "over: 0.7 s, start: 0.1 s"}},
    treatments=("hold",),
)
def equal_shafts_turned_against_each_other(play: Play, goes: str, when: str) -> None:
    """Three equal shafts in a row, two equal clutches, equal torques at the ends: both clutches let go in one instant.

    Oracle: the shaft in the middle has no way to turn; the ends turn alike.
    """
    result = play.run(SHAFTS.replace("@GOES@", goes).replace("@WHEN@", when))
    play.near("middle", result["r2.speed"][-1], 0.0, 1e-6)
    play.near("ends", result["r1.speed"][-1] + result["r3.speed"][-1], 0.0, 1e-6)
    if goes == "step":
        kept = 0.4 * 97 * 0.13
        play.near("speed", result["r1.speed"][-1], (10 - kept) / 0.7 * 0.7, 1e-4)
