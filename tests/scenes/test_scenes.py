"""The generators of random scenes: the same text for a seed, nothing to remark, and a run that ends."""

import hashlib

import pytest

import fairlead
from tests.scenes.networks import KINDS, network
from tests.scenes.routes import route

FEW = [*((network, seed) for seed in range(len(KINDS))), *((route, seed) for seed in range(3))]
MANY = [*((network, seed) for seed in range(len(KINDS), 100)), *((route, seed) for seed in range(3, 40))]


EXPECTED = "run.engine: "
"""What is remarked on where a scene asks for `stepping` and has laws that it is not made for."""


def played(make, seed, folder):
    path = folder / "scene.yaml"
    path.write_text(make(seed), encoding="utf-8")
    model = fairlead.load(path)
    assert [remark for remark in model.check() if EXPECTED not in remark.what] == []
    return model.run(out=folder / "run", force=True)


@pytest.mark.parametrize(("make", "seed"), FEW, ids=lambda value: getattr(value, "__name__", str(value)))
def test_a_random_scene_checks_clean_and_runs_to_its_end(make, seed, tmp_path):
    result = played(make, seed, tmp_path)
    assert result.status == "finished", result.run["sentence"]


@pytest.mark.slow
@pytest.mark.parametrize(("make", "seed"), MANY, ids=lambda value: getattr(value, "__name__", str(value)))
def test_many_random_scenes_check_clean_and_run_to_their_ends(make, seed, tmp_path):
    result = played(make, seed, tmp_path)
    assert result.status == "finished", result.run["sentence"]


def test_a_seed_gives_the_same_text_everywhere():
    """A failure that is reported by its seed can be played again: Python fixes its streams of random numbers."""
    texts = "".join(network(seed) for seed in range(20)) + "".join(route(seed) for seed in range(20))
    again = "".join(network(seed) for seed in range(20)) + "".join(route(seed) for seed in range(20))
    assert texts == again
    assert network(0) != network(len(KINDS))
    assert len({hashlib.sha256(network(seed).encode()).digest() for seed in range(200)}) == 200


def test_a_network_has_as_many_bodies_as_are_asked_for():
    for seed in range(len(KINDS) - 1):
        assert network(seed, size=40).count("type: Mass") == 40
