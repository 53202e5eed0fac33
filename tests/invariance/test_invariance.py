"""A few scenes under every change that must not matter; `make invariance` plays more of them, one change at a time.

What two runs are compared by is tested as well: a comparison that overlooks a digit would find everything invariant.
"""

from __future__ import annotations

import dataclasses
import re

import numpy as np
import pytest

import fairlead
from fairlead.integrate.point.even_steps import COARSE, rounded
from tests.invariance import outcome
from tests.invariance.known import KNOWN
from tests.invariance.lockstep import first_difference, tries
from tests.invariance.outcome import Outcome
from tests.invariance.plays import bundled, crowd, random_plays
from tests.invariance.settings import in_force, settings
from tests.invariance.trials import PLAIN, Trial, differences, play, trials
from tests.scenes.networks import network

FEW = [one for one in bundled() if one.name in ("belt", "weak_clamp")] + random_plays((1, 2, 3, 5, 6, 18, 60), (4, 8))
"""Among them contacts in circles (network 18), stiff turns on a drum (route 4), fronts from two sides (weak_clamp)."""
QUICK = {"belt", "weak_clamp", "network 3", "network 18", "route 4"}
IN_TWO_PARTS = pytest.mark.parametrize(
    "scenes",
    [
        pytest.param([one for one in FEW if one.name in QUICK], id="quick"),
        pytest.param([one for one in FEW if one.name not in QUICK], id="others", marks=pytest.mark.slow),
    ],
)
AT_ONCE = ("PYTHONHASHSEED", "OPENBLAS_CORETYPE", "NPY_DISABLE_CPU_FEATURES")
"""Settings that are tried together here: code for another processor would have to be compiled first."""


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """plain(scenes) -> what comes out of each of them, played once."""
    done = {}

    def played(scenes):
        missing = [one for one in scenes if one.name not in done]
        if missing:
            found, said = play(PLAIN, missing, tmp_path_factory.mktemp("plain"))
            print(said)
            done.update(found)
        return done

    return played


@IN_TWO_PARTS
def test_other_names_and_settings_and_runs_before_change_no_bit(plain, scenes, tmp_path):
    """All at once: names, hash seed, BLAS, instructions of numpy; each scene run twice, after others."""
    named = next(trial for trial in trials() if trial.change and trial.equal)
    environment = {key: value for setting in settings().values() for key, value in setting.items() if key in AT_ONCE}
    environment["OPENBLAS_CORETYPE"] = "Prescott"
    everything = Trial("all at once", environment=environment, change=named.change, job={"times": 2}, backwards=True)
    other, said = play(everything, scenes, tmp_path)
    print(said)
    assert differences(everything, scenes, plain(scenes), other) == {}


@IN_TWO_PARTS
def test_the_order_of_instances_and_unknowns_changes_no_more_than_rounding(plain, scenes, tmp_path):
    trial = next(trial for trial in trials() if "order" in trial.job)
    plays = [one for one in scenes if one.name not in KNOWN.get(trial.name, ())]
    other, _ = play(trial, plays, tmp_path)
    assert differences(trial, plays, plain(scenes), other) == {}


@pytest.mark.parametrize("seed", [2, 3])
def test_the_order_in_which_a_hundred_parts_are_written_changes_no_more_than_rounding(seed, tmp_path):
    plays = [crowd(seed)]
    assert min(one.text.count("{type: ") for one in plays) > 100
    trial = next(trial for trial in trials() if trial.change and not trial.equal)
    one, _ = play(PLAIN, plays, tmp_path / "one")
    other, _ = play(trial, plays, tmp_path / "other")
    assert differences(trial, plays, one, other) == {}


@pytest.mark.slow
@pytest.mark.parametrize("trial", trials(), ids=lambda trial: trial.name)
def test_no_single_change_matters(plain, trial, tmp_path):
    if trial.lacking:
        pytest.skip(trial.lacking)
    plays = [one for one in FEW if one.name not in KNOWN.get(trial.name, ())]
    other, said = play(trial, plays, tmp_path)
    print(said)
    assert differences(trial, plays, plain(FEW), other) == {}


