"""Runs of bundled routes beside statics: two computations of the same netlist that share no law."""

import numpy as np
import pytest

import fairlead
from fairlead.analysis.margins.margins import margins
from fairlead.analysis.margins.quasi_static import against_statics
from fairlead.analysis.statics.shares import shares

ROUTES = {"guidance_route": {"run.stop": "40 s"}, "guidance_route_ideal": {}, "crustacean": {}}
BAND = 0.02  # of physics 7b; single elements that stick and slip, and a mesh of a few elements on a bend, leave 1 %


@pytest.mark.parametrize("name", ROUTES)
def test_tensions_of_steady_motion_are_those_of_statics(bundled, name):
    found = against_statics(fairlead.load(name).flat, bundled(name, ROUTES[name]))
    assert found["difference"] < BAND, found


def test_the_core_in_the_water_has_the_mean_of_the_tension_while_the_line_is_paid_out(bundled):
    """Between the last bend and the end connector hose and core stay as long as each other."""
    result = bundled("guidance_route_ideal")
    (found,) = fairlead.load("guidance_route_ideal").statics()
    core = shares(found.moving[0]).shares[-1].core[0]  # at 25 s
    rows = np.searchsorted(result.t, np.arange(24.0, 24.95, 0.05))
    told = np.mean(result["line.core[150].tension"][rows])
    assert told == pytest.approx(core, rel=0.03)  # the line has come 0.5 m further since, and bulkheads slip a little


@pytest.mark.slow
def test_the_hose_of_a_run_is_told_beside_its_estimate(bundled):
    """Means of both layers halfway between bend A and the deployer, by hand; the lowest hose is that of the margins."""
    result = bundled("guidance_route_ideal")
    found = against_statics(fairlead.load("guidance_route_ideal").flat, result)
    (line,) = margins(result)
    assert found["lowest"]["run"] == line.whole.hose.value
    shared = found["shares"]
    rows = np.searchsorted(result.t, np.linspace(shared["from"], shared["to"], 100))
    x = result.columns([f"line.hose_node[{k}].x" for k in range(161)])[rows]
    for layer in ("hose", "core"):
        tension = result.columns([f"line.{layer}[{k}].tension" for k in range(160)])[rows]
        nearest = np.abs((x[:, 1:] + x[:, :-1]) / 2 - shared["place"]).argmin(axis=1)
        mean = tension[np.arange(len(rows)), nearest].mean()
        assert shared[layer]["run"] == pytest.approx(mean, abs=2)  # between the nearest two


def test_margins_of_the_whole_route_are_those_of_its_signals(bundled):
    """Recorded rows lie inside the extremes of the steps, and within what a tension does between two rows."""
    result = bundled("guidance_route_ideal")
    (line,) = margins(result)
    names = result.match("line.hose[*].tension")
    hose = result.columns(names)
    core = result.columns(result.match("line.core[*].tension"))
    assert line.whole.hose.value == min(result.extremes(name).lowest for name in names)
    assert hose.min() * (1 + 1e-3) < line.whole.hose.value <= hose.min()
    assert (hose + core).max() <= line.whole.peak.value < (hose + core).max() * (1 + 1e-3)
    assert line.ruck_margin(line.whole) == pytest.approx(160 / -line.whole.hose.value)
    assert [one.name for one in line.stations][:3] == ["winch", "tensiometer", "bend_a"]
    assert line.missing == ()


@pytest.mark.slow
def test_what_slides_on_belts_is_what_is_paid_out_less(bundled):
    """Up to the stop of the weak clamp's belts: their way less that of the end of the line."""
    result = bundled("weak_clamp", {"run.stop": "26 s"})
    (line,) = margins(result)
    run, paid = (result[name][-1] - result[name][0] for name in ("belts.x", "line.hose_node[160].x"))
    assert line.whole.slipped.value == pytest.approx(run - paid, abs=0.05)
