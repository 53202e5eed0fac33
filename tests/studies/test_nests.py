"""Laws that contain each other: the larger one is never fitted worse, wherever its own search begins."""

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import least_squares

import fairlead
from fairlead.errors import Location
from fairlead.studies.fits.fit_file import Law, Sought, read_fit
from fairlead.studies.fits.known import loss_sum
from fairlead.studies.fits.laws import compare
from fairlead.studies.fits.nests import Contained, places
from fairlead.studies.fits.problem import FEATURES, Problem
from fairlead.studies.fits.search import fit, foretelling
from tests.studies.test_fits import DRY, FREQUENCY, HEAD, SCENE, write

DAMPED = (
    SCENE.replace("{k: 400 N/m", "{c: 0 N*s/m, one: 0, two: 0, both: 0, k: 400 N/m")
    .replace("  pad:", '  damper: {type: Damper, damping: "{c}"}\n  pad:')
    .replace("spring.a, pad.a]", "spring.a, pad.a, damper.a]")
    .replace("block.flange, pad.b]", "block.flange, pad.b, damper.b]")
)
SIDES = DAMPED.replace('"{c}"', '"{one + both} N*s/m"').replace('"{k}"', '"{400 + 100*(two + both)} N/m"')
TWICE = HEAD.replace("parameters:", "  two: {file: coast.csv, time: t, signals: {block.x: place}}\nparameters:")


def sought(name: str, start: float, low: float, high: float, *, log: bool = False) -> Sought:
    return Sought(name, start, low, high, log, "", 1.0, Location(""))


def damped(folder: Path, text: str = DAMPED) -> fairlead.Model:
    (folder / "scene.yaml").write_text(text)
    return fairlead.load(folder / "scene.yaml")


class Wavy:
    """A stand-in of a record: residuals of a and b that have a second minimum near b = 2 pi, where the loss is 0.2."""

    count, known_noise, by, left = 3, True, FEATURES, {}

    def without(self, values):
        return ()

    def residuals(self, values):
        a, b = values["a"], values.get("b", 0.0)
        return np.array([a - 2, 1 - np.cos(b) + 0.1 * b, 0.1])


def test_a_search_begins_at_a_place_that_is_better_than_where_its_own_ended(tmp_path) -> None:
    asked = read_fit(write(tmp_path, f"{HEAD}  a: {{start: 1, low: 0, high: 5}}\nstarts: 1\nloss: {{by: time}}\n"))
    small, large = Law("small"), Law("large", sought=(sought("b", 6, 0, 9),))
    contained, alone = fit(asked, [Wavy()], small), fit(asked, [Wavy()], large)
    place = Problem((*asked.sought, *large.sought), ()).z((contained.values["a"], 0.0))
    assert alone.loss > 20 * contained.loss
    also = [("elsewhere", place + 0.3), ("small", place)]
    found = fit(asked, [Wavy()], large, also=also)
    assert found.loss <= contained.loss * (1 + 1e-9)
    assert [one.begun["b"] for one in found.starts] == pytest.approx([6.0, 0.0], abs=1e-4)
    foretold = foretelling(asked, [Wavy()], large, alone, also)
    assert foretold == pytest.approx({"a": 2.0, "b": 0.0}, abs=1e-4)


def test_a_record_is_not_foretold_from_another_minimum_than_the_full_fit_shows(tmp_path) -> None:
    """Its start leads to b = 2 pi, where the loss is 0.2; the law was then judged by a failure of the search."""
    asked = read_fit(write(tmp_path, f"{HEAD}  a: {{start: 1, low: 0, high: 5}}\nstarts: 1\nloss: {{by: time}}\n"))
    law, near = Law("large", sought=(sought("b", 6, 0, 9),)), Law("large", sought=(sought("b", 1, 0, 9),))
    whole = fit(asked, [Wavy()], near)
    assert whole.values["b"] == pytest.approx(0.0, abs=0.05)
    assert foretelling(asked, [Wavy()], law, whole) == pytest.approx({"a": 2.0, "b": 0.0}, abs=0.05)


@pytest.mark.slow
def test_a_law_that_contains_another_is_not_fitted_worse_from_a_start_that_leads_elsewhere(tmp_path) -> None:
    laws = "laws:\n  both: {parameters: {c: {start: 40, low: 0.001, high: 100, log: true}}}\n  dry: {}\n"
    stiff = FREQUENCY.replace("380", "250")
    file = write(tmp_path, f"{TWICE}{stiff}{DRY}starts: 1\nloss: {{by: time}}\n{laws}", noise=1e-3, seed=1)
    damped(tmp_path)
    asked = read_fit(file)
    both, dry = compare(asked, asked.laws)
    assert [both.law.name, dry.law.name] == ["both", "dry"]  # as in the file, though `dry` was fitted first
    own, further = both.fitted.starts
    assert own.loss > 1.2 * dry.fitted.loss  # from 40 N s/m alone
    assert further.begun["k"] == pytest.approx(dry.fitted.values["k"], rel=1e-5)
    assert both.fitted.loss <= dry.fitted.loss * (1 + 1e-4)  # it has 0.001 N s/m of damping at least
    for record in ("one", "two"):  # the other record is the same one, so that what holds of fits holds of foretelling
        assert both.left_out[record]["block.x"].mean < 1.01 * dry.left_out[record]["block.x"].mean


def test_parameters_of_other_names_are_found_from_the_numbers_of_the_components(tmp_path) -> None:
    """One share for damper and spring is contained in a share for each."""
    model = damped(tmp_path, SIDES)
    like = Contained.of(model, {"both": 0.3, "mu": 0.2})
    larger = (sought("mu", 0.1, 0.01, 0.5, log=True), sought("one", 0.9, 0.001, 1), sought("two", 0.9, 0.001, 1))
    problem = Problem(larger, ())
    (found,) = places(problem, model, like)
    assert problem.values(found) == pytest.approx({"mu": 0.2, "one": 0.3, "two": 0.3})


def test_a_parameter_that_no_number_of_the_contained_law_tells_is_tried_at_its_bounds_too(tmp_path) -> None:
    model = damped(tmp_path)
    problem = Problem((sought("c", 1, 0, 9), sought("k", 300, 200, 900)), ())
    like = Contained(frozenset({"c"}), {"damper.damping": 4.0, "c": 4.0})
    found = [problem.values(one) for one in places(problem, model, like)]
    assert [one["k"] for one in found] == pytest.approx([300, 200, 900])
    assert [one["c"] for one in found] == pytest.approx([4.0] * 3)


@pytest.mark.parametrize("kind", ["linear", "soft_l1", "huber", "cauchy", "arctan"])
def test_the_sum_of_a_loss_is_that_of_the_search(kind: str) -> None:
    r = np.array([0.3, -2.0, 5.0])
    found = least_squares(lambda x: r + 0 * x, [0.0], loss=kind, f_scale=1.5)
    assert loss_sum(kind, 1.5, r) == pytest.approx(found.cost, rel=1e-12)
