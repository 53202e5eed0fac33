"""A sine that stands in no equation and only switches: no switch is passed over, on any engine, at any accuracy.

A relay behind a sine pushes a mass, whose speed at the end is the time the relay was on. The oracle has the instants
from the angle as a formula, searched at 40 000 places a second.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import brentq

Curve = Callable[[np.ndarray], np.ndarray]
STOP, UPPER, PLACES = 4.0, 0.5, 160_000
BEHIND = """
  relay: {type: Relay, upper: 0.5}
  push: {type: ForceActuator}
  box: {type: Mass, mass: 1 kg}
connections:
  - [relay.signal, push.force]
  - [push.flange, box.flange]
"""
SPINNING = """
  rotor: {type: Inertia, moment: 1 kg*m^2, speed: 300 rad/s}
  seen: {type: RotationSensor}
  switch: {type: SignalFunction, expression: sin(a)}
"""
OF_SPINNING = "  - [rotor.shaft, seen.shaft]\n  - [seen.angle, switch.a]\n  - [switch.signal, relay.value]\n"
SCENES: dict[str, tuple[str, str, Curve]] = {
    "swept sine": (
        "\n  switch: {type: SignalChirp, first: 1 Hz, last: 100 Hz, over: 4 s}",
        "  - [switch.signal, relay.value]\n",
        lambda t: np.sin(2 * np.pi * (t + 99 / 4 * t**2 / 2)),
    ),
    "sine swept by octaves": (
        "\n  switch: {type: SignalChirp, first: 2 Hz, last: 128 Hz, over: 3 s, sweep: exponential}",
        "  - [switch.signal, relay.value]\n",
        lambda t: np.sin(2 * np.pi * np.where(t < 3, 2 * np.expm1(np.log(64) / 3 * t) / (np.log(64) / 3),
                                              126 / (np.log(64) / 3) + 128 * (t - 3))),
    ),
    "shaft that turns evenly": (SPINNING.rstrip("\n"), OF_SPINNING, lambda t: np.sin(300 * t)),
    "shaft that runs down": (
        SPINNING + "  drag: {type: ShaftLoad, linear: 0.3 N*m*s/rad}",
        OF_SPINNING.replace("seen.shaft]", "seen.shaft, drag.shaft]"),
        lambda t: np.sin(1000 * -np.expm1(-0.3 * t)),
    ),
    "marks along a rail": (
        """
  sled: {type: Mass, mass: 1 kg, velocity: 30 m/s}
  seen: {type: MotionSensor}
  switch: {type: SignalFunction, expression: "b*cos(7*a + 0.3)", constants: {b: 1.5}}""",
        "  - [sled.flange, seen.flange]\n  - [seen.x, switch.a]\n  - [switch.signal, relay.value]\n",
        lambda t: 1.5 * np.cos(210 * t + 0.3),
    ),
}  # fmt: skip


def time_on(curve: Curve) -> tuple[float, int]:
    """How long a relay behind the curve is on until STOP [s], and how often it switches after the start."""
    t = np.linspace(0.0, STOP, PLACES)
    above = curve(t) > UPPER
    crossings = np.flatnonzero(above[1:] != above[:-1])
    at = [brentq(lambda x: float(curve(np.float64(x))) - UPPER, t[k], t[k + 1], xtol=1e-13) for k in crossings]
    spans = np.diff([0.0, *at, STOP])
    return float(spans[0 if above[0] else 1 :: 2].sum()), len(at)


@pytest.mark.parametrize("accuracy", ["1e-3", "1e-5"])
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("name", SCENES)
def test_every_switch_is_made(simulate, name, engine, accuracy):
    """The speed at the end is the time that the relay was on; a shaft that runs down is known to the accuracy only."""
    first, links, curve = SCENES[name]
    expected, switches = time_on(curve)
    run = f"run: {{stop: {STOP} s, accuracy: {accuracy}, engine: {engine}}}"
    result = simulate(f"components:{first}{BEHIND}{links}{run}\n")
    assert sum(event.component == "relay" for event in result.events if event.t > 0) == switches
    assert result.at("box.v", STOP) == pytest.approx(expected, abs=float(accuracy))
