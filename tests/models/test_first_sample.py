"""The first sample of a controller: taken of the scene as it has settled without it, not of start values."""

import numpy as np
import pytest

HELD = """
components:
  ground: {type: Ground}
  block: {type: Mass, mass: 2 kg, velocity: 0, position: 0}
  grip: {type: Contact, normal_force: 20 N, curve: {curve: coulomb, coulomb: 0.4, stiction: 0.5}}
  push: {type: ForceSource, force: {constant: 7 N, ramp: {to: 2 N, over: 0.1 s}}}
  reading: {type: SampledSensor, period: 10 ms}
connections: [[ground.flange, grip.a], [grip.b, block.flange, push.flange], [grip.friction, reading.value]]
run: {stop: 0.05 s}
record: {signals: [reading.signal, block.x]}
"""
HUNG = """
components:
  hook: {type: MotionSource, position: 0}
  rope: {type: Tether, stiffness: 5 kN/m, length: 1 m}
  load: {type: Mass, mass: 3 kg, velocity: 0, position: -1.02 m}
  weight: {type: ForceSource, force: -100 N}
  reading: {type: SampledSensor, period: 10 ms}
connections:
  - [hook.flange, rope.b]
  - [rope.a, load.flange, weight.flange]
  - [rope.tension, reading.value]
run: {stop: 0.05 s}
record: {signals: [reading.signal, load.x]}
"""
STOPPED = """
components:
  ground: {type: Ground}
  block: {type: Mass, mass: 2 kg, velocity: 0, position: 0}
  grip: {type: Contact, normal_force: 20 N, curve: {curve: coulomb, coulomb: 0.4, stiction: 0.5}}
  push: {type: ForceSource, force: 11 N}
  against: {type: ForceActuator}
  asked: {type: SignalGain, gain: GAIN}
  offset: {type: SignalSource, value: -2.0}
  reading: {type: SampledSensor, period: 10 ms}
connections:
  - [ground.flange, grip.a]
  - [grip.b, block.flange, push.flange, against.flange]
  - [offset.signal, reading.value]
  - [reading.signal, asked.value]
  - [asked.signal, against.force]
run: {stop: 0.05 s, accuracy: 1e-6}
record: {signals: [reading.signal, block.x, grip.friction]}
"""
ENGINES = ("rodas", "stepping", "ida")


def needs(engine):
    """Skip where the library of an engine is missing."""
    if engine == "ida":
        pytest.importorskip("sksundae.ida", reason="needs scikit-sundae: pip install 'fairlead[ida]'")


@pytest.mark.parametrize("engine", ENGINES)
def test_it_reads_the_force_that_a_contact_holds_with(simulate, engine):
    """A block stands under a push of 7 N that grows by 20 N/s and is read from the first instant on."""
    needs(engine)
    result = simulate(HELD, **{"run.engine": engine})
    at = np.array([0.005, 0.015, 0.035])
    np.testing.assert_allclose(result.at("reading.signal", at), [7.0, 7.2, 7.6], rtol=1e-6)
    assert result["reading.signal"][0] == pytest.approx(7.0)
    np.testing.assert_allclose(result["block.x"], 0.0, atol=1e-15)


@pytest.mark.parametrize("engine", ENGINES)
def test_it_reads_a_rope_that_is_taut_at_the_start(simulate, engine):
    """A load that hangs 20 mm below a rope of 5 kN/m: 100 N."""
    needs(engine)
    result = simulate(HUNG, **{"run.engine": engine})
    np.testing.assert_allclose(result["reading.signal"], 100.0, rtol=1e-4)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("gain", "moves"), [(1.0, False), (0.1, True)])
def test_what_lets_go_without_the_command_of_the_start_still_holds_with_it(simulate, engine, gain, moves):
    """11 N beat the 10 N of stiction; with -2 N of a first sample 9 N are left: more than the 8 N of sliding.

    With -0.2 N the block goes at 2.8 N / 2 kg.
    """
    needs(engine)
    result = simulate(STOPPED.replace("GAIN", str(gain)), **{"run.engine": engine})
    right = 0.5 * 1.4 * result.t**2 if moves else 0.0 * result.t
    np.testing.assert_allclose(result["block.x"], right, atol=2e-6)
    assert result.run["counters"]["switches"] == moves
