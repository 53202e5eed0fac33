"""What rubs, locks or stops between two shafts or bodies that a gear or a pair of racks ties with a ratio.

They are one body with one speed w, and  slip = (ratio - 1) w:  zero for all w with the ratio 1 alone. What holds there
holds the body itself, and a friction T of the slip brakes it with  |ratio - 1| T.
"""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.errors import ModelError
from tests.conftest import Scene

ENGINES = pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
WITH_IMPACTS = pytest.mark.parametrize("engine", ["rodas", "ida"])

CLUTCH = """
    parameters: {{ratio: 2, method: hold}}
    components:
      a: {{type: Inertia, moment: 1 kg*m^2}}
      b: {{type: Inertia, moment: 1 kg*m^2}}
      gear: {{type: Gear, ratio: "{{ratio}}"}}
      clutch: {{type: Clutch, radius: 0.1 m, normal_force: 100 N, curve: 0.3}}
      motor: {{type: TorqueSource, torque: {torque}}}
      {more}
    connections: [[motor.shaft, a.shaft, gear.a, clutch.a], [gear.b, b.shaft, clutch.b]{joined}]
    friction: {{method: "{{method}}"}}
    run: {{stop: 1 s, engine: {engine}}}
"""


def clutch(engine: str, torque: str, more: str = "", joined: str = "") -> str:
    """Two shafts on a gear, with a clutch of 3 N*m between them and a torque on the first."""
    return CLUTCH.format(engine=engine, torque=torque, more=more, joined=joined)


@ENGINES
@pytest.mark.parametrize("method", ["hold", "karnopp", "binding"])
@pytest.mark.parametrize("ratio", [-1.0, 2.0, 0.5])
def test_a_clutch_across_a_gear_slips(simulate: Scene, engine: str, ratio: float, method: str) -> None:
    """(1 + ratio^2) w' = 10 - 3 |ratio - 1|."""
    result = simulate(clutch(engine, "10 N*m"), ratio=ratio, method=method)
    speed = (10 - 3 * abs(ratio - 1)) / (1 + ratio**2)
    assert result["a.speed"][-1] == pytest.approx(speed, rel=1e-10 if method == "hold" else 1e-3)
    assert result["b.speed"][-1] == pytest.approx(ratio * result["a.speed"][-1])


@ENGINES
@pytest.mark.parametrize("ratio", [-1.0, 2.0, 0.5])
def test_a_clutch_across_a_gear_holds_until_it_lets_go(simulate: Scene, engine: str, ratio: float) -> None:
    """The torque 12 t is held up to 3 |ratio - 1|."""
    result = simulate(clutch(engine, "{drift: {rate: 12 N*m/s}}"), ratio=ratio)
    moves = 3 * abs(ratio - 1) / 12
    (event,) = result.events
    assert event.t == pytest.approx(moves, rel=1e-6 if engine != "stepping" else 1e-3)
    assert np.abs(result["a.speed"][result.t <= 0.999 * moves]).max(initial=0.0) < 1e-12
    assert result["a.speed"][-1] == pytest.approx(6 * (1 - moves) ** 2 / (1 + ratio**2), rel=1e-4)


@ENGINES
def test_a_brake_beside_it_shares_the_load(simulate: Scene, engine: str) -> None:
    """Of T = 2 s + r by a clutch across a ratio of 3 and a brake, s = 2 w and r = w, T = 5 w: 3 N*m are reached at 7.5.

    The brake bears the rest up to 4 N*m: the shafts move from 10 N*m on.
    """
    brake = "brake: {type: Brake, radius: 0.1 m, normal_force: 100 N, curve: 0.4}"
    text = clutch(engine, "{drift: {rate: 15 N*m/s}}", brake, ", [a.shaft, brake.shaft]")
    result = simulate(text, ratio=3)
    times = [event.t for event in result.events]
    assert times == pytest.approx([7.5 / 15, 10 / 15], rel=1e-6 if engine != "stepping" else 1e-3)
    assert result["a.speed"][-1] == pytest.approx(7.5 * (1 / 3) ** 2 / 10, rel=1e-4)


