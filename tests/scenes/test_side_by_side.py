"""What happens in one scene is no matter of another that nothing joins to it, not even at the same instant."""

import numpy as np
import pytest

from tests.scenes.classes import CLASSES
from tests.scenes.side_by_side import LEFT, RIGHT, joined, motions, stop_of

ACCURACY = 1e-6
ALLOWED = 300
"""Accuracies: steps are other ones, and a scene of impacts makes more of an error; outcomes differ by far more."""
KINDS = ["networks", "impacts", "catches", "ties", "limits", "jumps", "starts", "ratios"]
REFUSED = [("impacts", "stepping"), ("ratios", "stepping"), ("ratios", "ida")]  # by name: rigid stops, moving ratios
PLAYED = [(kind, engine) for kind in KINDS for engine in ("rodas", "stepping", "ida") if (kind, engine) not in REFUSED]
QUICK = {"impacts": (22, "rodas"), "catches": (28, "rodas"), "ties": (24, "rodas"), "starts": (33, "stepping")}
"""One seed and engine for `make test`."""


def apart(alone, both, begins, back):
    """The largest difference of what a scene shows in company from what it shows alone."""
    mine = {back(name): values for name, values in both.items() if name.startswith(begins)}
    assert mine
    assert set(mine) == set(alone)
    return max(float(np.abs(values - alone[name]).max()) for name, values in mine.items())


@pytest.mark.parametrize("kind", QUICK)
def test_a_scene_beside_its_like_goes_as_alone(kind):
    """All that happens in one happens in the other at the same instant."""
    seed, engine = QUICK[kind]
    alike(kind, seed, engine)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [20, 21, 28, 41])
@pytest.mark.parametrize(("kind", "engine"), PLAYED)
def test_any_scene_beside_its_like_goes_as_alone(kind, seed, engine):
    alike(kind, seed, engine)


def alike(kind, seed, engine):
    scene = CLASSES[kind](seed)
    stop = stop_of(scene)
    text, back = joined(scene.text, scene.text)
    alone = motions(scene, scene.text, stop, engine, ACCURACY)
    both = motions(scene, text, stop, engine, ACCURACY)
    for begins, names in zip((LEFT, RIGHT), back):
        assert apart(alone, both, begins, names) <= ALLOWED * ACCURACY


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [50, 60])
def test_two_scenes_beside_each_other_go_as_alone(kind, seed):
    one, other = CLASSES[kind](seed), CLASSES[kind](seed + 1)
    stop = min(stop_of(one), stop_of(other))
    text, back = joined(one.text, other.text)
    both = motions(one, text, stop, "rodas", ACCURACY)
    for scene, begins, names in zip((one, other), (LEFT, RIGHT), back):
        alone = motions(scene, scene.text, stop, "rodas", ACCURACY)
        assert apart(alone, both, begins, names) <= ALLOWED * ACCURACY
