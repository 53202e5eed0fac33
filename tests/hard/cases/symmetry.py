"""What must not depend on the side, on the hour, or on the unit."""

from __future__ import annotations

import math

import numpy as np

from tests.hard.play import Play
from tests.hard.registry import case

MIRRORED = """
components:
  wall: {type: Ground}
  left: {type: Mass, mass: 1 kg, position: 0 m, velocity: -0.2 m/s}
  right: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0.2 m/s}
  hook_left: {type: Spring, stiffness: 100 N/m}
  hook_right: {type: Spring, stiffness: 100 N/m}
  tie: {type: Spring, stiffness: 20 N/m}
  belt_left: {type: MotionSource, velocity: -0.2 m/s}
  belt_right: {type: MotionSource, velocity: 0.2 m/s}
  pad_left: {type: Contact, normal_force: 10 N, curve: @CURVE@}
  pad_right: {type: Contact, normal_force: 10 N, curve: @CURVE@}
connections:
  - [wall.flange, hook_left.a, hook_right.a]
  - [hook_left.b, left.flange, pad_left.b, tie.a]
  - [hook_right.b, right.flange, pad_right.b, tie.b]
  - [belt_left.flange, pad_left.a]
  - [belt_right.flange, pad_right.a]
friction: {method: hold}
run: {stop: 20 s, accuracy: 1e-6}
record: {every: 10 ms}
"""
JUMP = "{curve: coulomb, stiction: 1.0, coulomb: 0.6}"
FALL = "{curve: tustin, stiction: 1.0, coulomb: 0.6, velocity: 50 mm/s}"


@case({"jump": {"curve": JUMP}, "falling curve": {"curve": FALL}})
def mirrored_blocks_stay_mirrored(play: Play, curve: str) -> None:
    """Two blocks on belts that run apart, tied by a spring: 25 cycles of stick-slip, left and right at the same times.

    Oracle: x_left = -x_right at every instant; both let go in pairs.
    """
    result = play.run(MIRRORED.replace("@CURVE@", curve))
    play.near("sum of both positions", result["left.x"] + result["right.x"], 0.0, 1e-9)
    left = [e.t for e in result.events if e.component == "pad_left" and e.t > 0.1]
    right = [e.t for e in result.events if e.component == "pad_right" and e.t > 0.1]
    play.check(len(left) == len(right), f"{len(left)} switches on the left, {len(right)} on the right")
    play.near("instants of both sides", left, right, 1e-9)


DRIVEN = """
components:
  floor: {type: Ground}
  block: {type: Mass, mass: @M@, position: 0 m, velocity: 0 m/s}
  pad: {type: Contact, normal_force: @N@, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.4}}
  load: {type: ForceSource, force: @LOAD@}
  spring: {type: SpringDamper, stiffness: @K@, damping: @D@}
connections: [[floor.flange, pad.a, spring.a], [pad.b, block.flange, load.flange, spring.b]]
friction: {method: hold}
run: {start: @START@, stop: @STOP@, accuracy: @ACCURACY@}
record: {signals: [block.x, block.v], every: @EVERY@}
"""


def driven(**values: str) -> str:
    """The scene with numbers for its letters."""
    usual = {"M": "1 kg", "N": "10 N", "K": "100 N/m", "D": "1 N*s/m", "START": "0 s", "STOP": "6 s", "EVERY": "10 ms",
             "ACCURACY": "1e-6", "LOAD": "{sine: {amplitude: 12 N, frequency: 1.5 Hz}}"}  # fmt: skip
    text = DRIVEN
    for letter, value in {**usual, **values}.items():
        text = text.replace(f"@{letter}@", value)
    return text


@case({"1 s": {"shift": 1.0}, "1e4 s": {"shift": 1e4}, "-1e6 s": {"shift": -1e6}})
def time_shifted(play: Play, shift: float) -> None:
    """A shaken block with spring and stick-slip starts at 0, and the same scene with all its times moved.

    Oracle: the same positions; a time of 1e6 s has 1e-10 s between numbers, which moves a switch by no more than that.
    A slip that turns may be told as one change of zone or as two in one instant.
    """
    begun = play.run(driven())
    phase = -360 * 1.5 * shift
    load = f"{{sine: {{amplitude: 12 N, frequency: 1.5 Hz, phase: {math.fmod(phase, 360.0)!r} deg}}}}"
    moved = play.run(driven(LOAD=load, START=f"{shift!r} s", STOP=f"{shift + 6!r} s"))
    t = np.linspace(0.1, 5.9, 117) + 1e-3
    x, y = begun.at("block.x", t), moved.at("block.x", t + shift)
    play.near("position", y, x, play.by(3e-6, 3e-6, 1e-5) + 5e-10 * abs(shift))
    one, other = (len({event.t for event in result.events}) for result in (begun, moved))
    play.check(one == other or play.treatment != "hold", f"{one} instants with switches, {other} when moved")


@case(
    {
        "other words for the same": {"kind": "words"},
        "forces and masses x 1e3": {"kind": "force"},
        "lengths x 1e-2": {"kind": "length"},
    }
)
def unit_rescaled(play: Play, kind: str) -> None:
    """The same scene in other units (g, kN/mm, min), with all forces and masses a thousandfold, and with all lengths
    and forces a hundredth.

    Oracle: the same positions, or a hundredth of them, within what the accuracy is worth.
    """
    begun, scale, creep = play.run(driven()), 1.0, play.creep
    if kind == "words":
        other = driven(M="1000 g", N="0.01 kN", K="1e-4 kN/mm", D="1e3 g/s",
                       STOP="0.1 min", EVERY="0.01 s",
                       LOAD="{sine: {amplitude: 0.012 kN, frequency: 1.5 Hz}}")  # fmt: skip
    elif kind == "force":
        other = driven(M="1000 kg", N="10 kN", K="1e5 N/m", D="1e3 N*s/m",
                       LOAD="{sine: {amplitude: 12 kN, frequency: 1.5 Hz}}")  # fmt: skip
    else:
        scale = 1e-2
        other = driven(N="0.1 N", LOAD="{sine: {amplitude: 0.12 N, frequency: 1.5 Hz}}", ACCURACY="1e-8")
    more = {}
    if play.treatment == "binding":
        more = {"friction__creep": creep * scale}
    if play.treatment == "lugre" and scale != 1:
        more = {"friction__presliding": 2e-5 * scale}
    result = play.run(other, **more)
    t = np.linspace(0.05, 5.95, 119) + 1e-3
    play.near("position", result.at("block.x", t) / scale, begun.at("block.x", t), play.by(5e-6, 5e-6, 2e-5))
