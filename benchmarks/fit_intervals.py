"""How often the 95 % intervals of a fit hold the truth over many seeds of noise, and how wide they are.

    python -m benchmarks.fit_intervals [--seeds 100]

The records are closed forms that know nothing of fairlead, with noise: the belt of Rabinowicz (1951), which sticks and
slips for ever, and a block on a spring with dry friction, which swings in half cycles and sticks (Den Hartog 1931).
Their differences give the bound of Cramer and Rao, below which no interval can be at this noise. In the third scene
friction and normal force are sought at once, of which the record feels the product alone.
"""

import argparse
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fairlead.studies.fits.fit_file import read_fit
from fairlead.studies.fits.measured import Measured
from fairlead.studies.fits.search import fit, prepared
from tests.reference.belt import StickSlipBelt

LEVEL = 1.959964  # deviations of a 95 % interval to either side
NOISE = 2e-3  # m
BLOCK = """schema: 1
name: coasting
parameters: {k: 400 N/m, mu: 0.12, pressed: 10 N}
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: "{k}"}
  block: {type: Mass, mass: 2 kg, position: 0.1 m, velocity: 0 m/s}
  pad: {type: Contact, normal_force: "{pressed}", curve: "{mu}"}
connections:
  - [wall.flange, spring.a, pad.a]
  - [spring.b, block.flange, pad.b]
run: {stop: 2 s, accuracy: 1e-5}
"""
FIT = """model: {model}
records: {{one: {{file: record.csv, time: t, signals: {{block.x: {{column: x, noise: {noise} m}}}}}}}}
parameters:
{parameters}
loss: {{by: time}}
starts: 1
"""


def belt(stiction: float, coulomb: float, stiffness: float, times: NDArray) -> NDArray:
    """Position of the block on the belt, by curve and spring."""
    return StickSlipBelt(stiffness=stiffness, stiction=10 * stiction, coulomb=10 * coulomb).position(times)


def coasting(stiffness: float, friction: float, times: NDArray) -> NDArray:
    """Half cycles about -+F/k, each 2 F/k shorter than the one before, until the block sticks."""
    w, centre = np.sqrt(stiffness / 2), 10 * friction / stiffness
    found, peak, begun = np.empty_like(times), 0.1, 0.0
    while abs(peak) > centre:
        now = times >= begun
        middle = np.sign(peak) * centre
        found[now] = middle + (peak - middle) * np.cos(w * (times[now] - begun))
        peak, begun = 2 * middle - peak, begun + np.pi / w
    found[times >= begun] = peak
    return found


def swinging(stiffness: float, friction: float, pressed: float, times: NDArray) -> NDArray:
    """The same, by the normal force too."""
    return coasting(stiffness, friction * pressed / 10, times)


@dataclass(frozen=True)
class Oscillator:
    """A scene, its closed form, the times of the record, and the parameters: truth, start and bounds."""

    name: str
    model: str
    position: Callable[..., NDArray]
    times: NDArray
    parameters: dict[str, tuple[float, float, float, float]]

    @property
    def truth(self) -> NDArray:
        """True values."""
        return np.array([one[0] for one in self.parameters.values()])

    def least(self) -> NDArray:
        """The bound of Cramer and Rao for the deviations of the logarithms, of what the record tells."""
        columns = []
        for k in range(len(self.truth)):
            ends = [self.position(*(self.truth * np.exp(side * 1e-6 * np.eye(len(self.truth))[k])), self.times)
                    for side in (-1, 1)]  # fmt: skip
            columns.append((ends[1] - ends[0]) / 2e-6 / NOISE)
        j = np.stack(columns, axis=1)
        return np.sqrt(np.diag(np.linalg.pinv(j.T @ j, rcond=1e-9)))


