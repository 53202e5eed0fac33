"""The long route: tensions of the bundled model against closed forms, at rest in statics and at the start of a run."""

import math

import numpy as np
import pytest

import fairlead

MU, KEPT, ANGLE = 0.3, 200.0, 0.75 * math.pi  # friction, tension at the winch [N], bends inboard of the deployer [rad]


@pytest.fixture(scope="module")
def model():
    return fairlead.load("long_route", set={"run.stop": "0.1 s"})


@pytest.fixture(scope="module")
def states(model):
    return {math.copysign(1, state.speed): state for state in model.statics()[0].moving}


@pytest.mark.slow
def test_before_the_deployer_the_sum_of_the_angles_counts(states):
    for way, state in states.items():
        passages = {passage.name: passage for passage in state.passages}
        assert passages["deployer"].inboard == pytest.approx(KEPT * math.exp(way * MU * ANGLE), rel=1e-9)


@pytest.mark.slow
def test_the_pulley_takes_the_friction_of_its_bearing_only(states):
    for way, state in states.items():
        (pulley,) = (passage for passage in state.passages if passage.name == "pulley")
        mean = (pulley.inboard + pulley.outboard) / 2
        carried = 2 * mean * math.sin(math.pi / 8)  # N, by the bearing of a pulley that turns the line through 45 deg
        assert way * (pulley.outboard - pulley.inboard) == pytest.approx(0.1 * 0.04 * carried, rel=0.01)


def test_it_has_240_elements_in_three_modules(model):
    paths = {instance.path for instance in model.flat.instances}
    assert "line.core[239]" in paths
    assert "line.core[240]" not in paths
    assert [k for k in range(241) if f"line.registration[{k}]" not in paths] == [0, 80, 160, 240]


def test_a_run_begins_with_the_tensions_of_statics_and_keeps_its_energy(model):
    result = model.run(out=None)
    assert result.status == "finished"
    assert result.run["energy"]["closure"] < 1e-6
    nodes = [result[f"line.hose_node[{k}].x"][0] for k in range(241)]
    k = int(np.searchsorted(nodes, 6.2)) - 1  # between the second bend and the deployer
    tension = result[f"line.core[{k}].tension"] + result[f"line.hose[{k}].tension"]
    assert tension[0] == pytest.approx(KEPT * math.exp(MU * ANGLE), rel=1e-9)  # nothing touches the line there
