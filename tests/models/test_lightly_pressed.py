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


BY_SIGNAL = """
    parameters: {normal: 1e-7}
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 1e-7, velocity: 1 m/s}
      press: {type: SignalSource, value: "{normal}"}
      pad: {type: Contact, curve: 0.25%s}
    connections: [[floor.flange, pad.a], [pad.b, block.flange], [press.signal, pad.normal]]
    run: {stop: 4 s}
    record: {signals: [block.x]}
"""


def told(scene: Scene, normal: float, lift: str = "") -> tuple[float, list[str]]:
    """Where the block is at the end, and what the run has to say of contacts that stayed open."""
    text = BY_SIGNAL % lift
    result = scene(text, normal=normal).run(out=None)
    return float(result["block.x"][-1]), [one for one in result.remarks if "never closed" in one]


@pytest.mark.filterwarnings("ignore")
def test_a_signal_below_the_lift_is_told(scene: Scene) -> None:
    x, said = told(scene, 1e-7)
    assert x == pytest.approx(4.0)
    assert len(said) == 1
    assert "pad was never closed although its normal force was above zero, up to 1e-07 N" in said[0]
    assert "`lift`" in said[0]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(("normal", "lift"), [(1e-7, ", lift: 1e-10 N"), (1e-7, ", lift: 1 mN"), (2e-6, ""), (0.0, "")])
def test_nothing_is_told_of_one_that_closes_or_whose_lift_was_given(scene: Scene, normal: float, lift: str) -> None:
    assert not told(scene, normal, lift)[1]