def test_steps_whose_errors_differ_in_the_last_digits_are_the_same():
    """Of a tenth of a thousand steps the last digits may still decide: those halfway between two roundings."""
    steps = np.random.default_rng(1).lognormal(-6.0, 3.0, 1000)
    of = np.frompyfunc(lambda h: rounded.py_func(h, COARSE), 1, 1)
    one, other = of(steps).astype(float), of(steps * (1.0 + 1e-9)).astype(float)
    assert np.count_nonzero(one != other) <= 1
    np.testing.assert_allclose(one, steps, rtol=2.0**-10)
    assert set(np.frexp(one)[0] * 2**10 % 1) == {0.0}
    assert rounded.py_func(np.inf, COARSE) == np.inf


def test_the_first_difference_of_two_runs_is_told(tmp_path):
    """Bodies that are a thousandth heavier are soon elsewhere; the same ones never."""
    text = network(1)
    scene, other = tmp_path / "one.yaml", tmp_path / "other.yaml"
    scene.write_text(text)
    other.write_text(re.sub(r"mass: (\S+) kg", lambda mass: f"mass: {float(mass[1]) * (1 + 1e-3)!r} kg", text))
    one, again, heavier = (fairlead.load(file) for file in (scene, scene, other))
    assert first_difference(tries(one), tries(again)) == ""
    assert "weights apart" in first_difference(tries(one), tries(heavier)).splitlines()[0]


RUN = Outcome(
    "finished", np.array([0.0, 0.5, 0.5, 1.0]), np.array([0, -1, 1, 0], dtype=np.int8), ("a.x", "b.x"), ("m", "m"),
    np.array([[0.0, 1.0], [0.1, 1.0], [0.1, 1.0], [0.2, 2.0]]), ((0.5, "pad", "held", "forward", "lets_go"),),
    {"steps": 100, "switches": 1},
)  # fmt: skip


def changed(**parts):
    return dataclasses.replace(RUN, **parts)


@pytest.mark.parametrize(
    "other",
    [
        changed(values=np.nextafter(RUN.values, 9.0)),
        changed(t=np.array([0.0, 0.5, 0.5, np.nextafter(1.0, 2.0)])),
        changed(side=np.zeros(4, dtype=np.int8)),
        changed(events=((np.nextafter(0.5, 1.0), "pad", "held", "forward", "lets_go"),)),
        changed(events=((0.5, "pad", "held", "backward", "lets_go"),)),
        changed(counters={"steps": 101, "switches": 1}),
        changed(status="failed"),
    ],
    ids=["a last digit", "a time of a row", "a side", "a time of a switch", "a zone", "a count", "how it ended"],
)
def test_two_runs_that_differ_in_one_thing_are_unlike(other):
    assert outcome.unlike(RUN, RUN) == []
    assert outcome.unlike(RUN, other)


@pytest.mark.parametrize(
    ("other", "told"),
    [
        (changed(values=RUN.values * (1 + 0.9e-5)), False),
        (changed(values=RUN.values * (1 + 1.1e-5)), True),
        (changed(counters={"steps": 102, "switches": 1}), False),
        (changed(counters={"steps": 103, "switches": 1}), True),
        (changed(counters={"steps": 100, "partial_steps": 3}), True),
        (changed(events=()), True),
        (changed(events=((0.50009, "pad", "held", "forward", ""),)), False),
        (changed(events=((0.50011, "pad", "held", "forward", ""),)), True),
        (changed(events=((0.5, "pad", "held", "backward", ""),)), True),
        (changed(events=(*RUN.events, (0.5, "rim", "a", "b", ""), (0.5, "rim", "b", "a", ""))), False),
        (changed(events=(*RUN.events, (0.5, "rim", "a", "b", ""), (0.6, "rim", "b", "a", ""))), True),
        (changed(events=((0.5, "pad", "held", "x", ""), (0.5, "pad", "x", "forward", ""))), False),
    ],
)
def test_the_order_of_sums_may_change_so_much_and_no_more(other, told):
    assert bool(outcome.apart(RUN, other, accuracy=1e-4)) == told


def test_columns_are_compared_by_their_names():
    turned = changed(names=RUN.names[::-1], values=RUN.values[:, ::-1])
    assert outcome.unlike(RUN, turned) == []
    assert outcome.unlike(RUN, changed(values=RUN.values[:, ::-1]))


def test_what_is_in_force_names_blas_build_and_instructions():
    said = in_force()
    assert "OpenBLAS" in said
    assert "compiled for" in said
