"""Terms of quantities in time: several of a kind, pulses, products and gates, at times where the value is known."""

import pathlib

import pytest

from fairlead.component.given import Waveform
from fairlead.component.tables import TableError
from fairlead.component.waveforms import read_waveform

HERE = pathlib.Path()
LINE = {"ramp": {"to": 1, "over": 1}}
SQUARE = {"product": {"of": LINE, "times": LINE}}


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


@pytest.mark.parametrize(
    ("given", "path", "says"),
    [
        ({"ramp": [{"to": "3 N", "over": "1 s"}, {"to": "3 m", "over": "1 s"}]}, ("ramp", 1, "to"), "is a length"),
        ({"sine": [{"amplitude": 1, "frequency": 1}] * 2}, ("sine", 1), "there is a sine already"),
        ({"pulses": {"to": 1, "every": 1, "wide": 1, "count": 3}}, ("pulses",), "narrower than the time between"),
        ({"pulses": {"to": 1, "every": 1, "wide": 0.5, "count": 2.5}}, ("pulses", "count"), "no number of pulses"),
        ({"pulses": {"to": 1, "every": 1, "wide": 0.5, "count": 1e6}}, ("pulses", "count"), "no number of pulses"),
        ({"gate": {"of": 3, "start": 2, "stop": 1}}, ("gate", "stop"), "is not after start"),
        ({"gate": {"of": {"sine": {"amplitude": 1, "frequency": 1}}, "stop": 1}}, ("gate", "of"), "a sine has no ends"),
        ({"product": {"of": 3, "times": "2 N"}}, ("product", "times"), "is a force, not a plain number"),
        ({"product": {"of": 3}}, ("product",), "times is missing"),
        ({"product": {"of": SQUARE, "times": SQUARE}}, ("product",), "a degree above 3"),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_term_is_told_at_its_place(given, path, says):
    with pytest.raises(TableError) as caught:
        wave(given)
    assert says in str(caught.value)
    assert caught.value.path == path
