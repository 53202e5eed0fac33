"""Flow valves in series that a pressure opens at once: the smallest keeps its flow, the others are wholly open.

All of them regulate after one pass of the settlement, and then nothing gives the pressures between them.
"""

from __future__ import annotations

import itertools

import pytest


def netlist(settings: tuple[float, ...], bars: float) -> str:
    valves = "\n".join(
        f"          {name}: {{type: FlowControlValve, setting: {flow} l/min}}"
        for name, flow in zip("vwxy", settings, strict=False)
    )
    chain = ", ".join(f"[{one}.b, {other}.a]" for one, other in itertools.pairwise("vwxy"[: len(settings)]))
    return f"""
        components:
          s: {{type: PressureSource, pressure: {bars} bar}}
{valves}
          t: {{type: Tank}}
        connections: [[s.port, v.a], {chain}, [{"vwxy"[len(settings) - 1]}.b, t.port]]
        run: {{stop: 0.1 s}}
    """


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("settings", [(4, 3), (3, 4), (4, 3, 5), (5, 4, 3), (3, 4, 5), (5, 3, 4), (6, 5, 4, 3)])
def test_the_smallest_keeps_its_flow(simulate, engine, settings):
    result = simulate(netlist(settings, 100), **{"run.engine": engine})
    for name in "vwxy"[: len(settings)]:
        assert result[f"{name}.flow"] == pytest.approx(min(settings) / 6e4, rel=1e-6)


@pytest.mark.parametrize("settings", [(4, 3), (3, 4)])
def test_too_little_pressure_starves_both(simulate, settings):
    """Each passes its setting at 5 bar, so that (Q/Q_v)^2 + (Q/Q_w)^2 = 1 bar/5 bar, but for what flows laminar."""
    result = simulate(netlist(settings, 2.01325), **{"run.accuracy": "1e-6"})  # of 1 bar to a tank at 1.01325 bar
    q = (0.2 / (1 / settings[0] ** 2 + 1 / settings[1] ** 2)) ** 0.5
    assert result["v.flow"][-1] * 6e4 == pytest.approx(q, rel=0.02)
