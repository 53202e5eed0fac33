"""Whole machines of models/machines, each against one thing that is known of it without the engine."""

import pathlib

import numpy as np
import pytest

import fairlead
from tests.reference.servo_cylinder import servo_cylinder
from tests.reference.web_line import web_line

SCENES = pathlib.Path(__file__).parents[2] / "models" / "machines"
G = 9.80665
pytestmark = pytest.mark.slow


def run(name, **settings):
    """A machine, with other values by their dotted names."""
    result = fairlead.load(SCENES / f"{name}.yaml", set={"run.accuracy": "1e-6", **settings}).run(out=None)
    assert result.ok
    assert result.run["energy"]["closure"] < 1e-4
    return result


def entries(result, where, to):
    """Times at which a zone is entered [s]."""
    return np.array([e.t for e in result.events if e.component == where and e.zone_to == to])


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize(("speed", "breakaway"), [(5, 7), (3, 5)])
def test_a_bit_sticks_and_slips_with_the_period_of_one_mass_behind_a_spring(engine, speed, breakaway):
    """It sticks while the string winds from u below to u above sliding, and slips for (2 pi - 2 atan(w u/v))/w."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = run("drill_string", **{"run.engine": engine, "table.speed": f"{speed} rad/s",
                                    "rock.breakaway": f"{breakaway} kN*m"})  # fmt: skip
    w, u = np.sqrt(500 / 300), (breakaway - 4) * 1e3 / 500
    slips = (2 * np.pi - 2 * np.arctan2(w * u, speed)) / w
    sticks = 2 * u / speed
    loose, held = entries(result, "rock.contact", "forward"), entries(result, "rock.contact", "held")
    held = held[held > loose[0]]
    assert len(loose) >= 4
    assert held[: len(loose) - 1] - loose[:-1] == pytest.approx(slips, rel=1e-4)
    assert loose[1:] - held[: len(loose) - 1] == pytest.approx(sticks, rel=1e-4)


def test_a_clutch_takes_over_when_two_straight_lines_meet():
    """With the gear's torque T on the sun: 0.2 s' = 100 + T - C, 0.05 r' = 3 T, 5 c' = -60 - 4 T + C, s + 3 r = 4 c."""
    result = run("gear_change")
    first = result.at("sun.speed", 1.0)
    assert first == pytest.approx((100 - 60 / 4) / (0.2 + 5 / 16), rel=1e-5)  # the ring is held
    clutch = 4 * 0.1 * 0.4 * 2e3
    laws = np.array([[0.2, 0, 0, -1], [0, 0.05, 0, -3], [0, 0, 5, 4], [1, 3, -4, 0]])
    sun, _, carrier, _ = np.linalg.solve(laws, [100 - clutch, 0, -60 + clutch, 0])
    meets = 1 + (first - first / 4) / (carrier - sun)
    assert entries(result, "clutch.contact", "held").max() == pytest.approx(meets, rel=1e-5)
    both = first + sun * (meets - 1)
    end = both + (100 - 60) / (0.2 + 0.05 + 5) * (2 - meets)
    assert [result[f"{name}.speed"][-1] for name in ("sun", "ring", "carrier")] == pytest.approx([end] * 3, rel=1e-4)


def test_a_worm_keeps_the_load_and_comes_down_after_its_play():
    """Lifting steadily, the motor gives the load's share, the bearing and the drag; at rest the coupling is loose."""
    result = run("worm_hoist")
    k = 0.12 / 30
    rate = (result.at("rotor.speed", 1.4) - result.at("rotor.speed", 1.2)) / 0.2
    middle = np.mean([result.at("rotor.speed", t) for t in np.linspace(1.2, 1.4, 41)])
    carried = 100 * k * (G + k * rate)
    assert 12 - 0.02 * middle - 0.03 * rate == pytest.approx(carried / 0.42 + 0.2, rel=2e-3)
    rests = result.at("load.x", 2.6)
    assert rests == result.at("load.x", 2.9) > 0.1
    comes_down = entries(result, "worm.rubbing.contact", "backward")
    assert len(comes_down) >= 1
    assert comes_down[comes_down > 3].min() > entries(result, "coupling", "reverse")[-1] - 0.5


