"""A scene far from the origin runs as near it: positions known to less than their weight do not cut the steps."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

EPS = np.finfo(np.float64).eps


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("accuracy", [1e-4, 1e-6, 1e-8])
@pytest.mark.parametrize("far", [1e5, 3e6, 1e9])
def test_a_thrown_block_comes_to_rest_anywhere_by_the_closed_form(
    simulate: Callable[..., Any], far: float, accuracy: float, engine: str
) -> None:
    """It slides v^2/(2 a) in v/a: 9 m in 6 s, in as many steps as at zero. A weight is 1e-8 m or less, an ulp 1e-7."""

    def thrown(place: float) -> Any:
        return simulate(
            f"""
            components:
              body: {{type: Mass, mass: 10 kg, velocity: 3 m/s, position: {place!r} m}}
              floor: {{type: Ground}}
              pad: {{type: Contact, normal_force: 10 N, curve: 0.5}}
            connections:
              - [floor.flange, pad.a]
              - [pad.b, body.flange]
            run: {{stop: 10 s, accuracy: {accuracy}, engine: {engine}, max_steps: 1000}}
            """
        )

    there, here = thrown(far), thrown(0.0)
    assert [event.zone_to for event in there.events] == [event.zone_to for event in here.events]
    assert there.events[1].t == pytest.approx(6.0, rel=accuracy)
    assert there["body.x"][-1] - far == pytest.approx(9.0, abs=9 * accuracy + 100 * EPS * far)
    more = 2.0 if engine == "ida" else 1.1  # weights given to it are no smaller than rounding, and its steps uneven
    assert there.run["counters"]["steps"] <= more * here.run["counters"]["steps"] + 2


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("far", [1e5, 1e6])
def test_two_bodies_on_a_spring_take_the_same_steps_anywhere(
    simulate: Callable[..., Any], far: float, engine: str
) -> None:
    """The second is thrown, the first sticks and slips: the way and the switches do not ask where that is."""

    def thrown(place: float) -> Any:
        return simulate(
            f"""
            components:
              body: {{type: Mass, mass: 10 kg, position: {place!r} m}}
              tip: {{type: Mass, mass: 10 kg, position: {place!r} m, velocity: 0.2 m/s}}
              arm: {{type: Spring, stiffness: 1000 N/m}}
              floor: {{type: Ground}}
              pad: {{type: Contact, normal_force: 10 N, curve: {{curve: coulomb, stiction: 0.5, coulomb: 0.3}}}}
            connections:
              - [floor.flange, pad.a]
              - [pad.b, body.flange, arm.a]
              - [arm.b, tip.flange]
            run: {{stop: 3 s, accuracy: 1e-4, engine: {engine}}}
            """
        )

    there, here = thrown(far), thrown(0.0)
    assert [event.zone_to for event in there.events] == [event.zone_to for event in here.events]
    assert there["body.x"][-1] - far == pytest.approx(here["body.x"][-1], abs=1e-6)
    assert there.run["counters"]["steps"] == pytest.approx(here.run["counters"]["steps"], rel=0.02)
