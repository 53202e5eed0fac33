"""What a report says of a run that was killed: no counter that is not known."""

from __future__ import annotations

from fairlead.report.page.trust import trust


def test_counters_of_a_killed_run_are_not_known():
    said = " ".join(one.text for one in trust({"settings": {"accuracy": 1e-4}, "engine": "rodas"}))
    assert "0 steps" not in said
    assert "not known" in said


def test_those_of_a_run_that_ended_are():
    run = {"settings": {"accuracy": 1e-4}, "engine": "rodas", "steps": 12, "rejected": 3, "switches": 4}
    assert "It took 12 steps, 3 were rejected, 4 zone changes." in " ".join(one.text for one in trust(run))
