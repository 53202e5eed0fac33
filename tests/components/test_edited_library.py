"""A library that is edited while Python goes on, as in a notebook, is read again."""

import math

import pytest

import fairlead
from fairlead.errors import ModelError

SPRING = """
from fairlead.component import Component, Parameter, Translational

class Volute(Component):
    \"\"\"A spring.\"\"\"
    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", "Stiffness.", default=10.0)

    def law(p, a, b):
        force = 1.0*p.stiffness*(b.x - a.x)
        return -force, force
"""
SCENE = """schema: 1
name: volute
components:
  wall: {type: Ground}
  body: {type: Mass, mass: 1 kg, position: 1 m}
  volute: {type: Volute}
connections: [[wall.flange, volute.a], [volute.b, body.flange]]
run: {stop: 0.1 s, accuracy: 1e-8}
"""


def ends(scene, library):
    return fairlead.load(scene, libraries=(str(library),)).run(out=None)["body.x"][-1]


@pytest.mark.parametrize("folder", [False, True], ids=["file", "folder"])
def test_an_edit_counts_at_the_next_load(tmp_path, folder):
    scene, library = tmp_path / "scene.yaml", tmp_path / ("springs" if folder else "springs.py")
    scene.write_text(SCENE)
    file = library / "__init__.py" if folder else library
    file.parent.mkdir(exist_ok=True)
    file.write_text(SPRING)
    before = fairlead.load(scene, libraries=(str(library),))
    first = before.run(out=None)["body.x"][-1]
    file.write_text(SPRING.replace("1.0*p.stiffness", "2.0*p.stiffness"))  # as long, within the same second
    assert ends(scene, library) == pytest.approx(swing(20.0), abs=1e-6)
    assert first == before.run(out=None)["body.x"][-1] == pytest.approx(swing(10.0), abs=1e-6)
    file.write_text(SPRING.replace("Volute", "Coil"))
    with pytest.raises(ModelError, match="no component type Volute"):
        fairlead.load(scene, libraries=(str(library),)).check()


def swing(stiffness):
    """Where a mass of 1 kg is after 0.1 s, let go 1 m from where its spring is at rest."""
    return math.cos(math.sqrt(stiffness) * 0.1)
