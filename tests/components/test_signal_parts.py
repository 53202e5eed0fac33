"""Parts that work on signals, against what their formulas say of a sine."""

import pathlib
import re

import numpy as np
import pytest
import scipy.signal
from scipy.interpolate import RegularGridInterpolator

import fairlead
from fairlead.errors import ModelError

SCENES = pathlib.Path(__file__).parents[2] / "models" / "single_parts"


def run(name, **settings):
    """A scene, with other values by their dotted names."""
    result = fairlead.load(SCENES / f"{name}.yaml", set={"run.accuracy": "1e-7", **settings}).run(out=None)
    assert result.ok
    return result


def relay(value, lower, upper):
    """Whether a relay is on, sample by sample."""
    on, told = False, []
    for x in value:
        on = x > upper or (on and x >= lower)
        told.append(on)
    return np.array(told)


def test_what_has_no_memory_is_a_formula_of_the_sine():
    result = run("limits_of_signals")
    wave = 2 * np.sin(2 * np.pi * result.t)
    clear = np.abs(np.abs(wave) - 1) > 1e-3  # of the jumps of the relay, and of the switch at zero
    expected = {
        "limited": np.clip(wave, -1, 1.5), "dead": 2 * np.sign(wave) * np.maximum(np.abs(wave) - 0.5, 0),
        "larger": np.maximum(wave, wave / 2), "size": np.abs(wave), "square": wave**2,
        "shape": np.interp(wave, [-2, 0, 2], [4, 0, 1]),
    }  # fmt: skip
    for name, values in expected.items():
        assert np.max(np.abs(result[f"{name}.signal"] - values)) < 1e-6, name
    assert np.array_equal(result["relay.signal"][clear] > 0, relay(wave, -1, 1)[clear])
    away = np.abs(wave) > 1e-3
    assert np.allclose(result["chosen.signal"][away], np.where(wave > 0, wave, wave / 2)[away], atol=1e-6)
    assert len(result.switches()) >= 10  # none was stepped over


@pytest.mark.parametrize("high", ["0.5", "0.3"])
def test_an_integral_stays_at_its_limit_and_leaves_when_the_value_turns(high):
    """The integral of 2 sin(w t) is (1 - cos(w t))/pi; it is held from where it meets the limit until t = 0.5 s."""
    result = run("memory_of_signals", **{"integral.high": high})
    free, late = (1 - np.cos(2 * np.pi * result.t)) / np.pi, result.t % 1 > 0.5
    top = float(high)
    fall = top - 2 / np.pi + free  # after the turn it falls from the limit
    first = result.t < 1
    expected = np.where(late, fall, np.minimum(free, top))
    assert np.max(np.abs(result["integral.signal"] - expected)[first]) < 1e-5
    assert result["integral.signal"].max() <= top + 1e-6


def test_filters_answer_as_their_frequency_response_says():
    result = run("memory_of_signals", **{"run.stop": "4 s"})
    settled, w = result.t > 3, 2 * np.pi
    for name, response in (("rate", 1j * w / (1 + 0.01j * w)), ("filter", 100 / (100 - w**2 + 10j * w))):
        expected = 2 * np.imag(response * np.exp(1j * w * result.t))
        assert np.max(np.abs(result[f"{name}.signal"] - expected)[settled]) < 2e-4 * abs(response), name


def test_samples_are_held_and_told_late():
    result = run("memory_of_signals")
    t = result.t[:-1] + 1e-9
    inside = (result.t[:-1] % 0.05 > 1e-6) & (result.t[:-1] % 0.05 < 0.05 - 1e-6)
    held = 2 * np.sin(2 * np.pi * np.floor(t / 0.05) * 0.05)
    assert np.allclose(result["held.signal"][:-1][inside], held[inside], atol=1e-6)
    between = (result.t[:-1] % 0.01 > 1e-6) & (result.t[:-1] % 0.01 < 0.01 - 1e-6)
    late = np.maximum(np.floor(t / 0.01) * 0.01 - 0.05, 0)
    assert np.allclose(result["late.signal"][:-1][between], 2 * np.sin(2 * np.pi * late)[between], atol=1e-6)


