"""Changes of zone that last, without those that are taken back at the same instant."""

from fairlead.results.events import Event, lasting


def event(t, before, after, component="pad"):
    return Event(t, component, before, after, "guard")


def told(events, span=10.0):
    return [(one.t, one.component, one.zone_from, one.zone_to) for one in lasting(events, span)]


def test_what_is_taken_back_at_once_is_no_change():
    begins, ends = ("held", "backward"), ("backward", "held")
    toggles = [event(1.0, *begins), event(2.0, *ends), event(2.0, *begins), event(3.0, *ends),
               event(3.0 + 5e-9, *begins), event(4.0, *ends)]  # fmt: skip
    assert told(toggles) == [(1.0, "pad", "held", "backward"), (4.0, "pad", "backward", "held")]


def test_on_the_way_to_another_zone_only_that_counts():
    turns = [event(2.0, "backward", "held"), event(2.0, "held", "forward")]
    assert told(turns) == [(2.0, "pad", "backward", "forward")]


def test_parts_and_times_are_told_apart():
    several = [event(1.0, "held", "forward", "a"), event(1.0, "held", "forward", "b"),
               event(1.0 + 1e-6, "forward", "held", "a")]  # fmt: skip
    assert told(several) == [(1.0, "a", "held", "forward"), (1.0, "b", "held", "forward"),
                             (1.0 + 1e-6, "a", "forward", "held")]  # fmt: skip
    assert told([]) == []
