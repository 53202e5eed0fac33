"""Line that a drum carries counts as part of the drum: the same motion, and far less to compute."""

import numpy as np
import pytest

from fairlead.integrate import parts
from tests.models.part_and_whole import on_the_grid

SCENE = """
    components:
      line: {{type: Cable, length: 40 m, element: 0.25 m, start: -34 m, tension: 300 N, mass: 2 kg/m,
             stiffness: 100 kN}}
      route:
        type: Route
        stations:
          - {{name: winch, type: Winch, radius: 0.5 m, moment: 20 kg*m^2, {drum}}}
          - {{name: gauge, type: Tensiometer, start: 0.75 m}}
          - {{name: bend, type: Bend, start: 2 m, angle: 60 deg, radius: 1 m, friction: 0.3}}
          - {{name: sea, type: Sea, start: 4 m, speed: 3 m/s, tail: 300 N}}
      {drive}
    connections:
      - [line.path, route.path]
      {joins}
    friction: {{method: hold}}
    run: {{stop: 7 s, accuracy: 1e-5}}
    record: {{every: 50 ms, signals: ["line.node[*].x", route.gauge.tension, {wanted}, energy.*]}}
"""
SPEED = "{table: {t: [0 s, 0.5 s, 3 s, 3.5 s, 6.5 s, 7 s], y: [0, 0.8, 0.8, -0.7, -0.7, 0]}}"
RIM = {
    "drum": "edge: 0.1 m",
    "drive": f"drum: {{type: MotionSource, velocity: {SPEED}}}",
    "joins": "- [drum.flange, route.winch.rim]",
    "wanted": "drum.force",
}
LAYERS = {
    "drum": "layers: on, width: 0.3 m, line_diameter: 40 mm, filled: 3 m",
    "drive": f"drum: {{type: MotionSource, velocity: {SPEED}}}\n      rack: {{type: Rack, radius: 0.5 m}}",
    "joins": "- [drum.flange, rack.rack]\n      - [rack.pinion, route.winch.shaft]",
    "wanted": "route.winch.radius",
}
CONTROLLED = {
    "drum": "edge: 0.1 m",
    "drive": f"wanted: {{type: SignalSource, value: {SPEED}}}\n"
    "      keeper: {type: Keeper, period: 20 ms}\n"
    "      motor: {type: TorqueActuator}",
    "joins": "- [wanted.signal, keeper.wanted]\n      - [keeper.torque, motor.torque]\n"
    "      - [motor.shaft, route.winch.shaft, keeper.shaft]",
    "wanted": "keeper.torque",
}
CLASSES = '''
    class Keeper(Controller):
        """Keeps a speed by a torque, with a memory of its own."""

        wanted = Input("m/s")
        shaft = Rotational("the drum")
        torque = Output("N*m")

        def begin(self):
            self.sum = 0.0

        def sample(self, wanted, shaft):
            missing = wanted / 0.5 - shaft.speed
            self.sum += 0.02 * missing
            return 400.0 * missing + 2000.0 * self.sum - 150.0

'''


@pytest.mark.usefixtures("brief")
@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("scene_of", [RIM, LAYERS, CONTROLLED], ids=["rim", "layers", "controlled"])
def test_a_line_that_is_paid_out_and_hauled_in_moves_as_it_would_in_whole(
    simulate, library, monkeypatch, scene_of, engine
):
    """The whole lets slip 1 um/s for each kN in its bonds, the part does not."""
    libraries = (library(CLASSES),) if scene_of is CONTROLLED else ()
    text = SCENE.format(**scene_of)
    part = simulate(text, libraries, **{"run.engine": engine})
    monkeypatch.setattr(parts, "LEAST", 10**9)
    whole = simulate(text, libraries, **{"run.engine": engine})
    assert whole.run["counters"]["partial_steps"] == 0
    assert part.run["counters"]["partial_steps"] > 0.7 * part.run["counters"]["steps"]
    near = {"rodas": 1e-6, "stepping": 5e-5}[engine]  # m; the bonds leak 2e-6 in 7 s, steps err by their accuracy
    for k in (1, 40, 80, 100, 120, 130, 136, 140, 150, 160):
        name = f"line.node[{k}].x"
        assert on_the_grid(part, name) == pytest.approx(on_the_grid(whole, name), abs=near), name
    assert np.ptp(np.asarray(part["line.node[160].x"])) > 2.0
    assert part.run["energy"]["closure"] < {"rodas": 1e-5, "stepping": 1e-3}[engine]


@pytest.mark.usefixtures("brief")
def test_what_moves_the_drum_moves_all_that_lies_on_it(simulate):
    """Force that accelerates the drum and 68 kg on it, of which 2 kg/m come off; the tension is that of the sea."""
    result = simulate(SCENE.format(**RIM), **{"run.stop": "0.45 s"})
    assert result.run["counters"]["partial_steps"] > 0
    t = np.asarray(result.t)
    rows = (t > 0.2) & (t < 0.4)
    pull = np.asarray(result["drum.force"])[rows] + np.asarray(result["route.gauge.tension"])[rows]
    assert pull.mean() == pytest.approx((20 / 0.5**2 + 2 * 34) * 0.8 / 0.5, rel=0.02)


JERKED = "{table: {t: [0 s, 0.1 s, 1.5 s, 1.6 s, 2 s], y: [0, 2, 2, 0, 0]}}"


def test_a_rope_that_lies_slack_off_the_drum_comes_taut_again(simulate):
    """Two metres a second from a drum that stops at once, with 20 N on it: elements that are loose stay in."""
    drum = RIM | {"drive": f"drum: {{type: MotionSource, velocity: {JERKED}}}"}
    text = SCENE.format(**drum).replace("300 N", "20 N").replace("speed: 3 m/s", "speed: 1 m/s").replace("7 s,", "2 s,")
    result = simulate(text)
    assert result.run["counters"]["partial_steps"] > 0.9 * result.run["counters"]["steps"]
    assert result.run["energy"]["closure"] < 1e-4
    assert np.asarray(result["route.gauge.tension"]).max() < 5e3


@pytest.mark.slow
def test_nothing_is_carried_while_one_layer_goes_over_to_the_next(simulate, monkeypatch):
    """The drum begins between two layers: its radius falls by a hundredth within half a second, in one zone."""
    text = SCENE.format(**LAYERS).replace("length: 40 m", "length: 80 m").replace("start: -34 m", "start: -70 m")
    text = text.replace("stop: 7 s", "stop: 1.5 s")
    part = simulate(text)
    monkeypatch.setattr(parts, "LEAST", 10**9)
    whole = simulate(text)
    radius = np.asarray(part["route.winch.radius"])
    assert radius[0] - radius[-1] > 5e-3
    assert part.run["counters"]["partial_steps"] > 0
    for k in (80, 200, 270, 300):
        name = f"line.node[{k}].x"
        assert on_the_grid(part, name) == pytest.approx(on_the_grid(whole, name), abs=1e-6), name
