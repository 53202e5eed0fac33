"""A class that says nothing of its energy is told so; the closure of its runs is not judged."""

from fairlead.analysis.record.energy import unjudged
from fairlead.report.page.trust import trust

LIBRARY = '''
class Soft(Component):
    """A spring whose author says nothing of its energy."""

    a, b = Translational(), Translational()

    def law(p, a, b):
        """Tension."""
        tension = 100 * (b.x - a.x)
        return Law(a=-tension, b=tension)
'''
SCENE = """
components:
  wall: {type: Ground}
  body: {type: Mass, mass: 1 kg, position: 1 m, velocity: 1 m/s}
  soft: {type: KIND}
connections: [[wall.flange, soft.a], [soft.b, body.flange]]
run: {stop: 1 s, accuracy: 1e-6}
record: {signals: ["*"]}
"""


def test_a_class_without_ledger_terms_is_named_and_its_closure_not_judged(simulate, library) -> None:
    energy = simulate(SCENE.replace("KIND", "Soft"), (library(LIBRARY),)).run["energy"]
    assert energy["closure"] is None
    assert energy["undeclared"] == ["soft"]
    assert unjudged(energy).startswith("soft: the class declares no energy")


def test_classes_that_declare_their_energy_or_pass_none_are_judged(simulate) -> None:
    energy = simulate(SCENE.replace("KIND", "Spring, stiffness: 100 N/m")).run["energy"]
    assert energy["closure"] < 1e-6
    assert unjudged(energy) == ""
    held = simulate(SCENE.replace("KIND", "ForceSensor").replace(", velocity: 1 m/s", "")).run["energy"]
    assert "undeclared" not in held


WRONG = LIBRARY.replace("b=tension)", "b=tension, stored=200 * (b.x - a.x))")


def test_where_the_ledger_does_not_close_a_class_of_ones_own_is_named_with_its_contract(simulate, library) -> None:
    result = simulate(SCENE.replace("KIND", "Soft"), (library(WRONG),))
    assert result.run["energy"]["own_classes"] == ["Soft"]
    (said,) = [one for one in result.remarks if "the energy ledger does not close" in one]
    assert "Soft does not come with fairlead" in said
    assert "from fairlead.testing import contract; contract(Soft)" in said
    assert "docs/components.md" in said
    assert any("contract(Soft)" in one for sentence in trust(result.run) for one in sentence if isinstance(one, str))


def test_a_class_of_ones_own_that_keeps_its_ledger_is_not_suspected(simulate, library) -> None:
    right = LIBRARY.replace("b=tension)", "b=tension, stored=50 * (b.x - a.x) ** 2)")
    result = simulate(SCENE.replace("KIND", "Soft"), (library(right),))
    assert not any("contract" in one for one in result.remarks)