@pytest.mark.parametrize("engine", ["stepping", "ida"])
def test_samples_that_rounding_alone_parts_are_taken_on_every_engine(engine):
    """3 times 50 ms is 2.8e-17 s after 15 times 10 ms."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    one, other = run("memory_of_signals"), run("memory_of_signals", **{"run.engine": engine})
    for name in ("held", "late", "integral"):
        assert other[f"{name}.signal"][-1] == pytest.approx(one[f"{name}.signal"][-1], abs=1e-5), name


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"limited.high": "-2"}, "limited.high: high -2 is not above low -1"),
        ({"relay.lower": "2"}, "relay.lower: lower 2 is above upper 1"),
        ({"dead.band": "-1"}, "dead.band = -1"),
    ],
)
def test_what_contradicts_itself_is_refused(change, says):
    with pytest.raises(ModelError, match=says):
        fairlead.load(SCENES / "limits_of_signals.yaml", set=change).check()


def test_gates_counters_and_timers_say_what_two_square_waves_give():
    result = run("logic_of_signals")
    fast, slow = np.sin(4 * np.pi * result.t), np.sin(np.pi * result.t)
    clear = (np.abs(fast) > 1e-3) & (np.abs(slow) > 1e-3)
    one, other = fast > 0, slow > 0
    for name, expected in (("both", one & other), ("some", one | other), ("alone", one ^ other)):
        assert np.array_equal(result[f"{name}.signal"][clear] > 0.5, expected[clear]), name
    assert np.allclose(result["alone.inverse"], 1 - result["alone.signal"])
    assert result["counter.count"][-1] == 3  # at 0.25, 0.75 and 1.5 s; at 1 s one hands over to the other
    assert result["hours.elapsed"][-1] == pytest.approx(1.0, abs=2e-3)
    made = result.t[np.flatnonzero(np.diff(result["timer.signal"]))]
    assert made == pytest.approx([0.1, 0.25, 0.6, 0.75, 1.1, 1.25, 1.6, 1.75], abs=3e-3)


@pytest.mark.slow
@pytest.mark.parametrize("b3", ["0 s^3", "2e-5 s^3"])
def test_a_transfer_function_answers_a_sweep_as_scipy_says(b3):
    """The reference holds its input linear between 80000 samples."""
    result = run("transfer_function", **{"plant.b3": b3})
    t = np.linspace(0, 5, 80001)
    sweep = np.sin(2 * np.pi * (t + 19 / 5 * t**2 / 2))
    numerator = [float(b3.split()[0]), 0, 1e-2, 1][-4 if b3 != "0 s^3" else -2 :]
    _, answer, _ = scipy.signal.lsim((numerator, [1e-5, 1e-3, 2e-2, 1]), sweep, t)
    assert np.max(np.abs(np.interp(result.t, t, answer) - result["plant.signal"])) < 1e-5


def test_a_transfer_function_is_the_blocks_it_stands_for(simulate):
    """Two formulations: a SecondOrder behind a lag, and the product of their denominators."""
    result = simulate("""
        components:
          step: {type: SignalSource, value: {ramp: {to: 1, over: 10 ms}}}
          slow: {type: SignalLag, lag: 50 ms}
          swings: {type: SecondOrder, omega: 20 rad/s, damping: 0.2}
          both: {type: TransferFunction, a1: 70 ms, a2: 3.5e-3 s^2, a3: 1.25e-4 s^3}
        connections: [[step.signal, slow.value, both.value], [slow.signal, swings.value]]
        run: {stop: 1 s, accuracy: 1e-7}
    """)
    assert np.abs(result["swings.signal"]).max() > 1.2
    assert np.allclose(result["swings.signal"], result["both.signal"], atol=1e-5)


@pytest.mark.parametrize(
    ("settings", "says"),
    [({"plant.b4": "1 s^4"}, "the numerator has order 4, the denominator 3"),
     ({f"plant.a{k}": "0" for k in range(4)}, "the denominator is zero")],
)  # fmt: skip
def test_a_transfer_function_that_cannot_be_is_refused(settings, says):
    with pytest.raises(ModelError, match=says):
        fairlead.load(SCENES / "transfer_function.yaml", set=settings).check()


def test_a_map_of_two_signals_is_bilinear_and_keeps_its_borders():
    result = run("table_of_two")
    x, y = [0, 1, 3], [-1, 0, 2, 2.5, 4]
    of = RegularGridInterpolator((y, x), [[0, 2, 4], [1, 1, 5], [3, 0, -2], [3, 0, -2], [1, 1, 1]])
    expected = of(np.c_[np.clip(result["down.signal"], -1, 4), np.clip(result["across.signal"], 0, 3)])
    assert np.allclose(result["chart.signal"], expected, atol=1e-9)


@pytest.mark.parametrize(
    ("text", "says"),
    [("0,0,1\n0,1,x\n1,2,3\n", "row 2: 'x' is not a finite number"), ("0,0,1\n0,1\n1,2,3\n", "row 2 has 1 values"),
     ("0,1,0\n0,1,2\n1,2,3\n", "x does not grow"), ("0,0,1\n", "it has 1 rows")],
)  # fmt: skip
def test_a_map_that_is_none_is_refused_with_its_row(tmp_path, text, says):
    (tmp_path / "map.csv").write_text(text)
    scene = (SCENES / "table_of_two.yaml").read_text(encoding="utf-8")
    (tmp_path / "scene.yaml").write_text(scene)
    with pytest.raises(ModelError, match=re.escape(says)):
        fairlead.load(tmp_path / "scene.yaml").check()
