"""A contact between parts that move fast together lets go once, however slowly its load rises over its limit.

A block lies on a belt that moves as given, v0 + a t, and a force on it grows by r t. The contact carries
F0 + r t - m a. So it lets go at t1 = (L + m a - F0)/r, and the slip is r (t - t1)^2/(2 m) from there on. In the time
for which the zones are tried ahead it grows by less than the rounding of the two speeds, of which it is the difference:
which way it goes must not be told from that. It let go and was held forty times at one instant.
"""

from __future__ import annotations

import collections
from pathlib import Path

import numpy as np
import pytest

import fairlead

MASS, LIMIT, FROM = 5.65, 5000.0, 4000.0  # kg, N, N
SPAN = 20.0  # s
TEXT = """
schema: 1
name: scene
components:
  belt: {{type: MotionSource, velocity: {{table: [[0 s, {v0} m/s], [20 s, {v1} m/s]]}}}}
  block: {{type: Mass, mass: 5.65 kg, velocity: {v0} m/s}}
  pad: {{type: Contact, normal_force: 5000 N, curve: {curve}}}
  pull: {{type: ForceSource, force: {{table: [[0 s, 4000 N], [20 s, {to} N]]}}}}
connections:
  - [belt.flange, pad.a]
  - [block.flange, pad.b, pull.flange]
"""
TURNING = """
schema: 1
name: scene
components:
  belt: {{type: SpeedSource, speed: {{table: [[0 s, {v0}], [20 s, {v1}]]}}}}
  block: {{type: Inertia, moment: 5.65 kg*m^2, speed: {v0} rad/s}}
  pad: {{type: Clutch, radius: 1 m, normal_force: 5 kN, faces: 1, curve: {curve}}}
  pull: {{type: TorqueSource, torque: {{table: [[0 s, 4000 N*m], [20 s, {to} N*m]]}}}}
connections:
  - [belt.shaft, pad.a]
  - [block.shaft, pad.b, pull.shaft]
"""
MOTIONS = ((-3.0, 0.0, 60.0), (40.0, 0.0, 1000.0), (40.0, -1.5, 1000.0), (40.0, -2.0, 100.0), (400.0, 0.0, 100.0),
           (400.0, -20.0, 60.0), (3000.0, 0.0, 100.0), (3000.0, -150.0, 1000.0))  # fmt: skip
"""v0, a, r: m/s, m/s^2, N/s."""


@pytest.mark.parametrize("accuracy", ["1e-3", "1e-4", "1e-6"])
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_block_on_a_fast_belt_lets_go_once(tmp_path: Path, engine: str, accuracy: str) -> None:
    if engine == "ida":
        pytest.importorskip("sksundae")
    for v0, a, rate in MOTIONS:
        t1 = (LIMIT + MASS * a - FROM) / rate
        events, slip = played(tmp_path, TEXT, v0, a, rate, t1, engine, accuracy)
        assert [zone for _, zone in events] == ["forward"], (v0, a, rate, len(events))
        assert events[0][0] == pytest.approx(t1, abs=1e-9 + 4 * float(accuracy) * LIMIT / rate * 1e-3)
        assert slip == pytest.approx(rate * 0.5**2 / (2 * MASS), rel=1e-3, abs=1e-3)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_where_sliding_takes_less_it_lets_go_once_too(tmp_path: Path, engine: str) -> None:
    """It starts with the slope (mu_s - mu_c) N/m then."""
    for v0, a, rate in MOTIONS:
        t1 = (LIMIT + MASS * a - FROM) / rate
        curve = "{curve: coulomb, stiction: 1, coulomb: 0.9}"
        events, slip = played(tmp_path, TEXT, v0, a, rate, t1, engine, "1e-4", curve)
        assert [zone for _, zone in events] == ["forward"], (v0, a, rate, len(events))
        assert slip == pytest.approx((rate * 0.5**2 / 2 + 0.1 * LIMIT * 0.5) / MASS, rel=1e-3)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_a_fast_clutch_lets_go_once(tmp_path: Path, engine: str) -> None:
    for v0, a, rate in MOTIONS:
        t1 = (LIMIT + MASS * a - FROM) / rate
        events, slip = played(tmp_path, TURNING, v0, a, rate, t1, engine, "1e-4")
        assert [zone for _, zone in events] == ["forward"], (v0, a, rate, len(events))
        assert slip == pytest.approx(rate * 0.5**2 / (2 * MASS), rel=1e-3, abs=1e-3)


def played(folder: Path, text: str, v0: float, a: float, rate: float, t1: float, engine: str, accuracy: str,
           curve: str = "1") -> tuple[list[tuple[float, str]], float]:  # fmt: skip
    """Zones that the contact comes to, with when; and its slip half a second after it lets go."""
    path = folder / "scene.yaml"
    path.write_text(text.format(v0=v0, v1=v0 + a * SPAN, to=FROM + rate * SPAN, curve=curve), encoding="utf-8")
    run = {"run.engine": engine, "run.accuracy": accuracy, "run.stop": f"{t1 + 0.5} s"}
    result = fairlead.load(path, set=run).run(out=None)
    switched = [(event.t, event.zone_to) for event in result.events if event.component.startswith("pad")]
    return switched, result["pad.slip"][-1]


@pytest.mark.parametrize("damping", [0.09, 0.1, 0.11, 0.2])
def test_wraps_of_a_winch_switch_once_at_an_instant(damping: float) -> None:
    result = fairlead.load("machines/traction_winch", set={"winch.damping_ratio": damping}).run(out=None)
    counts = collections.Counter((event.t, event.component) for event in result.events)
    assert len(result.events) > 90
    assert max(counts.values()) == 1
    assert np.all(np.diff([event.t for event in result.events]) >= 0.0)
