"""Whether a motion at constant speed has settled, what a tick compares, and every place that rucks: of written runs."""

from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.analysis.margins.quasi_static import against_statics
from fairlead.analysis.margins.ruck import verdicts
from fairlead.analysis.margins.ruck_words import figure, moment
from fairlead.analysis.margins.settled import drift, much
from fairlead.analysis.statics.route_record import route_records
from fairlead.analysis.statics.schedule import Stretch
from fairlead.cli.summary import summary_rows
from fairlead.report.page.verdict import verdict
from fairlead.results import Result, RunDirectory, Signal
from tests.unit.test_hose_against_statics import ARRAY, SHARE

ON_BEND, BEYOND_BELTS = 30, 50
"""Elements, by the way that the line has made at 3 s (1.25 m): they begin at 2.75 m and at 7.75 m."""


def written(model, path, drifts=0.0, rucks=()):
    """Results of the array under the closed form; its hose gets `drifts` N less tension from 3 to 5 s, linearly.

    `rucks` are spells (element, from, to).
    """
    t = np.linspace(0.0, 5.0, 251)
    way = np.where(t < 1, 0.25 * t**2, 0.25 + 0.5 * (t - 1))
    nodes = way[:, None] + np.arange(57) * 0.25 - 6
    middle = (nodes[:, 1:] + nodes[:, :-1]) / 2
    total = np.where(middle < 4, 100 * np.exp(0.3 * np.clip(middle - 2, 0, 1)), 60)
    hose = SHARE * total - drifts * np.clip((t[:, None] - 3) / 2, 0, 1)
    names = [f"line.{layer}[{k}].tension" for layer in ("hose", "core") for k in range(56)]
    names += [f"line.hose_node[{k}].x" for k in range(57)]
    run = RunDirectory.create(path, [Signal(name, "N") for name in names], {"routes": route_records(model.flat)})
    run.append(t, np.hstack([hose, total - hose, nodes]), np.zeros(len(t)))
    changes = [(t, k, zones) for k, a, b in rucks for t, zones in ((a, ("sound", "beyond")), (b, ("beyond", "sound")))]
    for at, k, zones in sorted(changes):
        run.event(at, f"line.hose[{k}]", *zones, "limit")
    run.finish("finished", {"end_time": 5.0})
    result = Result.open(path)
    result.run["against_statics"] = against_statics(model.flat, result)
    result.run["ruck"] = verdicts(result)
    return result


def told(result):
    return {one.about: one for one in verdict(result)}


@pytest.mark.slow
def test_a_motion_that_does_not_change_has_settled(scene, tmp_path):
    result = written(scene(ARRAY), tmp_path / "run")
    assert result.run["against_statics"]["drift"]["settled"]
    said = told(result)
    assert said["Settled"].mood == "good"
    assert "Not settled" not in dict(said["No ruck"].points)


@pytest.mark.slow
def test_extremes_that_go_on_growing_at_constant_speed_are_not_called_steady(scene, tmp_path):
    """From 3 to 5 s the tension falls by 40 N: by 20 N from half to half, of the 50 N that the hose takes."""
    result = written(scene(ARRAY), tmp_path / "run", drifts=40.0)
    drift = result.run["against_statics"]["drift"]
    assert drift["lowest"][0] - drift["lowest"][1] == pytest.approx(20.0, rel=0.02)
    assert not drift["settled"]
    said = told(result)
    assert said["Not settled"].mood == "fair"
    point = dict(said["No ruck"].points)["Not settled"]
    assert "The speed is constant from 3 to 5 s, but the hose still changes." in point
    assert "the margin depends on how long that motion lasts" in point
    assert not any("steady" in one.text for one in said.values())
    assert "not settled" in dict(summary_rows({"against_statics": result.run["against_statics"]}, "x"))


@pytest.mark.slow
def test_more_and_more_elements_that_ruck_are_not_called_steady_either(scene, tmp_path):
    spells = [(k, 4.0, 5.0) for k in range(28)]
    result = written(scene(ARRAY), tmp_path / "run", rucks=spells)
    assert result.run["against_statics"]["drift"]["rucking"] == pytest.approx([0.0, 0.5])
    assert "0 %, then 50 % of its elements ruck" in dict(told(result)["The hose rucks"].points)["Not settled"]