OSCILLATORS = (
    Oscillator("block on a belt", "belt", belt, np.linspace(0, 3, 61), {
        "pad.curve.stiction": (1.0, 0.97, 0.7, 1.4), "pad.curve.coulomb": (0.6, 0.62, 0.3, 0.69),
        "spring.stiffness": (100.0, 102.0, 80.0, 130.0)}),
    Oscillator("block that swings and sticks", "scene.yaml", coasting, np.linspace(0, 2, 81), {
        "k": (400.0, 380.0, 200.0, 800.0), "mu": (0.12, 0.1, 0.01, 0.5)}),
    Oscillator("the same, also by normal force", "scene.yaml", swinging, np.linspace(0, 2, 81), {
        "k": (400.0, 380.0, 200.0, 800.0), "mu": (0.12, 0.1, 0.01, 0.5), "pressed": (10.0, 11.0, 2.0, 50.0)}),
)  # fmt: skip


@dataclass(frozen=True)
class Coverage:
    """Of one parameter: how many intervals held the truth, and their median width over that of the bound.

    `untold` counts the fits that said that the data do not tell it, by the words that name it.
    """

    oscillator: str
    parameter: str
    seeds: int
    held: int
    width: float
    untold: dict[str, int]


def study(oscillator: Oscillator, seeds: int, folder: Path) -> Iterator[Coverage]:
    """Fits to the record with the noise of each seed."""
    names, exact = list(oscillator.parameters), oscillator.position(*oscillator.truth, oscillator.times)
    rows = "".join(f"{t!r},{x!r}\n" for t, x in zip(oscillator.times.tolist(), exact.tolist(), strict=True))
    (folder / "record.csv").write_text(f"t [s],x [m]\n{rows}")
    (folder / "scene.yaml").write_text(BLOCK)
    lines = [f"  {name}: {{start: {start}, low: {low}, high: {high}, log: true}}"
             for name, (_, start, low, high) in oscillator.parameters.items()]  # fmt: skip
    text = FIT.format(model=oscillator.model, noise=NOISE, parameters="\n".join(lines))
    (folder / "fit.yaml").write_text(text)
    asked = read_fit(folder / "fit.yaml")
    _, (target,), _ = prepared(asked)
    held, widths = dict.fromkeys(names, 0), {name: list[float]() for name in names}
    untold: dict[str, dict[str, int]] = {name: {} for name in names}
    for seed in range(seeds):
        noisy = exact + NOISE * np.random.default_rng(seed).normal(size=exact.size)
        measured = Measured(oscillator.times, {"block.x": noisy}, {"block.x": NOISE})
        found = fit(asked, [replace(target, record=replace(target.record, measured=measured))])
        hidden = next((one for one in found.directions if not one.told), None)
        for name, truth in zip(names, oscillator.truth, strict=True):
            one = found.intervals[name]
            if one.low is not None and one.high is not None:
                held[name] += one.low < truth < one.high
                widths[name].append(float(np.log(one.high / one.low)))
            elif hidden is not None:
                said = hidden.sentence.partition(":")[0]
                untold[name][said] = untold[name].get(said, 0) + 1
    for name, least in zip(names, oscillator.least(), strict=True):
        width = float(np.median(widths[name])) / (2 * LEVEL * least) if widths[name] else float("nan")
        yield Coverage(oscillator.name, name, seeds, held[name], width, untold[name])


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeds", type=int, default=100)
    seeds = parser.parse_args().seeds
    print("| scene | parameter | intervals that hold the truth | median width over that of Cramer and Rao | not told |")
    print("|---|---|---|---|---|")
    for oscillator in OSCILLATORS:
        with tempfile.TemporaryDirectory() as folder:
            for one in study(oscillator, seeds, Path(folder)):
                width = "" if np.isnan(one.width) else f"{one.width:.2f}"
                told = "; ".join(f"{count} of {seeds}: {said}" for said, count in one.untold.items())
                count = seeds - sum(one.untold.values())
                held = f"{one.held} of {count}" if count else ""
                print(f"| {one.oscillator} | `{one.parameter}` | {held} | {width} | {told} |", flush=True)


if __name__ == "__main__":
    main()
