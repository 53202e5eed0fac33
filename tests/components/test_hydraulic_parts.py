"""The hydraulic parts of models/single_parts against what their formulas say."""

import pathlib

import numpy as np
import pytest

import fairlead

BULK = 1e9  # Pa, of oil as the netlists have it
SCENES = pathlib.Path(__file__).parents[2] / "models" / "single_parts"


def run(name, **settings):
    """A scene, with other values by their dotted names."""
    result = fairlead.load(SCENES / f"{name}.yaml", set={"run.accuracy": "1e-6", **settings}).run(out=None)
    assert result.ok
    assert result.run["energy"]["closure"] < 1e-4
    return result


def first(result, where, to):
    """Time at which a zone was first entered [s]."""
    table = result.switches().to_pandas()
    return float(table["first"][(table["component"] == where) & (table["zone_to"] == to)].min())


@pytest.mark.slow
def test_two_check_valves_make_a_pump():
    """What a stroke delivers is its volume less what compressing the chamber's oil from tank to line takes."""
    result = run("check_valve")
    last = (result.t >= 0.8 - 1e-9) & (result.t <= 1.0 + 1e-9)
    stroke = 2 * 2e-4 / (2 * np.pi * 5)  # m^3, of a sine of 2e-4 m^3/s
    delivered = np.trapezoid(result["delivery.flow"][last], result.t[last])
    sucked = np.trapezoid(result["suction.flow"][last], result.t[last])
    rises = result["chamber.pressure"][last].max() - result["chamber.pressure"][last].min()
    assert delivered == pytest.approx(sucked, rel=2e-3)
    compressed = 20e-6 * rises / BULK
    assert delivered == pytest.approx(stroke - compressed, rel=2e-3)
    assert result["delivery.flow"].min() >= 0
    assert result["suction.flow"].min() >= 0


@pytest.mark.parametrize("load", [10, 6])
def test_pilots_open_at_the_pressure_of_the_balance_of_areas(load):
    result = run("piloted_valves", **{"load.pressure": f"{load} MPa"})
    tank = 1e5
    opens = first(result, "lock", "partly")
    assert result.at("pilot.pressure", opens) - tank == pytest.approx((load * 1e6 - tank + 0.5e5) / 3, rel=1e-4)
    opens = first(result, "balance.relief", "partly")
    assert result.at("pilot.pressure", opens) - tank == pytest.approx((14e6 - load * 1e6 + tank) / 2, rel=1e-4)
    assert np.all(result["lock.flow"] <= 0)  # the load comes down


def test_a_flow_is_kept_until_the_drop_is_too_small():
    result = run("metering_valves")
    keeps = first(result, "keeper", "starved")
    flow = 3e-3 / 60
    assert result.at("keeper.flow", keeps / 2) == pytest.approx(flow, rel=1e-6)
    assert result.at("second.pressure", keeps) == pytest.approx(10e6 - 5e5, rel=1e-4)
    rate = (result.at("second.pressure", keeps) - 1e5) / keeps
    assert rate == pytest.approx((flow + 1e-6) * BULK / 3e-3, rel=1e-4)  # 1 mL/s comes from the pump
    opened = result.t > 0.25
    share = result["orifice.flow"] / np.sqrt(np.maximum(10e6 - result["first.pressure"], 1))
    assert first(result, "orifice", "open") == pytest.approx(0.2, abs=1e-6)
    inside = opened & (10e6 - result["first.pressure"] > 3e6)
    assert np.ptp(share[inside]) < 1e-3 * share[inside].max()
    half = share[np.argmin(np.abs(result.t - 0.1))]
    assert half == pytest.approx(share[inside][0] / 2, rel=1e-3)


