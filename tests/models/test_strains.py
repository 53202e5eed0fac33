"""Elements of a line that a run has pressed together or turned inside out are told by name."""

import pytest

from fairlead.analysis.record.strains import remark

SCENE = """
components:
  wall: {{type: Ground}}
  line: {{type: {kind}, axial_stiffness: 100 N, length: 2 m}}
  hand: {{type: MotionSource, position: {{table: [[0, 2], [1, {end}]]}}}}
connections: [[wall.flange, line.a], [hand.flange, line.b]]
run: {{stop: 1 s, max_step: 2 ms}}
"""


@pytest.mark.parametrize(
    ("kind", "end", "says"),
    [
        ("Hose", -0.2, "line: inside out, the ends have passed each other; the least strain is -100 % in line"),
        ("Hose", 0.8, "line: pressed together; the least strain is -60 % in line"),
        ("Hose", 1.2, ""),
        ("Hose", 3.0, ""),
        ("Core", -0.2, "line: inside out"),
        ("Core", 0.8, ""),  # loose
    ],
)
def test_an_element_beyond_what_it_bears_is_told(kind, end, says, scene):
    run = scene(SCENE.format(kind=kind, end=end)).run(out=None, check=False).run
    ends = end < 0 and kind == "Hose"  # a core is loose at any length
    assert run["strains"]["least"] == pytest.approx(min(0.0, (0.0 if ends else end / 2) - 1), abs=1e-2)
    assert run["status"] == ("failed" if ends else "finished")
    assert says in remark(run["strains"])
    assert bool(says) == bool(remark(run["strains"]))


def test_a_scene_without_elements_has_none(scene):
    text = """
    components: {wall: {type: Ground}, block: {type: Mass, mass: 1 kg}, pad: {type: Damper, damping: 1 N*s/m}}
    connections: [[wall.flange, pad.a], [pad.b, block.flange]]
    run: {stop: 1 s}
    """
    assert scene(text).run(out=None).run["strains"] is None


def test_a_run_ends_where_an_element_turns_inside_out(scene):
    """Rows, events and figures go up to there, whatever is recorded and wherever the engine had got to."""
    text = SCENE.format(kind="Hose", end=2).replace("[1, 2]", "[0.5, -0.2], [1, 2]")
    result = scene(text).run(out=None, check=False)
    found, t = result.run["strains"], 2.0 / 4.4  # the hand goes at 4.4 m/s
    assert result.status == "failed"
    assert result.run["end_time"] == result.t[-1] == found["inside_out_from"] == pytest.approx(t, abs=2e-3)
    assert found["too_short_from"] == pytest.approx(t / 2, abs=2e-3)
    assert found["least"] == pytest.approx(-1.0, abs=5e-3)
    assert result.extremes("hand.x").lowest == pytest.approx(0.0, abs=1e-2)
    assert "line: inside out" in result.run["sentence"]
    assert "Give the line less friction" in result.run["sentence"]


LOOPED = """
components:
  wall: {{type: Ground}}
  line: {{type: {kind}, axial_stiffness: 100 N, length: 2 m, behind: {step}, ahead: {step}}}
  hand: {{type: MotionSource, position: {{table: [[0, 1.5], [1, 1.2]]}}}}
  place: {{type: MotionSource, position: {{table: [[0, {y}], [1, {y}]]}}}}
connections: [[wall.flange, line.a], [hand.flange, line.b], [place.flange, line.carriage]]
run: {{stop: 1 s}}
"""
STEP = "{x: [0 m, 0.8 m, 1 m, 3 m], y: [0, 0, 1, 1]}"


@pytest.mark.parametrize(
    ("kind", "y", "says"),
    [
        ("LoopedHose", 0.3, ""),
        ("LoopedHose", -0.4, "pressed together"),
        ("LoopedHose", -0.7, "inside out"),
        ("LoopedCore", -0.4, ""),  # loose
        ("LoopedCore", -0.7, "inside out"),
    ],
)
def test_an_element_with_a_loop_counts_its_way(kind, y, says, scene):
    """Its ends are 1.2 m apart in the end, and the loop of 2 y comes on top."""
    run = scene(LOOPED.format(kind=kind, y=y, step=STEP)).run(out=None, check=False).run
    ends = kind == "LoopedHose" and y == -0.7  # a core is loose at any length
    least = -1.0 if ends else (1.2 + 2 * y) / 2 - 1
    assert run["strains"]["least"] == pytest.approx(least, abs=0.03 if ends else 1e-9)
    assert says in remark(run["strains"])
    assert bool(says) == bool(remark(run["strains"]))


@pytest.mark.parametrize("record", ["{signals: []}", "{signals: [hand.force], every: 0.1 s}"])
def test_strains_are_watched_whatever_is_recorded(record, scene):
    run = scene(SCENE.format(kind="Hose", end=-0.2) + f"record: {record}\n").run(out=None, check=False).run
    assert run["end_time"] == pytest.approx(2.0 / 2.2, abs=3e-3)
    assert run["strains"]["least"] == pytest.approx(-1.0, abs=1e-2)
