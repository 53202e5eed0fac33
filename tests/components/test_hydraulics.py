"""Hydraulic components against closed forms: orifice, volume, motor, cylinder, pump, accumulator, relief, line."""

import math

import numpy as np
import pytest
from fairlead.components.hydraulics.fluid import drop_of, throttled

from fairlead.errors import ModelError
from tests.callbacks import Called
from tests.reference.valve_drive import Drive

DRIVE = Drive(inertia=1.025)
BETA, DENSITY = 1e9, 870.0


def eigenvalues(model, y=None):
    """Eigenvalues of M^-1 df/dy of a model without algebraic unknowns, without its ledger."""
    system = model.system
    called, kept = Called(system), ~system.quadrature
    jacobian, _ = called.jacobian(0.0, system.initial.copy() if y is None else y)
    matrix = np.linalg.solve(called.mass(), jacobian)[np.ix_(kept, kept)]
    return np.linalg.eigvals(matrix)


def oscillation(values):
    """The one angular frequency among eigenvalues, and the largest of their real parts."""
    swinging = values[np.abs(values.imag) > 1.0]
    assert len(swinging) == 2
    return abs(swinging[0].imag), swinging.real.max()


def test_an_orifice_is_laminar_near_zero_and_turbulent_beyond():
    ratios = [throttled(1.0, r * 1e5, 1e5) / math.sqrt(r * 1e5) for r in (0.01, 0.1, 1.0, 10.0)]
    np.testing.assert_allclose(ratios, [0.1000, 0.3154, 0.8409, 0.99752], atol=1e-4)
    slope = throttled(1.0, 1e-3, 1e5) / 1e-3
    assert slope == pytest.approx(1 / math.sqrt(1e5), rel=1e-9)
    assert throttled(2.0, -3e5, 1e5) == -throttled(2.0, 3e5, 1e5)


@pytest.mark.parametrize("flow", [1e-9, 1e-5, 3e-4, -2e-3, 0.1])
def test_the_drop_of_a_flow_is_the_inverse_of_the_flow_of_a_drop(flow):
    assert throttled(3e-7, drop_of(3e-7, flow, 1e5), 1e5) == pytest.approx(flow, rel=1e-12)


def test_orifices_in_series_find_the_pressures_between_them(simulate):
    """Nothing is stored between them, so a root of a root must be solved, from a start that is far from it."""
    text = """
        components:
          high: {type: PressureSource, pressure: 180 bar}
          one: {type: Orifice, area: 1 mm^2}
          two: {type: Orifice, area: 1 cm^2}
          three: {type: Orifice, area: 2 mm^2}
          low: {type: Tank}
        connections: [[high.port, one.a], [one.b, two.a], [two.b, three.a], [three.b, low.port]]
        run: {stop: 1 s}
    """
    result = simulate(text)
    areas = {"one": 1e-6, "two": 1e-4, "three": 2e-6}
    flow = result["one.flow"][-1]
    drops = {name: drop_of(0.62 * area * math.sqrt(2 / DENSITY), flow, 1e5) for name, area in areas.items()}
    assert sum(drops.values()) == pytest.approx(179e5, rel=1e-9)
    for name, drop in drops.items():
        assert result[f"{name}.drop"][-1] == pytest.approx(drop, rel=1e-6)


def test_an_orifice_between_two_pressures_turns_its_power_into_heat(simulate):
    text = """
        components:
          high: {type: PressureSource, pressure: 101 bar}
          edge: {type: Orifice, area: 4 mm^2}
          low: {type: Tank}
        connections: [[high.port, edge.a], [edge.b, low.port]]
        run: {stop: 2 s}
    """
    result = simulate(text)
    flow = 0.62 * 4e-6 * math.sqrt(2 / DENSITY) * 100e5 / (100e5**2 + 1e5**2) ** 0.25
    np.testing.assert_allclose(result["edge.flow"], flow, rtol=1e-12)
    assert result.run["energy"]["dissipated"] == pytest.approx(2 * flow * 100e5, rel=1e-9)
    assert result.run["energy"]["supplied"] == pytest.approx(2 * flow * 100e5, rel=1e-9)


