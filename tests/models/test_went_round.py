"""The order of release where held bodies have no slip but rounding, and the remark on one that comes to no end.

Of a circle of contacts the first falls to sliding friction and slips by nothing, since others hold both its sides. Its
acceleration is rounding, of either sign: taken for a slip that comes back it was caught again, and so on. So it was
where what is given seemed to stand still beside bodies that accelerate no faster.
"""

from __future__ import annotations

import types

import numpy as np
import pytest

from fairlead.analysis.record.went_round import ROUNDS, WentRound

CIRCLE = """
    components:
      floor: {{type: Ground}}
      m1: {{type: Mass, mass: {one} kg, position: 0 m}}
      m2: {{type: Mass, mass: {two} kg, velocity: 0 m/s}}
      m3: {{type: Mass, mass: {three} kg, velocity: 0 m/s}}
      md0: {{type: Mass, mass: {four} kg, velocity: 0.237 m/s}}
      c1: {{type: Lever, ratio: 2.09}}
      {f1}: {{type: Contact, curve: {{curve: coulomb, coulomb: 0.397, stiction: 0.629}}, normal_force: {n1} N}}
      {f2}: {{type: Contact, curve: {{curve: coulomb, coulomb: 0.609, stiction: 0.811}}, normal_force: {n2} N}}
      {f3}: {{type: Contact, curve: {{curve: coulomb, coulomb: 0.66, stiction: 0.852}}, normal_force: {n3} N}}
      f4: {{type: Contact, curve: 0.558, normal_force: {n4} N}}
      k0: {{type: SpringDamper, stiffness: {k} N/m, free_length: 0 m}}
      s0: {{type: ForceSource, force: {load}}}
      s2: {{type: ForceSource, force: {pull} N}}
    connections:
      - [floor.flange, c1.pivot, {f1}.a]
      - [m1.flange, {f3}.b, s0.flange, s2.flange]
      - [m2.flange, k0.a]
      - [m3.flange, c1.a, {f2}.b, f4.b, k0.b]
      - [md0.flange, {f1}.b, {f2}.a, {f3}.a]
      - [c1.b, f4.a]
    run: {{stop: 1 s, accuracy: 1e-6}}
"""
FORCES = {"n1": 45.2, "n2": 19.6, "n3": 53.3, "n4": 39.7, "pull": -22.17, "k": 1930.0}
MASSES = {"one": 4.94, "two": 0.553, "three": 3.61, "four": 1.94}
STEP = "{{step: {{from: {low} N, to: {high} N, at: 0.66 s}}}}"
RAMP = "{{ramp: {{from: {low} N, to: {high} N, start: 0.66 s, over: {over} us}}}}"


def scene(load: str, size: float = 1.0, names=("f1", "f2", "f3"), over: float = 10.0) -> str:
    given = {name: size * value for name, value in (FORCES | MASSES).items()}
    load = load.format(low=-2.81 * size, high=-25.63 * size, over=over)
    return CIRCLE.format(load=load, f1=names[0], f2=names[1], f3=names[2], **given)


@pytest.mark.parametrize("engine", ["rodas", "ida"])  # `stepping` refuses a lever without inertia
def test_a_load_that_jumps_leads_to_where_fast_ramps_lead(simulate, engine):
    ends = []
    for load, over in ((STEP, 0), (RAMP, 10), (RAMP, 100)):
        result = simulate(scene(load, over=over), **{"run.engine": engine})
        ends.append([result[f"{one}.x"][-1] for one in ("m1", "m3", "md0")])
        assert result.run["went_round"]["count"] == 0
    step, fast, slow = ends
    assert abs(slow[2]) > 0.1  # it does move
    assert step == pytest.approx(fast, abs=2 * np.abs(np.subtract(fast, slow)).max())


@pytest.mark.parametrize("names", [("f3", "f1", "f2"), ("a", "z", "b")])
@pytest.mark.parametrize("size", [1.0, 1e-4, 1e4])
def test_neither_names_nor_size_decide(simulate, names, size):
    here = simulate(scene(STEP))
    there = simulate(scene(STEP, size=size, names=names))
    assert [there[f"{one}.x"][-1] for one in ("m1", "md0")] == pytest.approx(
        [here[f"{one}.x"][-1] for one in ("m1", "md0")], rel=1e-5
    )


TRAIN = """
    components:
      j: {type: Inertia, moment: 0.1 kg*m^2}
      k: {type: Inertia, moment: 0.2 kg*m^2}
      g: {type: Gear, ratio: 3}
      brake: {type: Brake, curve: {curve: coulomb, coulomb: 0.3, stiction: 0.45}, normal_force: 60 N, radius: 0.1 m}
      clutch: {type: Clutch, curve: {curve: coulomb, coulomb: 0.3, stiction: 0.35}, normal_force: 20 N, radius: 0.1 m}
      load: {type: TorqueSource, torque: -1.5 N*m}
      motor: {type: SpeedSource, speed: {sine: {amplitude: 3 rad/s, frequency: 1.3 Hz, phase: 0.4 rad}}}
    connections: [[j.shaft, brake.shaft, load.shaft, g.a], [g.b, k.shaft, clutch.a], [clutch.b, motor.shaft]]
    run: {stop: 1.2 s, accuracy: 1e-6}
"""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_what_is_given_accelerates_while_the_load_comes_in(simulate, engine):
    """A motor turns round at a clutch; the brake behind it is overloaded. Ten changes, 178 with a motor that stands."""
    result = simulate(TRAIN, **{"run.engine": engine})
    creeps = simulate(TRAIN, **{"friction.method": "binding", "friction.creep": "1e-6 m/s"})
    assert result["j.angle"][-1] == pytest.approx(creeps["j.angle"][-1], rel=1e-4)
    assert result.run["switches"] == 10
    assert result.run["went_round"]["count"] == 0


def changes(*of: tuple[float, int]) -> np.ndarray:
    return np.array(list(of), dtype=[("t", float), ("machine", int)])


def test_an_order_without_end_is_told_with_when_and_who():
    watch = WentRound(types.SimpleNamespace(falls=np.array([0, 1, 1]), machine_names=["stop", "pad", "shoe"]))
    watch.watch(changes((0.2, 1), (0.2, 2), *[(0.5, 1)] * ROUNDS, (0.5, 2), *[(0.5, 0)] * ROUNDS))
    watch.watch(changes((0.7, 2)))
    watch.finish()
    assert watch.plain() == {"count": 1, "first": [{"t": 0.5, "contacts": ["pad"]}]}
    (said,) = watch.remarks()
    assert said.startswith("At t = 0.5 s the order in which contacts let go came to no end (pad among them)")


def test_contacts_that_let_go_again_and_again_in_time_are_none():
    watch = WentRound(types.SimpleNamespace(falls=np.array([1]), machine_names=["pad"]))
    watch.watch(changes(*[(0.1 * k, 0) for k in range(3 * ROUNDS)]))
    watch.finish()
    assert watch.remarks() == []