@pytest.mark.parametrize("mass", [200, 120])
def test_a_winch_lowers_at_the_speed_of_its_pump_whatever_the_load(mass):
    """The load's torque less the drag and what speeds it up is the drop over the motor, whose leakage adds to the flow.

    The balance of areas gives the rest: p_hold - tank + p_line - tank is 150 bar and the opening's share of 30 bar, at
    a ratio of one. All are means over a second, while it swings a little.
    """
    weight = mass * G
    result = run("lowering_winch", **{"load.mass": f"{mass} kg", "weight.force": f"{weight} N",
                                      "hold.pressure": f"{weight * 0.1 / 2e-5 + 1e5} Pa"})  # fmt: skip
    t = np.linspace(3.9, 4.9, 501)
    hold, line, speed = (np.mean(result.at(name, t)) for name in ("hold.pressure", "line.pressure", "drum.speed"))
    assert speed == pytest.approx((5e-4 + 5e-13 * (hold - line)) / 2e-5, rel=5e-3)
    rate = result.at("drum.speed", 4.9) - result.at("drum.speed", 3.9)
    needs = weight * 0.1 - 2 * speed - (5 + mass * 0.1**2) * rate
    assert hold - line == pytest.approx(needs / 2e-5, rel=2e-3)
    lifted = hold + line - 2e5
    assert lifted == pytest.approx(150e5 + 30e5 * np.mean(result.at("balance.opening", t)), rel=1e-3)
    crept = 5e-13 * weight * 0.1 / 2e-5 / 2e-5  # past the motor, with the valve shut
    assert result["drum.speed"][result.t > 7.5].mean() == pytest.approx(crept, abs=0.1)


@pytest.mark.parametrize("volume", [40, 15])
def test_a_tensioner_has_the_tension_of_its_gas(volume):
    """The gas begins with volume (25/39.2)^(1/1.2) and expands by area times travel; the rod's inertia is little."""
    result = run("tensioner_in_heave", **{"gas.volume": f"{volume} L"})
    area, tank = np.pi * 0.1**2 / 4, 1e5
    start = volume * 1e-3 * (25 / 39.2) ** (1 / 1.2)
    expands = start + area * (result["tensioner.travel"] - result["tensioner.travel"][0])
    level = 25e5 * (volume * 1e-3 / expands) ** 1.2
    late = result.t > 2
    assert np.allclose(result["line.tension"][late], area * (level - tank)[late], rtol=0.01)
    assert np.ptp(result["line.tension"][late]) > 0.05 * 30e3


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize(("gain", "integral_time", "share"), [(15, 0.2, 0.6), (8, 0.3, 0.5)])
def test_a_servo_cylinder_hunts_as_its_equations_integrated_by_scipy_do(engine, gain, integral_time, share):
    """The rows of both lie at most 5 ms apart; 1 um is for what lies between them."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    control = {"control.gain": str(gain), "control.integral_time": f"{integral_time} s"}
    settings = {"run.engine": engine, "run.stop": "4 s", "cylinder.seal_force": f"{share * 1500} N"}
    result = run("servo_cylinder", **settings, **control)
    t, x, switches = servo_cylinder(4, gain, integral_time, share)
    assert sum(event.component == "cylinder.seal" for event in result.events) == switches >= 60
    assert np.abs(np.interp(result.t, t, x) - result["load.x"]).max() < 1e-6
    late = result["load.x"][result.t > 2] - 0.15
    assert late.min() < -3e-5
    assert late.max() > 3e-5  # past the place wanted, both ways


ENGINE, PUMP, MOTOR, WHEEL = 200.0, 7e-6, 14e-6, 0.4 / 20  # rad/s, m^3/rad twice, m a rad of the motor
LEAKS, OUT, ROLLING = 2 * 5e-13, 3e-13, 800.0  # across pump and motor, out of either side of the motor, m^3/s/Pa; N


@pytest.mark.parametrize("setting", [0.6, 0.4])
def test_a_closed_hydrostatic_circuit_keeps_its_balances_of_oil_and_force(setting):
    """Means over a stretch with the swash plate at rest; what a litre of oil takes by compression is in all of them."""
    result = run("hydrostatic_drive", **{"setting": setting, "run.accuracy": "1e-6"})
    assert result.run["energy"]["closure"] < 1e-5
    t, high, low = result.t, result["forward.pressure"], result["backward.pressure"]
    for way, begin, end in ((1, 3.0, 6.0), (-1, 9.0, 12.0)):
        there = (t >= begin) & (t <= end)
        v = result["vehicle.v"][there]

        def mean(y, there=there):
            return np.trapezoid(y[there], t[there]) / (t[there][-1] - t[there][0])

        load = MOTOR * mean(high - low) / WHEEL
        assert load == pytest.approx(way * ROLLING + 4000 * (v[-1] - v[0]) / (end - begin), rel=1e-3)
        a, b = (high, low) if way > 0 else (low, high)
        stored = 1e-3 / 1e9 * (a[there][-1] - a[there][0]) / (end - begin)
        carried = setting * PUMP * ENGINE - LEAKS * mean(a - b) - OUT * mean(a) - stored  # what leaves the high side
        assert way * mean(result["vehicle.v"]) / WHEEL * MOTOR == pytest.approx(carried, rel=2e-3)
        charged = 10e-3 / 60 - mean(result["charge_relief.flow"])  # made up for what leaks out, and is compressed
        stored += 1e-3 / 1e9 * (b[there][-1] - b[there][0]) / (end - begin)
        assert charged == pytest.approx(OUT * mean(a + b) + stored, rel=0.1)


def test_a_closed_hydrostatic_circuit_brakes_by_driving_its_engine():
    result = run("hydrostatic_drive")
    slows = (result.t > 6.2) & (result.t < 6.9)  # while the swash plate turns back
    assert (result["vehicle.v"][slows] > 0).all()
    assert (result["backward.pressure"] > result["forward.pressure"])[slows].all()
    assert (result["pump.torque"][slows] < 0).all()
    lowest = np.minimum(result["forward.pressure"], result["backward.pressure"])
    assert lowest.min() > 19e5  # the charge pump keeps the low side up: 20 bar less what its check valve takes


def test_a_heavy_vehicle_speeds_up_as_its_relief_valves_let_it():
    """60 t: the pressure stays at what the valve passes at most, 300 bar and the pump's flow over its slope."""
    result = run("hydrostatic_drive", **{"vehicle.mass": "60 t", "run.stop": "3 s"})
    drop = result["forward.pressure"] - result["backward.pressure"]
    assert result["forward_relief.flow"].max() > 1e-4
    assert 300e5 < drop.max() < 300e5 + 0.6 * PUMP * ENGINE / 2e-10
    opens = result.t[np.argmax(result["forward_relief.flow"] > 1e-6)]
    t = np.arange(opens, opens + 0.5, 0.01)
    force = MOTOR * (result.at("forward.pressure", t) - result.at("backward.pressure", t)) / WHEEL - ROLLING
    gained = result.at("vehicle.v", t[-1]) - result.at("vehicle.v", t[0])
    assert gained == pytest.approx(np.trapezoid(force, t) / 60e3, rel=1e-3)