CLOSED = """
    components:
      a: {type: Volume, volume: 1 l, pressure: 90 bar, effects: {cavitation: off}}
      b: {type: Volume, volume: 1 l, pressure: 90 bar, effects: {cavitation: off}}
      motor: {type: HydraulicMotor, displacement: 125 cm^3/rev, effects: {leakage: off}}
      load: {type: Inertia, moment: 1.025 kg*m^2, speed: 0.5 rad/s}
    connections: [[a.port, motor.a], [b.port, motor.b], [motor.shaft, load.shaft]]
    run: {stop: 1 s, accuracy: 1e-6}
"""


def test_a_motor_between_closed_volumes_swings_at_its_hydraulic_frequency(scene):
    """Eigenvalues +-j w, w = D sqrt(2 beta/(V J)), and twice zero: the sum of the pressures and the angle."""
    values = eigenvalues(scene(CLOSED))
    frequency, damping = oscillation(values)
    assert frequency == pytest.approx(27.7897, abs=1e-4)
    assert frequency == pytest.approx(DRIVE.natural_frequency, rel=1e-12)
    assert abs(damping) < 1e-9
    assert np.sort(np.abs(values))[:2] == pytest.approx([0, 0], abs=1e-6)


def test_it_swings_as_the_closed_form_says_and_keeps_its_energy(simulate):
    result = simulate(CLOSED)
    w, swing = DRIVE.natural_frequency, 0.5 * 1.025 * DRIVE.natural_frequency / DRIVE.displacement / 2
    np.testing.assert_allclose(result["load.speed"], 0.5 * np.cos(w * result.t), atol=1e-5)
    np.testing.assert_allclose(result["a.pressure"], 90e5 - swing * np.sin(w * result.t), atol=1e-4 * swing)
    assert result.run["energy"]["closure"] < 1e-6
    assert result.run["energy"]["supplied"] == 0


VALVE_MOTOR = """
    components:
      power: {type: PowerUnit, pressure: 180 bar, tank_pressure: 2 bar}
      command: {type: SignalSource, value: {step: {to: 0.5, at: 10 ms}}}
      drive:
        type: ServoMotorDrive
        valve: {rated_flow: 40 l/min}
        motor: {displacement: 125 cm^3/rev, inertia: 1.025 kg*m^2}
        volume: 1 l
        pressure: 91 bar
        effects: {motor_friction: off, leakage: off}
    connections:
      - [power.supply, drive.supply]
      - [power.tank, drive.tank]
      - [command.signal, drive.command]
    run: {stop: 5 s, accuracy: 1e-5}
"""


def test_a_valve_and_a_motor_reach_the_speed_of_the_closed_form(simulate):
    """w = C_d A x sqrt((p_s - p_t)/rho)/D = K x sqrt((p_s - p_t)/2)/D, less 3e-5 of it for the laminar part."""
    result = simulate(VALVE_MOTOR)
    drive = Drive()
    square_root = drive.no_load_speed(0.5)
    half = (drive.supply - drive.tank) / 2
    exact = drive.conductance * 0.5 * throttled(1.0, half, drive.critical) / drive.displacement
    assert result["drive.speed"][-1] == pytest.approx(exact, rel=1e-6)
    assert result["drive.speed"][-1] == pytest.approx(square_root, rel=5e-5)
    assert square_root * drive.radius / drive.gear * 2 == pytest.approx(1.158, abs=5e-4)  # line speed, fully open
    assert result.run["energy"]["closure"] < 1e-5


def test_a_motor_that_cannot_turn_gives_its_stall_torque(simulate):
    text = VALVE_MOTOR.replace(
        "    connections:",
        """      brake: {type: Brake, radius: 1 m, curve: 1, normal_force: 1 kN, method: hold}
    connections:
      - [drive.shaft, brake.shaft]""",
    )
    result = simulate(text, **{"run.stop": "3 s"})
    assert result["drive.torque"][-1] == pytest.approx(354.1, abs=0.05)
    assert result["drive.torque"][-1] == pytest.approx(Drive().stall_torque, rel=1e-6)
    assert result["brake.torque"][-1] == pytest.approx(Drive().stall_torque, rel=1e-6)
    assert Drive().stall_torque * 30 / 0.65 == pytest.approx(16.3e3, abs=50)  # line pull of the winch at stall
    assert result["drive.speed"][-1] == pytest.approx(0.0, abs=1e-12)


