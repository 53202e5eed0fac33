"""Effects of the drives: what is off has no unknown, zone or term, and equals the limit of what is on.

The columns of physics section 6: off = the limiting model, on with its parameter taken to the limit.
"""

import numpy as np
import pytest

MOTOR = """
    components:
      power: {type: PowerUnit, pressure: 180 bar, tank_pressure: 2 bar, pump: {most: 100 l/min}}
      command:
        type: SignalSource
        value: {table: {t: [0, 0.05, 0.6, 0.7, 0.9, 1.0], y: [0.001, 0.6, 0.6, 0.0, 0.0, -0.4]}}
      load: {type: TorqueSource, torque: {table: {t: [0 s, 0.3 s, 0.32 s], y: [-40 N*m, -40 N*m, -90 N*m]}}}
      drive:
        type: ServoMotorDrive
        valve: {rated_flow: 40 l/min, leakage_conductance: 1e-13 m^3/s/Pa}
        motor: {displacement: 125 cm^3/rev, inertia: 0.5 kg*m^2, internal_leakage: 4e-12 m^3/s/Pa,
                external_leakage: 4e-13 m^3/s/Pa, viscous: 0.05 N*m*s/rad, dry: 6 N*m}
        volume: 0.5 l
        pressure: 91 bar
    connections:
      - [power.supply, drive.supply]
      - [power.tank, drive.tank]
      - [command.signal, drive.command]
      - [drive.shaft, load.shaft]
    friction: {method: hold}
    run: {stop: 1.3 s, accuracy: 1e-6}
    record: {signals: [drive.speed, drive.opening], every: 10 ms}
"""
CYLINDER = """
    components:
      power: {type: PowerUnit, pressure: 180 bar, tank_pressure: 2 bar}
      command:
        type: SignalSource
        value: {table: {t: [0, 0.05, 0.5, 0.6, 0.8, 0.9], y: [0.001, 0.3, 0.3, 0.0, 0.0, -0.2]}}
      load: {type: ForceSource, force: {table: {t: [0 s, 0.2 s, 0.22 s], y: [-8 kN, -8 kN, -12 kN]}}}
      wall: {type: Ground}
      mass: {type: Mass, mass: 400 kg, position: 0.2 m}
      drive:
        type: ServoCylinderDrive
        valve: {rated_flow: 40 l/min, leakage_conductance: 1e-13 m^3/s/Pa}
        cylinder: {bore_diameter: 63 mm, rod_diameter: 36 mm, stroke: 0.8 m, internal_leakage: 1e-13 m^3/s/Pa,
                   seal_force: 500 N, port_diameter: 30 mm}
        pressure_a: 70 bar
        pressure_b: 70 bar
    connections:
      - [power.supply, drive.supply]
      - [power.tank, drive.tank]
      - [command.signal, drive.command]
      - [wall.flange, drive.body]
      - [mass.flange, drive.rod, load.flange]
    friction: {method: hold}
    run: {stop: 1.2 s, accuracy: 1e-6}
    record: {signals: [mass.v, drive.travel, drive.opening], every: 10 ms}
"""


def difference(one, other, name):
    """Largest difference of a signal between two runs on one grid, relative to its largest value."""
    times = np.arange(0.02, one.t[-1], 0.01)
    a, b = one.at(name, times), other.at(name, times)
    return np.abs(a - b).max() / np.abs(b).max()


