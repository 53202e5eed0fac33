"""The handling system coupled with its control electronics, which are a program of their own, beside both as one model.

    python benchmarks/coupled_route.py            # the table, and coupled_route.png
    python benchmarks/coupled_route.py --long     # whether it swings up in 20 s, for each H (a minute)

The plant is models/coupled/plant.yaml: array, route, two drives, their oil. `Electronics` is plain Python that shares
no line with fairlead's controllers. The two exchange speeds, tension and commands every H and hold them in between; the
electronics go on in samples of Ts = 10 ms. With H = Ts nothing is held longer than in the one model, the bundled
`guidance_route`, so that both must agree to the tolerance of the engine; a longer H adds a delay to the loops.
"""

from __future__ import annotations

import pathlib
import sys
import warnings
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

import fairlead

PLANT = pathlib.Path(__file__).parents[1] / "models" / "coupled" / "plant.yaml"
PERIOD = 0.01  # s
HELD = (1, 2, 5, 10)  # H/Ts
ACCURACY = 1e-6
STOP = 8.0  # s
MEASURED = ("belt_speed", "drum_speed", "tension")
ONE = {"belt_speed": "belt_speed.signal", "drum_speed": "drum_speed.signal", "tension": "route.tensiometer.tension"}
"""Signals of the bundled model that are the same."""


@dataclass
class Pi:
    """PI with feed-forward, limits of +-1, slew and back-calculation; the value it works on is one sample old."""

    gain: float
    integral_time: float
    feed_forward: float
    slew: float
    ahead_gain: float = 0.0
    integral: float = 0.0
    command: float = 0.0
    before: float = 0.0

    def sample(self, reference: float, measured: float, ahead: float = 0.0) -> None:
        """One sample; what follows is in `command`."""
        error = reference - self.before
        wanted = self.feed_forward * reference + self.ahead_gain * ahead + self.gain * error + self.integral
        room = self.slew * PERIOD
        self.command = min(max(min(max(wanted, -1.0), 1.0), self.command - room), self.command + room)
        windup = (self.command - wanted) / (self.integral_time / 2)
        self.integral += PERIOD * (self.gain / self.integral_time * error + windup)
        self.before = measured


@dataclass
class Electronics:
    """Four tasks of one period, which pass what they give to one another at the next sample.

    A shaper turns the speed wanted into a trapezoid with rounded corners; a trim adds to it what keeps the tension
    of 200 N at the winch; each drive has a PI on its speed.
    """

    samples: int = 0
    speed: float = 0.0  # m/s, shaped
    rate: float = 0.0  # m/s^2
    trimmed: float = 0.0  # m/s, the reference of the winch
    trim: float = 0.0  # m/s, integral
    tension: float = 200.0  # N, one sample ago
    deployer: Pi = field(default_factory=lambda: Pi(0.3, 0.5, 0.64, 5.0))
    winch: Pi = field(default_factory=lambda: Pi(0.3, 0.3, 1 / 1.15, 2.0, ahead_gain=0.03))

    def sample(self, belt_speed: float, drum_speed: float, tension: float) -> dict[str, float]:
        """The commands from here on."""
        speed, rate, trimmed = self.speed, self.rate, self.trimmed  # what the tasks told at the sample before
        self._shape(wanted(PERIOD * self.samples))
        self._trim(speed, tension)
        self.deployer.sample(speed, belt_speed)
        self.winch.sample(trimmed, drum_speed, rate)
        self.samples += 1
        return {"deployer_command": self.deployer.command, "winch_command": self.winch.command}

    def _shape(self, target: float) -> None:
        """At most 0.5 m/s^2 and 2 m/s^3, and slow enough to stop at the target."""
        left = target - self.speed
        most = min(0.5, np.sqrt(2 * 2 * abs(left)))
        rate = min(max(left / PERIOD, -most), most)
        self.rate = min(max(rate, self.rate - 2 * PERIOD), self.rate + 2 * PERIOD)
        self.speed += self.rate * PERIOD

    def _trim(self, speed: float, tension: float) -> None:
        """PI on the tension, at most 0.2 m/s: too tight a line is paid out faster."""
        error = self.tension - 200.0
        asked = 5e-5 * error + self.trim
        given = min(max(asked, -0.2), 0.2)
        self.trim += PERIOD * (5e-5 / 0.2 * error + 2 * (given - asked) / 0.2)
        self.trimmed, self.tension = speed + given, tension