@ENGINES
def test_two_clutches_across_two_gears_share_by_their_ratios(simulate: Scene, engine: str) -> None:
    """Slips of 1 and 2 times the speed: T = s + 2 r with r = 2 s; at T = 7.5 the second is full, at 9 the first."""
    more = """c: {type: Inertia, moment: 1 kg*m^2}
      other: {type: Gear, ratio: 3}
      second: {type: Clutch, radius: 0.1 m, normal_force: 100 N, curve: 0.3}"""
    text = clutch(engine, "{drift: {rate: 15 N*m/s}}", more,
                  ", [a.shaft, other.a, second.a], [other.b, c.shaft, second.b]")  # fmt: skip
    result = simulate(text)
    times = [event.t for event in result.events]
    assert times == pytest.approx([0.5, 0.6], rel=1e-6 if engine != "stepping" else 1e-3)
    assert result["a.speed"][-1] == pytest.approx(7.5 * 0.4**2 / (1 + 4 + 9), rel=1e-4)


GRIPPER = """
    parameters: {{restitution: 0, speed: 1, force: 0}}
    components:
      one: {{type: Mass, mass: 1 kg, position: 0 m, velocity: "{{speed}}"}}
      other: {{type: Mass, mass: 3 kg}}
      rack: {{type: Rack, radius: 0.1 m}}
      opposite: {{type: Rack, radius: 0.1 m, offset: 0.2 m}}
      gear: {{type: Gear, ratio: -1}}
      jaws: {{type: RigidStop, restitution: "{{restitution}}"}}
      push: {{type: ForceSource, force: "{{force}}"}}
    connections:
      - [one.flange, rack.rack, jaws.a, push.flange]
      - [other.flange, opposite.rack, jaws.b]
      - [rack.pinion, gear.a]
      - [gear.b, opposite.pinion]
    run: {{stop: 0.2 s, engine: {engine}}}
"""


@WITH_IMPACTS
@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_jaws_that_close_on_racks_meet_and_part(simulate: Scene, engine: str, restitution: float) -> None:
    """They meet at 0.1 m, after 0.1 s, with 2 m/s, and part with the share of it that they give back."""
    result = simulate(GRIPPER.format(engine=engine), restitution=restitution)
    assert result["one.v"][-1] == pytest.approx(-restitution, abs=1e-6)
    assert result["other.x"][-1] - result["one.x"][-1] == pytest.approx(2 * restitution * 0.1, abs=1e-5)


@WITH_IMPACTS
def test_jaws_that_are_closed_bear_the_force_on_them(simulate: Scene, engine: str) -> None:
    """What the jaws bear acts on both: half of 8 N at each."""
    result = simulate(GRIPPER.format(engine=engine), force=8)
    assert result["jaws.force"][-1] == pytest.approx(4.0, rel=1e-6)
    assert abs(result["one.v"][-1]) < 1e-9


@ENGINES
@pytest.mark.parametrize("kind", ["OneWayClutch", "DogClutch"])
def test_what_locks_across_a_gear_locks_the_gear(simulate: Scene, engine: str, kind: str) -> None:
    """-2 N*m slow (1 + 4) w' from 1 rad/s: it stands after 2.5 s, at 1.25 rad, and may not turn back; or at 1 s."""
    text = f"""
    components:
      a: {{type: Inertia, moment: 1 kg*m^2, speed: 1 rad/s}}
      b: {{type: Inertia, moment: 1 kg*m^2}}
      gear: {{type: Gear, ratio: 2}}
      lock: {{type: {kind}}}
      load: {{type: TorqueSource, torque: -2 N*m}}
      {"one: {type: SignalSource, value: {step: {to: 1, at: 2.4 s}}}" * (kind == "DogClutch")}
    connections: [[a.shaft, gear.a, lock.a, load.shaft], [gear.b, b.shaft, lock.b]{
      ", [one.signal, lock.engage]" * (kind == "DogClutch")}]
    run: {{stop: 4 s, engine: {engine}}}
    """
    result = simulate(text)
    angle = 1.25 if kind == "OneWayClutch" else 2.4 - 0.2 * 2.4**2
    assert result["a.angle"][-1] == pytest.approx(angle, rel=1e-5)
    assert abs(result["a.speed"][-1]) < 1e-9