LEAKS = ("motor.internal_leakage", "motor.external_leakage", "valve.leakage_conductance")
TIGHT = {"drive.effects.compressibility": "off", "drive.effects.leakage": "off"}
# effect -> (what is set besides on both sides, the limit of on, tolerance)
MOTOR_LIMITS = {
    "valve_dynamics": ({}, {"drive.valve.natural_frequency": "20 kHz"}, 1e-3),
    "leakage": ({}, {f"drive.{name}": 1e-18 for name in LEAKS}, 1e-5),
    "compressibility": ({}, {"drive.fluid.bulk_modulus": "1e14 Pa"}, 1e-4),
    # tight: below an opening of 1e-4 the closed form holds the shaft, and rounds the opening just above that
    "compressibility, tight": ({"drive.effects.leakage": "off"}, {"drive.fluid.bulk_modulus": "1e14 Pa"}, 5e-4),
    "cavitation": ({}, {}, 1e-9),
    "motor_friction": ({}, {"drive.motor.dry": 1e-9, "drive.motor.viscous": 1e-9}, 1e-6),
    "supply_dynamics": ({}, {"power.line_volume": "1e5 m^3"}, 1e-5),
}  # fmt: skip
CYLINDER_LIMITS = {
    "valve_dynamics": ({}, {"drive.valve.natural_frequency": "20 kHz"}, 2e-3),
    "leakage": ({}, {"drive.cylinder.internal_leakage": 1e-18, "drive.valve.leakage_conductance": 1e-18}, 1e-5),
    "compressibility": ({}, {"drive.fluid.bulk_modulus": "1e14 Pa", "drive.cylinder.port_diameter": "0.3 m"}, 1e-3),
    "compressibility, tight": ({"drive.effects.leakage": "off"}, {"drive.fluid.bulk_modulus": "1e14 Pa"}, 1e-3),
    "cavitation": ({}, {}, 1e-9),
    "seal_friction": ({}, {"drive.cylinder.seal_force": 1e-9}, 1e-6),
}  # fmt: skip


def owner(effect):
    return "power" if effect == "supply_dynamics" else "drive"


@pytest.mark.parametrize("effect", MOTOR_LIMITS)
def test_a_motor_drive_with_an_effect_off_is_the_limit_of_on(simulate, effect):
    besides, limit, tolerance = MOTOR_LIMITS[effect]
    name = f"{owner(effect)}.effects.{effect.split(',')[0]}"
    on = simulate(MOTOR, **besides, **limit, **{name: "on"})
    off = simulate(MOTOR, **besides, **{name: "off"})
    assert difference(off, on, "drive.speed") < tolerance
    usual = simulate(MOTOR, **besides, **{name: "on"})
    if effect != "cavitation":
        assert difference(off, usual, "drive.speed") > 10 * tolerance  # the effect matters where it is not in the limit


@pytest.mark.parametrize("effect", CYLINDER_LIMITS)
def test_a_cylinder_drive_with_an_effect_off_is_the_limit_of_on(simulate, effect):
    besides, limit, tolerance = CYLINDER_LIMITS[effect]
    name = f"drive.effects.{effect.split(',')[0]}"
    on = simulate(CYLINDER, **besides, **limit, **{name: "on"})
    off = simulate(CYLINDER, **besides, **{name: "off"})
    assert difference(off, on, "mass.v") < tolerance


STICKY = {"seal_breakaway": "800 N", "seal_speed": "20 mm/s", "seal_viscous": "30 kN*s/m"}


def test_sticking_seals_beside_oil_that_is_not_compressed_are_those_of_the_limit(simulate):
    """As in CYLINDER_LIMITS, "compressibility, tight"; and the seals matter: at 0.1 m/s they take 3 kN beside 8."""
    besides, limit, tolerance = CYLINDER_LIMITS["compressibility, tight"]
    sticky = {f"drive.cylinder.{name}": value for name, value in STICKY.items()}
    on = simulate(CYLINDER, **besides, **sticky, **limit)
    off = simulate(CYLINDER, **besides, **sticky, **{"drive.effects.compressibility": "off"})
    assert difference(off, on, "mass.v") < tolerance
    usual = simulate(CYLINDER, **besides, **{"drive.effects.compressibility": "off"})
    assert difference(off, usual, "mass.v") > 10 * tolerance


UNKNOWNS = {
    "valve_dynamics": {"drive.spool.position", "drive.spool.speed"},
    "compressibility": {f"drive.volume_{side}.{name}" for side in "ab" for name in ("pressure", "empty")},
    "cavitation": {"drive.volume_a.empty", "drive.volume_b.empty"},
    "motor_friction": {"drive.rubbing.contact.force"},
    "leakage": set(),
}
KERNELS = {
    "valve_dynamics": {"Spool"},
    "compressibility": {"CavitatingVolume"},
    "cavitation": {"CavitatingVolume"},
    "motor_friction": {
        "Hold", "Ground", "Housing", "LeverArm", "MotorFriction", "Pressing", "Rack", "RotationalDamper",
    },
    "leakage": set(),
}


