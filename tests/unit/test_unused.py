"""What nobody reads costs nothing: outputs, sensors, sources; judged on the compiled system and by counts."""

import pytest

import fairlead
from fairlead.kernels import layout

SCENE = """
    components:
      hand: {type: MotionSource, position: {sine: {amplitude: 10 mm, frequency: 1 Hz}}}
      spring: {type: Spring, stiffness: 100 N/m}
      block: {type: Mass, mass: 1 kg}
      gauge: {type: MotionSensor}
      command: {type: SignalSource, value: {sine: {amplitude: 1, frequency: 3 Hz}}}
    connections:
      - [hand.flange, spring.a]
      - [spring.b, block.flange, gauge.flange]
    run: {stop: 2 s}
"""
ALONE = """
    components:
      hand: {type: MotionSource, position: {sine: {amplitude: 10 mm, frequency: 1 Hz}}}
      spring: {type: Spring, stiffness: 100 N/m}
      block: {type: Mass, mass: 1 kg}
    connections:
      - [hand.flange, spring.a]
      - [spring.b, block.flange]
    run: {stop: 2 s}
"""


def scheduled(system):
    """Paths of the instances whose outputs are computed whenever a law is evaluated."""
    return {
        system.blocks[block].instances[i].path
        for block, start, stop in system.memory["schedule"].reshape(-1, 3)
        for i in range(start, stop)
    }


def test_only_what_somebody_reads_is_computed_in_a_step(scene):
    assert scheduled(scene(SCENE).system) <= {"hand"}  # a prescribed motion is read by its reaction
    bend = fairlead.load("single_bend", set={"line.length": "4 m"}).system
    assert not {path for path in scheduled(bend) if "registration" in path or "_node" in path or "outer[" in path}


def test_a_sensor_and_a_source_that_nobody_reads_add_no_unknown_no_term_and_no_zone(scene):
    with_them, alone = scene(SCENE).system, scene(ALONE).system
    assert with_them.unknown_names == alone.unknown_names
    assert len(with_them.pattern.rows) == len(alone.pattern.rows)
    assert with_them.n_guards == alone.n_guards
    assert with_them.memory["context"][layout.N_PROGRAM] == alone.memory["context"][layout.N_PROGRAM]


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_what_is_recorded_changes_no_step(simulate, engine):
    nothing, all_of_it = (
        simulate(SCENE + f"    record: {{signals: {signals}}}\n", **{"run.engine": engine})
        for signals in ("[]", '["*"]')
    )
    for name in ("steps", "rhs", "jacobians", "factorisations", "solves"):
        assert nothing.run["counters"][name] == all_of_it.run["counters"][name], name
    assert nothing.run["end_time"] == all_of_it.run["end_time"]
