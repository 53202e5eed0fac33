"""A flow that stops, falls or begins at once where nothing gives way: the pressure follows at once, by a closed form.

    Q = K d/(d^2 + p_cr^2)^(1/4),  K = C_d A sqrt(2/rho)      the drop d of a flow Q through an orifice, by `drop_of`
"""

from __future__ import annotations

from math import sqrt

import pytest
from fairlead.components.hydraulics.fluid import drop_of, throttled

from tests.conftest import Scene

ENGINES = pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
K = 0.62 * 2e-6 * sqrt(2 / 870)  # of 2 mm^2
KNOWN_AS_MEANS = pytest.mark.filterwarnings("ignore")  # stepping tells of what it knows as means over its steps

FED = """
    parameters: {{after: 0 L/min}}
    components:
      tank: {{type: Tank}}
      source: {{type: FlowSource, flow: {{step: {{from: 10 L/min, to: "{{after}}", at: 1 s}}}}}}
      one: {{type: Orifice, area: 2 mm^2}}
      {more}
    connections: [[tank.port, source.inlet, {back}], [source.outlet, one.a]{joined}]
    run: {{stop: 2 s, engine: {engine}}}
"""
SERIES = {
    "one orifice": {"more": "", "back": "one.b", "joined": ""},
    "two in series": {"more": "two: {type: Orifice, area: 2 mm^2}", "back": "two.b", "joined": ", [one.b, two.a]"},
}


@KNOWN_AS_MEANS
@ENGINES
@pytest.mark.parametrize("after", [0.0, 1e-6, -1e-4])
@pytest.mark.parametrize("name", SERIES)
def test_the_drop_follows_a_flow_that_falls_at_once(simulate: Scene, engine: str, after: float, name: str) -> None:
    result = simulate(FED.format(engine=engine, **SERIES[name]), after=after)
    assert result["one.drop"][-1] == pytest.approx(drop_of(K, after, 1e5), rel=1e-6, abs=1.0)
    assert result["one.flow"][-1] == pytest.approx(after, rel=1e-6, abs=1e-12)


EMPTIED = """
    components:
      gas: {{type: Accumulator, volume: 1 L, precharge: 3 MPa, pressure: 4 MPa}}
      {through}
      low: {{type: PressureSource, pressure: 2 MPa}}
    connections: {joined}
    run: {{stop: 10 s, engine: {engine}}}
"""
DEVICES = {
    "orifice": ("o: {type: Orifice, area: 2 mm^2}", "[[gas.port, o.a], [o.b, low.port]]"),
    "sharp orifice": (
        "o: {type: Orifice, area: 2 mm^2, critical_pressure: 1 kPa}", "[[gas.port, o.a], [o.b, low.port]]"
    ),
    "two orifices": (
        "o: {type: Orifice, area: 2 mm^2}\n      q: {type: Orifice, area: 2 mm^2}",
        "[[gas.port, o.a], [o.b, q.a], [q.b, low.port]]",
    ),
    "variable orifice": (
        "o: {type: VariableOrifice, area: 2 mm^2}\n      s: {type: SignalSource, value: 0.9}",
        "[[gas.port, o.a], [o.b, low.port], [s.signal, o.opening]]",
    ),
    "flow control, starved": (
        "o: {type: FlowControlValve, setting: 2 L/min, needs: 3 MPa}", "[[gas.port, o.a], [o.b, low.port]]"
    ),
}  # fmt: skip


@KNOWN_AS_MEANS
@ENGINES
@pytest.mark.parametrize("name", DEVICES)
def test_an_accumulator_runs_empty_at_once(simulate: Scene, engine: str, name: str) -> None:
    through, joined = DEVICES[name]
    result = simulate(EMPTIED.format(engine=engine, through=through, joined=joined))
    assert result["gas.pressure"][-1] == pytest.approx(3e6)
    assert result["gas.gas"][-1] == pytest.approx(1e-3)
    assert result["o.flow"][-1] == pytest.approx(0.0, abs=1e-12)
    assert [event.zone_to for event in result.events if event.component == "gas"] == ["empty"]


SHUT = {
    "check valve": "o: {type: CheckValve, area: 2 mm^2}",
    "flow control, regulating": "o: {type: FlowControlValve, setting: 2 L/min}",
}


@KNOWN_AS_MEANS
@ENGINES
@pytest.mark.parametrize("name", SHUT)
def test_a_port_that_nothing_leads_away_from_wants_a_volume(scene: Scene, engine: str, name: str) -> None:
    """Emptied, the accumulator lets nothing in or out, nor does the valve: any pressure would do."""
    joined = "[[gas.port, o.a], [o.b, low.port]]"
    without = scene(EMPTIED.format(engine=engine, through=SHUT[name], joined=joined)).run(out=None, check=False)
    assert "the pressure at gas.port, o.a" in without.run["sentence"]
    assert "Add a Volume there" in without.run["sentence"]
    through = f"{SHUT[name]}\n      v: {{type: Volume, volume: 0.1 L, pressure: 4 MPa}}"
    joined = "[[gas.port, o.a, v.port], [o.b, low.port]]"
    result = scene(EMPTIED.format(engine=engine, through=through, joined=joined)).run(out=None)
    assert result["gas.gas"][-1] == pytest.approx(1e-3)
    assert result["o.flow"][-1] == pytest.approx(0.0, abs=1e-9)


PILOTED = """
    parameters: {{pilot: 2e6}}
    components:
      tank: {{type: Tank}}
      wanted: {{type: SignalSource, value: {{step: {{from: 1e5, to: "{{pilot}}", at: 1 s}}}}}}
      actuator: {{type: PressureActuator}}
      supply: {{type: PressureSource, pressure: 4 MPa}}
      o: {{type: Orifice, area: 300 mm^2}}
      valve: {{type: PilotCheckValve, area: 3 mm^2}}
    connections:
      - [tank.port, valve.a]
      - [valve.b, o.b]
      - [supply.port, o.a]
      - [wanted.signal, actuator.wanted]
      - [actuator.port, valve.pilot]
    run: {{stop: 2 s, engine: {engine}}}
"""


@KNOWN_AS_MEANS
@ENGINES
@pytest.mark.parametrize("pilot", [1.5e6, 2e6, 8e6, 2e7])
def test_a_pilot_opens_a_check_valve_at_once(simulate: Scene, engine: str, pilot: float) -> None:
    result = simulate(PILOTED.format(engine=engine), pilot=pilot)
    load, tank = 4e6 - result["o.drop"][-1], 1e5
    flow = result["o.flow"][-1]
    assert result["valve.opening"][-1] == 1.0
    assert flow == pytest.approx(throttled(1.5 * K, load - tank, 1e4), rel=1e-6)
    assert result["o.drop"][-1] == pytest.approx(drop_of(150 * K, flow, 1e5), rel=1e-4)
