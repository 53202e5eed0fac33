"""Elements of a line that a run has pressed together or turned inside out are told by name."""

import pytest

from fairlead.analysis.strains import remark

SCENE = """
components:
  wall: {{type: Ground}}
  line: {{type: {kind}, axial_stiffness: 100 N, length: 2 m}}
  hand: {{type: MotionSource, position: {{table: [[0, 2], [1, {end}]]}}}}
connections: [[wall.flange, line.a], [hand.flange, line.b]]
run: {{stop: 1 s}}
"""


@pytest.mark.parametrize(
    ("kind", "end", "says"),
    [
        ("Hose", -0.2, "line: inside out, the ends have passed each other; the least strain is -110 % in line"),
        ("Hose", 0.8, "line: pressed together; the least strain is -60 % in line"),
        ("Hose", 1.2, ""),
        ("Hose", 3.0, ""),
        ("Core", -0.2, "line: inside out"),
        ("Core", 0.8, ""),  # loose
    ],
)
def test_an_element_beyond_what_it_bears_is_told(kind, end, says, scene):
    run = scene(SCENE.format(kind=kind, end=end)).run(out=None).run
    assert run["strains"]["least"] == pytest.approx(end / 2 - 1, abs=1e-9)
    assert says in remark(run["strains"])
    assert bool(says) == bool(remark(run["strains"]))


def test_a_scene_without_elements_has_none(scene):
    text = """
    components: {wall: {type: Ground}, block: {type: Mass, mass: 1 kg}, pad: {type: Damper, damping: 1 N*s/m}}
    connections: [[wall.flange, pad.a], [pad.b, block.flange]]
    run: {stop: 1 s}
    """
    assert scene(text).run(out=None).run["strains"] is None
