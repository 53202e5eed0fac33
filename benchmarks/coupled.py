"""A winch coupled with its sampled controller, which is a program of its own, beside the run of both as one model.

    python benchmarks/coupled.py            # the table, and coupled.png

The controller is `Electronics`: plain Python that shares no line with the component `PiController`. Plant and
controller exchange speed and command every H and hold them in between; the controller goes on in samples of
Ts = 10 ms. With H = Ts nothing is held longer than in one model, so that both must agree to the tolerance of the
engine; a longer H adds a delay to the loop.
"""

from __future__ import annotations

import pathlib
import sys
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import fairlead

HERE = pathlib.Path(__file__).parent
PERIOD = 0.01  # s
HELD = (1, 2, 5, 10)  # H/Ts
ACCURACY = 1e-6


@dataclass
class Electronics:
    """PI with feed-forward, limits of +-1, slew and back-calculation; the value it works on is one sample old."""

    gain: float = 0.3
    integral_time: float = 0.3
    feed_forward: float = 1 / 1.15
    slew: float = 2.0
    tracking_time: float = 0.15
    integral: float = 0.0
    command: float = 0.0
    before: float = 0.0

    def sample(self, reference: float, measured: float) -> float:
        """The command from here on."""
        error = reference - self.before
        wanted = self.feed_forward * reference + self.gain * error + self.integral
        room = self.slew * PERIOD
        self.command = min(max(min(max(wanted, -1.0), 1.0), self.command - room), self.command + room)
        windup = (self.command - wanted) / self.tracking_time
        self.integral += PERIOD * (self.gain / self.integral_time * error + windup)
        self.before = measured
        return self.command


def reference(t: float) -> float:
    """Speed wanted [m/s]: 0.3 m/s, reached in a second."""
    return 0.3 * min(t, 1.0)


def coupled(held: int, stop: float, accuracy: float = ACCURACY) -> NDArray[np.float64]:
    """Speed of the line at all multiples of H = `held` Ts up to `stop` [m/s]."""
    plant, electronics = fairlead.load(HERE / "coupled_winch.yaml").start(accuracy=accuracy), Electronics()
    speeds = [plant.get("speed")]
    for k in range(0, round(stop / PERIOD), held):
        plant.set("command", electronics.sample(reference(PERIOD * k), speeds[-1]))
        for more in range(1, held):  # the controller goes on by itself
            electronics.sample(reference(PERIOD * (k + more)), speeds[-1])
        plant.advance(PERIOD * (k + held))
        speeds.append(plant.get("speed"))
    return np.array(speeds)


def together(stop: float, accuracy: float = ACCURACY) -> NDArray[np.float64]:
    """Speed of the line at all multiples of Ts, of plant and controller in one model, run in one piece [m/s]."""
    one = fairlead.load("winch_drive", set={"run.stop": stop, "run.accuracy": accuracy}).run(out=None)
    return np.array([one.at("line.v", PERIOD * k) for k in range(round(stop / PERIOD) + 1)])


def main(file: str = "coupled.png", stop: float = 8.0) -> None:
    """Print the table and draw the figure."""
    import matplotlib.pyplot as plt

    one = together(stop)
    figure, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
    axes.plot(PERIOD * np.arange(len(one)), one, "k", label="one model")
    print("H/Ts  largest difference of speed, over the largest speed")
    for m in HELD:
        speed = coupled(m, stop)
        print(f"{m:4d}  {np.max(np.abs(speed - one[::m])) / np.max(np.abs(one)):.2e}")
        axes.plot(m * PERIOD * np.arange(len(speed)), speed, lw=1, label=f"coupled, H = {m} Ts")
    axes.set(xlabel="time [s]", ylabel="speed of the line [m/s]")
    axes.legend()
    figure.savefig(file, dpi=150)


if __name__ == "__main__":
    main(*sys.argv[1:2])
