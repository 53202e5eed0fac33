"""What a study of cost advises agrees with its own table: a looser line that would do is named."""

import pytest

from fairlead.analysis.cost.choice import choose
from fairlead.analysis.cost.deviation import OutputError
from fairlead.analysis.cost.ladder import Equations, Rung
from fairlead.analysis.cost.study import Reference, Row, Study
from fairlead.analysis.cost.timed_run import Timed

SCENE = Equations("", exact=True)


def study(*lines):
    """A study of lines (engine, accuracy, error, seconds)."""
    rows = []
    for engine, accuracy, error, cpu in lines:
        found = [OutputError("block.x", "m", 1.0, error, error, error, 0.0, 0.0)]
        rows.append(Row(Rung(SCENE, engine, accuracy), Timed("finished", cpu=cpu), numerical=found, modelling=[]))
    return Study("belt", (0.0, 1.0), True, ["block.x"], ["m"], Reference("tight", Timed("finished"), 1e-9), rows)


def test_what_would_be_enough_is_said_beside_a_choice_that_is_more_exact_at_no_cost():
    """The more exact line is taken, for times that differ by less than a millisecond differ from run to run."""
    lines = ("rodas", 1e-3, 2e-2, 0.62e-3), ("rodas", 1e-4, 7e-5, 0.63e-3), ("rodas", 1e-5, 6e-7, 1.0e-3)
    assert choose(study(*lines), 0.01).sentence == (
        "1 %: accuracy 1e-5 with rodas: 6e-05 % numerical error, in 1 ms. "
        "The looser accuracy 1e-4 with rodas would do too (0.007 %, 0.63 ms), but saves too little time to matter."
    )


@pytest.mark.parametrize(("slow", "chosen"), [(1.09, 1e-5), (1.2, 1e-4)])
def test_a_tenth_of_the_time_decides_and_then_nothing_is_added(slow, chosen):
    choice = choose(study(("rodas", 1e-4, 7e-5, 1.0), ("rodas", 1e-5, 6e-7, slow)), 0.01)
    assert choice.row.rung.accuracy == chosen
    assert ("would do too" in choice.sentence) == (chosen == 1e-5)


def test_the_loosest_of_the_same_engine_is_named():
    lines = ("stepping", 1e-3, 5e-3, 0.1e-3), ("rodas", 1e-3, 5e-3, 0.3e-3), ("rodas", 1e-5, 6e-7, 0.2e-3)
    said = choose(study(*lines), 0.01).sentence
    assert "The looser accuracy 1e-3 with rodas would do too (0.5 %, 0.3 ms), but is not faster." in said