@pytest.mark.parametrize(("taper", "gain", "damping"), [(0.3, 300, 100), (0.8, 200, 200)])
def test_a_web_line_runs_as_its_balances_integrated_by_scipy_do(taper, gain, damping):
    """Inertias that move are written as J w' = torque there, and as bodies on relations of positions here."""
    result = run("web_line", **{"taper.taper": str(taper), "control.gain": str(gain), "run.stop": "20 s",
                                "control.ahead_gain": "-300", "damper.damping": f"{damping} N*m*s/rad"})  # fmt: skip
    t, rows = web_line(20, taper, gain, damping)
    names = ("dancer.tension_in", "dancer.tension_out", "web.tension", "dancer.angle", "unwinder.radius",
             "winder.radius")  # fmt: skip
    for name, row, within in zip(names, rows, (0.05, 0.05, 0.05, 1e-6, 1e-8, 1e-8), strict=True):
        assert np.abs(np.interp(result.t, t, row) - result[name]).max() < within, name
    assert np.ptp(result["dancer.angle"]) > 0.1


@pytest.mark.parametrize(("mu", "wraps"), [(0.15, 6), (0.1, 8)])
def test_a_traction_winch_hauls_and_pays_out_with_the_wraps_that_slip_at_the_side_the_rope_leaves(mu, wraps):
    """Hauling, the tension after k half wraps is min(load, storage e^(mu pi k)), for strain comes with the rope.

    Paying out it is max(storage, load e^(-mu pi k)) from the load. Torque and bearing of the storage drum
    give the tension there, the weight and the water that of the load.
    """
    result = run("traction_winch", **{"winch.mu": str(mu), "winch.half_wraps": str(wraps)})
    counts = np.arange(wraps + 1)
    for at, hauls in ((19.9, True), (40.0, False)):
        inner = [result.at(f"winch.span[{i}].tension", at) for i in range(wraps)]
        tensions = np.array([*inner, result.at("tail.tension", at)])
        load = 30e3 - 4e3 * result.at("load.v", at)
        assert tensions[-1] == pytest.approx(load, rel=1e-3)
        radius, way = result.at("drum.radius", at), -1 if hauls else 1
        store = (2500 + way * 100 * 0.6 / radius) / radius
        ratio = np.exp(mu * np.pi)
        hauled, paid = np.minimum(load, store * ratio**counts), np.maximum(store, load * ratio ** (counts - wraps))
        known = hauled if hauls else paid
        assert tensions == pytest.approx(known, rel=0.01)
    moved = result.at("load.x", 19.9) - result.at("load.x", 10.0)
    assert moved == pytest.approx(-0.6 * 9.9, rel=5e-3)
