"""What `auto` takes: the table of choice.py, and what it leaves to rodas."""

import pytest

from fairlead import choice


@pytest.fixture(autouse=True)
def _table(monkeypatch):
    monkeypatch.setattr(choice, "STEPPING_FROM", ((1e-2, 10), (1e-4, 100)))


@pytest.mark.parametrize(
    ("contacts", "linear", "accuracy", "engine"),
    [
        (0, True, 1e-3, "rodas"),
        (10, True, 1e-2, "stepping"),
        (9, True, 1e-2, "rodas"),
        (99, True, 1e-3, "rodas"),  # between two rows the tighter one counts
        (100, True, 1e-3, "stepping"),
        (1000, True, 1e-5, "rodas"),  # tighter than was measured
        (1000, False, 1e-2, "rodas"),  # laws that bend between switches
    ],
)
def test_the_engine_follows_contacts_laws_and_accuracy(contacts, linear, accuracy, engine):
    found, reason = choice.choose(contacts, linear, accuracy)
    assert found == engine
    assert reason.startswith("auto: ")


def test_without_a_row_rodas_is_taken(monkeypatch):
    monkeypatch.setattr(choice, "STEPPING_FROM", ())
    assert choice.choose(10_000, True, 0.1)[0] == "rodas"
