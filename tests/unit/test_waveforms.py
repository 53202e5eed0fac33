"""Terms of quantities in time: several of a kind, pulses, products and gates, at times where the value is known."""

import pathlib

import numpy as np
import pytest

from fairlead.component.given import Waveform
from fairlead.component.tables import TableError
from fairlead.component.waveforms import read_waveform

HERE = pathlib.Path()
LINE = {"ramp": {"to": 1, "over": 1}}
SQUARE = {"product": {"of": LINE, "times": LINE}}
SINE = {"amplitude": 2, "frequency": 1.5, "phase": 0.3}
SLOW = {"amplitude": 0.5, "frequency": "0.2 Hz", "phase": -1, "offset": 0.25}
RISING = {"product": {"of": {"sine": SINE}, "times": {"ramp": {"to": 1, "over": 2, "start": 0.5}}}}
SLOWER = {"ramp": {"to": 1, "over": 3}}
PARABOLA = {"product": {"of": {"sine": SLOW}, "times": {"product": {"of": LINE, "times": SLOWER}}}}


def wave(given, unit="N"):
    return read_waveform(given, Waveform(unit), HERE)


def test_several_terms_of_a_kind_add_up():
    """Up to 3 N within 1 s, and down again from 5 s to 6 s."""
    up_and_down = wave({"ramp": [{"to": "3 N", "over": "1 s"}, {"to": "-3 N", "over": "1 s", "start": "5 s"}]})
    assert [up_and_down(t) for t in (0.5, 3.0, 5.5, 9.0)] == pytest.approx([1.5, 3.0, 1.5, 0.0])
    steps = wave({"step": [{"to": 1, "at": 1}, {"to": 1, "at": 2}], "constant": 5})
    assert [steps(t) for t in (0.5, 1.5, 2.5)] == [5, 6, 7]


def test_tables_may_be_several_as_well():
    both = wave({"table": [{"t": [0, 1], "y": [0, 1]}, {"t": [0, 2], "y": [0, 4]}]})
    assert both(1.0) == pytest.approx(1 + 2)
    assert wave({"table": [[0, 0], [1, 2]]})(0.5) == pytest.approx(1.0)


def test_pulses_are_as_many_and_as_wide_as_they_say():
    train = wave({"pulses": {"to": "3 N", "from": "1 N", "every": "1 s", "wide": "0.2 s", "count": 3, "start": "2 s"}})
    assert [train(t) for t in (1.9, 2.1, 2.3, 3.1, 4.1, 5.1)] == [1, 3, 1, 3, 3, 1]
    soft = wave({"pulses": {"to": 4, "every": 1, "wide": 0.4, "count": 2, "rise": 0.1}})
    assert [soft(t) for t in (0.05, 0.2, 0.35, 0.6, 1.05)] == pytest.approx([2, 4, 2, 0, 2])


def test_a_product_multiplies_and_a_gate_lets_through_for_a_while():
    ramp = {"ramp": {"to": "4 N", "over": "4 s"}}
    doubled = wave({"product": {"of": ramp, "times": {"step": {"from": 1, "to": 2, "at": 2}}}})
    assert [doubled(t) for t in (1.0, 3.0, 5.0)] == pytest.approx([1.0, 6.0, 8.0])
    squared = wave({"product": {"of": ramp, "times": {"ramp": {"to": 1, "over": "4 s"}}}})
    assert squared(3.0) == pytest.approx(3.0 * 0.75)
    gated = wave({"gate": {"of": ramp, "start": "1 s", "stop": "3 s"}, "constant": 1})
    assert [gated(t) for t in (0.5, 2.0, 3.5)] == pytest.approx([1.0, 3.0, 1.0])


def sine(t):
    return 2 * np.sin(3 * np.pi * t + 0.3)


def slow(t):
    return 0.25 + 0.5 * np.sin(0.4 * np.pi * t - 1)


def within(t, start, stop):
    return (start <= t) & (t < stop)


