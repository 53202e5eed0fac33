"""Slip that goes through zero, or just reaches it."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

from tests.hard.play import CREEP, PRESLIDING, RELAXATION, Play
from tests.hard.registry import case

FRICTION = 3.0  # N on 1 kg


def thrown(load: str, speed: float, friction: float = FRICTION, stop: float = 2.0) -> str:
    """A block of 1 kg thrown over the floor under a load."""
    return f"""
    components:
      floor: {{type: Ground}}
      block: {{type: Mass, mass: 1 kg, position: 0 m, velocity: {speed!r} m/s}}
      pad: {{type: Contact, normal_force: 10 N, curve: {friction / 10!r}}}
      pull: {{type: ForceSource, force: {load}}}
    connections: [[floor.flange, pad.a], [pad.b, block.flange, pull.flange]]
    friction: {{method: hold}}
    run: {{stop: {stop!r} s, accuracy: 1e-6}}
    """


def late(play: Play, speed: float, acceleration: float, time: float) -> float:
    """What position may be off [m]: rounding; creep, or below v_n while not caught; a head start of bristles."""
    bend = np.sqrt(2 * PRESLIDING / acceleration) + 2 * RELAXATION
    return play.by(3e-6, 4 * CREEP * time + 4 * CREEP * speed, 2 * bend * speed)


@case({"it stays": {"weight": 2.0}, "at the limit": {"weight": 3.0}, "it slides back": {"weight": 5.0}})
def block_thrown_up_a_slope(play: Play, weight: float) -> None:
    """Thrown up a slope the block comes to rest where its friction turns round: below, at and above what then holds.

    Oracle: up with (weight + 3 N)/1 kg, then rest, or down with (weight - 3 N)/1 kg.
    """
    result = play.run(thrown(f"{-weight!r} N", 2.0))
    up, down = weight + FRICTION, max(weight - FRICTION, 0.0)
    top = 2.0 / up
    t = result.t
    exact = np.where(t < top, 2 * t - up * t**2 / 2, 2.0**2 / up / 2 - down * np.maximum(t - top, 0) ** 2 / 2)
    within = late(play, max(down * (2 - top), 2.0), max(down, 1.0), 2.0)
    if play.treatment == "lugre" and weight == FRICTION:
        within = 2 * np.sqrt(2 * FRICTION * PRESLIDING)  # at its limit it keeps what speed the bristles left it
    play.near("position", result["block.x"], exact, within)


@case({"holds": {"load": 3.0}, "pulled on": {"load": 6.0}, "pulled back": {"load": -6.0}})
def load_steps_at_the_instant_of_the_stop(play: Play, load: float) -> None:
    """A sliding block stops at 0.25 s, and exactly then its load steps up: a guard and a time event at once.

    Oracle: at rest at 0.125 m; from there it stays under 3 N, and slides with 2 N under 6 N either way.
    """
    result = play.run(thrown(f"{{step: {{to: {load!r} N, at: 0.25 s}}}}", 1.0, friction=4.0, stop=1.25))
    on = np.sign(load) * max(abs(load) - 4.0, 0.0)
    t = result.t
    exact = np.where(t < 0.25, t - 2 * t**2, 0.125 + on * np.maximum(t - 0.25, 0) ** 2 / 2)
    play.near("position", result["block.x"], exact, late(play, 2.0, 2.0, 1.25))


def swing(amplitude: float, rate: float, friction: float, stop: float) -> list[tuple[float, float, float]]:
    """Piece by piece (start, position, speed) of  v' = A sin(w t) - F sgn v  that never sticks: closed form, root."""
    pieces, t, x, v, sign = [], 0.0, 0.0, -amplitude / rate, -1.0

    def speed(s: float) -> float:
        return v + amplitude / rate * (np.cos(rate * t) - np.cos(rate * s)) - sign * friction * (s - t)

    while t < stop:
        pieces.append((t, x, v))
        grid = t + np.linspace(1e-6, 1.2, 4000) * np.pi / rate
        signs = np.array([speed(s) for s in grid]) * sign
        k = int(np.argmax(signs < 0))
        if k == 0:
            break
        end = brentq(speed, grid[k - 1], grid[k], xtol=1e-15)
        x, v, t, sign = _moved(x, v, t, end, amplitude, rate, sign * friction), 0.0, end, -sign
    return pieces


def _moved(x: float, v: float, t: float, s: float, amplitude: float, rate: float, friction: float) -> float:
    c = amplitude / rate
    rise = c * np.cos(rate * t) * (s - t) - c / rate * (np.sin(rate * s) - np.sin(rate * t))
    return x + v * (s - t) + rise - friction * (s - t) ** 2 / 2


@case()
def shaken_to_and_fro_without_sticking(play: Play) -> None:
    """A load of 20 N at 2 Hz turns a block round again and again against 3 N; it never sticks.

    Oracle: pieces in closed form, joined where the speed is zero (roots to the last digit); 20 reversals in 5 s.
    """
    amplitude, rate = 20.0, 4 * np.pi
    load = f"{{sine: {{amplitude: {amplitude!r} N, frequency: 2 Hz}}}}"
    result = play.run(thrown(load, -amplitude / rate, stop=5.0))
    pieces = swing(amplitude, rate, FRICTION, 5.0)
    play.check(len(pieces) >= 20, f"the oracle has {len(pieces)} pieces, and is broken")
    for start, x, _ in pieces[1:]:
        play.near(f"position at {start:.4f} s, where it turns", result.at("block.x", start), x,
                  play.by(2e-5, 2e-4, 8 * RELAXATION * amplitude / rate))  # fmt: skip
