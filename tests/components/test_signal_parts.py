"""Parts that work on signals, against what their formulas say of a sine."""

import pathlib

import numpy as np
import pytest

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
