"""How much of a device a travelling line feels: always the same, wherever its nodes are.

Physics section 4.0 and section 8, item 33: the windows of all nodes sum to the length of the device, to
1e-12, if the edge is a whole number of elements. Closed form and reason in `tests/reference/window.py`.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

import fairlead
from tests.reference import window

PITCH = 0.25


@pytest.fixture(scope="module")
def curvature():
    """Curvature times window [1/m] along the route of `single_bend`, as its nodes are given it."""
    model = fairlead.load("single_bend")
    loads = {i.path: i for i in model.flat.instances}
    return loads["line.outer_load[7]"].values.curvature


@pytest.mark.slow
@settings(max_examples=200, deadline=None)
@given(phase=some.floats(0.0, PITCH))
def test_the_bend_of_the_model_sums_to_its_angle(curvature, phase: float) -> None:
    """Over an endless chain at any phase; curvature 1/R times length is the angle, a quarter turn."""
    nodes = phase + PITCH * np.arange(8, 24)
    total = PITCH * sum(curvature(s) for s in nodes)
    assert total == pytest.approx(math.pi / 2, abs=1e-12)


@settings(max_examples=200, deadline=None)
@given(place=some.floats(2.0, 6.0))
def test_the_window_of_the_model_is_the_trapezoid(curvature, place: float) -> None:
    exact = float(window.weight(place, start=3.0, end=3.0 + math.pi / 2, edge=PITCH))
    assert curvature(place) == pytest.approx(exact, abs=1e-12)


def travelling_chain(edge: float, nodes: int = 20, strain: float = 0.0) -> str:
    """Nodes at a pitch of 0.25 m that travel inboard past a device at 2 ... 4.1 m; each feels 1 N/m of it."""
    half, lines, joins = edge / 2, [], []
    table = f"[[{2 - half}, 0], [{2 + half}, 1], [{4.1 - half}, 1], [{4.1 + half}, 0]]"
    for i in range(nodes):
        lines.append(f"node{i}: {{type: MotionSource, velocity: -0.3 m/s, origin: {1 + i * PITCH * (1 + strain)} m}}")
        lines.append(f"load{i}: {{type: LateralLoad, curvature: {table}}}")
        beside = [f"load{k}.{port}" for k, port in ((i + 1, "behind"), (i - 1, "ahead")) if 0 <= k < nodes]
        beside += [f"load{i}.behind"] * (i == 0) + [f"load{i}.ahead"] * (i == nodes - 1)
        joins += [f"[node{i}.flange, load{i}.flange, {', '.join(beside)}]"]
        joins += [f"[pull.force, load{i}.{side}]" for side in ("hose_in", "hose_out")]
    components = "\n".join(f"  {line}" for line in lines)
    connections = "\n".join(f"  - {join}" for join in joins)
    return f"""
components:
  pull: {{type: ForceSource, force: 1 N}}
  weight: {{type: Mass, mass: 1 kg}}
{components}
connections:
  - [pull.flange, weight.flange]
{connections}
run: {{stop: 3 s, accuracy: 1e-6}}
record: {{every: 7 ms}}
"""


def test_a_travelling_chain_feels_the_same_at_any_time(simulate) -> None:
    """Through compiled tables whose intervals are frozen within a step: no node is ever in the wrong one."""
    result = simulate(travelling_chain(edge=PITCH))
    total = result.columns(result.match("load*.force")).sum(axis=1)
    np.testing.assert_allclose(total, window.exact_sum(2.0, 4.1), rtol=1e-12)


def test_an_edge_that_is_no_multiple_of_the_pitch_ripples(simulate) -> None:
    """The counterexample, so that the test above is known to be able to fail."""
    result = simulate(travelling_chain(edge=0.6 * PITCH))
    total = result.columns(result.match("load*.force")).sum(axis=1)
    assert np.ptp(total) > 0.01


@pytest.mark.parametrize("strain", [0.02, -0.02])
def test_a_stretched_chain_feels_the_whole_device_and_ripples_by_half_its_strain(simulate, strain: float) -> None:
    """Arcs between the neighbours as they are; with lengths of the start the mean would be off by the strain."""
    result = simulate(travelling_chain(edge=PITCH, nodes=24, strain=strain))
    total = result.columns(result.match("load*.force")).sum(axis=1)
    passing = PITCH * (1 + strain) / 0.3  # s; whole elements, so that the mean is one over the phase
    late = result.t <= 3 * passing
    mean = np.trapezoid(total[late], result.t[late]) / result.t[late][-1]
    assert mean == pytest.approx(window.exact_sum(2.0, 4.1), abs=1e-4)
    assert np.ptp(total) / 2 == pytest.approx(abs(strain) * PITCH / 2, rel=0.1)
