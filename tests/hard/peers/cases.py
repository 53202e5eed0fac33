"""The cases: hard cases of tests/hard/cases that every tool can state, with the same closed forms."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from tests.hard.cases.chains import held_row
from tests.hard.cases.jumps_of_load import SHAFTS, STACK
from tests.hard.cases.normal_force import LIFTED, sliding
from tests.hard.cases.reversal import FRICTION, swing, thrown
from tests.hard.cases.simultaneous import row_of_blocks
from tests.hard.cases.stiction import LIMIT, SLIDING, loaded
from tests.hard.peers.dry import Dry, Reals

SOON = 1e-12
"""A jump is there so much before its time [s]: a tool that starts anew at the time may have rounded it down."""


@dataclass(frozen=True)
class PeerCase:
    """One case in two statements, and what is right."""

    name: str
    dry: Dry
    netlist: str
    signals: tuple[str, ...]
    """Positions of the bodies in the netlist, in the order of `dry`."""
    times: Reals
    """At which positions are compared; the last is the end."""
    exact: Callable[[Reals], Reals]
    """(times, bodies) of the positions found -> the right ones, or the right value of what `of` makes of them."""
    within: float
    """As in the hard case."""
    unit: str = "m"
    of: Callable[[Reals], Reals] = lambda x: x
    """What is compared: (times, bodies) of positions -> any shape."""
    stiff: bool = False

    def error(self, positions: Reals) -> float:
        """The largest difference from what is right."""
        return float(np.abs(self.of(positions) - self.exact(self.times)).max())


def always(*values: float) -> Callable[[float], Reals]:
    """The same at any time."""
    fixed = np.array(values, float)
    return lambda _t: fixed


def block(load: Callable[[float], Reals], sliding: float, stiction: float = 0.0, speed: float = 0.0) -> Dry:
    """A block of 1 kg on the floor."""
    return Dry(np.ones(1), np.array([speed]), load, np.ones((1, 1)), always(stiction or sliding), always(sliding))


def _lets_go(t: Reals) -> Reals:
    s = np.maximum(t, 1.0)
    return (5 * (s**3 - 3 * s + 2) / 6 - 1.5 * (s - 1) ** 2)[:, None]


def _stays(t: Reals) -> Reals:
    s = np.minimum(t, 0.4)
    return (2 * s - 2.5 * s**2)[:, None]


def _slides_back(t: Reals) -> Reals:
    return np.where(t < 0.25, 2 * t - 4 * t**2, 0.25 - (t - 0.25) ** 2)[:, None]


def _belt(t: Reals) -> Reals:
    late = np.maximum(t - 1, 0)
    return (0.2 * t + np.where(late < 0.1, 2.5 * late**2, 0.5 * late - 0.025))[:, None]


SHAKE, RATE = 20.0, 4 * np.pi


def _shaken(_t: Reals) -> Reals:
    return np.array([[x] for _, x, _ in _turns()])


def _turns() -> list[tuple[float, float, float]]:
    return swing(SHAKE, RATE, FRICTION, 5.0)[1:]


def row(blocks: int, load: Callable[[float], Reals], spring: float, damping: float, mass: float, limit: float) -> Dry:
    """Blocks on the floor with springs between neighbours."""
    springs = tuple((i, i + 1, spring, damping) for i in range(blocks - 1))
    limits = always(*[limit] * blocks)
    return Dry(np.full(blocks, mass), np.zeros(blocks), load, np.eye(blocks), limits, limits, springs)


def _pushed(t: float) -> Reals:
    return np.full(10, 8.0 if t < 0.5 - SOON else 0.0)


def _stop_together(t: Reals) -> Reals:
    fell = np.clip(t - 0.5, 0, 0.5)
    return np.repeat((2 * np.minimum(t, 0.5) ** 2 + 2 * fell - 2 * fell**2)[:, None], 10, axis=1)


def _both_ends(t: float) -> Reals:
    pull = np.zeros(10)
    pull[[0, -1]] = np.array([-1, 1]) * 3.5 * min(t / 10, 1.0)
    return pull


def _tensions(_t: Reals) -> Reals:
    one = np.maximum(3.5 - np.arange(1, 10), 0.0)
    return np.maximum(one, one[::-1])


def _stack() -> Dry:
    slip = np.array([[1.0, 0, 0], [-1, 1, 0], [0, -1, 1]])
    push = lambda t: np.array([0, 0, 6.45 if t >= 0.1 - SOON else 0.0])  # noqa: E731
    stiction, kinetic = always(6.3, 6.4, 6.5), always(6.0, 6.0, 5.0)
    return Dry(np.ones(3), np.zeros(3), push, slip, stiction, kinetic, breaks=(0.1,))


def _shafts() -> Dry:
    turn = lambda t: np.array([10.0, 0, -10]) * (t >= 0.3 - SOON)  # noqa: E731
    slip, arm = np.array([[-1.0, 1, 0], [0, -1, 1]]), 97 * 0.13
    return Dry(np.full(3, 0.7), np.zeros(3), turn, slip, always(*[0.5 * arm] * 2), always(*[0.4 * arm] * 2),
               breaks=(0.3,))  # fmt: skip


def _shafts_turn(t: Reals) -> Reals:
    end = (10 - 0.4 * 97 * 0.13) / 0.7 / 2 * np.maximum(t - 0.3, 0) ** 2
    return np.stack([end, 0 * t, -end], axis=1)


POINTS = [(0, 10), (1, 0), (1.5, 0), (2.5, 10), (4, 10)]


def _lifted() -> Dry:
    limit = lambda t: 0.5 * np.interp([t], *np.array(POINTS, float).T)  # noqa: E731
    return Dry(np.ones(1), np.zeros(1), always(2.0), np.ones((1, 1)), limit, limit, breaks=(1.0, 1.5, 2.5))


def cases() -> tuple[PeerCase, ...]:
    """All of them."""
    grow = lambda t: np.array([5.0 * t])  # noqa: E731
    equal = lambda t: np.full(10, 5.0 * t)  # noqa: E731
    shake = lambda t: np.array([SHAKE * np.sin(RATE * t)])  # noqa: E731
    belt = Dry(np.array([2.0]), np.array([0.2]), always(0.0), np.ones((1, 1)), always(10.0), always(10.0),
               belt=lambda t: 0.7 if t >= 1 - SOON else 0.2, breaks=(1.0,))  # fmt: skip
    together = row(10, _pushed, 1e4, 1.0, 1.0, 4.0)
    pushed = replace(together, breaks=(0.5,))
    ends = replace(row(10, _both_ends, 1e4, 20.0, 0.01, 1.0), breaks=(10.0,))
    ten = tuple(f"m{i}.x" for i in range(10))
    one = ("block.x",)
    shaken = np.array([t for t, _, _ in _turns()])

    def grid(stop: float) -> Reals:
        return np.linspace(0, stop, 21)

    def everything(text: str) -> str:
        head, _, _ = textwrap.dedent(text).partition("record:")
        return head + "\nrecord: {signals: ['*'], every: 10 ms}\n"

    return (
        PeerCase("load grows until a block lets go, stiction 5 N, sliding 3 N", block(grow, SLIDING, LIMIT),
                 everything(loaded("{drift: {rate: 5 N/s}}", stop=2.0)), one, grid(2.0), _lets_go, 1e-5),
        PeerCase("load of 0.8 of stiction for 10 s", block(always(4.0), LIMIT),
                 everything(loaded("4 N", sliding=LIMIT)), one, grid(10.0), lambda t: 0 * t[:, None], 1e-9),
        PeerCase("block thrown up a slope, it stays", block(always(-2.0), FRICTION, speed=2.0),
                 everything(thrown("-2 N", 2.0)), one, grid(2.0), _stays, 3e-6),
        PeerCase("block thrown up a slope, it slides back", block(always(-5.0), FRICTION, speed=2.0),
                 everything(thrown("-5 N", 2.0)), one, grid(2.0), _slides_back, 3e-6),
        PeerCase("belt that jumps in speed", belt, BELT, one, grid(2.0), _belt, 1e-5),
        PeerCase("shaken to and fro without sticking", block(shake, FRICTION, speed=-SHAKE / RATE),
                 everything(thrown("{sine: {amplitude: 20 N, frequency: 2 Hz}}", -SHAKE / RATE, stop=5.0)), one, shaken,
                 _shaken, 2e-5),
        PeerCase("ten blocks let go in one instant", row(10, equal, 1e4, 1.0, 1.0, 4.0),
                 everything(row_of_blocks(10, 0.4, "{drift: {rate: 5 N/s}}")), ten, grid(1.5),
                 lambda t: np.repeat((5 * np.maximum(t - 0.8, 0) ** 3 / 6)[:, None], 10, axis=1), 3e-6),
        PeerCase("ten blocks stop in one instant", pushed,
                 everything(row_of_blocks(10, 0.4, "{step: {from: 8 N, to: 0 N, at: 0.5 s}}")), ten, grid(1.5),
                 _stop_together, 3e-6),
        PeerCase("row of ten blocks pulled from both ends: tensions", ends,
                 everything(held_row(10, "{ramp: {to: 3.5 N, over: 10 s}}", 1.0, 12.0)), ten, grid(12.0), _tensions,
                 0.02, "N", lambda x: 1e4 * np.diff(x[-1]), stiff=True),
        PeerCase("stack of three under a load that jumps", _stack(),
                 everything(STACK.replace("@GOES@", "step: {to: 6.45 N, at: 0.1 s}")),
                 ("low.x", "middle.x", "top.x"), grid(1.1),
                 lambda t: np.repeat((0.075 * np.maximum(t - 0.1, 0) ** 2)[:, None], 3, axis=1), 1e-6),
        PeerCase("equal shafts turned against each other", _shafts(),
                 everything(SHAFTS.replace("@GOES@", "step").replace("@WHEN@", "at: 0.3 s")),
                 ("r1.angle", "r2.angle", "r3.angle"), grid(1.0), _shafts_turn, 1e-4, "rad"),
        PeerCase("normal force to zero and back", _lifted(),
                 everything(LIFTED.replace("effects: {energy: off}", "").replace(
                     "@PRESS@", "{table: [" + ", ".join(f"[{t} s, {n} N]" for t, n in POINTS) + "]}")),
                 one, grid(4.0), lambda t: sliding(t, POINTS)[:, None], 2e-5),
    )  # fmt: skip


BELT = """
components:
  belt: {type: MotionSource, velocity: {step: {from: 0.2 m/s, to: 0.7 m/s, at: 1 s}}}
  block: {type: Mass, mass: 2 kg, position: 0 m, velocity: 0.2 m/s}
  pad: {type: Contact, normal_force: 20 N, curve: 0.5}
connections: [[belt.flange, pad.a], [pad.b, block.flange]]
friction: {method: hold}
run: {stop: 2 s, accuracy: 1e-6}
record: {signals: ['*'], every: 10 ms}
"""
