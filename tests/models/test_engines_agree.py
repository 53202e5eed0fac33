"""Two engines that share laws and zones but no step agree on every bundled model, within their own error estimates.

The error of an engine at accuracy 1e-4 is estimated by itself, as the distance to its result at 1e-6. Then

    |A - B| at 1e-6  is at most a fifth of the sum of both estimates: both go to the same solution, of order one in the
                     accuracy or better; or it is below the weight of a position there, and less was never asked for
    |A - B| at 1e-4  is at most that sum over 1 - 1/5, for the estimates leave out the error at 1e-6

Compared are all positions at 51 times.
"""

from pathlib import Path

import fairlead.models
import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run, integrate
from fairlead.system.compile import compile

LOOSE, TIGHT = 1e-4, 1e-6
FALL, POSITION = 1 / 5, 1e-2  # of errors from LOOSE to TIGHT; m, the size a position's accuracy refers to
MODELS = sorted(path.stem for path in Path(fairlead.models.__file__).parent.glob("*.yaml"))
SPAN = {"belt": 5.0, "block_and_spring": 4.0, "sandwich": 2.0, "hundred_blocks": 0.5, "single_bend": 2.0,
        "guidance_route": 0.1, "guidance_route_ideal": 0.1, "guidance_route_electric": 0.1,
        "weak_clamp": 0.1, "slack_start": 0.1, "long_deployment": 0.05}  # fmt: skip
"""Seconds of each model that are compared: some whole cycles, or the first hundreds of switches."""
SHORT = 0.5


class Unknowns:
    """The system without its outputs, so that the engine records the unknowns themselves."""

    def __init__(self, system):
        self.system = system
        self.callbacks = {name: address for name, address in system.callbacks.items() if name != "outputs"}

    def __getattr__(self, name):
        return getattr(self.system, name)


def positions(model, span, engine, accuracy):
    """[51, number of positions], at equal distances in time."""
    system = compile(model.flat, accuracy)
    start = model.netlist.run.start
    outcome = integrate(Unknowns(system), Run(start=start, stop=start + span, every=span / 50, engine=engine))
    assert outcome.ok, outcome.sentence
    # Positions are what is solved to an absolute accuracy; a row after an event repeats the one before it.
    chosen = system.differential & ~system.quadrature & (system.relative == 0.0)
    if not chosen.any():
        pytest.skip(f"nothing in {model.netlist.name} has a position")
    times = outcome.times[outcome.sides == 0]
    return outcome.values[outcome.sides == 0][np.unique(np.round(times / span * 50), return_index=True)[1]][:, chosen]


@pytest.mark.parametrize("name", MODELS)
def test_rodas_and_ida_agree_within_their_error_estimates(name):
    pytest.importorskip("sksundae.ida", reason="needs scikit-sundae: pip install 'fairlead[ida]'")
    model, span = fairlead.load(name), SPAN.get(name, SHORT)
    found = {(e, a): positions(model, span, e, a) for e in ("rodas", "ida") for a in (LOOSE, TIGHT)}
    estimates = sum(np.abs(found[engine, LOOSE] - found[engine, TIGHT]).max() for engine in ("rodas", "ida"))
    assert np.abs(found["rodas", LOOSE] - found["ida", LOOSE]).max() <= estimates / (1 - FALL)
    assert np.abs(found["rodas", TIGHT] - found["ida", TIGHT]).max() <= max(FALL * estimates, TIGHT * POSITION)
