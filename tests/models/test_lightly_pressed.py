"""A constant normal force is never meant as none, however small: what it presses rubs, and stops.

    x = v^2/(2 mu N/m)        the way to a stop;  speeds and lengths in `nominal`, since they are small
"""

from __future__ import annotations

import pytest

from tests.conftest import Scene

ENGINES = pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
METHODS = ["hold", "karnopp", "binding", "saturation", "tanh", "lugre", "maxwell_slip", "reset_integrator"]

SLIDER = """
    parameters: {{normal: 1, method: hold}}
    components:
      floor: {{type: Ground}}
      block: {{type: Mass, mass: "{{normal}}", velocity: 1 m/s}}
      {pad}
    connections: {joined}
    friction: {{method: "{{method}}"}}
    run: {{stop: 4 s, engine: {engine}}}
"""
PAD = 'pad: {type: Contact, normal_force: "{normal}", curve: 0.25}', "[[floor.flange, pad.a], [pad.b, block.flange]]"
SHAFT = (
    'brake: {type: Brake, normal_force: "{normal}", curve: 0.25, radius: 1 m}\n      rim: {type: Rack, radius: 1 m}\n'
    '      frame: {type: Mass, mass: 1 kg}',
    "[[floor.flange, frame.flange], [rim.pinion, brake.shaft], [rim.rack, block.flange]]",
)  # fmt: skip


@ENGINES
@pytest.mark.parametrize("normal", [1e-3, 1e-6, 5e-7, 1e-12])
@pytest.mark.parametrize("what", [PAD, SHAFT], ids=["pad", "brake"])
def test_a_block_stops_after_its_way_however_light_it_is(simulate: Scene, engine: str, normal: float, what) -> None:
    pad, joined = what
    result = simulate(SLIDER.format(engine=engine, pad=pad, joined=joined), normal=normal)
    assert result["block.x"][-1] == pytest.approx(2.0, rel=1e-3)
    assert abs(result["block.v"][-1]) < 1e-9


@pytest.mark.parametrize("method", METHODS)
def test_every_treatment_rubs_however_little_presses(simulate: Scene, method: str) -> None:
    text = SLIDER.format(engine="rodas", pad=PAD[0], joined=PAD[1])
    light, heavy = (simulate(text, normal=normal, method=method) for normal in (5e-7, 5.0))
    assert light["block.x"][-1] == pytest.approx(heavy["block.x"][-1], rel=1e-3)


def test_a_lift_that_is_given_counts(simulate: Scene) -> None:
    pad = PAD[0].replace("curve", "lift: 2 N, curve")
    result = simulate(SLIDER.format(engine="rodas", pad=pad, joined=PAD[1]))
    assert result["block.x"][-1] == pytest.approx(4.0)


def test_none_presses_nothing(simulate: Scene) -> None:
    pad = PAD[0].replace('"{normal}"', "0 N")
    result = simulate(SLIDER.format(engine="rodas", pad=pad, joined=PAD[1]))
    assert result["block.x"][-1] == pytest.approx(4.0)
