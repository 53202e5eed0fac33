"""Steps of `stepping` are kept as long as they serve: with them the factors, and few are taken again."""

import numpy as np

import fairlead
from fairlead.integrate import Run, integrate


def test_a_chain_keeps_its_steps_and_its_factors():
    """Contacts are caught and let go 1100 times; steps that followed the error of each changed every other time."""
    system = fairlead.load("hundred_blocks", set={"friction.method": "hold", "run.accuracy": "1e-5"}).system
    outcome = integrate(system, Run(stop=3.0, engine="stepping"))
    assert outcome.ok, outcome.sentence
    counted = outcome.counters
    lengths = np.diff(np.unique(outcome.times))
    changed = np.abs(np.diff(lengths)) > 1e-9 * lengths[1:]
    assert counted.switches > 1000
    assert np.count_nonzero(changed) < 0.1 * counted.steps
    assert counted.rejected_error < 0.05 * counted.steps
    assert counted.factorisations < 0.6 * counted.steps


SWINGS = """
schema: 1
components:
  block: {type: Mass, mass: 1 kg, position: 0.1 m}
  floor: {type: Ground}
  pad: {type: Contact, normal_force: 1 N, curve: 0.2, method: hold}
  spring: {type: SpringDamper, stiffness: 100 N/m}
connections:
  - [block.flange, pad.b, spring.b]
  - [pad.a, spring.a, floor.flange]
run: {stop: 100 s, accuracy: 1e-5}
"""


def test_steps_grow_when_they_may(tmp_path):
    """A block that swings until friction holds it: then nothing limits the steps, and they are far longer."""
    (tmp_path / "swings.yaml").write_text(SWINGS, encoding="utf-8")
    outcome = integrate(fairlead.load(tmp_path / "swings.yaml").system, Run(stop=100.0, engine="stepping"))
    assert outcome.ok, outcome.sentence
    times = np.unique(outcome.times)
    lengths = np.diff(times)
    assert lengths[times[:-1] > 50.0].max() > 100 * np.median(lengths[times[:-1] < 5.0])
