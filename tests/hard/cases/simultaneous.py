"""Many contacts that switch in one and the same instant."""

from __future__ import annotations

import numpy as np

from tests.hard.play import PRESLIDING, Play
from tests.hard.registry import case

SIZES = {"1 contact": {"blocks": 1}, "10": {"blocks": 10}, "100": {"blocks": 100}, "1000": {"blocks": 1000}}
COST = {"100": "fair", "1000": "slow"}


def row_of_blocks(blocks: int, stiction: float, load: str) -> str:
    """Equal blocks of 1 kg on the floor, each under the same load, with a spring between neighbours."""
    parts = ["components:", "  floor: {type: Ground}"]
    floor = ["floor.flange"]
    joins = []
    for i in range(blocks):
        parts.append(f"  m{i}: {{type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}}")
        parts.append(f"  f{i}: {{type: ForceSource, force: {load}}}")
        curve = f"{{curve: coulomb, stiction: {stiction}, coulomb: 0.4}}"
        parts.append(f"  c{i}: {{type: Contact, normal_force: 10 N, curve: {curve}}}")
        floor.append(f"c{i}.a")
        here = [f"m{i}.flange", f"f{i}.flange", f"c{i}.b"]
        if i:
            parts.append(f"  s{i}: {{type: SpringDamper, stiffness: 1e4 N/m, damping: 1 N*s/m}}")
            here.append(f"s{i}.b")
        if i < blocks - 1:
            here.append(f"s{i + 1}.a")
        joins.append(f"  - [{', '.join(here)}]")
    joins.append(f"  - [{', '.join(floor)}]")
    few = ", ".join(f"m{i}.x, m{i}.v, c{i}.slip" for i in sorted({0, blocks // 2, blocks - 1}))
    tail = ["friction: {method: hold}", "run: {stop: 1.5 s, accuracy: 1e-6}",
            f"record: {{signals: [{few}], every: 5 ms}}", ""]  # fmt: skip
    return "\n".join([*parts, "connections:", *joins, *tail])


def few(result, quantity: str) -> np.ndarray:
    """First, middle and last block side by side."""
    return result.columns([f"{name}.{quantity}" for name in sorted({n.split(".")[0] for n in result.match("m*.x")})])


@case(SIZES, cost=COST, budget=120.0)
def blocks_let_go_in_one_instant(play: Play, blocks: int) -> None:
    """Equal blocks with springs between them; the load of each grows by 5 N/s up to and beyond its stiction of 4 N.

    Oracle: all let go at 0.8 s and move as one, x = 5 (t - 0.8)^3/6; no spring is ever stretched.
    """
    # Without stiction above Coulomb friction all treatments go to the same limit.
    result = play.run(row_of_blocks(blocks, 0.4, "{drift: {rate: 5 N/s}}"))
    x, t = few(result, "x"), result.t
    exact = 5 * np.maximum(t - 0.8, 0.0) ** 3 / 6
    # Binding creeps for 0.8 s at most at its creep. Bristles give way by some z while the excess force grows from 0:
    # a head start of (6 z/5)^(1/3) s at most, times the speed at the end.
    ahead = (6 * PRESLIDING / 5) ** (1 / 3) * 5 * 0.7**2 / 2
    play.near("position of a block", x, exact[:, None], play.by(3e-6, 2e-5, ahead))
    play.near("difference of two blocks", x - x[:, :1], 0.0, 1e-9)


@case(SIZES, cost=COST, budget=120.0, treatments=("hold", "binding"))
def blocks_let_go_in_one_instant_with_a_jump(play: Play, blocks: int) -> None:
    """The same with a stiction of 5 N above the sliding friction of 4 N.

    Oracle: all let go at 1 s; m v' = 5 t - 4 from there on; no spring is stretched.
    """
    result = play.run(row_of_blocks(blocks, 0.5, "{drift: {rate: 5 N/s}}"))
    x, late = few(result, "x"), np.maximum(result.t - 1.0, 0.0)
    exact = late**2 / 2 + 5 * late**3 / 6
    play.near("position of a block", x, exact[:, None], play.by(2e-6, 3e-5))
    play.near("difference of two blocks", x - x[:, :1], 0.0, 1e-9)


@case(SIZES, cost=COST, budget=120.0)
def blocks_stop_in_one_instant(play: Play, blocks: int) -> None:
    """Equal blocks pushed with 8 N each until 0.5 s and then left alone stop together.

    Oracle: stop after 0.5 s more at x = 1 m, at rest from there on; no spring is stretched; the heat is 4 N x 1 m each.
    """
    result = play.run(row_of_blocks(blocks, 0.4, "{step: {from: 8 N, to: 0 N, at: 0.5 s}}"))
    x, v, t = few(result, "x"), few(result, "v"), result.t
    late = np.clip(t - 0.5, 0.0, 0.5)
    ahead = 2.0 * np.sqrt(2 * PRESLIDING / 4)  # bristles that are still straight let it start faster, by their travel
    exact = np.where(t < 0.5, 2 * t**2, 0.5 + 2 * late - 2 * late**2)
    play.near("position of a block", x, exact[:, None], play.by(2e-6, 3e-5, ahead))
    play.near("difference of two blocks", x - x[:, :1], 0.0, 1e-9)
    play.near("speed at the end", v[-1], 0.0, play.by(1e-9, 1e-6, 1e-4))
    play.near("heat of a block", result.run["energy"]["dissipated"] / blocks, 4.0, play.by(1e-4, 1e-3, 4 * ahead))
