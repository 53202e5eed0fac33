"""Two ties join three ports to one degree of freedom, as docs/components.md shows."""

import pathlib
import re

import pytest

PAGE = pathlib.Path(__file__).parents[2] / "docs" / "components.md"
SCENE = """
components:
  one: {type: Mass, mass: 1 kg}
  two: {type: Mass, mass: 1 kg}
  three: {type: Mass, mass: 1 kg}
  yoke: {type: Yoke, ratio: 2}
  push: {type: ForceSource, force: 3 N}
connections: [[one.flange, yoke.a, push.flange], [two.flange, yoke.b], [three.flange, yoke.c]]
run: {stop: 1 s, accuracy: 1e-6}
record: {signals: [one.v, two.v, three.v]}
"""


def test_three_masses_on_one_lever_move_as_one(simulate, library):
    """(1 + 2^2 + (-1)^2) kg are moved by 3 N: v = 0.5 m/s after 1 s, twice that at b and the opposite at c."""
    text = re.search(r"<!-- file: yoke.py -->\n```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)[1]
    result = simulate(SCENE, libraries=(library(text),))
    assert [result[f"{name}.v"][-1] for name in ("one", "two", "three")] == pytest.approx([0.5, 1.0, -0.5], rel=1e-4)
