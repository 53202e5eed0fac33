"""What messages tell a user of bundled parts to do about contacts that cannot hold there, and that it helps."""

from __future__ import annotations

import pytest

from fairlead.errors import ModelError
from tests.conftest import Scene

PAD = "type: Contact, normal_force: 40 N, curve: 0.3"
CRANK = f"""
    components:
      frame: {{type: Ground}}
      fly: {{type: Inertia, moment: 0.02 kg*m^2, angle: 0.5 rad, speed: 20 rad/s}}
      crank: {{type: Crank, radius: 0.05 m, rod: 0.15 m}}
      piston: {{type: Mass, mass: 1.5 kg}}
      pad: {{{PAD}}}
    connections: [[fly.shaft, crank.shaft], [crank.slider, piston.flange, pad.b], [frame.flange, pad.a]]
    run: {{stop: 3 s}}
"""
CAM = f"""
    components:
      frame: {{type: Ground}}
      fly: {{type: Inertia, moment: 0.02 kg*m^2, angle: 0.5 rad, speed: 20 rad/s}}
      cam: {{type: Cam, lift: 20 mm}}
      follower: {{type: Mass, mass: 1.5 kg}}
      pad: {{{PAD}}}
    connections: [[fly.shaft, cam.shaft], [cam.slider, follower.flange, pad.b], [frame.flange, pad.a]]
    run: {{stop: 3 s}}
"""
BRAKED = """
    components:
      frame: {type: Ground}
      fly: {type: Inertia, moment: 0.02 kg*m^2, angle: 0.5 rad, speed: 20 rad/s}
      crank: {type: Crank, radius: 0.05 m, rod: 0.15 m}
      piston: {type: Mass, mass: 1.5 kg}
      pad: {type: Brake, radius: 0.1 m, normal_force: 40 N, curve: 0.3}
      rack: {type: Rack, radius: 0.1 m}
    connections: [[fly.shaft, crank.shaft], [crank.slider, piston.flange, rack.rack], [rack.pinion, pad.shaft]]
    run: {stop: 3 s}
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "name"), [(CRANK, "pad"), (CAM, "pad"), (BRAKED.replace("frame: {type: Ground}", ""), "pad.contact")],
    ids=["crank", "cam", "brake"],
)  # fmt: skip
def test_karnopp_on_a_relation_of_positions_is_told_to_take_hold(scene: Scene, text: str, name: str) -> None:
    ended = scene(text, **{"pad.method": "karnopp"}).run(out=None, check=False)
    assert ended.status == "failed"
    said = ended.run["sentence"]
    assert f"Write method: hold for {name}, or binding." in said
    assert "add a mass" not in said
    for method in ("hold", "binding"):
        assert scene(text, **{"pad.method": method}).run(out=None).status == "finished"


def test_a_session_says_the_same(scene: Scene) -> None:
    with pytest.raises(Exception, match="Write method: hold for pad, or binding"):
        scene(CRANK, **{"pad.method": "karnopp"}).start().advance(3.0)


LEVER = """
    components:
      frame: {type: Ground}
      a: {type: Mass, mass: 2 kg}
      b: {type: Mass, mass: 1 kg}
      pivot: {type: Mass, mass: 1 kg}
      lever: {type: Lever, ratio: 2}
      third: {type: Contact, normal_force: 10 N, curve: 0.4}
      one: {type: Contact, normal_force: 10 N, curve: 0.3}
      other: {type: Contact, normal_force: 10 N, curve: 0.2}
      push: {type: ForceSource, force: {ramp: {to: 10 N, over: 1 s}}}
    connections:
      - [frame.flange, one.a, other.a, third.a]
      - [pivot.flange, lever.pivot, third.b]
      - [push.flange, a.flange, one.b, lever.a]
      - [lever.b, b.flange, other.b]
    run: {stop: 1 s}
"""
PLANETARY = """
    components:
      sun: {type: Inertia, moment: 1 kg*m^2}
      gear: {type: Planetary, ratio: 3}
      one: {type: Brake, radius: 0.1 m, normal_force: 100 N, curve: 0.3}
      other: {type: Brake, radius: 0.1 m, normal_force: 100 N, curve: 0.3}
      lock: {type: Clutch, radius: 0.1 m, normal_force: 100 N, curve: 0.3}
      ring: {type: Inertia, moment: 1 kg*m^2}
      carrier: {type: Inertia, moment: 1 kg*m^2}
    connections:
      - [sun.shaft, gear.sun, lock.a]
      - [gear.ring, ring.shaft, one.shaft]
      - [gear.carrier, carrier.shaft, other.shaft, lock.b]
    run: {stop: 1 s}
"""


@pytest.mark.parametrize(
    ("text", "contacts", "ways"),
    [
        (LEVER, ["one", "other", "third"], ("put a Spring between", "a Mass where")),
        (PLANETARY, ["one", "other", "lock"], ("put a TorsionSpring between", "an Inertia where")),
    ],
    ids=["lever", "planetary"],
)
def test_contacts_on_a_gear_in_a_circle_are_told_in_words_of_parts(
    scene: Scene, text: str, contacts: list[str], ways: tuple[str, str]
) -> None:
    with pytest.raises(ModelError, match="in a closed circle") as told:
        scene(text).check()
    said = str(told.value)
    assert "method: binding" in said
    assert all(way in said for way in ways)
    assert "hold(b.v - a.v)" not in said
    for name in contacts if text is LEVER else ():
        scene(text, **{f"{name}.method": "binding"}).check()
    assert scene(text + "    friction: {method: binding}\n").run(out=None).status == "finished"
