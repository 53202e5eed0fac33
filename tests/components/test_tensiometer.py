"""The tensiometer of a route: what it reads, wherever the nodes are."""

import numpy as np
import pytest

SCENE = """
components:
  rope: {{type: Cable, length: 12 m, element: 0.3 m, start: -5 m, tension: 100 N, mass: 1 kg/m, stiffness: 500 kN}}
  route:
    type: Route
    stations:
      - {{name: gauge, type: Tensiometer, start: {start}, length: {length}}}
      - {{type: Guide, start: 4 m, length: 1 m, friction: 0.3}}
  drive: {{type: MotionSource, velocity: {{ramp: {{to: -0.2 m/s, over: 1 s}}}}}}
  load: {{type: ForceSource, force: {{ramp: {{from: 100 N, to: 180 N, over: 4 s}}}}}}
connections: [[rope.path, route.path], [drive.flange, rope.inboard], [load.flange, rope.outboard]]
friction: {{method: hold}}
run: {{stop: 4 s, accuracy: 1e-4}}
record: {{every: 20 ms, signals: ["rope.line[*].tension", "rope.node[*].x", route.gauge.tension]}}
"""
AWAY = SCENE.replace("start: 4 m", "start: 30 m")


@pytest.mark.parametrize(("start", "length"), [("1 m", "0.5 m"), ("1.1 m", "0.31 m"), ("-1 m", "2 m")])
def test_it_reads_the_mean_tension_over_its_length_without_a_ripple(simulate, start, length):
    """Elements of 0.3 m pass it; the reading is that of the line, whose tension hardly differs from place to place."""
    result = simulate(SCENE.format(start=start, length=length))
    tension = result.columns(result.match("rope.line[*].tension"))
    nodes = result.columns(result.match("rope.node[*].x"))
    middle = (nodes[:, 1:] + nodes[:, :-1]) / 2
    first, extent = (float(text.split()[0]) for text in (start, length))
    places = np.linspace(first, first + extent, 21)
    want = [np.interp(places, *pair).mean() for pair in zip(middle, tension, strict=True)]
    np.testing.assert_allclose(result["route.gauge.tension"], want, rtol=2e-3)


def test_where_there_is_no_line_it_reads_nothing(simulate):
    result = simulate(AWAY.format(start="20 m", length="1 m"))
    assert np.abs(result["route.gauge.tension"]).max() == 0.0


def test_half_a_length_of_line_counts_half(simulate):
    """The line ends in the middle of it at the start."""
    result = simulate(AWAY.format(start="6.5 m", length="1 m"), **{"drive.velocity.ramp.to": 0})
    tension = result.columns(result.match("rope.line[*].tension"))[:, -1]
    np.testing.assert_allclose(result["route.gauge.tension"], tension / 2, rtol=5e-3)
