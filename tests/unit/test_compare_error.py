"""The error that `compare` shows: relative to how far a signal moves, and of what hardly moves to what moves most."""

from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.analysis.cost.compare import LEAST, _error, compare


class Recorded(dict[str, np.ndarray]):
    """Positions by name at common times, as a result has them."""

    t = np.linspace(0.0, 1.0, 101)

    @property
    def signals(self):
        return [SimpleNamespace(name=name, unit="m") for name in self]

    def match(self, _pattern):
        return list(self)

    def at(self, name, t):
        return np.interp(t, self.t, self[name])


def test_a_block_that_moves_by_rounding_does_not_make_the_error():
    """A difference of 1e-9 m on a range of 1e-12 m is not an error of a thousand where another block moves by 0.1 m."""
    t = Recorded.t
    right = Recorded(moves=0.1 * t, rests=1e-12 * t)
    found = Recorded(moves=0.1 * t + 1e-4, rests=1e-12 * t + 1e-9)
    error, name = _error(found, right, "*")
    assert (name, error) == ("moves", pytest.approx(1e-4 / 0.1))


def test_a_block_that_should_rest_and_does_not_still_counts():
    """Relative to a thousandth of what moves most, so that 1 mm beside 0.1 m is an error of ten."""
    t = Recorded.t
    error, name = _error(Recorded(moves=0.1 * t, rests=0 * t + 1e-3), Recorded(moves=0.1 * t, rests=0 * t), "*")
    assert (name, error) == ("rests", pytest.approx(1e-3 / (LEAST * 0.1)))


def test_where_nothing_moves_there_is_no_error():
    """A block that is held: what is left is rounding, of which no difference is a share."""
    t = Recorded.t
    right = Recorded(one=5.0 + 1e-16 * t, other=1e-18 * t)
    assert _error(Recorded(one=5.0 + 1e-9 * t, other=1e-5 * t), right, "*") == (None, "")


SWINGS = """
    components:
      g: {type: Ground}
      s: {type: Spring, stiffness: 100 N/m}
      m: {type: Mass, mass: 1 kg, position: 0.5 m}
      c: {type: SlideFriction, sliding: 1 N}
    connections: [[g.flange, s.a, c.a], [s.b, m.flange, c.b]]
    run: {stop: 20 s}
"""


def closed(t):
    """Half swings about +-F/k, 2 F/k less each time, until it lies where the spring cannot move it."""
    omega, offset, start = 10.0, 0.01, 0.5
    half = np.pi / omega
    number = np.minimum((t / half).astype(int), 25)
    turn = start - 2 * offset * number  # how far out the half swing begins; at 0 it stays
    centre = offset * (1 - 2 * (number % 2))
    begins = turn * (1 - 2 * (number % 2))
    return np.where(turn > offset, centre + (begins - centre) * np.cos(omega * (t - number * half)), 0.0)


def test_the_error_is_that_of_the_motion_and_not_of_lines_between_its_rows(scene, tmp_path):
    """By lines exact hold had 1.2e-4, more than binding, and both only because their steps are as long as they are."""
    vary = {"friction.method": ["hold", "binding"]}
    found = compare(lambda chosen: scene(SWINGS, **chosen), vary, out=tmp_path / "compared")
    hold, binding = (row.error for row in found.rows)
    t = np.linspace(0.0, 20.0, 4001)
    run = scene(SWINGS).run(out=None)
    right = float(np.sqrt(np.mean((run.at("m.x", t) - closed(t)) ** 2)) / np.ptp(closed(t)))
    assert hold == pytest.approx(right, rel=0.2)
    assert hold < 5e-6
    assert hold < binding


def test_the_error_does_not_depend_on_how_often_the_scene_is_recorded(scene, tmp_path):
    """Lines between points of a coarse grid were told as an error a hundred times too large."""
    errors = []
    for every in ("", "record: {every: 0.3 s}"):
        text = f"{SWINGS}    {every}"

        def load(settings, text=text):
            return scene(text, **settings)

        found = compare(load, {"friction.method": ["hold", "tanh"]}, out=tmp_path / (every[:6] or "all"))
        errors.append([row.error for row in found.rows])
    assert errors[0] == pytest.approx(errors[1], rel=1e-9)
    assert errors[0][1] > 2 * errors[0][0] > 0.0


@pytest.mark.parametrize("order", [["1e-2", "1e-5"], ["1e-5", "1e-2"]])
def test_the_reference_is_finer_than_the_finest_accuracy_of_the_list(scene, tmp_path, order):
    """It was a hundredth of the first, 1e-4: its own error was told as that of the run at 1e-5."""

    def load(settings):
        return scene(SWINGS, **settings)

    found = compare(load, {"run.accuracy": order}, settings={"run.stop": "3 s"}, out=tmp_path / "compared")
    assert found.reference == "the scene at accuracy 1e-07"
    t = np.linspace(0.0, 3.0, 4001)
    for row in found.rows:
        run = scene(SWINGS).run(out=None, accuracy=float(row.label), stop=3.0)
        right = float(np.sqrt(np.mean((run.at("m.x", t) - closed(t)) ** 2)) / np.ptp(closed(t)))
        assert row.error == pytest.approx(right, rel=0.2)


def test_a_parameter_that_the_accuracy_is_made_of_counts_as_well(scene, tmp_path):
    text = f"{SWINGS}    parameters: {{fine: 1e-3}}".replace("stop: 20 s", "stop: 1 s, accuracy: '{fine}'")
    found = compare(lambda chosen: scene(text, **chosen), {"fine": ["1e-3", "1e-5"]}, out=tmp_path / "compared")
    assert found.reference == "1e-5 at accuracy 1e-07"
