"""Zones in the contract: circles of them, zones that nothing leads to, and guards that cannot fire."""

import pytest

from fairlead.testing.world import circle_of


@pytest.mark.parametrize(("path", "once"), [
    (["off", "on"] * 30, "off -> on -> off"),
    (["held", "off", "on", "off", "on", "off"], "off -> on -> off"),
    (["x", "a", "b", "b", "c", "a", "b", "c", "c", "a", "b", "c"], "a -> b -> c -> a"),
    (["a", "b", "a", "c", "a", "b", "a", "c"], "a -> b -> a -> c -> a"),
])  # fmt: skip
def test_a_circle_of_zones_is_told_once_round_from_where_it_is_entered(path, once):
    assert circle_of(path) == once