def test_a_pump_keeps_a_drop_whatever_the_load_and_another_turns_with_its_signal():
    """The flow is that of the orifice at the drop kept, which the band lessens by its share of the full flow."""
    result = run("pumps_that_follow")
    flow, drop = result["pump.flow"][-1], result["line.pressure"][-1] - result["side.pressure"][-1]
    assert drop == pytest.approx(20e5 - 4e5 * flow / 1e-3, rel=1e-4)
    assert result["side.pressure"][-1] == pytest.approx(1e5 + flow / 3e-11, rel=1e-4)
    assert result["swash.flow"][-1] == pytest.approx(4e-6 * 100, rel=1e-9)  # beyond 1 it stays at 1
    level = result["circuit.pressure"][-1]
    assert result["swash.torque"][-1] == pytest.approx(4e-6 * (level - 1e5), rel=1e-9)
    assert level == pytest.approx(1e5 + 4e-4 / 5e-11, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_load_that_is_too_high_has_the_pressure_of_the_limit(engine):
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = run("pumps_that_follow", **{"resistance.conductance": "1e-12 m^3/s/Pa", "run.engine": engine})
    flow = result["pump.flow"][-1]
    assert result["line.pressure"][-1] == pytest.approx(200e5 - 4e5 * flow / 1e-3, rel=1e-4)


@pytest.mark.slow
def test_a_lift_stands_where_spring_air_and_load_say():
    result = run("single_acting_cylinder", **{"lever.value": "40e5", "run.stop": "6 s", "effects.seal_friction": "off",
                                              "supply.conductance": "1e-8 m^3/s/Pa",
                                              "damper.damping": "2 kN*s/m"})  # fmt: skip
    area = np.pi * 0.04**2 / 4
    assert result["load.x"][-1] == pytest.approx((area * 39e5 - 500 - 2943) / 1e4, rel=1e-4)
    assert result["lift.pressure"][-1] == pytest.approx(40e5, rel=1e-4)


def test_gas_that_keeps_its_temperature_follows_boyle(simulate):
    result = simulate("""
        components:
          sump: {type: Tank}
          pump: {type: FixedPump, flow: 0.1 L/s}
          store: {type: Accumulator, volume: 1 L, precharge: 20 bar, heat: isothermal, pressure: 25 bar}
        connections: [[sump.port, pump.inlet], [pump.outlet, store.port]]
        run: {stop: 4 s, accuracy: 1e-7}
    """)
    assert result["store.pressure"][-1] == pytest.approx(20e5 * 1e-3 / (1e-3 * 20 / 25 - 4e-4), rel=1e-6)
    assert result.run["energy"]["closure"] < 1e-6


def test_what_a_pump_gives_warms_the_block_by_the_losses_of_all_it_flows_through():
    result = run("warm_oil", **{"run.accuracy": "1e-6"})
    steady = result.at("block.temperature", 20.0) - result.at("block.temperature", 10.0)
    assert steady == pytest.approx(result["pump.power"][-1] * 10 / 5000, rel=1e-6)
    parts = sum(result[f"{name}.loss"][-1] for name in ("relief", "throttle", "check", "gap"))
    assert parts == pytest.approx(result["pump.power"][-1], rel=1e-6)
    assert min(result[f"{name}.loss"][-1] for name in ("relief", "throttle", "check", "gap")) > 10


LOSSES = """
    components:
      supply: {{type: PressureSource, pressure: 20 MPa}}
      sump: {{type: Tank, pressure: 1 MPa}}
      part: {{type: {kind}}}
      {more}
      fed: {{type: HeatActuator}}
      body: {{type: HeatCapacity, capacity: 500 J/K}}
    connections:
      {joins}
      - [part.loss, fed.heat]
      - [fed.port, body.port]
    run: {{stop: 2 s, accuracy: 1e-6}}
    record: {{signals: [body.temperature, part.loss]}}
"""
BETWEEN = "- [supply.port, part.a]\n      - [part.b, sump.port]"
DROP = 19e6


@pytest.mark.parametrize(
    ("kind", "more", "joins", "loss"),
    [
        ("Leak, conductance: 1e-12", "", BETWEEN, 1e-12 * DROP**2),
        ("FlowControlValve, setting: 6 L/min", "", BETWEEN, 1e-4 * DROP),
        ("HydraulicMotor, displacement: 20 cm^3/rev, internal_leakage: 1e-12, external_leakage: 2e-13",
         "jammed: {type: Housing}", f"{BETWEEN}\n      - [part.shaft, jammed.shaft]",
         1e-12 * DROP**2 + 2e-13 * (20e6**2 + 1e6**2)),
        ("ServoValve, rated_flow: 12 L/min, rated_drop: 9.5 MPa, effects: {valve_dynamics: off}",
         "asked: {type: SignalSource, value: -0.5}\n      pipe: {type: Volume, volume: 1 L, pressure: 10.5 MPa}",
         "- [supply.port, part.supply]\n      - [part.tank, sump.port]\n      - [part.a, part.b, pipe.port]\n"
         "      - [asked.signal, part.command]", 1e-4 * DROP),
    ],
    ids=["leak", "flow valve", "motor", "servo valve"],
)  # fmt: skip
def test_a_part_tells_as_loss_what_no_work_is_made_of(simulate, kind, more, joins, loss):
    """Flow times drop; of a stalled motor what leaks across and out; of a valve half open both lands in a row."""
    result = simulate(LOSSES.format(kind=kind, more=more, joins=joins))
    assert result["part.loss"][-1] == pytest.approx(loss, rel=1e-4)
    assert result["body.temperature"][-1] - result["body.temperature"][0] == pytest.approx(2 * loss / 500, rel=1e-3)


@pytest.mark.parametrize(("side", "way"), [("cap", 1), ("rod", -1)])
def test_a_rigid_chamber_moves_as_fast_as_oil_comes_through_its_orifice(side, way):
    """m dv/dt = A (p - drop), drop = (A v/K)^2 far above p_cr: v = v_end tanh(t/tau), v_end = K sqrt(p)/A."""
    result = run("rigid_chamber", **{"ram.side": side, "orifice.critical_pressure": "1 Pa"})
    k, area, pressure = 0.62 * 2e-6 * np.sqrt(2 / 870), 10e-4, 5e6
    end = k * np.sqrt(pressure) / area
    tau = 100 * end / (area * pressure)
    assert result["load.v"] == pytest.approx(way * end * np.tanh(result.t / tau), abs=2e-4 * end)
    assert result["ram.pressure"][-1] == pytest.approx(0, abs=pressure * 1e-3)
