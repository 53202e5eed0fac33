"""The thermal parts of models/single_parts against closed forms, on every engine."""

import pathlib

import numpy as np
import pytest

import fairlead

SCENE = pathlib.Path(__file__).parents[2] / "models" / "single_parts" / "warming.yaml"
ROOM = 293.15


@pytest.mark.parametrize("engine", ["rodas", *(pytest.param(e, marks=pytest.mark.slow) for e in ("stepping", "ida"))])
def test_losses_warm_bodies_as_their_balance_says(engine):
    """What a flywheel had is in disc and pad; plate and valve go to where as much is lost as comes in."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = fairlead.load(SCENE, set={"run.accuracy": "1e-6", "run.engine": engine}).run(out=None)
    assert result.ok
    kinetic = 2 * 50**2 / 2
    assert result["disc.temperature"][-1] == pytest.approx(ROOM + 0.7 * kinetic / 400, rel=1e-6)
    assert result["pad.temperature"][-1] == pytest.approx(ROOM + 0.3 * kinetic / 100, rel=1e-6)
    loses = (8 + 6 * 2) * 0.2  # W/K, at the root of 4 m/s
    warmer = 100 / loses * (1 - np.exp(-result.t * loses / 20))
    assert np.allclose(result["reads.temperature"], ROOM + warmer, atol=0.2)  # the root is rounded by 1 % of 1 m/s
    warmer = result["throttle.flow"][-1] * 9.9e6 / 2 * (1 - np.exp(-result.t * 2 / 500))
    assert np.allclose(result["valve.temperature"], ROOM + warmer, atol=1e-2)
    assert result.run["energy"]["closure"] < 1e-5  # heat is told once, where it is made


def test_a_motor_and_a_clutch_warm_bodies_by_all_that_they_lose():
    """A motor without load loses what its rotor gains, J (U/K)^2/2; a clutch J1 J2/(J1 + J2) dw^2/2."""
    result = fairlead.load(SCENE.with_name("warm_drive.yaml"), set={"run.accuracy": "1e-6"}).run(out=None)
    assert result.ok
    gained = 2e-3 * (48 / 0.12) ** 2 / 2
    assert result["winding.temperature"][-1] == pytest.approx(ROOM + gained / 60, abs=1e-4)
    rubbed = 2 * 1 / 3 * 60**2 / 2
    assert result["disc.temperature"][-1] == pytest.approx(ROOM + 0.4 * rubbed / 500, abs=1e-6)
    assert result["cover.temperature"][-1] == pytest.approx(ROOM + 0.6 * rubbed / 1500, abs=1e-6)
    assert result["wheel.speed"][-1] == pytest.approx(40, rel=1e-9)


LOSSES = """
    components:
      coil: {{type: {motor}}}
      asked: {{type: SignalSource, value: 5}}
      jammed: {{type: Housing}}
      fed: {{type: HeatActuator}}
      winding: {{type: HeatCapacity, capacity: 60 J/K}}
    connections:
      - [asked.signal, coil.{asked}]
      - [coil.shaft, jammed.shaft]
      - [coil.loss, fed.heat]
      - [fed.port, winding.port]
    run: {{stop: 1 s, accuracy: 1e-6}}
    record: {{signals: [winding.temperature, coil.current]}}
"""


@pytest.mark.parametrize(
    ("motor", "asked", "current"),
    [
        ("DcDrive, resistance: 2 ohm, constant: 0.1, inductance: 1e-6, most_voltage: 48, most_current: 9", "command",
         2.5),
        ("PmMotor, constant: 0.1, resistance: 2 ohm, lag: 1e-6", "wanted", 5),
        ("PmMotor, constant: 0.1, resistance: 2 ohm, lag: 1e-6, effects: {winding: on}", "wanted", 5),
        ("PmMotor, constant: 0.1, resistance: 2 ohm, effects: {current_loop: off}", "wanted", 5),
    ],
)  # fmt: skip
def test_a_stalled_motor_warms_its_winding_by_r_i_squared(simulate, motor, asked, current):
    result = simulate(LOSSES.format(motor=motor, asked=asked))
    assert result["winding.temperature"][-1] - ROOM == pytest.approx(2 * current**2 / 60, rel=1e-4)


def test_a_body_that_friction_warms_slips_more_easily(simulate):
    """Thermal port and FrictionHeat are two formulations of one body: capacity dT/dt = share T v - loss (T - T0)."""
    scene = """
        components:
          hand: {{type: MotionSource, velocity: 0.5 m/s, origin: 0}}
          spring: {{type: SpringDamper, stiffness: 5 kN/m, damping: 200 N*s/m}}
          block: {{type: Mass, mass: 10 kg, position: 0, velocity: 0}}
          floor: {{type: Ground}}
          rubs: {{type: Contact, curve: {{curve: coulomb, coulomb: 0.3, softening: 2e-3 1/K}}, normal_force: 200 N}}
          {body}
        connections:
          - [hand.flange, spring.b]
          - [spring.a, block.flange, rubs.b]
          - [floor.flange, rubs.a]
          {joins}
        run: {{stop: 4 s, accuracy: 1e-6}}
    """
    one = simulate(scene.format(
        body="warm: {type: FrictionHeat, capacity: 2 J/K, loss: 0.5 W/K, share: 0.8}",
        joins="- [rubs.friction, warm.friction]\n          - [rubs.slip, warm.slip]\n"
              "          - [warm.temperature, rubs.temperature]"))  # fmt: skip
    other = simulate(scene.format(
        body="leads: {type: FrictionLoss, share: 0.8}\n          warm: {type: HeatCapacity, capacity: 2 J/K}\n"
             "          reads: {type: TemperatureSensor}\n          air: {type: FixedTemperature}\n"
             "          away: {type: HeatConductor, conductance: 0.5 W/K}",
        joins="- [rubs.friction, leads.friction]\n          - [rubs.slip, leads.slip]\n"
              "          - [leads.b, warm.port, away.a, reads.port]\n          - [away.b, leads.a, air.port]\n"
              "          - [reads.temperature, rubs.temperature]"))  # fmt: skip
    times = np.linspace(0.5, 4, 36)
    assert one.at("warm.temperature", 4.0) > ROOM + 20
    assert np.allclose(one.at("warm.temperature", times), other.at("warm.temperature", times), atol=1e-3)
    assert np.allclose(one.at("block.x", times), other.at("block.x", times), atol=1e-6)


@pytest.mark.parametrize(("speed", "within"), [(0.0, 0.0), (2e-3, 1.5e-2), (-0.01, 1.1e-6), (1.0, 1e-9), (100.0, 1e-9)])
def test_convection_grows_with_the_root_of_the_speed(simulate, speed, within):
    """heat = (still + moved sqrt|v|) area difference: `moved` is what 1 m/s adds."""
    result = simulate("""
        parameters: {speed: 1}
        components:
          plate: {type: HeatCapacity, capacity: 1000 J/K, start_temperature: 400 K}
          air: {type: FixedTemperature, temperature: 300 K}
          draught: {type: SignalSource, value: "{speed}"}
          cooled: {type: HeatConvection, area: 1 m^2, still: 5 W/K/m^2, moved: 20 W/K/m^2}
        connections: [[plate.port, cooled.a], [cooled.b, air.port], [draught.signal, cooled.speed]]
        run: {stop: 1 s}
    """, speed=speed)  # fmt: skip
    added = result["cooled.heat"][0] / 100 - 5
    assert added == pytest.approx(20 * abs(speed) ** 0.5, rel=within, abs=1e-9)
