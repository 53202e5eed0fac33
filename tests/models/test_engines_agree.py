"""Three engines that share laws and zones agree on every bundled model, within their own error estimates.

No two of them share a step: `rodas` locates every switch, `stepping` finds zones inside its steps, `ida` is a
multistep method of somebody else. The error of an engine at accuracy 1e-4 is estimated by itself, as the distance to
its result at 1e-6. Then, of any two of them,

    |A - B| at 1e-6  is at most a fifth of the sum of both estimates: both go to the same solution, and errors fall to
                     a fifth in two decades; or it is below the weight of a position there, and less was never asked for
    |A - B| at 1e-4  is at most that sum over 1 - 1/5, for the estimates leave out the error at 1e-6

Compared are all positions at 51 times; where nothing has a position all states, over their nominal size.
"""

import functools
import itertools
from pathlib import Path

import fairlead.models
import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run, integrate

LOOSE, TIGHT = 1e-4, 1e-6
FALL, POSITION = 1 / 5, 1e-2  # of errors from LOOSE to TIGHT; m, the size a position's accuracy refers to
MODELS = sorted(path.stem for path in Path(fairlead.models.__file__).parent.glob("*.yaml"))
ENGINES = ("rodas", "stepping", "ida")
SPAN = {"belt": 5.0, "block_and_spring": 4.0, "sandwich": 2.0, "hundred_blocks": 0.5, "single_bend": 2.0,
        "guidance_route": 0.1, "guidance_route_ideal": 0.1, "guidance_route_electric": 0.1,
        "weak_clamp": 0.1, "slack_start": 0.05, "long_deployment": 0.02, "long_route": 0.003,
        "power_unit": 0.7}  # fmt: skip
"""Seconds of each model that are compared: some whole cycles, or the first hundreds of switches."""
SHORT = 0.5
QUICK = {"belt", "block_and_spring", "crustacean", "friction_anchor", "power_unit", "sandwich", "torsion",
         "valve_motor", "winch_drive"}  # fmt: skip


class Unknowns:
    """The system without its outputs, so that the engine records the unknowns themselves."""

    def __init__(self, system):
        self.system = system
        self.callbacks = {name: address for name, address in system.callbacks.items() if name != "outputs"}

    def instance(self, *run):
        return Unknowns(self.system.instance(*run))

    def __getattr__(self, name):
        return getattr(self.system, name)


@functools.cache
def states(name, engine, accuracy):
    """[51, states] at equal distances in time, in metres; POSITION is the nominal size of other states."""
    model, span = fairlead.load(name), SPAN.get(name, SHORT)
    start = model.netlist.run.start
    run = Run(start=start, stop=start + span, every=span / 50, engine=engine, accuracy=accuracy)
    outcome = integrate(Unknowns(model.system), run)
    assert outcome.ok, outcome.sentence
    system = outcome.problem
    state = system.differential & ~system.quadrature
    # Positions are what is solved to an absolute accuracy; a row after an event repeats the one before it.
    position = state & (system.relative == 0.0)
    chosen = position if position.any() else state
    times = outcome.times[outcome.sides == 0]
    rows = outcome.values[outcome.sides == 0][np.unique(np.round(times / span * 50), return_index=True)[1]][:, chosen]
    return rows if position.any() else rows * POSITION * accuracy / system.absolute[chosen]


def pairs():
    """Every model and two engines; those whose runs take seconds are slow."""
    for name, (one, other) in itertools.product(MODELS, itertools.combinations(ENGINES, 2)):
        quick = name in QUICK or (name == "single_bend" and "ida" not in (one, other))
        yield pytest.param(name, one, other, marks=[] if quick else pytest.mark.slow)


@pytest.mark.parametrize(("name", "one", "other"), list(pairs()))
def test_two_engines_agree_within_their_error_estimates(name, one, other):
    if "ida" in (one, other):
        pytest.importorskip("sksundae.ida", reason="needs scikit-sundae: pip install 'fairlead[ida]'")
    found = {(e, a): states(name, e, a) for e in (one, other) for a in (LOOSE, TIGHT)}
    estimates = sum(np.abs(found[engine, LOOSE] - found[engine, TIGHT]).max() for engine in (one, other))
    assert np.abs(found[one, LOOSE] - found[other, LOOSE]).max() <= estimates / (1 - FALL)
    assert np.abs(found[one, TIGHT] - found[other, TIGHT]).max() <= max(FALL * estimates, TIGHT * POSITION)
