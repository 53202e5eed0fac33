"""Parts whose corner at no load is rounded off: a scene made smaller comes out alike, or the run tells so."""

from __future__ import annotations

import re
import warnings

import pytest

SCREW = """
    parameters: {{s: {s}}}
    components:
      motor: {{type: TorqueSource, torque: "{{2*s}}"}}
      rotor: {{type: Inertia, moment: "{{1e-3*s}}"}}
      part: {{type: LeadScrew, radius: 10 mm, lead: 5 mm, curve: 0.1{more}}}
      load: {{type: Mass, mass: "{{100*s}}"}}
      weight: {{type: ForceSource, force: "{{-981*s}}"}}
    connections:
      - [motor.shaft, rotor.shaft, part.screw]
      - [part.nut, load.flange, weight.flange]
    run: {{stop: 0.3 s, accuracy: 1e-5}}
"""
HOIST = """
    parameters: {{s: {s}}}
    components:
      motor: {{type: TorqueSource, torque: "{{8*s}}"}}
      rotor: {{type: Inertia, moment: "{{0.05*s}}"}}
      part: {{{part}{more}}}
      drum: {{type: Rack, radius: 0.1 m}}
      load: {{type: Mass, mass: "{{80*s}}"}}
      weight: {{type: ForceSource, force: "{{-784.8*s}}"}}
    connections:
      - [motor.shaft, rotor.shaft, part.a]
      - [part.b, drum.pinion]
      - [drum.rack, load.flange, weight.flange]
    run: {{stop: 0.3 s, accuracy: 1e-5}}
"""
LOSSY = 'type: LossyGear, ratio: "{{1/30}}", efficiency: 0.45'
GEARBOX = 'type: Gearbox, ratio: "{{1/30}}", efficiency: 0.6'
TEETH = """
    parameters: {{s: {s}}}
    components:
      motor: {{type: TorqueSource, torque: "{{8*s}}"}}
      stub: {{type: Inertia, moment: "{{0.01*s}}"}}
      sensor: {{type: TorqueSensor}}
      rotor: {{type: Inertia, moment: "{{0.05*s}}"}}
      part: {{type: LoadedFriction, dry: 0, by_motor: 0.3{more}}}
      frame: {{type: Housing}}
      drum: {{type: Rack, radius: 0.1 m}}
      load: {{type: Mass, mass: "{{80*s}}"}}
    connections:
      - [motor.shaft, stub.shaft, sensor.a]
      - [sensor.b, rotor.shaft, part.b, drum.pinion]
      - [sensor.torque, part.motor]
      - [drum.rack, load.flange]
      - [frame.shaft, part.a]
    run: {{stop: 0.3 s, accuracy: 1e-5}}
"""
WORM = """
    parameters: {{s: {s}}}
    components:
      motor: {{type: TorqueSource, torque: "{{20*s}}"}}
      rotor: {{type: Inertia, moment: "{{0.05*s}}"}}
      part: {{type: Worm, radius: 20 mm, lead: 12.57 mm, curve: 0.12, wheel_radius: 100 mm{more}}}
      wheel: {{type: Inertia, moment: "{{0.1*s}}"}}
      drum: {{type: Rack, radius: 0.1 m}}
      load: {{type: Mass, mass: "{{80*s}}"}}
      weight: {{type: ForceSource, force: "{{-784.8*s}}"}}
    connections:
      - [motor.shaft, rotor.shaft, part.worm]
      - [part.wheel, wheel.shaft, drum.pinion]
      - [drum.rack, load.flange, weight.flange]
    run: {{stop: 0.3 s, accuracy: 1e-5}}
"""
PLAY = f'{GEARBOX}, stiffness: "{{{{1e5*s}}}}", effects: {{{{backlash: on}}}}'
SCENES = {
    "LeadScrew": SCREW, "Worm": WORM, "LoadedFriction": TEETH,
    "LossyGear": HOIST.replace("{part}", LOSSY), "Gearbox": HOIST.replace("{part}", GEARBOX),
    "Gearbox with play": HOIST.replace("{part}", PLAY),
}  # fmt: skip


def travel(simulate, name: str, s: float, more: str = "") -> tuple[float, list[str]]:
    """Where the load is at the end [m], and what the run said of rounding."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = simulate(SCENES[name].format(s=s, more=more))
    return float(result["load.x"][-1]), [said for said in result.remarks if "rounded off" in said]


@pytest.mark.parametrize("s", [3e-6, 1e-8, 1e-10])
@pytest.mark.parametrize("name", SCENES)
def test_a_small_load_is_told_and_what_is_told_makes_it_come_out_as_the_large_one(simulate, name, s) -> None:
    """All forces and masses times s leave the motion as it is.

    A load F of what the corner is rounded over counts as F^2/2 alone, so it is the load that is asked for its size.
    """
    right, said = travel(simulate, name, 1.0)
    assert not said
    wrong, (said,) = travel(simulate, name, s)
    assert abs(wrong - right) > 0.02 * abs(right)
    given = re.search(r"Give part\.(round_off): (.+)\.$", said)
    small, said = travel(simulate, name, s, f", {given[1]}: {given[2]}")
    assert not said
    assert small == pytest.approx(right, rel=1e-2)


@pytest.mark.parametrize("s", [1e-6, 1e-10])
@pytest.mark.parametrize("name", SCENES)
def test_with_a_corner_as_much_smaller_a_part_of_any_size_rubs_alike(simulate, name, s) -> None:
    """The contacts inside begin to press at a thousandth of the corner, not at 1e-6 N."""
    unit = "N" if name in ("LeadScrew", "Worm") else "N*m"
    right, _ = travel(simulate, name, 1.0, f", round_off: 1e-6 {unit}")
    small, said = travel(simulate, name, s, f", round_off: {1e-6 * s} {unit}")
    assert not said
    assert small == pytest.approx(right, rel=1e-4)


@pytest.mark.parametrize("name", ["LeadScrew", "Worm", "Gearbox"])
def test_a_part_that_turns_evenly_and_carries_nothing_is_not_told(simulate, name) -> None:
    """What a load of nothing is made of by rounding is no small load. The others are never without one."""
    moving = re.sub(r"(torque|force): \"[^\"]+\"", r"\1: 0", SCENES[name].format(s=1.0, more=""))
    moving = re.sub(r"(rotor: {type: Inertia, moment: \"[^\"]+\")", r"\1, speed: 10 rad/s", moving)
    result = simulate(moving)
    assert abs(result["rotor.speed"][-1]) == pytest.approx(10.0)
    assert not [said for said in result.remarks if "rounded off" in said]
