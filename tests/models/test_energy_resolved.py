"""A closure is judged by what the error weights resolve: a scene that moves by less than them is no bad run."""

import numpy as np
import pytest

from fairlead.analysis.record.energy import explained, open_by
from fairlead.analysis.record.reported import told

PULSE = """
    components:
      rotor: {type: Inertia, moment: 0.1 kg*m^2}
      push: {type: TorqueSource, torque: {pulses: {to: 1 N*m, wide: 1e-7 s, every: 10 s, count: 1, start: 1 s}}}
      brake: {type: Brake, radius: 0.1 m, curve: 0.4, normal_force: 10 N}
    connections: [[rotor.shaft, push.shaft, brake.shaft]]
    run: {stop: 2 s, accuracy: 1e-5, engine: ida}
"""
BAD = "do not trust"


def _bad(energy: dict[str, float]) -> bool:
    return any(BAD in one.text for one in told({"status": "finished", "energy": energy}))


def test_a_pulse_of_a_ten_millionth_of_a_second_is_no_bad_run(simulate) -> None:
    """It gives 0.1 kg m^2 a speed of 0.6 urad/s, a sixteenth of the weight of its speed, and 30 fJ go to the brake."""
    run = simulate(PULSE).run
    assert run["energy"]["resolved"] == pytest.approx(0.5 * 0.1 * (1e-5 * 1.0) ** 2)
    assert run["energy"]["closure"] > 0.1  # else this tests nothing
    assert not any(BAD in one.text for one in told(run))


DRAGGED = """
    components:
      floor: {{type: Ground}}
      grain: {{type: Mass, mass: 1e-6 kg}}
      spring: {{type: Spring, stiffness: 1 N/m}}
      drive: {{type: MotionSource, velocity: 1e-6 m/s}}
      pad: {{type: Contact, normal_force: 1e-5 N, curve: {{curve: coulomb, stiction: 0.5, coulomb: 0.3}}}}
    connections: [[floor.flange, pad.a], [pad.b, grain.flange, spring.a], [spring.b, drive.flange]]
    nominal: {{"*.x": 1 um, "*.v": 1 um/s}}
    run: {{stop: 30 s, engine: {engine}}}
"""
SHUT_IN = """
    components:
      left: {{type: FixedPoint, position: -0.1 m}}
      right: {{type: FixedPoint, position: 0.1 m}}
      block: {{type: Mass, mass: 1 kg, position: 0 m}}
      one: {{type: RigidStop, length: 0.1 m}}
      other: {{type: RigidStop, length: 0.1 m}}
      pad: {{type: Contact, method: binding, normal_force: 10 N, curve: 0.3}}
      push: {{type: ForceSource, force: {{sine: {{amplitude: 20 N, frequency: 1 Hz}}}}}}
    connections:
      - [left.flange, one.a, pad.a]
      - [one.b, block.flange, push.flange, other.a, pad.b]
      - [other.b, right.flange]
    run: {{stop: 2 s, engine: {engine}}}
"""
SPECK = """
    components:
      floor: {{type: Ground}}
      speck: {{type: Mass, mass: 1e-9 kg, velocity: 1 mm/s}}
      pad: {{type: Contact, normal_force: 5e-7 N, curve: 0.2}}
    connections: [[floor.flange, pad.a], [pad.b, speck.flange]]
    run: {{stop: 0.1 s, engine: {engine}}}
"""


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("text", [DRAGGED, SHUT_IN, SPECK], ids=["dragged", "shut in", "speck"])
def test_energies_as_small_as_rounding_are_no_bad_run(simulate, text: str, engine: str) -> None:
    run = simulate(text.format(engine=engine)).run
    assert run["energy"]["throughput"] < run["energy"]["known_to"]
    assert not any(BAD in one.text for one in told(run))


@pytest.mark.parametrize("speed", [1e-3, 1.0, 30.0])
def test_weights_explain_what_a_speed_off_by_its_weight_does_to_the_energy(speed) -> None:
    """Three bodies, all as fast: the sum of m (v + w)^2/2 - m v^2/2 is what is said to be explained."""
    masses, w = np.array([0.5, 2.0, 10.0]), 1e-4
    off = float(np.sum(masses / 2 * ((speed + w) ** 2 - speed**2)))
    energy = {"throughput": float(np.sum(masses / 2 * speed**2)), "resolved": float(np.sum(masses / 2 * w**2))}
    assert explained(energy) * energy["throughput"] == pytest.approx(off, rel=1e-9)


def test_true_errors_are_told() -> None:
    """Half of what passed is missing where a hundred million times the resolved energy passed, or nothing is known."""
    assert _bad({"closure": 0.5, "throughput": 1e-3, "resolved": 1e-11})
    assert _bad({"closure": 0.5})
    assert not _bad({"closure": 0.5, "throughput": 1e-12, "resolved": 1e-11})
    assert not _bad({"closure": 0.5, "throughput": 1e-9, "resolved": 1e-20, "known_to": 1e-8})
    assert _bad({"closure": 0.5, "throughput": 1e-6, "resolved": 1e-20, "known_to": 1e-8})
    assert open_by({"closure": 0.5, "throughput": 1e-12, "resolved": 1e-11}) == 0.0
    assert open_by({"closure": None}) is None