def test_with_a_load_pressure_the_speed_is_that_of_what_is_left(simulate):
    text = VALVE_MOTOR.replace(
        "    connections:",
        """      load: {type: TorqueSource, torque: -100 N*m}
    connections:
      - [drive.shaft, load.shaft]""",
    )
    result = simulate(text)
    drive = Drive()
    left = (drive.supply - drive.tank - 100 / drive.displacement) / 2
    speed = drive.conductance * 0.5 * math.sqrt(left) / drive.displacement
    assert result["drive.speed"][-1] == pytest.approx(speed, rel=1e-4)
    assert result["drive.load_pressure"][-1] == pytest.approx(100 / drive.displacement, rel=1e-5)


def test_leakage_lets_a_locked_motor_turn_under_load_at_the_speed_of_the_closed_form(simulate):
    """With the valve shut the oil can only get away by leaking: D w = C_i p_L + C_e/2 p_L about equal pressures."""
    text = """
        components:
          a: {type: Volume, volume: 1 l, pressure: 90 bar}
          b: {type: Volume, volume: 1 l, pressure: 90 bar}
          motor: {type: HydraulicMotor, displacement: 125 cm^3/rev, internal_leakage: 4e-12 m^3/s/Pa}
          rotor: {type: Inertia, moment: 1 kg*m^2}
          load: {type: TorqueSource, torque: -100 N*m}
        connections: [[a.port, motor.a], [b.port, motor.b], [motor.shaft, rotor.shaft, load.shaft]]
        run: {stop: 60 s, accuracy: 1e-5}
    """
    result = simulate(text)
    turning = -100 * 4e-12 / DRIVE.displacement**2
    assert result["rotor.speed"][-1] == pytest.approx(turning, rel=1e-5)
    assert result["motor.load_pressure"][-1] == pytest.approx(100 / DRIVE.displacement, rel=1e-6)


CAVITATING = """
    components:
      oil: {type: Volume, volume: 0.5 l, pressure: 10 bar}
      pump: {type: HydraulicMotor, displacement: 20 cm^3/rev, effects: {leakage: off}}
      low: {type: Tank}
      rotor: {type: Inertia, moment: 2 kg*m^2, speed: 10 rad/s}
      spring: {type: TorsionSpring, stiffness: 200 N*m/rad}
      wall: {type: Housing}
    connections: [[oil.port, pump.a], [pump.b, low.port], [rotor.shaft, pump.shaft, spring.b], [wall.shaft, spring.a]]
    run: {stop: 1 s, accuracy: 1e-6}
"""


def test_oil_that_is_drawn_away_leaves_a_void_that_is_filled_again_to_the_last_drop(simulate):
    """A rotor that swings draws oil out and pushes it back; what is missing beside the compression is the void."""
    result = simulate(CAVITATING)
    displaced = 20e-6 / (2 * math.pi) * result["rotor.angle"]
    squeezed = 0.5e-3 / BETA * (10e5 - result["oil.pressure"])
    assert result["oil.pressure"].min() > -5e3  # of some 20 bar that the swing would ask for
    void = displaced - squeezed
    torn = np.flatnonzero(result["oil.pressure"] < 1e3)
    assert void[torn].max() > 1e-7
    filled = [event.t for event in result.events if event.zone_to == "full" and event.t > 0]
    assert len(filled) == 2  # in two swings
    np.testing.assert_allclose(result.at("oil.pressure", filled[0] + 0.02), 10e5 - BETA / 0.5e-3 * 20e-6 / (2 * math.pi)
                               * result.at("rotor.angle", filled[0] + 0.02), atol=5e3)  # fmt: skip
    assert result.run["energy"]["closure"] < 1e-6
    bare = simulate(CAVITATING, **{"oil.effects.cavitation": "off"})
    assert bare["oil.pressure"].min() < -10e5