MODULATED = {
    "several sines": ({"sine": [SINE, SLOW]}, lambda t: sine(t) + slow(t)),
    "a sine and its opposite": ({"sine": [SINE, {**SINE, "amplitude": -2}], "constant": 3}, lambda t: 3 + 0 * t),
    "an envelope": (RISING, lambda t: sine(t) * np.clip((t - 0.5) / 2, 0, 1)),
    "a curved envelope": (PARABOLA, lambda t: slow(t) * np.clip(t, 0, 1) * np.clip(t / 3, 0, 1)),
    "a burst": ({"gate": {"of": {"sine": SINE}, "start": 0.7, "stop": 2.1}}, lambda t: sine(t) * within(t, 0.7, 2.1)),
    "a burst with an envelope": (
        {"gate": {"of": RISING, "start": 1, "stop": 3}, "constant": 1},
        lambda t: 1 + sine(t) * np.clip((t - 0.5) / 2, 0, 1) * within(t, 1, 3),
    ),
    "a sine by its own frequency": (
        {"product": {"of": {"sine": SINE}, "times": {"sine": {**SINE, "phase": 1}}}},
        lambda t: sine(t) * 2 * np.sin(3 * np.pi * t + 1),
    ),
    "side bands": ({"product": {"of": {"sine": SINE}, "times": {"sine": SLOW}}}, lambda t: sine(t) * slow(t)),
    "a sine in pulses": (
        {"product": {"of": {"sine": SINE}, "times": {"pulses": {"to": 1, "every": 1, "wide": 0.5, "count": 3}}}},
        lambda t: sine(t) * within(t, 0, 3) * (t % 1 < 0.5),
    ),
    "a sine of no frequency": ({"gate": {"of": {"sine": {**SINE, "frequency": 0}}, "stop": 2}},
                               lambda t: 2 * np.sin(0.3) * within(t, 0, 2)),
}  # fmt: skip


@pytest.mark.parametrize("name", MODULATED)
def test_sines_are_added_multiplied_and_gated(name):
    """Against numpy; the integral and the rate against quadrature and differences of the same formula."""
    given, formula = MODULATED[name]
    made = wave(given)
    times = np.linspace(-1.003, 4.001, 700)
    assert [made(t) for t in times] == pytest.approx(formula(times).tolist(), abs=1e-13)
    fine = np.linspace(0, 4, 400_001)
    middle = formula((fine[1:] + fine[:-1]) / 2)
    total = np.concatenate([[0], np.cumsum(middle) * (fine[1] - fine[0])])
    integral, rate = made.integral(0.0), made.derivative()
    assert [integral(t) for t in fine[::20_000]] == pytest.approx(total[::20_000].tolist(), abs=1e-8)
    smooth = [t for t in times if all(abs(t - border) > 2e-5 for border in made.borders)]
    slopes = [(formula(t + 1e-5) - formula(t - 1e-5)) / 2e-5 for t in smooth]
    assert [rate(t) for t in smooth] == pytest.approx(slopes, abs=1e-6)
    assert all(abs(height) < 1e-12 for _, height in integral.jumps())


@pytest.mark.parametrize(
    ("given", "path", "says"),
    [
        ({"ramp": [{"to": "3 N", "over": "1 s"}, {"to": "3 m", "over": "1 s"}]}, ("ramp", 1, "to"), "is a length"),
        ({"sine": [SINE, {"amplitude": "1 m", "frequency": 1}]}, ("sine", 1, "amplitude"), "is a length"),
        ({"sine": [{"amplitude": 1, "frequency": k} for k in range(1, 20)]}, (), "these are 18 sines and more"),
        ({"product": {"of": {"sine": [SINE, SLOW]}, "times": {"sine": {**SINE, "amplitude": "2 N"}}}},
         ("product", "times", "sine", "amplitude"), "is a force, not a plain number"),
        ({"pulses": {"to": 1, "every": 1, "wide": 1, "count": 3}}, ("pulses",), "narrower than the time between"),
        ({"pulses": {"to": 1, "every": 1, "wide": 0.5, "count": 2.5}}, ("pulses", "count"), "no number of pulses"),
        ({"pulses": {"to": 1, "every": 1, "wide": 0.5, "count": 1e6}}, ("pulses", "count"), "no number of pulses"),
        ({"gate": {"of": 3, "start": 2, "stop": 1}}, ("gate", "stop"), "is not after start"),
        ({"gate": {"of": {"sine": {"amplitude": 1}}, "stop": 1}}, ("gate", "of", "sine"), "frequency is missing"),
        ({"product": {"of": 3, "times": "2 N"}}, ("product", "times"), "is a force, not a plain number"),
        ({"product": {"of": 3}}, ("product",), "times is missing"),
        ({"sine": {"amplitude": 1, "omega": 3}}, ("sine", "omega"), "Did you mean frequency?"),
        ({"pulses": {"to": 1, "period": 1, "wide": 0.5, "count": 2}}, ("pulses", "period"), "Did you mean every?"),
        ({"square": {"amplitude": 1}}, ("square",), "Did you mean pulses?"),
        ({"cosine": {"amplitude": 1, "frequency": 1}}, ("cosine",), "Did you mean sine with phase: 90 deg?"),
        ({"product": {"of": SQUARE, "times": SQUARE}}, ("product",), "a degree above 3"),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_term_is_told_at_its_place(given, path, says):
    with pytest.raises(TableError) as caught:
        wave(given)
    assert says in str(caught.value)
    assert caught.value.path == path
