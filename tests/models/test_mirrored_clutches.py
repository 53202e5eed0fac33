"""Clutches that are turned against each other reach their limit at once, and rounding does not choose between them.

    rotor - clutch - rotor - clutch - rotor        torques that rise, +M on the left and -M on the right

The middle one stays where it is by symmetry. A clutch lets go at M0 and slides with less: with the torque k t on an
outer rotor of moment J it turns, from t0 = M0/k on, by J w = k (t^2 - t0^2)/2 - M1 (t - t0).
"""

from __future__ import annotations

import random

import pytest

SCENE = """
    components:
      left: {{type: Inertia, moment: {moment} kg*m^2}}
      middle: {{type: Inertia, moment: {middle} kg*m^2}}
      right: {{type: Inertia, moment: {moment} kg*m^2}}
      one: {clutch}
      two: {clutch}
      push: {{type: TorqueSource, torque: {{ramp: {{to: {most} N*m, over: 1 s, start: {start} s}}}}}}
      pull: {{type: TorqueSource, torque: {{ramp: {{to: -{most} N*m, over: 1 s, start: {start} s}}}}}}
    connections:
      - [push.shaft, left.shaft, one.a]
      - [one.b, middle.shaft, two.a]
      - [two.b, right.shaft, pull.shaft]
    run: {{stop: {stop} s, accuracy: 1e-6, engine: {engine}}}
"""


@pytest.mark.parametrize("engine", ["rodas", "ida", "stepping"])
@pytest.mark.parametrize("seed", range(12))
def test_both_let_go_at_once_and_the_middle_stays(simulate, seed, engine):
    r = random.Random(seed)
    moment, middle, force = (float(f"{r.uniform(*span):.4g}") for span in ((0.05, 0.6), (0.03, 0.6), (20.0, 80.0)))
    stiction, start = float(f"{r.uniform(0.15, 0.3):.4g}"), float(f"{r.uniform(0.05, 0.2):.4g}")
    sliding, most = float(f"{0.7 * stiction:.4g}"), float(f"{0.3 * force * stiction:.4g}")
    curve = f"{{curve: coulomb, stiction: {stiction}, coulomb: {sliding}}}"
    clutch = f"{{type: Clutch, radius: 0.1 m, normal_force: {force} N, curve: {curve}}}"
    t0 = start + 0.1 * force * stiction / most
    result = simulate(SCENE.format(moment=moment, middle=middle, clutch=clutch, most=most, start=start, engine=engine,
                                   stop=t0 + 0.3))  # fmt: skip
    lets_go = [event for event in result.events if event.zone_from == "held"]
    assert [event.t for event in lets_go] == pytest.approx([t0, t0], abs=1e-6)
    rise, over = most * ((t0 - start) * 0.3 + 0.045), 0.1 * force * sliding * 0.3
    assert float(result["left.speed"][-1]) == pytest.approx((rise - over) / moment, rel=1e-4)
    assert abs(result["middle.speed"]).max() < 1e-5 * abs(result["left.speed"]).max()
