"""Where a void opens, and who tells its size."""

import math

import pytest
from scipy.integrate import quad

BESIDE = """
    components:
      wall: {{type: Ground}}
      cylinder:
        {{type: Cylinder, bore_diameter: 50 mm, stroke: 0.5 m, cap_dead_volume: 0.1 L, pressure_a: 5 bar,
         pressure_b: 5 bar, effects: {{seal_friction: off{off}}}}}
      oil: {{type: Volume, volume: 0.2 L, pressure: 5 bar}}
      shut: {{type: Leak, conductance: 1e-13 m^3/s/Pa}}
      wide: {{type: Leak, conductance: 1e-8 m^3/s/Pa}}
      low: {{type: Tank}}
      pull: {{type: MotionSource, position: {{table: [[0 s, 0.1], [1 s, 0.2], [2 s, 0.2]]}}}}
    connections:
      - [wall.flange, cylinder.body]
      - [cylinder.rod, pull.flange]
      - [cylinder.a, oil.port, shut.a]
      - [cylinder.b, wide.a]
      - [shut.b, wide.b, low.port]
    run: {{stop: 2 s}}
    record: {{every: 10 ms}}
"""
AREA, BULK = math.pi / 4 * 0.05**2, 1e9


def test_a_cylinder_tells_the_void_that_opens_in_its_chamber_while_a_volume_at_its_port_stays_full(simulate):
    """Drawn out with the port shut: what the piston sweeps beyond the expansion of the oil is the void."""
    result = simulate(BESIDE.format(off=""))
    expands = 5e5 / BULK * (0.2e-3 + 0.1e-3 + AREA * 0.1)
    assert result["cylinder.void_a"][-1] == pytest.approx(AREA * 0.1 - expands, rel=1e-3)
    assert result["cylinder.pressure_a"][-1] == 0.0
    assert result["cylinder.void_b"].max() == 0.0
    assert result["oil.void"].max() == 0.0
    assert result["oil.pressure"][-1] > 0.0  # full of oil, with what the leak brings flowing on into the chamber


def test_a_plunger_tells_its_void(simulate):
    text = """
        components:
          wall: {type: Ground}
          lift: {type: SingleActingCylinder, bore_diameter: 50 mm, stroke: 0.5 m, pressure: 5 bar}
          shut: {type: Leak, conductance: 0}
          low: {type: Tank}
          pull: {type: MotionSource, position: {table: [[0 s, 0.1], [1 s, 0.2], [2 s, 0.2]]}}
        connections: [[wall.flange, lift.body], [lift.rod, pull.flange], [lift.a, shut.a], [shut.b, low.port]]
        run: {stop: 2 s}
    """
    result = simulate(text.replace("stroke: 0.5 m,", "stroke: 0.5 m, effects: {seal_friction: off},"))
    expands = 5e5 / BULK * (0.1e-3 + AREA * 0.1)
    assert result["lift.void"][-1] == pytest.approx(AREA * 0.1 - expands, rel=1e-3)


def test_a_servo_motor_tells_the_void_of_the_side_that_an_overrunning_load_empties(simulate):
    """Valve shut, the shaft turned on: the void of a is what the motor draws less what the oil there expands."""
    text = """
        components:
          low: {type: Tank}
          high: {type: PressureSource, pressure: 20 bar}
          drive:
            {type: ServoMotorDrive, valve: {rated_flow: 10 L/min}, volume: 1 L, pressure: 10 bar,
             motor: {displacement: 20 cm^3/rev, inertia: 0.1 kg*m^2},
             effects: {leakage: off, valve_dynamics: off, motor_friction: off}}
          shut: {type: SignalSource, value: 0}
          turn: {type: SpeedSource, speed: 10 rad/s}
        connections:
          - [high.port, drive.supply]
          - [low.port, drive.tank]
          - [shut.signal, drive.command]
          - [turn.shaft, drive.shaft]
        run: {stop: 2 s}
    """
    result = simulate(text)
    turned = 20e-6 / (2 * math.pi) * 10 * 2
    assert result["drive.void_a"][-1] == pytest.approx(turned - 10e5 / BULK * 1e-3, rel=5e-3)
    assert result["drive.void_b"].max() == 0.0


def test_entrained_air_is_told_as_the_volume_without_oil(simulate):
    """Oil drawn from 1 bar: its volume is that of the oil drawn, by the integral of the compliance on its page."""
    text = """
        components:
          oil: {type: Volume, volume: 1 L, pressure: 1 bar, effects: {air: on}}
          draw: {type: FlowSource, flow: 2 cm^3/s}
          low: {type: Tank}
        connections: [[oil.port, draw.inlet], [draw.outlet, low.port]]
        run: {stop: 5 s, accuracy: 1e-6}
    """
    result = simulate(text)
    share, n, last = 0.005, 1.2, result["oil.pressure"][-1]
    assert last < 0.5e5
    drawn = quad(lambda p: 1e-3 * (1 / BULK + share / (n * p) * (1e5 / p) ** (1 / n)), last, 1e5)[0]
    assert drawn == pytest.approx(10e-6, rel=1e-3)
    squeezed = 1e-3 * (1e5 - last) / BULK
    assert result["oil.void"][0] == pytest.approx(share * 1e-3, rel=1e-9)
    assert result["oil.void"][-1] == pytest.approx(share * 1e-3 + 10e-6 - squeezed, rel=1e-5)


def test_two_volumes_on_one_node_share_their_void_in_proportion(simulate):
    text = """
        components:
          one: {type: Volume, volume: 1 L, pressure: 2 bar}
          two: {type: Volume, volume: 3 L, pressure: 2 bar}
          draw: {type: FlowSource, flow: 2 cm^3/s}
          low: {type: Tank}
        connections: [[one.port, two.port, draw.inlet], [draw.outlet, low.port]]
        run: {stop: 5 s}
    """
    result = simulate(text)
    whole = 10e-6 - 2e5 / BULK * 4e-3
    assert result["one.void"][-1] == pytest.approx(whole / 4, rel=1e-3)
    assert result["two.void"][-1] == pytest.approx(whole * 3 / 4, rel=1e-3)
