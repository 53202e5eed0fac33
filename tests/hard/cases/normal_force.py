"""Normal forces that vanish and come back."""

from __future__ import annotations

import numpy as np

from tests.hard.play import CREEP, Play
from tests.hard.registry import case

LIFTED = """
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
  anvil: {type: Mass, mass: 1e9 kg}
  press: {type: ForceSource, force: @PRESS@}
  pad: {type: Contact, curve: 0.5}
  pull: {type: ForceSource, force: 2 N}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, pull.flange]
  - [press.flange, anvil.flange]
  - [press.force, pad.normal]
friction: {method: hold}
run: {stop: 4 s, accuracy: 1e-6}
record: {signals: [block.*, pad.*], every: 5 ms}
effects: {energy: off}
"""


def sliding(t: np.ndarray, normal: list[tuple[float, float]]) -> np.ndarray:
    """Positions of 1 kg under 2 N and 0.5 N(t), N linear between points: v' by pieces of time, 1e5 of them."""
    fine = np.linspace(0.0, t[-1], 400_001)
    n = np.interp(fine, *np.array(normal).T)
    h = fine[1]
    v = np.zeros_like(fine)
    for k in range(1, len(fine)):
        limit = 0.25 * (n[k] + n[k - 1])
        v[k] = v[k - 1] + h * (2 - limit) if v[k - 1] > 0 or limit < 2 else 0.0
        v[k] = max(v[k], 0.0)
    x = np.concatenate([[0.0], np.cumsum((v[1:] + v[:-1]) / 2 * h)])
    return np.interp(t, fine, x)


@case(
    {
        "in ramps": {"points": [(0, 10), (1, 0), (1.5, 0), (2.5, 10), (4, 10)]},
        "touching zero": {"points": [(0, 10), (1, 0), (2, 10), (4, 10)]},
        "at once": {"points": [(0, 10), (1, 10), (1 + 1e-9, 0), (1.5, 0), (1.5 + 1e-9, 10), (4, 10)]},
        "four times": {"points": [(k / 2, 10.0 * (k % 2 == 0)) for k in range(9)]},
    }
)
def normal_force_to_zero_and_back(play: Play, points: list[tuple[float, float]]) -> None:
    """What presses a block goes to zero and comes back while 2 N pull; it slides where 0.5 N(t) is less than that.

    Oracle: speed and position by quadrature of m v' = 2 - 0.5 N(t), apart from fairlead; friction never above 0.5 N(t).
    """
    table = ", ".join(f"[{t!r} s, {n!r} N]" for t, n in points)
    result = play.run(LIFTED.replace("@PRESS@", f"{{table: [{table}]}}"))
    exact = sliding(result.t, points)
    play.near("position", result["block.x"], exact, play.by(2e-5, 2e-5 + 4 * CREEP, 1e-2))
    limit = 0.5 * np.interp(result.t, *np.array(points).T)
    if play.treatment != "lugre":  # whose bristles may be bent further than they slide
        over = (np.abs(result["pad.friction"]) - limit)[result.side == 0].max()
        play.check(over < 1e-5, f"friction is {over:.2g} N above its limit")