def test_entrained_air_makes_oil_soft_at_low_pressure_as_its_formula_says(simulate):
    """Pumped slowly up from 1 bar: the volume taken in is V (dp/beta + air (1 - (p_0/p)^(1/n)))."""
    text = """
        components:
          oil: {type: Volume, volume: 1 l, pressure: 1 bar, effects: {air: on}}
          pump: {type: FixedPump, flow: 10 cm^3/s}
          low: {type: Tank}
        connections: [[low.port, pump.inlet], [pump.outlet, oil.port]]
        run: {stop: 1 s, accuracy: 1e-6}
    """
    result = simulate(text)
    p, taken = result["oil.pressure"], 10e-6 * result.t
    np.testing.assert_allclose(1e-3 * ((p - 1e5) / BETA + 0.005 * (1 - (1e5 / p) ** (1 / 1.2))), taken, atol=2e-10)
    assert result.run["energy"]["closure"] < 1e-6
    hard = simulate(text, **{"oil.effects.air": "off"})
    assert hard["oil.pressure"][-1] == pytest.approx(1e5 + 10e-6 / 1e-3 * BETA, rel=1e-9)


def test_air_in_the_limit_of_none_is_oil(simulate):
    text = CLOSED.replace("effects: {cavitation: off}", "air_share: 1e-9, effects: {air: on}")
    frequency = DRIVE.natural_frequency
    result = simulate(text)
    np.testing.assert_allclose(result["load.speed"], 0.5 * np.cos(frequency * result.t), atol=2e-4)


def test_an_accumulator_holds_the_gas_volumes_of_the_closed_form(simulate):
    """V = V_0 (p_0/p)^(1/n): 4.580, 3.460, 2.806 l at 100, 140, 180 bar of 5 l at 90 bar, n = 1.2."""
    text = """
        parameters: {p: 100 bar}
        components:
          source: {type: PressureSource, pressure: "{p}"}
          accumulator: {type: Accumulator, volume: 5 l, precharge: 90 bar}
        connections: [[source.port, accumulator.port]]
        run: {stop: 5 s, accuracy: 1e-6}
    """
    for pressure, volume in ((100, 4.580), (140, 3.460), (180, 2.806)):
        result = simulate(text, p=f"{pressure} bar")
        assert result["accumulator.gas"][-1] * 1e3 == pytest.approx(volume, abs=5e-4)
        assert result["accumulator.gas"][-1] == pytest.approx(5e-3 * (90 / pressure) ** (1 / 1.2), rel=1e-6)
        assert result.run["energy"]["closure"] < 1e-5


def test_an_accumulator_below_its_precharge_takes_nothing_and_one_that_runs_out_closes(simulate):
    text = """
        components:
          accumulator: {type: Accumulator, volume: 1 l, precharge: 50 bar, pressure: 60 bar}
          edge: {type: Orifice, area: 2 mm^2}
          low: {type: Tank}
          line: {type: Volume, volume: 0.1 l, pressure: 60 bar}
        connections: [[accumulator.port, line.port, edge.a], [edge.b, low.port]]
        run: {stop: 3 s}
    """
    result = simulate(text)
    assert [event.zone_to for event in result.events if event.component == "accumulator"] == ["empty"]
    assert result["accumulator.gas"][-1] == pytest.approx(1e-3, rel=1e-6)
    assert result["accumulator.pressure"][-1] == pytest.approx(50e5, rel=1e-6)
    assert result["line.pressure"][-1] == pytest.approx(1e5, rel=1e-3)


def test_a_relief_valve_settles_above_its_setting_by_the_flow_over_its_slope(simulate):
    text = """
        components:
          pump: {type: FixedPump, flow: 30 l/min}
          line: {type: Volume, volume: 1 l}
          relief: {type: ReliefValve, setting: 210 bar, slope: 2e-9 m^3/s/Pa}
          tank: {type: Tank, pressure: 0 bar}
        connections: [[tank.port, pump.inlet, relief.b], [pump.outlet, line.port, relief.a]]
        run: {stop: 1 s}
    """
    result = simulate(text)
    expected = 210e5 + 0.5e-3 / 2e-9
    assert result["line.pressure"][-1] == pytest.approx(expected, rel=1e-4)
    assert result.run["energy"]["closure"] < 1e-5