RUBBING = """
    components:
      one: {{type: Mass, mass: 1 kg}}
      other: {{type: Mass, mass: 1 kg}}
      {ties}
      pad: {{type: Contact, normal_force: 10 N, curve: 0.1}}
    connections: [[one.flange, pad.a, {one}], [other.flange, pad.b, {other}]{more}]
    run: {{stop: 1 s}}
"""
RACKS = """there: {{type: Rack, radius: 0.1 m}}
      back: {{type: Rack, radius: {radius} m}}
      first: {{type: Gear, ratio: 4}}
      second: {{type: Gear, ratio: 0.25}}"""
CHAIN = ", [there.pinion, first.a], [first.b, second.a], [second.b, back.pinion]"


@pytest.mark.parametrize(
    ("ties", "one", "other", "more"),
    [
        ("link: {type: RigidLink, length: 1 m}", "link.a", "link.b", ""),
        (RACKS.format(radius=0.1), "there.rack", "back.rack", CHAIN),
    ],
)
def test_what_moves_alike_can_never_slip(scene: Scene, ties: str, one: str, other: str, more: str) -> None:
    with pytest.raises(ModelError, match=r"pad has both sides on one rigid body \(one\); they can never slip") as told:
        _ = scene(RUBBING.format(ties=ties, one=one, other=other, more=more)).system
    assert "Remove pad, or what ties pad.a to pad.b" in str(told.value)


def test_the_same_racks_of_other_radii_do_slip(scene: Scene) -> None:
    text = RUBBING.format(ties=RACKS.format(radius=0.2), one="there.rack", other="back.rack", more=CHAIN)
    _ = scene(text).system


PLANETS = """
    components:
      sun: {type: Inertia, moment: 1 kg*m^2}
      planets: {type: Planetary, ratio: 3}
      direct: {type: Gear, ratio: 1}
      %s
    connections: [[sun.shaft, planets.sun, direct.a], [direct.b, planets.ring]%s]
"""


def test_a_planetary_gear_with_all_shafts_as_one_is_told(scene: Scene) -> None:
    text = PLANETS % ("again: {type: Gear, ratio: 1}", ", [sun.shaft, again.a], [again.b, planets.carrier]")
    with pytest.raises(ModelError, match="planets has all sides on one rigid body"):
        _ = scene(text).system


@ENGINES
def test_a_planetary_gear_with_two_shafts_as_one_takes_the_third_along(simulate: Scene, engine: str) -> None:
    more = "rest: {type: Inertia, moment: 2 kg*m^2}\n      motor: {type: TorqueSource, torque: 3 N*m}"
    text = PLANETS % (more, ", [rest.shaft, planets.carrier, motor.shaft]")
    result = simulate(text, **{"run.stop": "1 s", "run.engine": engine})
    assert result["sun.speed"][-1] == pytest.approx(1.0)
    assert result["rest.speed"][-1] == pytest.approx(1.0)


def test_a_contact_across_a_gear_that_is_driven_is_told(scene: Scene) -> None:
    text = clutch("rodas", "0 N*m", "drive: {type: SpeedSource, speed: 1 rad/s}", ", [a.shaft, drive.shaft]")
    with pytest.raises(ModelError, match="across a prescribed motion") as told:
        _ = scene(text).system
    assert "method: binding" in str(told.value)
