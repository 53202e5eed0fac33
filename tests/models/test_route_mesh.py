"""What the elements of the guidance route change: halved, and shifted by half of one against the devices.

The error of a mesh is estimated by halving it: with order one it is twice what that changes, with order two 4/3 of it.
"""

import math
import shutil
from pathlib import Path

import numpy as np
import pytest

import fairlead
from tests.models.along_the_route import BEND_A, inside, layer, tension_at
from tests.reference.capstan import tension_ratio

MODELS = Path(__file__).parents[2] / "models"
LENGTH, MU = 40.0, 0.35


def with_half_ends(folder, element):
    """A copy of the netlist in which the line begins and ends with half an element; it is the same line."""
    half, near = element / 2, element / 2 + 1e-6
    points = [(0.0, half), (half, half), (near, element)]
    points += [(LENGTH - place, length) for place, length in reversed(points)]
    graded = "[" + ", ".join(f"[{place!r}, {length!r}]" for place, length in points) + "]"
    shutil.copytree(MODELS / "parts", folder / "parts")
    part = folder / "parts" / "array_route.yaml"
    text, element = part.read_text(encoding="utf-8"), 'element: "{element}"'
    part.write_text(text.replace(element, f"{element}\n    graded: {graded}"), encoding="utf-8")
    return shutil.copy(MODELS / "guidance_route.yaml", folder)


def figures(result):
    """Excess of the ratio of tensions at bend A over that of a string, steadily; and what the start makes."""
    assert result.status == "finished", result.run["sentence"]
    winch, before = tension_at(result, [1.0, 4.2], 5.0, 8.0)
    force = -result.columns(result.match("line.outer_deployer[*].friction")).sum(axis=1)
    start = result.t <= 2.0
    tension = layer(result, "hose") + layer(result, "core")
    return np.array([
        before / winch / tension_ratio(MU, BEND_A) - 1,
        np.trapezoid(force[start], result.t[start]) / 2.0,
        np.where(inside(result), tension, -np.inf).max(),
        layer(result, "hose").min(),
    ])  # fmt: skip


@pytest.fixture(scope="module")
def meshes(tmp_path_factory):
    """Figures with elements of 0.5 m, of 0.25 m, and of 0.5 m shifted by half of one."""
    found = {}
    for name, element in (("coarse", 0.5), ("halved", 0.25), ("shifted", 0.5)):
        folder = tmp_path_factory.mktemp(name)
        path = with_half_ends(folder, element) if name == "shifted" else MODELS / "guidance_route.yaml"
        settings = {"element": f"{element} m", "run.stop": "8 s", "run.accuracy": "1e-4", "record.every": "5 ms"}
        found[name] = figures(fairlead.load(path, set=settings).run(out=folder / "run"))
    return found


def test_steady_tensions_converge_with_order_two(meshes):
    """Of a capstan of n nodes the error is n (mu d)^3/12, d = angle/n: a quarter for half the elements."""
    coarse, halved = meshes["coarse"][0], meshes["halved"][0]
    assert math.log2(coarse / halved) == pytest.approx(2.0, abs=0.4)
    n = BEND_A / 0.5
    assert coarse == pytest.approx(n * (MU * 0.5) ** 3 / 12, rel=0.3)  # at the ends of the bend nodes count in part


def test_steady_tensions_do_not_know_where_the_elements_are(meshes):
    assert abs(meshes["shifted"][0] - meshes["coarse"][0]) < 0.05 * meshes["coarse"][0]


def test_a_start_knows_where_they_are_within_the_error_of_the_mesh(meshes):
    """Force of the deployer, greatest tension, lowest hose tension."""
    error = 2 * np.abs(meshes["halved"] - meshes["coarse"])[1:]
    assert (np.abs(meshes["shifted"] - meshes["coarse"])[1:] < error).all()