@pytest.mark.slow
def test_a_tick_says_what_it_compares_and_none_stands_for_a_hose_that_statics_misses(scene, tmp_path):
    result = written(scene(ARRAY), tmp_path / "run", drifts=40.0)
    said = told(result)
    assert (said["Against statics"].mood, said["Against statics"].brief) == (
        "good", "tension of hose and core together as in statics",
    )  # fmt: skip
    hose = said["Hose against statics"]
    assert (hose.mood, hose.brief) == ("fair", "hose alone not as in statics")
    assert "which is the unsafe side" in hose.text
    slight = told(written(scene(ARRAY), tmp_path / "slight", drifts=10.0))["Hose against statics"]
    assert (slight.mood, slight.brief) == ("plain", "hose alone not as in statics")  # far from the 50 N all the same
    level = told(written(scene(ARRAY), tmp_path / "level"))["Hose against statics"]
    assert (level.mood, level.brief) == ("good", "hose alone as in statics")


@pytest.mark.slow
def test_every_place_that_rucks_is_told_with_when_it_begins(scene, tmp_path):
    spells = [(ON_BEND, 3.0, 3.1), (ON_BEND, 4.0, 4.1), (BEYOND_BELTS, 3.5, 4.5), (BEYOND_BELTS + 1, 3.6, 5.0)]
    result = written(scene(ARRAY), tmp_path / "run", rucks=spells)
    (found,) = result.run["ruck"]
    assert [(one["where"], one["t"], one["elements"]) for one in found["places"]] == [
        ("on the bend", 3.0, 1), ("outboard of belts", 3.5, 2), ("between the bend and belts", 4.0, 1),
    ]  # fmt: skip
    where = dict(told(result)["The hose rucks"].points)["Where"]
    assert where.startswith("On the bend from t = 3 s (1 element, ")
    assert "outboard of belts from t = 3.5 s (2 elements, " in where


@pytest.mark.parametrize(
    ("value", "text"),
    [(244.06575, "244"), (2171.4, "2170"), (0.65556, "0.656"), (18023.0, "18000"), (1e7, "10000000"), (0.0, "0")],
)
def test_figures_of_a_verdict_have_three_digits(value, text):
    assert figure(value) == text


def test_an_instant_of_a_long_run_keeps_its_seconds():
    assert [moment(t) for t in (7.6584, 19.2416, 1234.5, 0.0)] == ["7.66", "19.2", "1234", "0"]


@pytest.mark.slow
def test_the_box_of_trust_stays_folded_where_the_verdict_says_what_is_wrong(scene, tmp_path):
    spells = [(k, 4.0, 5.0) for k in range(28)]
    said = told(written(scene(ARRAY), tmp_path / "run", drifts=40.0, rucks=spells))
    assert [(said[about].mood, said[about].opens) for about in ("Not settled", "Hose against statics")] == [
        ("fair", False), ("fair", False),
    ]  # fmt: skip
    assert told(written(scene(ARRAY), tmp_path / "sound", drifts=40.0))["Hose against statics"].opens


def a_line(tension, places, ruck_force=None):
    """What `drift` reads of a line on a drum that ends at 0 m."""
    t = np.linspace(0.0, 4.0, len(tension))
    record = {"line": "rope", "layers": ["line"], "nodes": tension.shape[1] + 1, "ruck_force": ruck_force,
              "stations": [{"type": "Winch", "begin": None, "end": 0.0}]}  # fmt: skip
    return SimpleNamespace(record=record, layers=[tension], places=places, result=SimpleNamespace(t=t, events=()))


def test_line_that_leaves_a_drum_with_what_it_was_wound_on_with_leaves_the_rest_settled():
    """Twenty elements of 1 m at 1000 N on a drum and 400 N off it; half of those that are stored come off by 4 s."""
    way = np.linspace(0.0, 10.0, 401)
    places = np.arange(20)[None, :] - 10.4 + way[:, None]
    wound = np.where(places < 0, 1000.0 - 60.0 * way[:, None], 400.0)
    stored = drift(a_line(wound, places), Stretch(0.0, 4.0, 2.5))
    assert stored["settled"]
    assert stored["highest"] == stored["lowest"] == [400.0, 400.0]
    assert not drift(a_line(wound, None), Stretch(0.0, 4.0, 2.5))["settled"]


@pytest.mark.parametrize(
    ("beside", "share", "told"),
    [(400.0, 2 / 400, "2 N, 0.5 % of 400 N"), (10.0, 2 / 10, "2 N, 20 % of 10 N"), (400.0, 0.3, "30 %")],
)
def test_a_change_of_tension_is_told_in_newtons_and_as_a_share_of_what_it_is_beside(beside, share, told):
    """The highest tension falls from 15 to 13 N; in the last case the share of elements that ruck changes more."""
    found = {"lowest": [5.0, 5.0], "highest": [15.0, 13.0], "beside": beside, "change": share}
    assert much(found) == told
    assert much({"lowest": [5.0, 5.0], "highest": [15.0, 13.0], "change": share}) == f"{100 * share:.2g} %"  # of old
