"""The contract of what is no plain two-port: friction curves of one's own, gears, parameters with any name."""

import pytest
from fairlead.components.route.bend import Bend

import fairlead
from fairlead.component import Component, Law, Parameter, Rotational, Unknown, hold
from fairlead.component.registry import load_library
from fairlead.errors import ModelError
from fairlead.testing import ContractError, checks, contract

CURVES = """
from fairlead.component import Parameter
from fairlead.components.friction.curve import Curve


class LinearTest(Curve):
    stiction = Parameter("1", "Coefficient at rest.", least=0)
    slope = Parameter("s/m", "Growth with speed.", least=0)

    def coefficient(p, v):
        return p.stiction + p.slope * v


class DrivesTest(Curve):
    mu = Parameter("1", "It pushes.", least=0)

    def coefficient(p, v):
        return -p.mu


class MixedTest(Curve):
    mu = Parameter("1", "A speed is added to it.", least=0)

    def coefficient(p, v):
        return p.mu + v
"""


@pytest.fixture(scope="module")
def curves(tmp_path_factory):
    file = tmp_path_factory.mktemp("curves") / "curves.py"
    file.write_text(CURVES)
    return load_library(str(file))


def test_a_friction_curve_is_asked_in_the_parts_that_take_it(curves) -> None:
    assert {check.kind.__name__ for check in checks(curves.LinearTest)} >= {"Hold"}
    contract(curves.LinearTest)
    contract(curves.LinearTest, stiction=0.3, slope=0.1)


@pytest.mark.parametrize(("name", "says"), [("DrivesTest", "cannot dissipate less than nothing"),
                                            ("MixedTest", "terms of a sum have one unit")])  # fmt: skip
def test_what_is_wrong_with_a_curve_is_told(name, says, curves) -> None:
    with pytest.raises(ContractError, match=says):
        contract(getattr(curves, name))


def test_a_part_that_no_law_takes_says_so() -> None:
    with pytest.raises(ContractError, match="Bend is no component"):
        contract(Bend)


class RatioTest(Component):
    """A gear: a.speed = n b.speed."""

    a, b = Rotational(), Rotational()
    n = Parameter("1", "Ratio.", above=0)
    torque = Unknown("N*m", "At b.")

    def law(p, a, b, torque):
        return Law(b=torque, a=-torque / p.n, torque=hold(a.speed - p.n * b.speed))


class LossTest(RatioTest):
    """The same, and its torques are not those of a gear: power is lost without a word."""

    def law(p, a, b, torque):
        return Law(b=torque, a=-0.9 * torque / p.n, torque=hold(a.speed - p.n * b.speed))


class CouplingTest(Component):
    """It holds both shafts together, and passes on the wrong torque."""

    a, b = Rotational(), Rotational()
    torque = Unknown("N*m", "At b.")

    def law(p, a, b, torque):
        return Law(b=torque, a=-1.1 * torque, torque=hold(b.speed - a.speed))


def test_the_torques_of_a_gear_need_not_sum_to_zero() -> None:
    contract(RatioTest)
    with pytest.raises(ContractError, match="energy is not accounted for"):
        contract(LossTest)
    with pytest.raises(ContractError, match="must sum to zero"):
        contract(CouplingTest)


SCENE = """
schema: 1
components:
  wall: {type: Ground}
  own: {type: CreepTest, k: 100 N/m}
  block: {type: Mass, mass: 1 kg}
connections: [[wall.flange, own.a], [own.b, block.flange]]
run: {stop: 1 s}
record: {signals: [NAME]}
"""
LIBRARY = """
from fairlead.component import Component, Law, Output, Parameter, State, Translational


class CreepTest(Component):
    a, b = Translational(), Translational()
    k = Parameter("N/m", above=0)
    crept = State("m", "What it has crept.")
    tension = Output("N", "Tension.")

    def law(p, a, b, crept):
        tension = p.k * (b.x - a.x - crept)
        return Law(a=-tension, b=tension, tension=tension, crept=tension / p.k * 1e-3, stored=tension**2 / (2 * p.k))
"""


@pytest.mark.parametrize(("name", "says"), [
    ("own.crept", "crept is a state of CreepTest, which is no signal: declare an Output"),
    ("own.k", "k is a parameter of CreepTest, which is no signal. own gives tension"),
    ("own.tenson", "Did you mean own.tension"),
])  # fmt: skip
def test_a_state_that_is_recorded_is_told_to_be_none_of_the_signals(name, says, tmp_path) -> None:
    (tmp_path / "scene.yaml").write_text(SCENE.replace("NAME", name))
    (tmp_path / "own.py").write_text(LIBRARY)
    model = fairlead.load(tmp_path / "scene.yaml", libraries=[str(tmp_path / "own.py")])
    for ask in (model.check, lambda: fairlead.sensitivity(model, f"end({name})", "own.k")):
        with pytest.raises(ModelError) as caught:
            ask()
        assert says in str(caught.value)
