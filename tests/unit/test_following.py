"""What a given motion has more on the chord of a step: asked of the laws that follow one, and of no others."""

import numpy as np
import pytest

import fairlead
from tests.callbacks import Called

DRIVEN = {
    "a spring": ("hundred_blocks", {"blocks": "6"}),
    "signals that follow": ("single_bend", {}),
    "one block": ("belt", {}),
}
# The rate of a balance is a signal of its own beside w (algebraic_nodes.py), and follows what is given too.
WITHOUT_INERTIA = """
    schema: 1
    name: light
    components:
      ground: {type: Ground}
      hand: {type: MotionSource, position: {sine: {amplitude: 40 mm, frequency: 1 Hz}}}
      hook: {type: Spring, stiffness: 2000 N/m}
      pad: {type: Contact, normal_force: 10 N, curve: 0.5, method: hold}
      block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
      shaft: {type: SpringDamper, stiffness: 300 N/m, damping: 4 N*s/m}
    connections:
      - [hand.flange, hook.a]
      - [hook.b, pad.a]
      - [pad.b, block.flange, shaft.a]
      - [shaft.b, ground.flange]
    run: {stop: 1 s}
"""


def ahead_of(system, seed):
    """(`ahead`, f on the chord less f at its time, f) for a step of 5 ms at some place near the start."""
    called = Called(system)
    here, n = called.system, called.n
    y = here.initial + 1e-3 * np.random.default_rng(seed).normal(size=n)
    t, asked, chord, moment = 0.3, np.zeros(n), np.zeros(n), np.zeros(n)
    here.mean[:4] = [t - 0.0025, t + 0.0025, 0.5, 0.5]
    called._call("ahead", t, y, asked)
    called._call("forces", t, y, chord)
    here.mean[2:4] = 0.0
    called._call("forces", t, y, moment)
    return asked, chord - moment, chord


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("name", [*DRIVEN, "a node without inertia"])
def test_ahead_is_the_difference_of_two_evaluations_of_f(name, seed, tmp_path):
    if name in DRIVEN:
        model, settings = DRIVEN[name]
        system = fairlead.load(model, set=settings).system
    else:
        (tmp_path / "light.yaml").write_text(WITHOUT_INERTIA)
        system = fairlead.load(tmp_path / "light.yaml").system
        assert system.numbering.rated
    asked, difference, f = ahead_of(system, seed)
    rounding = 4e-16 * np.abs(f).max()
    np.testing.assert_allclose(asked, difference, rtol=0, atol=16 * rounding)
    if name != "one block":  # which is pulled at a constant speed
        assert np.abs(difference).max() > 1e4 * rounding


def test_a_row_of_blocks_asks_its_hook_alone():
    """However many blocks there are: two whole evaluations in every step were a third of all."""
    model = fairlead.load("hundred_blocks", set={"blocks": "12", "run.stop": "0.5 s"})
    flows = model.system.memory["following_flows"]
    assert [(model.system.blocks[b].instances[k].path) for b, k, end in flows.tolist() if end == k + 1] == ["hook"]
