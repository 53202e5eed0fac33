"""Gears of three shafts without inertia at a given speed: what a brake holds makes them gears of two shafts.

The row of the gear and that of the brake give the speeds of two shafts, and what is left is a relation between the
load and the given motion, whose acceleration it has to follow. The oracle is the same scene with a Gear, which costs no
unknown.
"""

from __future__ import annotations

import numpy as np
import pytest

from fairlead import Result
from tests.conftest import Scene

MOTOR = "motor: {type: SpeedSource, speed: {sine: {amplitude: 10 rad/s, frequency: 1 Hz}}}"
CLUTCH = """cl: {{type: Clutch, radius: 0.1 m, curve: 0.3, normal_force: 50 N}}
      load: {{type: Inertia, moment: {moment} kg*m^2}}"""
BRAKE = "band: {type: Brake, radius: 0.1 m, curve: 0.3, normal_force: 500 N}"

SCENE = """
    components:
      {parts}
    connections: [{joined}]
    run: {{stop: 2 s, engine: {engine}, accuracy: {accuracy}}}
"""
# parts and connections with a gear of three members, of two members; what both show
PAIRS = {
    "planetary, ring braked": (
        [MOTOR, "gear: {type: Planetary, ratio: 3}", BRAKE],
        "[motor.shaft, gear.sun], [gear.ring, band.shaft], [gear.carrier, cl.a], [cl.b, load.shaft]",
        [MOTOR, "gear: {type: Gear, ratio: 0.25}"],
        "[motor.shaft, gear.a], [gear.b, cl.a], [cl.b, load.shaft]",
        "0.5",
    ),
    "planetary, carrier braked": (
        [MOTOR, "gear: {type: Planetary, ratio: 3}", BRAKE],
        "[motor.shaft, gear.sun], [gear.carrier, band.shaft], [gear.ring, cl.a], [cl.b, load.shaft]",
        [MOTOR, "gear: {type: Gear, ratio: -0.3333333333333333}"],
        "[motor.shaft, gear.a], [gear.b, cl.a], [cl.b, load.shaft]",
        "0.4",
    ),
    "differential, one side braked": (
        [MOTOR, "gear: {type: Differential}", BRAKE],
        "[motor.shaft, gear.case], [gear.left, band.shaft], [gear.right, cl.a], [cl.b, load.shaft]",
        [MOTOR, "gear: {type: Gear, ratio: 2}"],
        "[motor.shaft, gear.a], [gear.b, cl.a], [cl.b, load.shaft]",
        "0.05",
    ),
    "gear on a support that turns": (
        [MOTOR, "gear: {type: SupportedGear, ratio: 3}", BRAKE],
        "[motor.shaft, gear.support], [gear.a, band.shaft], [gear.b, cl.a], [cl.b, load.shaft]",
        [MOTOR, "gear: {type: Gear, ratio: -2}"],
        "[motor.shaft, gear.a], [gear.b, cl.a], [cl.b, load.shaft]",
        "0.06",
    ),
    "two planetaries, both rings braked": (
        [
            MOTOR, "gear: {type: Planetary, ratio: 3}", BRAKE,
            "next: {type: Planetary, ratio: 1}",
            "last: {type: Brake, radius: 0.1 m, curve: 0.3, normal_force: 500 N}",
        ],
        "[motor.shaft, gear.sun], [gear.ring, band.shaft], [gear.carrier, next.sun], [next.ring, last.shaft],"
        " [next.carrier, cl.a], [cl.b, load.shaft]",
        [MOTOR, "gear: {type: Gear, ratio: 0.125}"],
        "[motor.shaft, gear.a], [gear.b, cl.a], [cl.b, load.shaft]",
        "1",
    ),
}  # fmt: skip


def played(scene: Scene, parts: list[str], joined: str, moment: str, engine: str, accuracy: float) -> Result:
    every = "\n      ".join([*parts, CLUTCH.format(moment=moment)])
    return scene(SCENE.format(parts=every, joined=joined, engine=engine, accuracy=accuracy))


def changes(result: Result) -> list[tuple[float, str, str, str]]:
    """Time, contact, zone before and after of every instant: without those that were tried at it."""
    found: dict[tuple[float, str], list[str]] = {}
    for one in result.events:
        found.setdefault((one.t, one.component), [one.zone_from]).append(one.zone_to)
    return [(*at, zones[0], zones[-1]) for at, zones in found.items() if zones[0] != zones[-1]]


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("name", PAIRS)
def test_a_braked_gear_is_one_of_two_shafts(simulate: Scene, engine: str, name: str) -> None:
    parts, joined, fewer, plainly, moment = PAIRS[name]
    found = played(simulate, parts, joined, moment, engine, 1e-5)
    right = played(simulate, fewer, plainly, moment, "rodas", 1e-8)
    times = np.linspace(0.0, 2.0, 101)
    for signal, size in (("load.speed", 10.0), ("load.angle", 5.0)):
        assert np.max(np.abs(found.at(signal, times) - right.at(signal, times))) <= 1e-5 * size
    zones = [changed for _, *changed in changes(right)]
    assert [changed for _, *changed in changes(found)] == zones
    assert len(zones) > 3  # the clutch slips, and slips the other way


