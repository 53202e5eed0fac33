"""Where nothing determines a pressure, a voltage or a temperature, the message says which part belongs there."""

import numpy as np
import pytest

from fairlead.errors import ModelError

LOWERED = """
    components:
      diesel: {type: SpeedSource, speed: 150 rad/s}
      pump: {type: VariablePump, displacement: 28 cm^3/rev, leakage: 1e-13 m^3/s/Pa}
      swash: {type: SignalSource, value: {ramp: {to: 0.5, over: 0.5 s, start: 0.2 s}}}
      charge: {type: PressureSource, pressure: 20 bar}
      feed_a: {type: CheckValve, area: 50 mm^2}
      feed_b: {type: CheckValve, area: 50 mm^2}
      counter: {type: CounterbalanceValve, area: 20 mm^2, setting: 90 bar, ratio: 3}
      motor: {type: HydraulicMotor, displacement: 100 cm^3/rev, internal_leakage: 1e-13 m^3/s/Pa}
      rotor: {type: Inertia, moment: 0.2 kg*m^2}
      weight: {type: TorqueSource, torque: -98 N*m}
    connections:
      - [diesel.shaft, pump.shaft]
      - [swash.signal, pump.setting]
      - [charge.port, feed_a.a, feed_b.a]
      - [pump.inlet, feed_a.b, counter.valve]
      - [pump.outlet, feed_b.b, counter.pilot, motor.b]
      - [counter.load, motor.a]
      - [motor.shaft, rotor.shaft, weight.shaft]
    run: {stop: 0.1 s}
"""
OPEN = {
    "hydraulic, joined by closed valves": ("""
        components:
          tank: {type: Tank}
          one: {type: CheckValve, area: 50 mm^2}
          two: {type: CheckValve, area: 50 mm^2}
        connections: [[tank.port, one.a, two.a], [one.b, two.b]]
        run: {stop: 1 s}
    """, "node {one.b, two.b} has nothing that gives way, and no law determines its pressure", "Add a Volume there"),
    "electrical": ("""
        components:
          source: {type: VoltageSource, voltage: 10 V}
          load: {type: Resistor, resistance: 5 ohm}
        connections: [[source.plus, load.plus], [source.minus, load.minus]]
        run: {stop: 1 s}
    """, "are joined without a Capacitor, and to no place whose voltage is known", "Join one of them to an Earth."),
    "thermal": ("""
        components:
          one: {type: HeatConductor, conductance: 3 W/K}
          two: {type: HeatConductor, conductance: 3 W/K}
        connections: [[one.a, two.a], [one.b, two.b]]
        run: {stop: 1 s}
    """, "are joined without a HeatCapacity, and to no place", "Join one of them to a FixedTemperature"),
}  # fmt: skip


@pytest.mark.parametrize("domain", OPEN)
def test_check_says_what_belongs_at_a_node_that_is_left_open(scene, domain):
    text, what, way_out = OPEN[domain]
    with pytest.raises(ModelError) as told:
        scene(text).check()
    assert what in str(told.value)
    assert way_out in str(told.value)
    assert "mass" not in str(told.value).lower()


@pytest.mark.slow
def test_a_run_says_which_pressure_is_open_by_the_names_of_the_netlist_and_asks_for_a_volume(scene):
    """While the counterbalance valve is shut, oil between it and a motor without leakage has nowhere to go."""
    result = scene(LOWERED.replace("internal_leakage: 1e-13", "internal_leakage: 0")).run(out=None, check=False)
    said = result.run["sentence"]
    assert "the equations do not determine the pressure at counter.load, motor.a." in said
    assert "Add a Volume there" in said
    assert "mass" not in said


@pytest.mark.parametrize("leakage", [1e-13, 1e-16, 1e-20])
def test_the_least_leakage_determines_it(scene, leakage):
    """The weight turns the motor as the oil leaks through it:  D w = leakage M/D."""
    result = scene(LOWERED.replace("internal_leakage: 1e-13", f"internal_leakage: {leakage}")).run(out=None)
    displacement = 100e-6 / (2 * np.pi)
    assert result.at("rotor.speed", 0.1) == pytest.approx(-leakage * 98.0 / displacement**2, rel=1e-6)


def test_with_volumes_it_runs(scene):
    text = LOWERED
    for name, port in {"load": "counter.load", "inlet": "pump.inlet", "outlet": "pump.outlet"}.items():
        text = text.replace("rotor: {", f"{name}: {{type: Volume, volume: 0.1 L}}\n      rotor: {{")
        text = text.replace(f"[{port}, ", f"[{port}, {name}.port, ")
    assert scene(text).run(out=None).ok