def looked_at(system):
    """Names of unknowns, of machines with zones, and kernels by the name of their class."""
    unknowns = set(system.unknown_names)
    machines = set(system.machine_names)
    return unknowns, machines, {block.kernel.variant.type.__name__: block.kernel.structure for block in system.blocks}


@pytest.mark.parametrize("effect", UNKNOWNS)
def test_what_is_off_in_a_motor_drive_is_absent_from_the_compiled_system(scene, effect):
    unknowns, _, kernels = looked_at(scene(MOTOR).system)
    left, machines, compiled = looked_at(scene(MOTOR, **{f"drive.effects.{effect}": "off"}).system)
    assert unknowns - left == UNKNOWNS[effect]
    assert kernels.keys() - compiled.keys() == KERNELS[effect]
    assert not any(name.startswith(tuple(UNKNOWNS[effect])) for name in machines)


def test_leakage_that_is_off_leaves_no_term(scene):
    _, _, compiled = looked_at(scene(MOTOR, **{"drive.effects.leakage": "off"}).system)
    assert not [p for s in compiled.values() for p in s.parameters if "leakage" in p]


def test_without_compressibility_and_leakage_no_pressure_is_an_unknown(scene):
    off = TIGHT
    assert not [name for name in scene(MOTOR, **off).system.unknown_names if "pressure" in name]
    unknowns = [name for name in scene(CYLINDER, **off).system.unknown_names if name.startswith("drive.")]
    assert unknowns == ["drive.spool.position", "drive.spool.speed", "drive.oil.holding", "drive.seal.force"]


def test_with_everything_off_a_motor_drive_has_one_degree_of_freedom_and_one_torque(scene):
    effects = ("valve_dynamics", "compressibility", "leakage", "cavitation", "motor_friction")
    system = scene(MOTOR, **{f"effects.{effect}": "off" for effect in (*effects, "energy")}).system
    assert system.unknown_names == ["drive.rotor.angle", "drive.rotor.speed", "drive.oil.holding"]


def test_the_pressures_without_compression_are_those_of_the_formula(simulate):
    """p_a - p_b = (p_s - p_t) - rho (D w)^2/(C_d A x)^2 while oil flows the way the valve is open, plus otherwise."""
    off = {**TIGHT, "drive.effects.motor_friction": "off"}
    text = MOTOR.replace("drive.opening]", "drive.opening, drive.load_pressure]")
    result = simulate(text, **off)
    at = (result.t > 0.1) & (result.t < 0.6)
    conductance, displaced = 40e-3 / 60 / np.sqrt(35e5), 125e-6 / (2 * np.pi) * result["drive.speed"][at]
    formula = 178e5 - 2 * (displaced / (conductance * result["drive.opening"][at])) ** 2
    np.testing.assert_allclose(result["drive.load_pressure"][at], formula, atol=2e3)  # the laminar part, below 1 bar


def test_a_closed_valve_without_compression_locks_the_shaft(simulate):
    off = {**TIGHT, "drive.effects.valve_dynamics": "off"}
    result = simulate(MOTOR, **off)
    locked = (result.t > 0.71) & (result.t < 0.9)
    assert np.abs(result["drive.speed"][locked]).max() < 1e-9
    assert {"closed", "backward"} == {e.zone_to for e in result.events if e.component == "drive.oil"}


def test_algebraic_pressures_that_nothing_determines_are_refused(scene):
    from fairlead.errors import ModelError

    off = {"drive.effects.compressibility": "off", **{f"drive.{name}": "0" for name in LEAKS[1:]}}
    with pytest.raises(ModelError, match=r"(?s)drive: without compressibility .* Switch leakage off too"):
        scene(MOTOR, **off).check()


def test_energy_closes_with_every_effect_on_and_off(simulate):
    for settings in (
        {}, {"effects.supply_dynamics": "on"}, {"drive.effects.compressibility": "off"},
        {"drive.effects.compressibility": "off", "drive.effects.leakage": "off"}, {"drive.motor.efficiency": "0.9"},
    ):  # fmt: skip
        result = simulate(MOTOR, **settings)
        assert result.run["energy"]["closure"] < 1e-5, settings
    for settings in ({}, {"drive.effects.compressibility": "off"}):
        assert simulate(CYLINDER, **settings).run["energy"]["closure"] < 1e-5, settings
