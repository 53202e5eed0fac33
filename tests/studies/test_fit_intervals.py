"""Intervals of a stick-slip oscillator hold the truth as often as they say, and are no wider than need be.

Records are the closed form of Rabinowicz' belt (tests/reference/belt.py) with noise; that form gives the Cramer-Rao
bound too.
"""

from dataclasses import replace

import numpy as np
import pytest

from fairlead.studies.fits.fit_file import read_fit
from fairlead.studies.fits.measured import Measured
from fairlead.studies.fits.search import fit, prepared
from tests.reference.belt import StickSlipBelt

NOISE, SEEDS = 2e-3, 100
TRUTH = {"pad.curve.stiction": 1.0, "pad.curve.coulomb": 0.6, "spring.stiffness": 100.0}
TIMES = np.linspace(0, 3, 61)
FIT = """model: belt
records:
  one: {file: belt.csv, time: t, signals: {block.x: {column: x, noise: 2 mm}}}
parameters:
  pad.curve.stiction: {start: 0.97, low: 0.7, high: 1.4, log: true}
  pad.curve.coulomb: {start: 0.62, low: 0.3, high: 0.69, log: true}
  spring.stiffness: {start: 102 N/m, low: 80 N/m, high: 130 N/m, log: true}
loss: {by: time}
starts: 1
"""


def position(stiction, coulomb, stiffness):
    return StickSlipBelt(stiffness=stiffness, stiction=10 * stiction, coulomb=10 * coulomb).position(TIMES)


def least_deviations():
    """The Cramer-Rao bound of the logarithms, from differences of the closed form."""
    truth = np.array(list(TRUTH.values()))
    columns = []
    for k in range(3):
        ends = [position(*(truth * np.exp(side * 1e-6 * np.eye(3)[k]))) for side in (-1, 1)]
        columns.append((ends[1] - ends[0]) / 2e-6 / NOISE)
    j = np.stack(columns, axis=1)
    return np.sqrt(np.diag(np.linalg.inv(j.T @ j)))


@pytest.mark.slow
def test_intervals_hold_the_truth_in_90_to_99_of_100_seeds_and_are_near_the_cramer_rao_bound(tmp_path) -> None:
    exact = position(*TRUTH.values())
    rows = "".join(f"{t!r},{x!r}\n" for t, x in zip(TIMES.tolist(), exact.tolist(), strict=True))
    (tmp_path / "belt.csv").write_text(f"t [s],x [m]\n{rows}")
    (tmp_path / "fit.yaml").write_text(FIT)
    asked = read_fit(tmp_path / "fit.yaml")
    _, (target,), _ = prepared(asked)
    held, widths = dict.fromkeys(TRUTH, 0), {name: [] for name in TRUTH}
    for seed in range(SEEDS):
        noisy = exact + NOISE * np.random.default_rng(seed).normal(size=exact.size)
        measured = Measured(TIMES, {"block.x": noisy}, {"block.x": NOISE})
        found = fit(asked, [replace(target, record=replace(target.record, measured=measured))])
        for name, truth in TRUTH.items():
            one = found.intervals[name]
            held[name] += one.low < truth < one.high
            widths[name].append(np.log(one.high / one.low))
    assert all(90 <= count <= 99 for count in held.values()), held
    for (name, wide), least in zip(widths.items(), least_deviations(), strict=True):
        assert np.median(wide) < 1.5 * 2 * 1.96 * least, name
