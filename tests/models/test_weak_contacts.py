"""A contact that holds a tenth of a millinewton lets go when its load says so, though weights of forces count newtons.

A body rests under a load that swings a little above stiction. The instant at which it lets go is a formula; the load
rises slowly there, so a share of the force is a larger share of the time.
"""

from math import asin, cos, pi

import pytest

STICTION, PEAK, RATE = 0.5, 0.51, pi
LETS_GO = asin(STICTION / PEAK) / RATE
SLOPE = PEAK * RATE * cos(RATE * LETS_GO) / STICTION
"""Of the load at that instant, as a share of stiction a second."""


@pytest.mark.parametrize("unit", [1.0, 1e-2, 1e-4])
@pytest.mark.parametrize("accuracy", [1e-4, 1e-6])
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_it_lets_go_at_its_limit(simulate, engine, accuracy, unit):
    """The force is known to ten accuracies of itself there, however small it is."""
    result = simulate(f"""
    components:
      floor: {{type: Ground}}
      chip: {{type: Mass, mass: {unit!r} kg}}
      pad: {{type: Contact, normal_force: {unit!r} N, curve: {{curve: coulomb, stiction: {STICTION}, coulomb: 0.4}}}}
      load: {{type: ForceSource, force: {{sine: {{amplitude: {PEAK * unit!r} N, frequency: 0.5 Hz}}}}}}
    connections: [[chip.flange, load.flange, pad.b], [pad.a, floor.flange]]
    run: {{stop: 1 s, accuracy: {accuracy}, engine: {engine}}}
    """)
    lets_go = next(event.t for event in result.events if event.zone_from == "held")
    assert lets_go == pytest.approx(LETS_GO, abs=2 * 10 * accuracy / SLOPE)
