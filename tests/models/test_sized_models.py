"""Models with sizes that have a source, against what a line that slides round bends must do whatever its sizes."""

import math
import pathlib

import numpy as np
import pytest

import fairlead

SIZED = pathlib.Path(__file__).parents[2] / "models" / "sized"
ROPES, BREAKS, AT = 2, 14_000 * 4.44822, (0.03, 0.04)  # N each, at a strain: docs/physics.md, 7d


def run(name, **settings):
    result = fairlead.load(SIZED / f"{name}.yaml", set=settings).run(out=None)
    assert result.ok, result.run["sentence"]
    return result


def mean(result, y, begin, end):
    """Mean over time between two times."""
    t = np.asarray(result.t)
    there = (t >= begin) & (t <= end)
    return np.trapezoid(np.asarray(y)[there], t[there]) / (t[there][-1] - t[there][0])


NAMES = ["single_bend_sized", "guidance_route_sized", "long_route_sized", "long_deployment_sized"]


def between(result, begin, end):
    """Tension of the whole line between two places of the route, over time; nan where no node is there."""
    tension = np.full(len(result.t), np.nan)
    nodes = sorted(result.match("line.hose_node[*].x"), key=lambda name: int(name.split("[")[1].split("]")[0]))
    for k, name in enumerate(nodes[:-1]):
        here = (np.asarray(result[name]) > begin) & (np.asarray(result[name]) <= end)
        if here.any():
            both = np.asarray(result[f"line.core[{k}].tension"]) + np.asarray(result[f"line.hose[{k}].tension"])
            tension[here] = both[here]
    return tension


def mean_where_seen(result, y, begin, end):
    """Mean over time between two times, of what is known."""
    t = np.asarray(result.t)
    seen = (t >= begin) & (t <= end) & np.isfinite(y)
    return np.trapezoid(y[seen], t[seen]) / (t[seen][-1] - t[seen][0])


@pytest.mark.parametrize("name", NAMES)
def test_the_core_is_two_ropes_of_aramid(name):
    line = fairlead.load(SIZED / f"{name}.yaml").netlist.components["line"].parameters
    given = float(line["core"].plain()["stiffness"].removesuffix(" MN")) * 1e6
    softest, stiffest = (ROPES * BREAKS / strain for strain in reversed(AT))
    assert 0.9 * softest < given < stiffest


@pytest.mark.parametrize("name", NAMES)
def test_modules_and_drums_have_sizes_of_their_sources(name):
    """30 to 75 m a module, drums of 10 to 20 diameters: docs/physics.md, 7d."""
    components = fairlead.load(SIZED / f"{name}.yaml").netlist.components
    line = components["line"].parameters
    long = float(line["length"].plain().removesuffix(" m")) / float(line["modules"].plain() if "modules" in line else 1)
    assert 30 <= long <= 75
    diameter = float(line["diameter"].plain().removesuffix(" mm")) * 1e-3
    for one in components["route"].parameters["stations"].plain():
        if one["type"] == "Winch":
            assert 10 <= 2 * float(one["radius"].removesuffix(" m")) / diameter <= 20


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mu", "within", "settings"),  # as of the single bend: docs/physics.md, 7a
    [(0.35, 0.01, {"line.element": "0.5 m"}), pytest.param(0.35, 0.01, {}, marks=pytest.mark.slow),
     pytest.param(0.60, 0.02, {}, marks=pytest.mark.slow)],
)  # fmt: skip
def test_the_haul_takes_what_the_capstan_does(mu, within, settings):
    result = run("single_bend_sized", mu=mu, **settings)
    assert -mean(result, result["haul.force"], 5, 15) == pytest.approx(800 * math.exp(mu * math.pi / 2), rel=within)
    parted = max(np.abs(result[signal]).max() for signal in result.match("line.registration[*].d"))
    assert parted < 0.02 if mu < 0.4 else parted > 0.12
    assert result.run["energy"]["closure"] < 1e-4