def test_a_pressure_pump_settles_on_its_characteristic(simulate):
    """An orifice takes K sqrt(p); the pump gives (cut_off - p)/band of its full flow."""
    text = """
        components:
          pump: {type: PressurePump, most: 60 l/min, cut_off: 180 bar, band: 20 bar}
          line: {type: Volume, volume: 2 l, pressure: 150 bar}
          edge: {type: Orifice, area: 3 mm^2}
          tank: {type: Tank, pressure: 0 bar}
        connections: [[tank.port, pump.inlet, edge.b], [pump.outlet, line.port, edge.a]]
        run: {stop: 3 s}
    """
    result = simulate(text)
    p = result["line.pressure"][-1]
    drawn = 0.62 * 3e-6 * math.sqrt(2 / DENSITY) * p / (p**2 + 1e10) ** 0.25
    assert drawn == pytest.approx(1e-3 * (180e5 - p) / 20e5, rel=1e-4)
    assert 160e5 < p < 180e5
    assert {event.zone_to for event in result.events} >= {"regulating"}


CYLINDER = """
    components:
      cylinder:
        {type: Cylinder, bore_diameter: 80 mm, rod_diameter: 45 mm, stroke: 0.6 m, pressure_a: 50 bar,
         pressure_b: 73 bar, port_diameter: 100 mm, effects: {seal_friction: off, leakage: off}}
      wall: {type: Ground}
      mass: {type: Mass, mass: 500 kg, position: 0.2 m}
      shut_a: {type: Volume, volume: 1e-9 m^3, pressure: 50 bar}
      shut_b: {type: Volume, volume: 1e-9 m^3, pressure: 73 bar}
    connections:
      - [wall.flange, cylinder.body]
      - [cylinder.rod, mass.flange]
      - [cylinder.a, shut_a.port]
      - [cylinder.b, shut_b.port]
    run: {stop: 0.2 s, accuracy: 1e-6}
"""


def test_a_closed_cylinder_swings_at_its_frequency(scene):
    """w^2 = beta (A_a^2/V_a + A_b^2/V_b)/m at the travel of 0.2 m."""
    model = scene(CYLINDER)
    cap, rod = math.pi / 4 * 0.08**2, math.pi / 4 * (0.08**2 - 0.045**2)
    stiffness = BETA * (cap**2 / (1e-4 + cap * 0.2) + rod**2 / (1e-4 + rod * 0.4))
    frequency, _ = oscillation(eigenvalues(model))
    assert frequency == pytest.approx(math.sqrt(stiffness / 500), rel=2e-4)


def test_the_energy_of_a_swinging_cylinder_is_accounted_for(simulate):
    result = simulate(CYLINDER, **{"mass.velocity": "0.3 m/s", "run.stop": "1 s"})
    assert result.run["energy"]["closure"] < 1e-6


VENTED = """
    components:
      tank: {type: Tank}
      hose_a: {type: Orifice, area: 20 mm^2}
      hose_b: {type: Orifice, area: 20 mm^2}
      cylinder: {type: Cylinder, bore_diameter: 40 mm, rod_diameter: 22 mm, stroke: 0.5 m}
      wall: {type: Ground}
      load: {type: Mass, mass: 10 kg, position: 0.1 m}
    connections:
      - [tank.port, hose_a.a, hose_b.a]
      - [hose_a.b, cylinder.a]
      - [hose_b.b, cylinder.b]
      - [wall.flange, cylinder.body]
      - [cylinder.rod, load.flange]
    run: {stop: 1 s}
"""


@pytest.mark.slow
def test_a_cylinder_open_on_both_sides_stays_where_it_is(simulate):
    """Pressures are absolute: oil at 1 bar pushes the rod out, area_rod 1 bar = 38 N, and the air pushes it in."""
    assert np.abs(simulate(VENTED)["load.x"] - 0.1).max() < 1e-9
    without = simulate(VENTED, **{"cylinder.air": "0 Pa"})
    assert without["load.x"][-1] > 0.11


SEALS = {
    "parameters": "seal_force: 600 N, seal_breakaway: 900 N, seal_speed: 10 mm/s",
    "a contact beside it": "effects: {seal_friction: off}",
}