SERIES = {
    "coils": ("""
        components:
          earth: {type: Earth}
          source: {type: VoltageSource, voltage: 10 V}
          one: {type: Inductor, inductance: 1 V*s/A}
          two: {type: Inductor, inductance: 3 V*s/A, resistance: 1 ohm}
        connections: [[earth.terminal, two.minus, source.minus], [source.plus, one.plus], [one.minus, two.plus]]
        run: {stop: 1 s}
    """, "{one.minus, two.plus} joins one and two in series"),
    "a choke before a motor": ("""
        components:
          earth: {type: Earth}
          source: {type: VoltageSource, voltage: 24 V}
          choke: {type: Inductor, inductance: 5e-3 V*s/A}
          motor: {type: DcMotor, resistance: 1 ohm, constant: 0.1 N*m/A}
          rotor: {type: Inertia, moment: 1e-3 kg*m^2}
        connections:
          - [earth.terminal, source.minus, motor.minus]
          - [source.plus, choke.plus]
          - [choke.minus, motor.plus]
          - [motor.shaft, rotor.shaft]
        run: {stop: 1 s}
    """, "{choke.minus, motor.plus} joins choke and motor in series"),
}  # fmt: skip


@pytest.mark.parametrize("name", SERIES)
def test_inductances_in_series_are_to_be_added(scene, name):
    """Their node is joined to an Earth through the circuit, so nobody is to be asked for one."""
    text, what = SERIES[name]
    with pytest.raises(ModelError) as told:
        scene(text).check()
    assert what in str(told.value)
    assert "give one of them the sum" in str(told.value)
    assert "Join the circuit to an Earth" not in str(told.value)


def bridge(star="", rails="", coil=True):
    """Six diodes between three sources in a star, each with a coil in front, and a resistor."""
    phases = zip("uvw", (0, -120, 120), (1, 3, 5), strict=True)
    parts, joins = "", ""
    for x, phase, k in phases:
        parts += f"""
          {x}: {{type: VoltageSource, voltage: {{sine: {{amplitude: 325 V, frequency: 50 Hz, phase: {phase} deg}}}}}}
          l{x}: {{type: {"Inductor, inductance: 1e-3 V*s/A" if coil else "Resistor"}, resistance: 0.1 ohm}}
          d{k}: {{type: Diode}}
          d{k + 1}: {{type: Diode}}"""
        joins += f"""
          - [{x}.plus, l{x}.plus]
          - [l{x}.minus, d{k}.plus, d{k + 1}.minus]"""
    return f"""
        components:{parts}
          earth: {{type: Earth}}
          load: {{type: Resistor, resistance: 50 ohm}}
          lead: {{type: Resistor, resistance: 10 kohm}}
        connections:{joins}
          - [u.minus, v.minus, w.minus{star}]
          - [d1.minus, d3.minus, d5.minus, load.plus]
          - [d2.plus, d4.plus, d6.plus, load.minus{rails}]
        run: {{stop: 40 ms}}
        record: {{every: 20 us}}
    """


EARTHED, LED = ", earth.terminal, lead.minus", ", lead.plus"
LEVELS = {
    "rails behind coils": (bridge(star=EARTHED + LED), r"lu, lv, lw alone.*level of their voltage"),
    "a star behind coils": (bridge(rails=EARTHED + LED), r"lu, lv, lw alone.*level of their voltage"),
    "a circuit with a capacitor": ("""
        components:
          store: {type: Capacitor, capacity: 1e-3 A*s/V, initial: 10 V}
          load: {type: Resistor, resistance: 100 ohm}
        connections: [[store.plus, load.plus], [store.minus, load.minus]]
        run: {stop: 1 s}
    """, r"to no place whose voltage is known"),
    "oil between two lines": ("""
        components:
          low: {type: Tank}
          high: {type: PressureSource, pressure: 2 bar}
          one: {type: HydraulicLine, length: 1 m, diameter: 10 mm}
          two: {type: HydraulicLine, length: 1 m, diameter: 10 mm}
          bend: {type: Orifice, area: 10 mm^2}
        connections: [[low.port, one.a], [one.b, bend.a], [bend.b, two.a], [two.b, high.port]]
        effects: {compressibility: off}
        run: {stop: 1 s}
    """, r"one\.column\[0\], two\.column\[0\] alone.*level of their pressure"),
}  # fmt: skip


@pytest.mark.parametrize("name", LEVELS)
def test_check_names_a_part_whose_common_level_nothing_determines(scene, name):
    """Its laws ask for differences alone, and their sum over the part is an equation without any of its unknowns."""
    text, what = LEVELS[name]
    with pytest.raises(ModelError, match=what) as told:
        scene(text).check()
    (fault,) = told.value.faults
    assert fault.way_out.startswith(("Join one of them to an Earth", "Add a Volume there"))


@pytest.mark.parametrize("text", [
    bridge(star=EARTHED, rails=LED), bridge(star=LED, rails=EARTHED), bridge(star=EARTHED + LED, coil=False),
], ids=["rails led to the Earth", "star led to the Earth", "resistors for coils"])  # fmt: skip
def test_with_a_way_to_the_earth_it_runs(scene, text):
    """The mean voltage of a six-pulse bridge: 3 sqrt(3)/pi of the amplitude, less thresholds and commutation."""
    model = scene(text)
    model.check()
    result = model.run(out=None)
    late = result.t >= 20e-3 - 1e-9
    mean = np.trapezoid(result["load.current"][late], result.t[late]) / 20e-3
    ideal = 3 * 3**0.5 / np.pi * 325 - 2 * 0.7
    coils = 3 * 2 * np.pi * 50 * 1e-3 / np.pi * ("Inductor" in text)  # ohm
    assert mean == pytest.approx(ideal / (50 + 0.2 + coils), rel=3e-3)