@pytest.mark.parametrize("accuracy", [1e-4, 1e-7])
def test_steps_grow_few_with_the_accuracy_as_where_all_has_inertia(simulate: Scene, accuracy: float) -> None:
    """The rate of the given acceleration is in df/dt: without it steps are of order one, 2500 at 1e-7."""
    parts, joined, *_, moment = PAIRS["planetary, ring braked"]
    result = played(simulate, parts, joined, moment, "rodas", accuracy)
    assert result.run["counters"]["steps"] < 300


def test_a_brake_too_weak_slips_and_the_clutch_holds(simulate: Scene) -> None:
    """The load takes 4/3 of the torque of the brake at most, wherever the gear slips: by steps of the closed form."""
    parts, joined, *_ = PAIRS["planetary, ring braked"]
    weak = [part.replace("500 N", "20 N") for part in parts]
    result = played(simulate, weak, joined, "0.5", "rodas", 1e-7)
    speed, step, most = 0.0, 1e-5, 0.6 * 4 / 3 / 0.5
    for k in range(200_000):
        wanted = 10 * np.sin(2 * np.pi * (k + 1) * step) / 4
        speed += min(max(wanted - speed, -most * step), most * step)
    assert result["load.speed"][-1] == pytest.approx(speed, abs=5e-5)
    assert {component for _, component, *_ in changes(result)} == {"band.contact"}


@pytest.mark.parametrize("method", ["hold", "karnopp"])
def test_nor_do_both_slip_where_friction_falls_as_they_let_go(simulate: Scene, method: str) -> None:
    """In the order of release (release.py) the same pattern is met: load = 3 t up to 2.5 rad/s."""
    parts, joined, *_, moment = PAIRS["planetary, ring braked"]
    falls = "{curve: coulomb, coulomb: 0.3, stiction: 0.4}"
    parts = ["motor: {type: SpeedSource, speed: 10 rad/s}", parts[1], BRAKE.replace("0.3", falls)]
    every = "\n      ".join([*parts, CLUTCH.format(moment=moment).replace("0.3", falls)])
    text = SCENE + "    friction: {{method: {method}}}\n"
    result = simulate(text.format(parts=every, joined=joined, engine="rodas", accuracy=1e-6, method=method))
    times = np.linspace(0.1, 1.9, 19)
    assert result.at("load.speed", times) == pytest.approx(np.minimum(3 * times, 2.5), abs=1e-5)


def test_of_two_that_are_torn_at_once_the_weaker_slips(simulate: Scene) -> None:
    """The motor turns at once at 10 rad/s. Not all contacts of a gear without inertia can slip: nothing would turn it.

    The clutch bears 1.5 N*m, for which the ring needs 1.125 of the 15 N*m of its brake: load = 3 t up to 2.5 rad/s.
    """
    parts, joined, *_, moment = PAIRS["planetary, ring braked"]
    parts = ["motor: {type: SpeedSource, speed: 10 rad/s}", *parts[1:]]
    result = played(simulate, parts, joined, moment, "rodas", 1e-6)
    times = np.linspace(0.1, 1.9, 19)
    assert result.at("load.speed", times) == pytest.approx(np.minimum(3 * times, 2.5), abs=1e-5)
    assert result["band.slip"][1:] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("force", ["500 N", "45 N", "5 N"])
def test_which_one_slips_does_not_depend_on_the_order_of_the_netlist(simulate: Scene, force: str) -> None:
    """What is tried at the jump goes by their order; what comes of it does not."""
    parts, joined, *_, moment = PAIRS["planetary, ring braked"]
    parts = ["motor: {type: SpeedSource, speed: 10 rad/s}", parts[1], BRAKE.replace("500 N", force)]
    parts += CLUTCH.format(moment=moment).split("\n      ")
    text = "\n      ".join
    found = [
        simulate(SCENE.format(parts=text(order), joined=joined, engine="rodas", accuracy=1e-6))
        for order in (parts, parts[::-1])
    ]
    times = np.linspace(0.1, 1.9, 19)
    assert found[0].at("load.speed", times) == pytest.approx(found[1].at("load.speed", times), abs=1e-9)
    assert [changed for _, *changed in changes(found[0])] == [changed for _, *changed in changes(found[1])]


def test_where_the_brake_is_the_weaker_one_it_slips(simulate: Scene) -> None:
    """The brake bears 0.15 N*m, the clutch then carries 4/3 of it: load = 0.4 t."""
    parts, joined, *_, moment = PAIRS["planetary, ring braked"]
    parts = ["motor: {type: SpeedSource, speed: 10 rad/s}", parts[1], BRAKE.replace("500 N", "5 N")]
    result = played(simulate, parts, joined, moment, "rodas", 1e-6)
    assert result["load.speed"][-1] == pytest.approx(0.8, abs=1e-6)
    assert result["cl.slip"][-1] == pytest.approx(0.0, abs=1e-9)
    assert result["band.slip"][-1] == pytest.approx((4 * 0.8 - 10) / 3 * 0.1, abs=1e-6)
