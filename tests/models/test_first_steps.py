"""The first step after a switch: where switches follow each other closely it is mostly not repeated."""

import fairlead


def test_few_first_steps_on_a_long_line_are_repeated():
    """Steps cut at their very start still say how long the next may be at most: it was 1.2 a switch, and is 0.3."""
    model = fairlead.load("long_deployment", set={"run.stop": "8 s", "record.every": "4 s"})
    counters = model.run(out=None, check=False).run["counters"]
    assert counters["located"] > 300
    assert counters["rejected_error"] < 0.6 * counters["located"]