@pytest.mark.parametrize("given", SEALS)
def test_seals_stick_as_a_contact_whose_curve_has_forces_does(simulate, given):
    """Pressed with 1 N, the coefficients of a contact are forces; 400 N do not move the rod, 1000 N do."""
    text = VENTED.replace("wall:", "pull: {type: ForceSource, force: 400 N}\n      wall:", 1)
    text = text.replace("area: 20 mm^2", "area: 2000 mm^2").replace("load.flange]", "load.flange, pull.flange]")
    text = text.replace("stroke: 0.5 m", f"stroke: 0.5 m, {SEALS[given]}")
    if given == "a contact beside it":
        curve = "{curve: stribeck, stiction: 900, coulomb: 600, velocity: 10 mm/s}"
        text = text.replace("wall:", f"seals: {{type: Contact, normal_force: 1 N, curve: {curve}}}\n      wall:", 1)
        text = text.replace("cylinder.body]", "cylinder.body, seals.a]")
        text = text.replace("pull.flange]", "pull.flange, seals.b]")
    friction = "cylinder.friction" if given == "parameters" else "seals.friction"
    at_rest = simulate(text)
    assert np.abs(at_rest["load.x"] - 0.1).max() < 1e-6
    moved = simulate(text, **{"pull.force": "1000 N", "run.stop": "50 ms"})
    assert moved["load.x"][-1] > 0.13
    assert moved[friction][-1] == pytest.approx(600, rel=1e-3)


FREE = """
    components:
      air: {type: PressureSource, pressure: 1 bar}
      wall: {type: Ground}
      pull: {type: ForceSource, force: 90 N}
      load: {type: Mass, mass: 10 kg, position: 0.1 m, velocity: 0}
      cylinder: {type: TYPE, bore_diameter: 40 mm, stroke: 0.5 m, port_diameter: 1 m, SEALS}
    connections: [[air.port, PORTS], [wall.flange, cylinder.body], [cylinder.rod, load.flange, pull.flange]]
    run: {stop: 0.5 s, accuracy: 1e-6}
    record: {every: 5 ms, signals: [load.x, load.v, cylinder.friction]}
"""
PORTS = {"Cylinder": "cylinder.a, cylinder.b", "SingleActingCylinder": "cylinder.a"}


def free_cylinder(kind, seals):
    return FREE.replace("TYPE", kind).replace("PORTS", PORTS[kind]).replace("SEALS", seals)


@pytest.mark.parametrize("engine", ["rodas", "ida", "stepping"])
@pytest.mark.parametrize("kind", PORTS)
def test_seals_break_away_and_then_rub_with_their_sliding_and_their_viscous_force(simulate, kind, engine):
    """10 dv/dt = 90 - 50 - 200 v from rest: v = 0.2 (1 - exp(-20 t)). With 70 N below the 80 N to begin it stays.

    Oil of 1 bar at the ports and the air are the same; bores as wide as these take 9 mN of 40 N at 0.2 m/s.
    """
    if engine == "ida":
        pytest.importorskip("sksundae")
    text = free_cylinder(kind, "seal_force: 50 N, seal_breakaway: 80 N, seal_viscous: 200 N*s/m")
    moved = simulate(text, **{"run.engine": engine})
    t = moved.t
    assert np.abs(moved["load.v"] - 0.2 * (1 - np.exp(-20 * t))).max() < 3e-4 * 0.2
    assert moved["cylinder.friction"][-1] == pytest.approx(50, rel=1e-4)
    held = simulate(text, **{"run.engine": engine, "pull.force": "70 N"})
    assert np.abs(held["load.x"] - 0.1).max() < 1e-9
    assert held["cylinder.friction"][-1] == pytest.approx(70, rel=1e-4)


def test_seals_that_only_drag_have_no_dry_friction(simulate):
    """10 dv/dt = 90 - 200 v, and nothing holds."""
    moved = simulate(free_cylinder("SingleActingCylinder", "seal_viscous: 200 N*s/m"))
    assert np.abs(moved["load.v"] - 0.45 * (1 - np.exp(-20 * moved.t))).max() < 3e-4 * 0.45


@pytest.mark.parametrize("kind", PORTS)
@pytest.mark.parametrize(
    ("seals", "says"),
    [
        ("seal_breakaway: 80 N", "cylinder.seal_breakaway: seal_breakaway is given without seal_force"),
        ("seal_force: 90 N, seal_breakaway: 80 N", "seal_breakaway 80 N is below seal_force = 90 N"),
        ("seal_force: 90 N, seal_speed: 1 mm/s", "cylinder.seal_speed: seal_speed is given without seal_breakaway"),
        ("seal_force: -1 N", "cylinder.seal_force = -1 N"),
    ],
)
def test_seals_that_contradict_themselves_are_refused(scene, kind, seals, says):
    with pytest.raises(ModelError, match=says):
        scene(free_cylinder(kind, seals)).check()


