"""A contact on a node without mass, as of Jenkins' element: `stepping` holds it without creep, and finds its zones."""

import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run, integrate

ELEMENT = """
schema: 1
components:
  floor: {type: Ground}
  link: {type: SpringDamper, stiffness: 500 N/m, damping: 5 N*s/m}
  pad: {type: Contact, normal_force: 10 N, curve: 0.2, method: hold}
  hand: {type: MotionSource, position: {sine: {amplitude: 40 mm, frequency: 1.1 Hz}}}
connections:
  - [floor.flange, pad.a]
  - [hand.flange, link.a]
  - [link.b, pad.b]
run: {stop: 3 s}
"""
BESIDE_A_BLOCK = """
schema: 1
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 1 kg}
  spring: {type: Spring, stiffness: 300 N/m}
  link: {type: SpringDamper, stiffness: 500 N/m, damping: 5 N*s/m}
  under: {type: Contact, normal_force: 10 N, curve: 0.3, method: hold}
  pad: {type: Contact, normal_force: 10 N, curve: 0.2, method: hold}
  hand: {type: MotionSource, position: {sine: {amplitude: 40 mm, frequency: 1.1 Hz}}}
connections:
  - [floor.flange, under.a, pad.a]
  - [hand.flange, spring.b]
  - [spring.a, block.flange, under.b, link.a]
  - [link.b, pad.b]
run: {stop: 3 s}
"""


ON_A_TABLE = """
schema: 1
components:
  floor: {type: Ground}
  table: {type: MotionSource, position: {sine: {amplitude: 10 mm, frequency: 3.7 Hz}}}
  link: {type: SpringDamper, stiffness: 500 N/m, damping: 5 N*s/m}
  pad: {type: Contact, normal_force: 1000 N, curve: 0.3, method: hold}
connections:
  - [floor.flange, link.a]
  - [link.b, pad.b]
  - [table.flange, pad.a]
run: {stop: 3 s}
"""


def run(tmp_path, text, engine, accuracy):
    (tmp_path / "scene.yaml").write_text(text, encoding="utf-8")
    system = fairlead.load(tmp_path / "scene.yaml", set={"run.accuracy": accuracy}).system
    outcome = integrate(system, Run(stop=3.0, engine=engine, record=["pad.slip", "pad.friction"]))
    assert outcome.ok, outcome.sentence
    return outcome.problem, outcome


@pytest.mark.parametrize("scene", [ELEMENT, BESIDE_A_BLOCK], ids=["element", "beside_a_block"])
@pytest.mark.parametrize("accuracy", ["1e-3", "1e-4", "1e-5"])
def test_it_holds_without_creep_and_switches_without_going_to_and_fro(tmp_path, scene, accuracy):
    """One solve takes its slip away. It took half of it once, and steps that caught it went a hundred passes."""
    _, outcome = run(tmp_path, scene, "stepping", accuracy)
    slip, force = np.abs(outcome.values[:, :2]).T
    held = force < 1.99  # N; steps in which it lets go or is caught have the mean force 2
    assert held.sum() > 20  # steps
    assert slip[held].max() < 1e-12
    assert outcome.counters.unsolved == 0
    assert outcome.counters.settling_passes < 4 * outcome.counters.switches


@pytest.mark.parametrize("accuracy", [1e-3, 1e-4, 1e-5])
def test_held_on_a_table_that_swings_it_stays_where_it_is_on_the_table(tmp_path, accuracy):
    """300 N hold it against 6: it moves by 10 mm sin(2 pi 3.7 Hz t). Its speed is a mean over the step."""
    system, outcome = run(tmp_path, ON_A_TABLE, "stepping", str(accuracy))
    (at,) = (k for k, name in enumerate(system.unknown_names) if name.endswith(".x"))
    assert outcome.counters.switches == 0
    assert outcome.y[at] == pytest.approx(0.01 * np.sin(2 * np.pi * 3.7 * 3.0), abs=0.1 * accuracy)
    assert np.abs(outcome.values[:, 0]).max() < 1e-12


@pytest.mark.parametrize("scene", [ELEMENT, BESIDE_A_BLOCK], ids=["element", "beside_a_block"])
def test_its_place_is_that_of_the_other_engine(tmp_path, scene):
    system, outcome = run(tmp_path, scene, "stepping", "1e-5")
    _, other = run(tmp_path, scene, "rodas", "1e-7")
    at = [k for k, name in enumerate(system.unknown_names) if name.endswith(".x")]
    assert outcome.y[at] == pytest.approx(other.y[at], abs=1e-5)