@pytest.mark.slow
@pytest.mark.parametrize("core", ["on", "off"])
def test_tensions_of_the_route_are_those_of_its_capstans(core):
    """Between bend A and the deployer 200 N times exp(+-mu 90 deg), also of a core that does not stretch."""
    result = run("guidance_route_sized", **{"effects.core_stretch": core})
    tension = between(result, 4.0, 4.5)
    for way, begin, end in ((1, 10, 24), (-1, 35, 47)):
        wanted = 200 * math.exp(way * 0.35 * math.pi / 2)
        assert mean_where_seen(result, tension, begin, end) == pytest.approx(wanted, rel=0.01)
        assert mean(result, result["route.tensiometer.tension"], begin, end) == pytest.approx(200, rel=0.01)


@pytest.mark.slow
def test_a_core_that_does_not_stretch_is_hauled_through_the_long_route():
    """Until the line turns round at 29 s: there the zones of a rigid core do not settle, and the run says so."""
    result = run("long_route_sized", **{"effects.core_stretch": "off", "run.stop": "28 s"})
    wanted = 200 * math.exp(0.3 * math.radians(135))
    assert mean_where_seen(result, between(result, 5.85, 6.2), 10, 24) == pytest.approx(wanted, rel=0.01)


@pytest.mark.slow
def test_before_the_deployer_of_the_long_route_only_the_sum_of_angles_counts():
    """200 N times exp(+-mu 135 deg) after bends of 45 and 90 deg; a connector passes both."""
    result = run("long_route_sized")
    tension = between(result, 5.85, 6.2)
    for way, begin, end in ((1, 10, 24), (-1, 35, 47)):
        wanted = 200 * math.exp(way * 0.3 * math.radians(135))
        assert mean_where_seen(result, tension, begin, end) == pytest.approx(wanted, rel=0.01)
        assert mean(result, result["route.tensiometer.tension"], begin, end) == pytest.approx(200, rel=0.01)
    connector = np.asarray(result["line.hose_node[78].x"])  # of 30 m that are coarse, then fine
    assert result.run["energy"]["closure"] < 1e-4
    assert connector.min() < 2.0 < 5.57 < connector.max()  # from before bend A to behind bend B


@pytest.mark.slow
def test_the_long_deployment_draws_its_line_round_bend_a_by_the_capstan_law():
    """600 N exp(mu 90 deg) before the deployer, while 1 m/s are paid out."""
    result = run("long_deployment_sized", **{"run.stop": "30 s"})
    tension = between(result, 5.2, 5.8)
    assert mean_where_seen(result, tension, 15, 29) == pytest.approx(600 * math.exp(0.3 * math.pi / 2), rel=0.01)
    end, belts = result["line.hose_node[600].x"], result["belts.x"]
    assert end[-1] - end[0] == pytest.approx(belts[-1] - belts[0], abs=0.05)
    assert result.run["energy"]["closure"] < 1e-4


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "back_tension"), [("stepping", "200 N"), ("stepping", "100 N"), ("rodas", "200 N")])
def test_no_contact_of_the_route_takes_more_than_friction_allows(tmp_path, engine, back_tension):
    """Slack is hauled in with a core that stretches: hose and core come to rest and are torn loose on each other.

    The largest limit of the scene is that of an element between the belts, 0.6 times 1500 N/m on each side of 0.25 m;
    one that was stopped at once took thousands.
    """
    netlist = (SIZED / "guidance_route_sized.yaml").read_text()
    assert '"line.core[*].tension"' in netlist
    scene = tmp_path / "scene.yaml"
    scene.write_text(netlist[: netlist.index("  plots:")].replace("line.core[*].tension", "line.outer[*].friction"))
    model = fairlead.load(scene, set={"effects.core_stretch": "on", "back_tension": back_tension})
    result = model.run(out=None, engine=engine, stop="29.4 s")
    assert result.ok, result.run["sentence"]
    names = [signal.name for signal in result.signals if signal.name.endswith("friction")]
    assert len(names) > 100
    assert max(np.abs(result[name]).max() for name in names) <= 0.6 * 1500 * 2 * 0.25
