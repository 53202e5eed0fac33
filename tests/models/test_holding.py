"""What holds stands still: no creep above rounding, and no drift in an hour, by `rodas` and by `stepping`.

Networks of coupled contacts: trees of bodies, some pairs of them joined more than once and over circles.
"""

import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run, integrate
from tests.reference.held_network import random_network

ENGINES = pytest.mark.parametrize("engine", ["rodas", "stepping"])
CREEP = 1e-12  # m/s
CASES = [(20, 20), (20, 40), (60, 120)]  # bodies, contacts: a tree, and two with circles


def swinging(network, stop, engine, slowly):
    """The netlist of a network whose loads swing, each at a frequency of its own."""
    text = network.netlist(stop, engine)
    for k, load in enumerate(network.loads):
        rate = 0.5 + 0.03 * k
        wave = f"amplitude: {abs(load):.17g} N, frequency: {slowly * rate} Hz, phase: {k} rad"
        constant = f"f{k}: {{type: ForceSource, force: {load:.17g} N}}"
        assert constant in text
        text = text.replace(constant, f"f{k}: {{type: ForceSource, force: {{sine: {{{wave}}}}}}}")
    return text


def run(system, engine, stop, every, *what):
    """The outcome, and for each name pattern every recorded row [rows, signals]."""
    chosen = [signal.name for signal in system.recording(what).chosen]
    outcome = integrate(system, Run(stop=stop, every=every, engine=engine, record=what))
    assert outcome.ok, outcome.sentence
    tables = []
    for pattern in what:
        ending = pattern.rpartition("*")[2]
        tables.append(outcome.values[:, [k for k, name in enumerate(chosen) if name.endswith(ending)]])
    return outcome, *tables


@ENGINES
@pytest.mark.parametrize(("bodies", "contacts"), CASES)
def test_a_network_that_holds_swinging_loads_for_an_hour_stays_where_it_is(scene, engine, bodies, contacts):
    network = random_network(3, bodies, contacts, 1e4, 1.0)
    assert np.abs(network.loads).sum() < network.limits.min()  # nothing can let go
    system = scene(swinging(network, "3600 s", engine, slowly=1e-2)).system
    outcome, speeds = run(system, engine, 3600.0, 25.0, "m*.v")
    assert not len(outcome.events)
    assert np.abs(speeds).max() < CREEP
    places = [k for k, name in enumerate(system.unknown_names) if name.endswith(".x")]
    assert len(places) == bodies
    assert np.abs(outcome.y[places]).max() < CREEP * 3600.0  # the same of the mean over the hour: 4 nm


def check_that_nothing_creeps(scene, text, engine, contacts):
    """In both rows of a switch too, and in those between two steps, of which `stepping` takes fewer than rows."""
    system = scene(text).system
    outcome, slip, bound = run(system, engine, 2.0, 1e-3, "c*.slip", "c*.bound")
    assert slip.shape[1] == contacts
    holds = bound == 1
    assert 0.05 < holds.mean() < 0.95  # some hold, some slide
    assert len(outcome.events) > 50
    assert np.abs(slip[holds]).max() < CREEP


@ENGINES
@pytest.mark.parametrize(("bodies", "contacts"), CASES)
def test_what_holds_between_slips_does_not_creep(scene, engine, bodies, contacts):
    text = swinging(random_network(1, bodies, contacts, 1.0, 1.3), "2 s", engine, slowly=1.0)
    check_that_nothing_creeps(scene, text, engine, contacts)


@pytest.mark.parametrize(("bodies", "contacts"), CASES)
def test_what_holds_on_a_shaken_wall_does_not_creep_in_steps(scene, bodies, contacts):
    text = swinging(random_network(1, bodies, contacts, 1.0, 1.3), "2 s", "stepping", slowly=1.0)
    shaken = "wall: {type: MotionSource, position: {sine: {amplitude: 40 mm, frequency: 1.5 Hz}}}"
    check_that_nothing_creeps(scene, text.replace("wall: {type: Ground}", shaken), "stepping", contacts)


@ENGINES
def test_a_hundred_blocks_do_not_creep_while_they_hold(engine):
    system = fairlead.load("hundred_blocks").system
    _, slip, bound = run(system, engine, 1.0, 1e-3, "rod.guide[*].slip", "rod.guide[*].bound")
    assert slip.shape[1] == 100
    assert (bound == 1).mean() > 0.1
    assert np.abs(slip[bound == 1]).max() < CREEP
