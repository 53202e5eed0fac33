"""A void keeps the pressure at nothing, however small the volume of oil is in which it opens."""

import pytest

import fairlead

INFLOW = 0.62 * 1e-6 * (2 / 870) ** 0.5 * 1e5 / (2e10) ** 0.25  # m^3/s; 1 mm^2 from 1 bar to 0, turbulent beyond 1 bar
DRAWN = 1e-4  # m^3/s

SCENE = """
schema: 1
components:
  tank: {{type: Tank}}
  hole: {{type: Orifice, area: 1 mm^2}}
  oil: {{type: Volume, volume: {volume} m^3, pressure: 1 bar{more}}}
  pump: {{type: FlowSource, flow: {{ramp: {{to: {drawn} m^3/s, over: 0.1 s}}}}}}
  sump: {{type: Tank}}
connections:
  - [tank.port, hole.a]
  - [hole.b, oil.port, pump.inlet]
  - [pump.outlet, sump.port]
run: {{stop: 1 s, engine: {engine}}}
"""


def played(tmp_path, volume, engine="rodas", more="", drawn=DRAWN):
    netlist = tmp_path / "scene.yaml"
    netlist.write_text(SCENE.format(volume=volume, engine=engine, more=more, drawn=drawn), encoding="utf-8")
    return fairlead.load(netlist).run(out=None)


@pytest.mark.parametrize("volume", [1e-3, 1e-5, 1e-7])
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_what_is_drawn_and_does_not_come_is_void_at_no_pressure(tmp_path, volume, engine):
    result = played(tmp_path, volume, engine)
    assert abs(result["oil.pressure"][-1]) < 1e-3 * 1e5
    assert result["hole.flow"][-1] == pytest.approx(INFLOW, rel=2e-3)
    full = 0.1 * DRAWN / 2 + 0.9 * DRAWN - 1.0 * INFLOW
    assert result["oil.void"][-1] == pytest.approx(full, rel=2e-2)


@pytest.mark.parametrize("volume", [1e-3, 1e-7])
def test_oil_with_air_has_the_pressure_of_its_air(tmp_path, volume):
    """Its least pressure is above zero, and its air expands by what is missing."""
    result = played(tmp_path, volume, more=", effects: {air: on}")
    assert result["oil.pressure"].min() > 0
    assert result["oil.void"][-1] == pytest.approx(0.95 * DRAWN - INFLOW + 0.005 * volume, rel=3e-2)


def test_two_voids_on_one_node_share_what_is_missing_by_volume(tmp_path):
    netlist = tmp_path / "scene.yaml"
    text = SCENE.format(volume=1e-6, engine="rodas", more="", drawn=DRAWN)
    text = text.replace("  pump:", "  side: {type: Volume, volume: 3e-6 m^3, pressure: 1 bar}\n  pump:")
    netlist.write_text(text.replace("oil.port,", "oil.port, side.port,"), encoding="utf-8")
    result = fairlead.load(netlist).run(out=None)
    assert result["side.void"][-1] == pytest.approx(3 * result["oil.void"][-1], rel=1e-3)
