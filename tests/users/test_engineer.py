"""A handling engineer's week: a 60 m array on a route of one's own, from the bundled parts and the pages in docs/.

Laid out with statics, hauled for two seconds, hauled again with twice the friction, and what came out taken to pandas,
Excel and a figure. What is expected is the capstan formula and the balance of energy, worked out here.
"""

import math

import numpy as np
import pandas as pd
import pytest

import fairlead

MU, LOAD, SPEED, LIMIT = 0.25, 800.0, 0.3, 2500.0
FIRST, SECOND = math.radians(90), math.radians(60)  # what the two bends turn the line by; the wheel between them turns
BY_THE_DRUM, BEFORE_WHEEL, AFTER_WHEEL, OUTBOARD = 1.0, 5.7, 10.0, 16.0  # places on the route between devices [m]

ROUTE = f"""
schema: 1
name: own_route
description: A 60 m array in three modules; a winch hauls it through two bends and over a pulley.
parameters: {{mu: {MU}, speed: {SPEED} m/s, load: {LOAD} N}}
components:
  line:
    type: ArrayModule
    length: 60 m
    modules: 3
    element: 0.3 m
    graded: [[0 m, 1 m], [28 m, 1 m], [29 m, 0.3 m], [47 m, 0.3 m], [48 m, 1 m], [60 m, 1 m]]
    start: -30 m
    tension: "{{load}}"
    profile: statics
    hose: {{mass: 1.5 kg/m, stiffness: 10 kN}}
    core: {{mass: 4 kg/m, stiffness: 500 kN}}
    ruck_force: 200 N
    side_wall: 3 kN/m
  route:
    type: Route
    stations:
      - {{type: Winch, radius: 0.6 m}}
      - {{name: first, type: Bend, start: 2 m, angle: 90 deg, radius: 1.5 m, friction: "{{mu}}"}}
      - {{name: wheel, type: Pulley, start: 7 m, angle: 60 deg, radius: 1 m, friction: 0.5}}
      - {{name: second, type: Bend, start: 12 m, angle: 60 deg, radius: 1.5 m, friction: "{{mu}}"}}
  haul: {{type: MotionSource, velocity: {{ramp: {{to: "{{-speed}}", over: 0.8 s}}}}}}
  tow: {{type: ForceSource, force: "{{load}}"}}
connections:
  - [line.path, route.path]
  - [haul.flange, route.winch.rim]
  - [tow.flange, line.outboard]
run: {{stop: 2 s, accuracy: 1e-3}}
record:
  every: 20 ms
  signals: ["line.hose[*].tension", "line.core[*].tension", "line.hose_node[*].x", "line.outer*[*].slip", haul.force]
limits: {{"line.core[*].tension": {{below: {LIMIT} N}}}}
"""


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """The route, written to a file as its user does."""
    path = tmp_path_factory.mktemp("engineer") / "own_route.yaml"
    path.write_text(ROUTE.lstrip(), encoding="utf-8")
    return fairlead.load(path)


@pytest.fixture(scope="module")
def hauled(model):
    """The run with the friction of the netlist."""
    return model.run(out=None)


@pytest.fixture(scope="module")
def rougher(model):
    """The same with twice the friction in the bends."""
    return model.with_values(mu=2 * MU).run(out=None)


def tension(result, place):
    """Tension of hose and core together at a place on the route, over time [N]."""
    hose = result.elements("line.hose[*].tension", side="right")
    both = hose.values + result.elements("line.core[*].tension", side="right").values
    return np.array([np.interp(place, *row) for row in zip(hose["place"].values, both, strict=True)])


def steady(result, place):
    """Its mean over the last half second, at a steady speed [N]."""
    times = result.elements("line.hose[*].tension", side="right")["time"].values
    return tension(result, place)[times >= times[-1] - 0.5].mean()


def test_the_route_has_no_mistakes(model):
    assert model.check() == []


@pytest.mark.parametrize("mu", [MU, 2 * MU])
def test_statics_has_the_tensions_of_capstans(model, mu):
    (line,) = model.with_values(mu=mu).statics()
    stations = line.stations().to_pandas().set_index("station")
    middle = LOAD * math.exp(mu * SECOND)
    assert stations["outboard"]["winch"] == pytest.approx(middle * math.exp(mu * FIRST))
    assert stations["inboard"]["wheel"] == pytest.approx(stations["outboard"]["wheel"])
    rest = line.at_rest().to_pandas().set_index("station")
    assert rest["inboard_most"]["second"] == pytest.approx(middle)
    assert rest["inboard_least"]["second"] == pytest.approx(LOAD**2 / middle)
    drive = line.drives().to_pandas().set_index(["drive", "state"]).loc[("winch", "hauling")]
    assert drive["power"] == pytest.approx(stations["outboard"]["winch"] * SPEED)


