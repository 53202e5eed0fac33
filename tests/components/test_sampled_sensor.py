"""A sensor with noise and a step of its numbers: staircases and statistics in closed form (physics section 6)."""

import math

import numpy as np
import pytest

PERIOD, SAMPLES = 0.01, 2000
SCENE = f"""
    components:
      source: {{type: SignalSource, value: VALUE}}
      sensor: {{type: SampledSensor, period: {PERIOD} s GIVEN}}
      filter: {{type: SignalLag, lag: 20 ms}}
    connections:
      - [source.signal, sensor.value]
      - [sensor.signal, filter.value]
    run: {{stop: STOP, accuracy: 1e-6}}
    record: {{signals: ["*.*"]}}
"""


def scene_of(given, value="0", samples=SAMPLES):
    """One sample more than asked for lies at the end and is not told."""
    stop = f"{(samples - 0.5) * PERIOD} s"
    return SCENE.replace("GIVEN", given).replace("VALUE", value).replace("STOP", stop)


def told(result, samples=SAMPLES):
    """What the sensor tells after each sample, as recorded."""
    rows = np.searchsorted(result.t, (np.arange(samples) + 0.25) * PERIOD) - 1
    return result["sensor.signal"][rows]


def test_a_step_of_its_numbers_makes_an_exact_staircase(simulate):
    """The nearest multiple, halves upward; no rounding is allowed but that of the product."""
    step, samples = 0.07, 200
    ramp = "{ramp: {from: -1, to: 1, over: 2 s}}"
    result = simulate(scene_of(f", resolution: {step}", ramp, samples))
    at = np.arange(samples) * PERIOD
    values = result.at("source.signal", at)
    np.testing.assert_allclose(values, -1 + at, atol=1e-12)
    clear = np.abs((values / step + 0.5) % 1 - 0.5) < 0.5 - 1e-9  # not on the border of two steps
    assert clear.sum() > samples - 3
    np.testing.assert_array_equal(told(result, samples)[clear], step * np.floor(values[clear] / step + 0.5))


def test_without_noise_and_step_it_tells_what_was_there_at_its_samples(simulate):
    samples = 200
    result = simulate(scene_of("", "{sine: {amplitude: 1, frequency: 2 Hz}}", samples))
    wave = np.sin(4 * math.pi * PERIOD * np.arange(samples))
    np.testing.assert_allclose(told(result, samples), wave, atol=1e-12)


def test_noise_has_the_mean_the_variance_and_the_shape_of_a_normal_law_and_no_memory(simulate):
    """Bounds that a right sequence passes 999 times in 1000; the chi-square one by Wilson and Hilferty (1931)."""
    sigma, n, z = 0.5, SAMPLES, 3.29
    noise = told(simulate(scene_of(f", noise: {sigma}, seed: 7", "3"))) - 3
    assert abs(noise.mean()) < z * sigma / math.sqrt(n)
    low, high = (1 - 2 / (9 * (n - 1)) + sign * z * math.sqrt(2 / (9 * (n - 1))) for sign in (-1, 1))
    assert low**3 < noise.var(ddof=1) / sigma**2 < high**3
    for lag in (1, 2, 3, 10):
        assert abs(np.mean(noise[lag:] * noise[:-lag])) / sigma**2 < z / math.sqrt(n - lag)
    below = np.array([[0.5 * math.erfc(-x / sigma / math.sqrt(2)) for x in sorted(noise)]])
    steps = np.arange(n + 1) / n
    assert max((steps[1:] - below).max(), (below - steps[:-1]).max()) < 1.95 / math.sqrt(n)  # Kolmogorov, Smirnov


@pytest.mark.slow
def test_a_seed_is_a_noise_bit_by_bit_on_every_engine(simulate):
    text = scene_of(", noise: 1, seed: 3", samples=100)
    one = told(simulate(text, **{"run.engine": "rodas"}), 100)
    for engine in ("rodas", "stepping", "ida"):
        np.testing.assert_array_equal(told(simulate(text, **{"run.engine": engine}), 100), one)
    fine = told(simulate(text, **{"run.max_step": "0.7 ms"}), 100)
    np.testing.assert_array_equal(fine, one)
    other = told(simulate(text.replace("seed: 3", "seed: 4")), 100)
    assert abs(np.corrcoef(one, other)[0, 1]) < 3.29 / math.sqrt(100)


def test_a_filter_lets_through_of_the_variance_what_its_closed_form_says(simulate):
    """y' = a y + (1 - a) w with a = exp(-period/lag): var y = (1 - a)/(1 + a) var w, here 0.2449."""
    result = simulate(scene_of(", noise: 1, seed: 1"))
    a = math.exp(-PERIOD / 0.02)
    filtered = result.at("filter.signal", np.arange(50, SAMPLES) * PERIOD)
    spread = math.sqrt(2 / len(filtered) * (1 + a**2) / (1 - a**2))  # of a variance estimated from an AR(1) sequence
    assert filtered.var() == pytest.approx((1 - a) / (1 + a), rel=3.29 * spread)
    y, w = 0.0, told(result)  # and sample by sample: the held noise through the lag
    for k in range(200):
        assert result.at("filter.signal", k * PERIOD) == pytest.approx(y, abs=1e-6)
        y = a * y + (1 - a) * w[k]


def test_without_sampling_it_is_perfect_and_nothing_is_sampled(scene, simulate):
    wave = "{sine: {amplitude: 1, frequency: 2 Hz}}"
    text = scene_of(", noise: 1, resolution: 0.3", wave, 50) + "    effects: {sampling: off}\n"
    assert not scene(text).system.memory["sampled"].size
    result = simulate(text)
    np.testing.assert_array_equal(result["sensor.signal"], result["source.signal"])


def test_the_step_and_the_period_that_vanish_leave_a_perfect_sensor(simulate):
    """The error is at most half a step, and at most what the value changes in a period."""
    wave, slope = "{sine: {amplitude: 1, frequency: 2 Hz}}", 4 * math.pi
    for step, period in ((0.1, 0.01), (0.01, 0.001)):
        text = scene_of(f", resolution: {step}", wave, 50).replace(f"period: {PERIOD} s", f"period: {period} s")
        result = simulate(text)
        at = np.linspace(0.0, 0.49, 500)
        error = np.abs(result.at("sensor.signal", at) - np.sin(slope * at)).max()
        assert error <= step / 2 + slope * period
        assert error > step / 4