@pytest.mark.parametrize("oil", ["on", "off"])
@pytest.mark.parametrize("leakage", ["on", "off"])
def test_a_drive_whose_valve_vents_it_stays_too(simulate, oil, leakage):
    """The air is there whatever the oil is taken for: compressed, rigid with leakage, or in one law with the lands."""
    result = simulate(f"""
        components:
          supply: {{type: PressureSource, pressure: 1 bar}}
          tank: {{type: Tank}}
          half: {{type: SignalSource, value: 0.5}}
          drive: {{type: ServoCylinderDrive, valve: {{rated_flow: 20 L/min, leakage_conductance: 1e-12}},
                  cylinder: {{bore_diameter: 40 mm, rod_diameter: 22 mm, stroke: 0.5 m}},
                  effects: {{compressibility: {oil}, leakage: {leakage}}}}}
          wall: {{type: Ground}}
          load: {{type: Mass, mass: 10 kg, position: 0.1 m}}
        connections:
          - [supply.port, drive.supply]
          - [tank.port, drive.tank]
          - [half.signal, drive.command]
          - [wall.flange, drive.body]
          - [drive.rod, load.flange]
        run: {{stop: 1 s}}
    """)
    assert np.abs(result["load.x"] - 0.1).max() < 1e-6


def test_a_cylinder_hits_its_stops_and_stays_within_them(simulate):
    text = """
        components:
          supply: {type: PressureSource, pressure: 100 bar}
          low: {type: Tank}
          cylinder: {type: Cylinder, bore_diameter: 50 mm, stroke: 0.3 m, seal_force: 200 N}
          in: {type: Orifice, area: 10 mm^2}
          out: {type: Orifice, area: 10 mm^2}
          wall: {type: Ground}
          mass: {type: Mass, mass: 100 kg, position: 0.1 m}
        connections:
          - [supply.port, in.a]
          - [in.b, cylinder.a]
          - [cylinder.b, out.a]
          - [out.b, low.port]
          - [wall.flange, cylinder.body]
          - [cylinder.rod, mass.flange]
        friction: {method: hold}
        run: {stop: 3 s}
    """
    result = simulate(text)
    area = math.pi / 4 * 0.05**2
    assert result["cylinder.travel"].max() < 0.303
    assert result["cylinder.travel"][-1] == pytest.approx(0.3 + (100e5 - 1e5) * area / 1e8, abs=3e-6)  # seals stick
    moving = (result.t > 0.2) & (result["cylinder.travel"] < 0.29)
    speed = np.diff(result["cylinder.travel"][moving]) / np.diff(result.t[moving])
    conductance = 0.62 * 10e-6 * math.sqrt(2 / DENSITY)
    free = conductance * math.sqrt((99e5 - 200 / area) / 2) / area
    assert np.median(speed) == pytest.approx(free, rel=1e-2)
    assert result.run["energy"]["closure"] < 1e-4


def test_a_cylinder_pulled_out_faster_than_oil_follows_leaves_a_void(simulate):
    text = """
        components:
          tank_a: {type: Tank}
          tank_b: {type: Tank}
          cylinder: {type: Cylinder, bore_diameter: 50 mm, stroke: 0.3 m, port_diameter: 4 mm}
          wall: {type: Ground}
          pull:
            type: MotionSource
            velocity: {trapezoid: {to: 1 m/s, rise: 10 ms, stay: 100 ms, fall: 10 ms}}
            origin: 0.05 m
        connections:
          - [tank_a.port, cylinder.a]
          - [tank_b.port, cylinder.b]
          - [wall.flange, cylinder.body]
          - [cylinder.rod, pull.flange]
        friction: {method: binding}  # the seal lies between two given motions
        run: {stop: 4 s}
    """
    result = simulate(text)
    assert result["cylinder.pressure_a"].min() > -1.0
    zones = [event.zone_to for event in result.events if event.component == "cylinder.cap"]
    assert zones == ["cavitating", "full"]
    assert result["cylinder.pressure_a"][-1] == pytest.approx(1e5, rel=1e-3)
    assert result.run["energy"]["closure"] < 1e-4


