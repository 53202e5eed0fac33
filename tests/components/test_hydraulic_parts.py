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
    rises = result["chamber.level"][last].max() - result["chamber.level"][last].min()
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
    assert result.at("pilot.level", opens) - tank == pytest.approx((load * 1e6 - tank + 0.5e5) / 3, rel=1e-4)
    opens = first(result, "balance.relief", "partly")
    assert result.at("pilot.level", opens) - tank == pytest.approx((14e6 - load * 1e6 + tank) / 2, rel=1e-4)
    assert np.all(result["lock.flow"] <= 0)  # the load comes down


def test_a_flow_is_kept_until_the_drop_is_too_small():
    result = run("metering_valves")
    keeps = first(result, "keeper", "starved")
    flow = 3e-3 / 60
    assert result.at("keeper.flow", keeps / 2) == pytest.approx(flow, rel=1e-6)
    assert result.at("second.level", keeps) == pytest.approx(10e6 - 5e5, rel=1e-4)
    rate = (result.at("second.level", keeps) - 1e5) / keeps
    assert rate == pytest.approx((flow + 1e-6) * BULK / 3e-3, rel=1e-4)  # 1 mL/s comes from the pump
    opened = result.t > 0.25
    share = result["orifice.flow"] / np.sqrt(np.maximum(10e6 - result["first.level"], 1))
    assert first(result, "orifice", "open") == pytest.approx(0.2, abs=1e-6)
    inside = opened & (10e6 - result["first.level"] > 3e6)
    assert np.ptp(share[inside]) < 1e-3 * share[inside].max()
    half = share[np.argmin(np.abs(result.t - 0.1))]
    assert half == pytest.approx(share[inside][0] / 2, rel=1e-3)
