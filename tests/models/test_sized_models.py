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


@pytest.mark.parametrize("name", ["single_bend_sized", "guidance_route_sized"])
def test_the_core_is_two_ropes_of_aramid(name):
    line = fairlead.load(SIZED / f"{name}.yaml").netlist.components["line"].parameters
    given = float(line["core"].plain()["stiffness"].removesuffix(" MN")) * 1e6
    softest, stiffest = (ROPES * BREAKS / strain for strain in reversed(AT))
    assert 0.9 * softest < given < stiffest


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
    t = np.asarray(result.t)
    tension = np.full(len(t), np.nan)
    nodes = sorted(result.match("line.hose_node[*].x"), key=lambda name: int(name.split("[")[1].split("]")[0]))
    for k, name in enumerate(nodes[:-1]):
        here = (np.asarray(result[name]) > 4.0) & (np.asarray(result[name]) <= 4.5)
        if here.any():
            both = np.asarray(result[f"line.core[{k}].tension"]) + np.asarray(result[f"line.hose[{k}].tension"])
            tension[here] = both[here]
    for way, begin, end in ((1, 10, 24), (-1, 35, 47)):
        seen = (t >= begin) & (t <= end) & np.isfinite(tension)
        wanted = 200 * math.exp(way * 0.35 * math.pi / 2)
        assert np.trapezoid(tension[seen], t[seen]) / (t[seen][-1] - t[seen][0]) == pytest.approx(wanted, rel=0.01)
        assert mean(result, result["route.tensiometer.tension"], begin, end) == pytest.approx(200, rel=0.01)
