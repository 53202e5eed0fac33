"""Signals that decide one another at once are solved for, and `check` names them."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import fairlead

ENGINES = ["rodas", "stepping", "ida"]
NEAR = {"rodas": 2e-6, "stepping": 2e-4, "ida": 2e-6}
"""Of signals of size 1: ten times the accuracy of 1e-7 and the gain of what follows; stepping is of second order."""

LOOPS = """
schema: 1
components:
  r: {type: SignalSource, value: {sine: {amplitude: 1, frequency: 1 Hz}}}
  a: {type: Sum, gain_b: 0.5, gain_c: -2}
  b: {type: Sum, gain_b: 0.25}
  c: {type: SignalGain, gain: 0.5, offset: 1}
  plant: {type: StateSpace, a: -2, b: 1, c: 2, d: 0.5}
  e: {type: Sum, gain_b: -4}
connections:
  - [r.signal, a.a, e.a]
  - [a.signal, b.a, c.value]
  - [b.signal, a.b, b.b]
  - [c.signal, a.c]
  - [e.signal, plant.value]
  - [plant.signal, e.b]
run: {stop: 2 s, accuracy: 1e-7}
"""
BENT = """
schema: 1
components:
  s: {type: SignalSource, value: {ramp: {from: 1, to: 3, over: 1 s}}}
  f: {type: SignalFunction, expression: "a - x**3/3"}
  limit: {type: Limiter, low: -1.2, high: 1.2}
  memory: {type: Integrator}
connections:
  - [s.signal, f.a]
  - [f.signal, limit.value, memory.value]
  - [limit.signal, f.x]
run: {stop: 2 s, accuracy: 1e-7}
"""
GAIN = """
schema: 1
components:
  s: {type: SignalSource, value: {sine: {amplitude: 1, frequency: 1 Hz}}}
  sum: {type: Sum}
  back: {type: SignalGain, gain: -3}
  memory: {type: Integrator}
connections: [[s.signal, sum.a], [sum.signal, back.value, memory.value], [back.signal, sum.b]]
run: {stop: 1 s}
"""


def load(tmp_path, text, **settings):
    """A scene with other values by their dotted names."""
    (tmp_path / "scene.yaml").write_text(text, encoding="utf-8")
    return fairlead.load(tmp_path / "scene.yaml", set=settings)


def needs(engine):
    """Skip where the engine is not installed."""
    if engine == "ida":
        pytest.importorskip("sksundae")


@pytest.mark.parametrize("engine", ENGINES)
def test_loops_that_share_a_signal_and_one_through_a_feed_through_are_solved(tmp_path, engine):
    """b = a + b/4 and a = r + b/2 - 2 (a/2 + 1) give a = 3/4 (r - 2); so y = 2 x + u/2, u = r - 4 y."""
    needs(engine)
    result = load(tmp_path, LOOPS, **{"run.engine": engine}).run(out=None)
    wave = np.sin(2 * np.pi * result.t)
    assert np.allclose(result["a.signal"], 3 / 4 * (wave - 2), atol=NEAR[engine])
    assert np.allclose(result["b.signal"], wave - 2, atol=NEAR[engine])
    exact = solve_ivp(lambda t, x: -14 / 3 * x + np.sin(2 * np.pi * t) / 3, (0, 2), [0], rtol=1e-10, atol=1e-12,
                      t_eval=result.t)  # fmt: skip
    assert np.allclose(result["plant.signal"], (2 * exact.y[0] + wave / 2) / 3, atol=NEAR[engine])


@pytest.mark.parametrize("engine", ENGINES)
def test_a_bent_loop_is_solved_and_its_corner_found(tmp_path, engine):
    """f = a - clip(f)^3/3 meets the limit of 1.2 where a = 1.2 + 1.2^3/3 = 1.776, at 0.388 s."""
    needs(engine)
    result = load(tmp_path, BENT, **{"run.engine": engine}).run(out=None)
    a, f = np.minimum(1 + 2 * result.t, 3), result["f.signal"]
    assert np.allclose(f, a - np.clip(f, -1.2, 1.2) ** 3 / 3, atol=NEAR[engine])
    assert f[-1] == pytest.approx(3 - 1.2**3 / 3, abs=1e-6)
    assert next(e.t for e in result.events if e.component == "limit") == pytest.approx(0.388, abs=1e-5)


def test_check_names_every_loop_and_a_state_in_it_is_none(tmp_path):
    remarks = [str(one) for one in load(tmp_path, LOOPS).check()]
    assert len(remarks) == 3
    assert any("a loop without delay: plant.signal -> e -> plant.in_value -> plant.signal; plant.signal is" in one
               for one in remarks)  # fmt: skip
    assert any("b -> b" in one for one in remarks)  # it reads its own output
    lagging = GAIN.replace("{type: SignalGain, gain: -3}", "{type: SignalLag, lag: 1 s}")
    assert load(tmp_path, lagging).check() == []


def test_a_model_with_other_values_solves_its_loop_anew(tmp_path):
    model = load(tmp_path, GAIN)
    for gain in (-3, 0.5):
        result = model.with_values({"back.gain": gain}).run(out=None, accuracy=1e-7)
        wave = np.sin(2 * np.pi * result.t)
        assert np.allclose(result["sum.signal"], wave / (1 - gain), atol=1e-6)


def test_a_loop_of_gain_one_determines_nothing_and_says_so(tmp_path):
    result = load(tmp_path, GAIN, **{"back.gain": "1"}).run(out=None, check=False)
    assert not result.ok
    assert "do not determine sum.signal.loop.found" in result.run["sentence"]
    assert "a loop of signals whose gain is 1" in result.run["sentence"]