def wanted(t: float) -> float:
    """Speed of the line that is asked for [m/s]: 0.5 m/s from the start."""
    return 0.5 * min(t / 0.01, 1.0)


def coupled(held: int, stop: float = STOP, accuracy: float = ACCURACY) -> dict[str, NDArray[np.float64]]:
    """What is measured at all multiples of H = `held` Ts up to `stop`, with the electronics in Python."""
    plant, electronics = fairlead.load(PLANT).start(accuracy=accuracy), Electronics()
    found = [[plant.get(name) for name in MEASURED]]  # settled without a command, as for the first sample of one model
    for k in range(0, round(stop / PERIOD), held):
        for name, value in electronics.sample(*found[-1]).items():
            plant.set(name, value)
        for _ in range(1, held):  # the electronics go on by themselves
            electronics.sample(*found[-1])
        plant.advance(PERIOD * (k + held))
        found.append([plant.get(name) for name in MEASURED])
    return dict(zip(MEASURED, np.array(found).T, strict=True))


def together(stop: float = STOP, accuracy: float = ACCURACY) -> dict[str, NDArray[np.float64]]:
    """The same at all multiples of Ts, of plant and electronics in one model, run in one piece."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fairlead.errors.RunWarning)
        given = {"run.stop": stop, "run.accuracy": accuracy, "record.every": PERIOD}
        one = fairlead.load("guidance_route", set=given).run(out=None)
    times = PERIOD * np.arange(round(stop / PERIOD) + 1)
    return {name: one.at(signal, times) for name, signal in ONE.items()}


def off(
    found: dict[str, NDArray[np.float64]], one: dict[str, NDArray[np.float64]], held: int
) -> dict[str, tuple[float, float]]:
    """Largest and root mean square difference of each signal, over its largest value."""
    far = {name: (found[name] - one[name][::held]) / np.max(np.abs(one[name])) for name in found}
    return {name: (float(np.max(np.abs(d))), float(np.sqrt(np.mean(d**2)))) for name, d in far.items()}


LONG = 45.0  # s
PIECES = ((4.0, 8.0), (8.0, 12.0), (12.0, 16.0), (16.0, 20.0))  # s


def swings(found: NDArray[np.float64], one: NDArray[np.float64], held: int) -> list[float]:
    """How far a coupled signal swings about that of the one model in each of PIECES."""
    beside = one[::held]
    count = min(len(found), len(beside))
    away = found[:count] - beside[:count]
    places = [[round(t / (held * PERIOD)) for t in piece] for piece in PIECES]
    return [float(np.ptp(away[first:last])) for first, last in places]


def long(accuracy: float = 1e-4) -> None:
    """Print the swing of the belts about the one model, by H and by piece of time."""
    one = together(LONG, accuracy)["belt_speed"]
    pieces = ", ".join(f"{begin:g}-{end:g} s" for begin, end in PIECES)
    print(f"H/Ts  swing of the belt speed about that of the one model [m/s], in {pieces}")
    for held in (1, 2, 3, 4, 5, 10):
        found = coupled(held, LONG - LONG % (held * PERIOD), accuracy)["belt_speed"]
        print(f"{held:4d}  " + "  ".join(f"{most:.1e}" for most in swings(found, one, held)))


def main(file: str = "coupled_route.png") -> None:
    """Print the table and draw the figure."""
    import matplotlib.pyplot as plt

    one = together()
    figure, axes = plt.subplots(len(MEASURED), sharex=True, figsize=(8, 8), layout="constrained")
    print("H/Ts  largest and rms difference over the largest value, of " + ", ".join(MEASURED))
    for m in HELD:
        found = coupled(m)
        print(f"{m:4d}  " + "  ".join(f"{most:.1e} {mean:.1e}" for most, mean in off(found, one, m).values()))
        for panel, name in zip(axes, MEASURED, strict=True):
            panel.plot(m * PERIOD * np.arange(len(found[name])), found[name], lw=1, label=f"coupled, H = {m} Ts")
    for panel, name, unit in zip(axes, MEASURED, ("m/s", "m/s", "N"), strict=True):
        panel.plot(PERIOD * np.arange(len(one[name])), one[name], "k--", lw=1, label="one model")
        panel.set_ylabel(f"{name.replace('_', ' ')} [{unit}]")
    axes[-1].set_xlabel("time [s]")
    axes[0].legend()
    figure.savefig(file, dpi=150)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--long"]:
        long()
    else:
        main(*sys.argv[1:2])
