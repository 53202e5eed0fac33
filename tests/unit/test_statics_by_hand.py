"""Small functions of statics and of signals, by hand: speed off a drum, drag, a bearing, loops of signals."""

from __future__ import annotations

from types import SimpleNamespace

import networkx as nx
import numpy as np
import pytest

from fairlead.analysis.statics.off_the_drum import line_speed
from fairlead.analysis.statics.on_the_drum import most_paid_out
from fairlead.analysis.statics.pieces import bearing, drag
from fairlead.component.piecewise import linear_table
from fairlead.component.values import Wave
from fairlead.system.numbering.ranks import circle


@pytest.mark.parametrize("turns", [0.5, 2.0])
def test_a_line_comes_off_a_drum_by_its_speed_times_the_radius_at_the_angle_it_has_turned(turns):
    """omega = turns t; the radius falls evenly with the angle, r = 2 - angle/50, which is turns t^2/2."""
    drum, radius = Wave(linear_table([0.0, 10.0], [0.0, 10.0 * turns])), linear_table([0.0, 100.0], [2.0, 0.0])
    speed = line_speed(drum, radius, 0.0, 10.0)
    for t in np.linspace(0.1, 9.9, 23):
        assert speed(float(t)) == pytest.approx(turns * t * (2.0 - turns * t**2 / 100.0), rel=1e-4)


def test_a_corner_of_the_radius_is_where_the_angle_comes_to_it():
    """At 3 rad/s an angle of 6.003 rad is reached at 2.001 s, between two looks: 1 m up to there, then thicker."""
    drum = Wave(linear_table([0.0, 4.0], [3.0, 3.0]))
    speed = line_speed(drum, linear_table([0.0, 6.003, 12.0], [1.0, 1.0, 1.5997]), 0.0, 4.0)
    for t in (0.5, 2.001, 2.0015, 3.0):
        assert speed(t) == pytest.approx(3.0 * (1.0 + 0.1 * max(3.0 * t - 6.003, 0.0)), abs=1e-6)


@pytest.mark.parametrize(("flow", "speed"), [(2.0, 0.5), (0.0, 1.5), (-1.0, 1.0)])
def test_drag_goes_with_the_square_of_the_flow_along_the_line_and_its_sign(flow, speed):
    sea = SimpleNamespace(station=SimpleNamespace(drags=lambda diameter: 40.0 * diameter))
    route = SimpleNamespace(signal=lambda _sea, _t: flow, says=SimpleNamespace(diameter=0.02))
    assert drag(route, sea, 0.0, speed) == pytest.approx(0.8 * np.sign(flow - speed) * (flow - speed) ** 2)


@pytest.mark.parametrize("share", [0.0, 0.03])
def test_a_bearing_takes_its_share_of_what_pulls_at_the_wheel_either_way(share):
    wheel = SimpleNamespace(station=SimpleNamespace(taken_by_bearing=lambda: share))
    assert bearing(wheel, -200.0) == bearing(wheel, 200.0) == pytest.approx(200.0 * share)


def test_the_most_that_is_paid_out_is_found_with_the_instant_at_which_it_first_is():
    """way = 3 sin(t) up to pi, which is highest at pi/2 between two looks; 3 again at the end of a later stretch."""
    schedule = SimpleNamespace(
        begin=0.0, end=7.0, stretches=lambda: [SimpleNamespace(end=np.pi / 2), SimpleNamespace(end=6.0)],
        way=lambda t: 3.0 if t == 6.0 else 3.0 * np.sin(t) if t < np.pi else 0.0,
    )  # fmt: skip
    assert most_paid_out(schedule) == (3.0, np.pi / 2)


@pytest.mark.parametrize("seed", range(5))
def test_a_loop_of_signals_is_one_of_the_graph(seed):
    graph = nx.gnp_random_graph(9, 0.3, seed=seed, directed=True)
    followers = {str(a): {str(b): {} for b in graph.successors(a)} for a in graph}
    found = circle(followers)
    assert all(graph.has_edge(int(a), int(b)) for a, b in zip(found, [*found[1:], found[0]], strict=True))
    assert len(set(found)) == len(found)
