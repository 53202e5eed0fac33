"""Edges of pulses and samples that are due at one instant, however their times are rounded: a sample sees the edge."""

import pytest


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize(
    ("every", "wide", "start"), [(0.1, 0.05, 0.1), (0.7, 0.35, 0.7), (0.3, 0.1, 0.3), (0.25, 0.125, 0.25)]
)  # fmt: skip
def test_every_edge_is_seen_by_the_sample_at_its_instant(simulate, engine, every, wide, start):
    """Each pulse begins at one sample and ends at another one."""
    result = simulate(f"""
    components:
      pulses: {{type: SignalSource,
               value: {{pulses: {{to: 1, every: {every} s, wide: {wide} s, count: 40, start: {start} s}}}}}}
      rising: {{type: SignalEdge, period: {wide} s}}
      both: {{type: SignalEdge, period: {wide} s, edge: both}}
    connections: [[pulses.signal, rising.value, both.value]]
    run: {{stop: {42 * every} s, engine: {engine}}}
    """)
    assert result["rising.count"][-1] == 40
    assert result["both.count"][-1] == 80
