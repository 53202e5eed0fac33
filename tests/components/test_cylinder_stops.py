"""A cylinder whose end stop is too soft: its chamber has no volume left, and the run says so, on every engine."""

import pytest

SCENE = """
components:
  floor: {{type: Ground}}
  lever: {{type: SignalSource, value: {{table: [[0 s, 60e5], [0.5 s, 60e5], [0.6 s, 1e5], [5 s, 1e5]]}}}}
  supply: {{type: PressureActuator, conductance: 2e-10 m^3/s/Pa}}
  lift: {{type: SingleActingCylinder, bore_diameter: 40 mm, stroke: 0.2 m, dead_volume: 1e-4 m^3,
         stop_stiffness: {stiffness} N/m, effects: {{cavitation: "{void}"}}}}
  load: {{type: Mass, mass: 300 kg, position: 0, velocity: 0}}
  weight: {{type: ForceSource, force: -2943 N}}
  damper: {{type: Damper, damping: 20 kN*s/m}}
connections:
  - [lever.signal, supply.wanted]
  - [supply.port, lift.a]
  - [floor.flange, lift.body, damper.a]
  - [lift.rod, load.flange, weight.flange, damper.b]
run: {{stop: 5 s}}
"""
DEEP = 1e-4 / (3.141592653589793 * 0.02**2)
"""m: how long the dead volume is, 80 mm."""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("void", ["on", "off"])
def test_a_piston_that_goes_through_its_dead_volume_ends_the_run_by_name(scene, void, engine):
    """At air pressure the load of 2943 N stands 0.29 m deep on a stop of 1e4 N/m: the dead volume is 80 mm long."""
    model = scene(SCENE.format(void=void, stiffness=1e4))
    result = model.run(out=None, engine=engine, check=False)
    assert result.status == "failed"
    assert "lift has no volume left" in result.run["sentence"]
    assert "stiffer stop" in result.run["sentence"]
    assert result.extremes("lift.travel").lowest == pytest.approx(-0.99 * DEEP, rel=0.05)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_a_stop_that_is_stiff_enough_lets_it_go_on(scene, engine):
    """2943 N on 1e5 N/m are 29 mm."""
    result = scene(SCENE.format(void="on", stiffness=1e5)).run(out=None, engine=engine)
    assert result.at("lift.travel", 5.0) == pytest.approx(-0.02943, rel=0.02)
