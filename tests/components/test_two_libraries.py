"""Libraries of two models in one process do not disturb each other, whatever their classes and files are called."""

import pytest

import fairlead
from fairlead.component.registry import known_types
from fairlead.errors import ModelError

LIBRARY = '''
from fairlead.component import Component, Parameter, Translational
from fairlead.components.friction.curve import Curve


class Grip(Curve):
    """A friction of NUMBER."""
    MORE

    def coefficient(p, v):
        return NUMBER + 0*v


class Spiral(Component):
    """A spring."""
    a, b = Translational(), Translational()
    stiffness = Parameter("N/m", "Stiffness.", default=STIFFNESS)

    def law(p, a, b):
        force = p.stiffness*(b.x - a.x)
        return -force, force
'''
SCENE = """schema: 1
name: grip
components:
  floor: {type: Ground}
  body: {type: Mass, mass: 1 kg, velocity: 10 m/s}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: grip}}
  spiral: {type: Spiral}
connections: [[floor.flange, pad.a, spiral.a], [spiral.b, body.flange, pad.b]]
run: {stop: 0.01 s}
record: {signals: [pad.friction, body.x, body.v]}
"""


@pytest.fixture
def model(tmp_path):
    """Makes a model whose library, always `own.py`, has this friction and stiffness."""

    def load(friction, stiffness, more="", folder=None):
        place = tmp_path / (folder or f"{friction}")
        place.mkdir(exist_ok=True)
        text = LIBRARY.replace("NUMBER", str(friction)).replace("STIFFNESS", str(stiffness)).replace("MORE", more)
        (place / "own.py").write_text(text, encoding="utf-8")
        (place / "grip.yaml").write_text(SCENE, encoding="utf-8")
        return fairlead.load(place / "grip.yaml", libraries=[place / "own.py"])

    return load


def friction(model):
    return model.run(out=None)["pad.friction"][0]


@pytest.mark.slow
def test_models_whose_libraries_define_the_same_names_keep_their_own(model):
    one, two = model(0.2, 100.0), model(0.5, 900.0)
    assert friction(two) == pytest.approx(5.0)
    assert friction(one) == pytest.approx(2.0)
    assert friction(two.with_values({"pad.normal_force": "20 N"})) == pytest.approx(10.0)
    again = one.with_values({"pad.normal_force": "20 N"})
    assert friction(again) == pytest.approx(4.0)
    assert again.rebuilt == ""  # it is the library of `one`, not one read anew
    assert one.check() == two.check() == []


@pytest.mark.slow
def test_a_parameter_that_only_the_other_library_has_is_refused(model):
    one = model(0.2, 100.0)
    two = model(0.5, 900.0, more='wear = Parameter("1", "Wear.", default=1.0)')
    assert friction(two.with_values({"pad.curve.wear": 2.0})) == pytest.approx(5.0)
    with pytest.raises(ModelError, match="wear"):
        one.with_values({"pad.curve.wear": 2.0})


def test_a_model_without_the_library_does_not_know_its_members(model, tmp_path):
    friction(model(0.2, 100.0))
    text = SCENE.replace("type: Spiral", "type: Spring, stiffness: 1 N/m")
    (tmp_path / "plain.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match=r"there is no curve grip"):
        fairlead.load(tmp_path / "plain.yaml").check()
    assert "grip" not in known_types()["Contact"].members
    assert "coulomb" in {member.word for member in type_of_curves().members.values()}


def type_of_curves():
    from fairlead.components.friction.curve import Curve

    return Curve


@pytest.mark.slow
def test_a_member_of_a_bundled_word_counts_for_its_own_model_only(model, tmp_path):
    mine = model(0.7, 100.0, more='word = "coulomb"')
    text = SCENE.replace("{curve: grip}", "{curve: coulomb, coulomb: 0.3}").replace(
        "type: Spiral", "type: Spring, stiffness: 100 N/m"
    )
    (tmp_path / "plain.yaml").write_text(text, encoding="utf-8")
    (tmp_path / "0.7" / "grip.yaml").write_text(SCENE.replace("curve: grip", "curve: coulomb"), encoding="utf-8")
    mine = fairlead.load(tmp_path / "0.7" / "grip.yaml", libraries=mine.libraries)
    assert friction(mine) == pytest.approx(7.0)
    assert friction(fairlead.load(tmp_path / "plain.yaml")) == pytest.approx(3.0)


def test_a_library_that_fails_leaves_nothing_behind(model, tmp_path):
    (tmp_path / "broken").mkdir()
    text = LIBRARY.replace("NUMBER", "0.9").replace("STIFFNESS", "1.0").replace("MORE", "") + "\nraise ValueError\n"
    (tmp_path / "broken" / "own.py").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match="cannot be loaded"):
        known_types([str(tmp_path / "broken" / "own.py")])
    assert "grip" not in type_of_curves().members
    assert friction(model(0.2, 100.0)) == pytest.approx(2.0)
