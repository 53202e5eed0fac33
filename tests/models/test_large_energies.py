"""Machines of any size come to rest when and where the closed form says, and lose what they had."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("scale", [1.0, 1e6, 1e12])
@pytest.mark.parametrize("accuracy", [1e-4, 1e-8])
def test_a_thrown_body_loses_all_its_energy_whatever_its_mass(
    simulate: Callable[..., Any], scale: float, accuracy: float, engine: str
) -> None:
    """It comes to rest at m v/F; its energy is a whole 1e14 J at the last, with an error weight far below rounding."""
    mass, speed, force = 2.0 * scale, 12.0, 5.0 * scale
    rest = mass * speed / force
    result = simulate(
        f"""
        components:
          body: {{type: Mass, mass: {mass!r} kg, velocity: {speed} m/s}}
          floor: {{type: Ground}}
          pad: {{type: Contact, normal_force: {force!r} N, curve: 1}}
        connections:
          - [body.flange, pad.a]
          - [pad.b, floor.flange]
        run: {{stop: 6 s, accuracy: {accuracy}, engine: {engine}}}
        """
    )
    assert [event.zone_to for event in result.events] == ["backward", "held"]
    assert result.events[1].t == pytest.approx(rest, rel=accuracy)
    assert result["body.x"][-1] == pytest.approx(0.5 * speed * rest, rel=accuracy)
    assert result.run["energy"]["dissipated"] == pytest.approx(0.5 * mass * speed**2, rel=10 * accuracy)
