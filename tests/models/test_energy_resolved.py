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
    assert open_by({"closure": 0.5, "throughput": 1e-12, "resolved": 1e-11}) == 0.0
    assert open_by({"closure": None}) is None