@pytest.mark.parametrize(("run", "mu"), [("hauled", MU), ("rougher", 2 * MU)])
def test_a_run_reaches_the_ratios_of_capstans(run, mu, request):
    result = request.getfixturevalue(run)
    assert result.ok
    assert steady(result, OUTBOARD) == pytest.approx(LOAD, rel=0.02)
    assert steady(result, AFTER_WHEEL) / steady(result, OUTBOARD) == pytest.approx(math.exp(mu * SECOND), rel=0.01)
    assert steady(result, BEFORE_WHEEL) == pytest.approx(steady(result, AFTER_WHEEL), rel=0.01)
    assert steady(result, BY_THE_DRUM) / steady(result, BEFORE_WHEEL) == pytest.approx(math.exp(mu * FIRST), rel=0.01)


def test_paid_out_the_tension_falls_towards_the_drum(model):
    result = model.with_values(speed=-SPEED).run(out=None)
    assert steady(result, BY_THE_DRUM) == pytest.approx(LOAD * math.exp(-MU * (FIRST + SECOND)), rel=0.02)


def test_twice_the_friction_adds_more_tension_the_farther_inboard(hauled, rougher):
    """At the same times, and the square of the ratio over the load in the end."""
    np.testing.assert_array_equal(np.unique(hauled.t.round(9)), np.unique(rougher.t.round(9)))
    added = [steady(rougher, place) - steady(hauled, place) for place in (BY_THE_DRUM, BEFORE_WHEEL, OUTBOARD)]
    assert added[0] > added[1] > added[2]
    assert steady(rougher, BY_THE_DRUM) / LOAD == pytest.approx((steady(hauled, BY_THE_DRUM) / LOAD) ** 2, rel=0.03)


@pytest.mark.parametrize("run", ["hauled", "rougher"])
def test_the_energy_of_a_run_closes(run, request):
    entry = request.getfixturevalue(run).energy.to_pandas().set_index("entry")["energy"]
    assert entry["dissipated"] > 0
    assert entry["supplied"] == pytest.approx(entry["dissipated"] + entry["stored"], rel=1e-3)


def test_margins_say_where_the_line_bears_least(hauled, rougher):
    """The wall of the first bend bears tension over radius, so a margin of what is allowed over that."""
    for result in (hauled, rougher):
        worst = result.margins().to_pandas()
        side_wall = worst[(worst["quantity"] == "side_wall") & (worst["station"] == "first")].iloc[0]
        peak = worst[(worst["quantity"] == "peak") & (worst["station"] == "first")].iloc[0]
        assert side_wall["value"] == pytest.approx(peak["value"] / 1.5, rel=1e-6)
        assert side_wall["margin"] == pytest.approx(3000 / side_wall["value"])
    (verdict,) = hauled.rucks().to_pandas().to_dict("records")
    assert not verdict["rucks"]  # all of it is pulled


def test_a_limit_holds_once_and_is_broken_with_twice_the_friction(model, hauled, rougher):
    (kept,) = hauled.limits.to_pandas().to_dict("records")
    (broken,) = rougher.limits.to_pandas().to_dict("records")
    assert not kept["broken"]
    assert broken["broken"]
    assert kept["value"] < LIMIT < broken["value"]
    with pytest.warns(fairlead.RunWarning, match="limit broken"):
        model.with_values(mu=2 * MU).run(out=None, stop="0.6 s")


def test_tables_go_to_pandas_and_excel(hauled, tmp_path):
    pytest.importorskip("openpyxl", reason="the extra fairlead[excel]")
    signals = ["haul.force", "line.core[40].tension"]
    hauled.to_excel(tmp_path / "run.xlsx", signals, side="right")
    sheets = pd.read_excel(tmp_path / "run.xlsx", sheet_name=None)
    frame = hauled.to_pandas(signals, side="right")
    force = next(iter(sheets.values())).filter(like="haul.force").iloc[:, 0]
    np.testing.assert_allclose(force.to_numpy(dtype=float), frame["haul.force"].to_numpy())
    margins = hauled.margins().to_pandas()
    margins.to_excel(tmp_path / "margins.xlsx", index=False)
    assert pd.read_excel(tmp_path / "margins.xlsx")["value"].to_numpy() == pytest.approx(margins["value"].to_numpy())


def test_a_figure_shows_the_tension_along_the_line(hauled, tmp_path):
    figure = hauled.plot("line.core[*].tension", between=(0.0, "1 s"), file=tmp_path / "tension.png")
    assert (tmp_path / "tension.png").read_bytes().startswith(b"\x89PNG")
    assert "N" in figure.axes[0].get_ylabel()