def test_a_line_carries_pressure_waves_at_the_speed_of_sound_in_oil(scene):
    """Open at one end, closed at the other: the first mode is c/(4 L), c = sqrt(beta/rho)."""
    text = """
        components:
          open: {type: Tank}
          line:
            {type: HydraulicLine, length: 10 m, diameter: 20 mm, sections: 20, fluid: {viscosity: 1e-9 m^2/s},
             effects: {cavitation: off}}
        connections: [[open.port, line.a]]
        run: {stop: 1 s}
    """
    values = np.sort(np.abs(eigenvalues(scene(text)).imag))
    first = values[values > 1.0][0]
    assert first == pytest.approx(math.pi / 2 * math.sqrt(BETA / DENSITY) / 10, rel=3e-4)


def test_a_laminar_line_follows_hagen_and_poiseuille(simulate):
    text = """
        components:
          high: {type: PressureSource, pressure: 3 bar}
          line: {type: HydraulicLine, length: 4 m, diameter: 10 mm, sections: 3}
          low: {type: Tank}
        connections: [[high.port, line.a], [line.b, low.port]]
        run: {stop: 2 s}
        record: {signals: ["line.column[0].flow"]}
    """
    expected = 2e5 * math.pi * 0.01**4 / (128 * DENSITY * 40e-6 * 4)
    for effects in ({}, {"line.effects.fluid_inertia": "off"}, {"line.effects.compressibility": "off"}):
        result = simulate(text, **effects)
        assert result["line.column[0].flow"][-1] == pytest.approx(expected, rel=1e-4)


def test_oil_without_inertia_is_the_limit_of_light_oil(scene, simulate):
    text = """
        components:
          high: {type: PressureSource, pressure: 10 bar}
          line: {type: HydraulicLine, length: 4 m, diameter: 10 mm, sections: 2, fluid: {viscosity: 40e-6 m^2/s}}
          end: {type: Volume, volume: 1 l, pressure: 1 bar}
        connections: [[high.port, line.a], [line.b, end.port]]
        run: {stop: 0.2 s, accuracy: 1e-6}
        record: {signals: [end.pressure], every: 2 ms}
    """
    off = simulate(text, **{"effects.fluid_inertia": "off"})
    light = {"line.fluid.density": "1e-3 kg/m^3", "line.fluid.viscosity": f"{40e-6 * 870 / 1e-3} m^2/s"}
    np.testing.assert_allclose(simulate(text, **light)["end.pressure"], off["end.pressure"], rtol=1e-4)
    assert not [n for n in scene(text, **{"effects.fluid_inertia": "off"}).system.unknown_names if "column" in n]


@pytest.mark.parametrize(("setting", "above"), [(0.2, 0.05), (0.5, 0.1), (1.0, 0.2), (3.0, 0.5), (100.0, 5.0)])
def test_a_relief_valve_of_any_setting_holds_its_setting_and_flow_over_slope(simulate, setting, above):
    """Charge, cooler and bypass valves are set to parts of a bar: rounding at no drop follows the setting."""
    text = f"""
        components:
          pump: {{type: FixedPump, flow: {above * 1e5 * 1e-9} m^3/s}}
          oil: {{type: Volume, volume: 0.1 l}}
          relief: {{type: ReliefValve, setting: {setting} bar, slope: 1e-9 m^3/s/Pa}}
          tank: {{type: Tank, pressure: 0 bar}}
          return: {{type: Tank, pressure: 0 bar}}
        connections: [[tank.port, pump.inlet], [pump.outlet, oil.port, relief.a], [relief.b, return.port]]
        run: {{stop: 60 s, accuracy: 1e-6}}
        record: {{every: 1 s, signals: [oil.pressure, relief.flow]}}
    """
    result = simulate(text)
    assert result["oil.pressure"][-1] == pytest.approx((setting + above) * 1e5, rel=1e-3)
    assert result["relief.flow"][-1] == pytest.approx(above * 1e5 * 1e-9, rel=1e-6)
