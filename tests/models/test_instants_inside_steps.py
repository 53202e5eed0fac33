"""Instants of switches inside steps of `stepping`: of contacts among more of them than it ends its steps for."""

import math

import numpy as np
import pytest

ROW = 45  # more than the machines for which steps end at every switch
FRICTION = 3.0  # N, of 10 N at 0.3


def blocks(driven, connected):
    """Blocks on a floor that nothing moves, beside one that something does."""
    parts = "".join(f"  m{k}: {{type: Mass, mass: 1 kg}}\n  c{k}: {CONTACT}\n" for k in range(ROW))
    joints = "".join(f"  - [floor.flange, c{k}.a]\n  - [c{k}.b, m{k}.flange]\n" for k in range(ROW))
    return (
        f"components:\n  floor: {{type: Ground}}\n  rub: {CONTACT}\n  block: {{type: Mass, mass: 1 kg{driven[0]}}}\n"
        f"{driven[1]}{parts}connections:\n{joints}  - [floor.flange, rub.a]\n  - [rub.b, block.flange{connected}]\n"
        "run: {stop: 2 s, engine: stepping}\n"
    )


CONTACT = "{type: Contact, normal_force: 10 N, curve: 0.3}"


def switches(result):
    """When the contact of the driven block changed, and into which zone."""
    return [(event.t, event.zone_to) for event in result.events if event.component == "rub" and event.t > 0.0]


@pytest.mark.parametrize(("accuracy", "within"), [(1e-3, 2e-3), (1e-5, 1e-4)])
def test_a_block_on_a_spring_comes_to_rest_and_lets_go_when_it_must(accuracy, within, simulate):
    """x = 0.5 m on a spring of 40 N/m: half swings of pi/omega, each 2 F/k shorter, and rest where k x is below F."""
    driven = (", position: 0.5 m", "  spring: {type: Spring, stiffness: 40 N/m}\n")
    text = blocks(driven, ", spring.b").replace("- [floor.flange, rub.a]", "- [floor.flange, rub.a, spring.a]")
    result = simulate(text, **{"run.accuracy": accuracy})
    half, left, turns = math.pi / math.sqrt(40), 0.5, []
    while left * 40 > FRICTION:
        left -= 2 * FRICTION / 40
        turns.append(half * (len(turns) + 1))
        left = abs(left)
    seen = [t for t, _ in switches(result)]
    assert all(min(abs(t - turn) for t in seen) < within for turn in turns)
    assert all(min(abs(t - turn) for turn in turns) < within for t in seen)


@pytest.mark.parametrize(("accuracy", "within"), [(1e-3, 3e-3), (1e-5, 3e-4)])
def test_a_block_that_a_force_pushes_to_and_fro_lets_go_at_its_friction(accuracy, within, simulate):
    """F(t) = 5 N sin(2 pi t): it lets go where that is 3 N; the instants are no ends of steps."""
    driven = ("", "  push: {type: ForceSource, force: {sine: {amplitude: 5 N, frequency: 1 Hz}}}\n")
    result = simulate(blocks(driven, ", push.flange"), **{"run.accuracy": accuracy})
    first = next(t for t, zone in switches(result) if zone == "forward")
    assert first == pytest.approx(math.asin(0.6) / (2 * math.pi), abs=within)
    assert np.abs(np.array(result.t) - first).min() > 0.0
    assert [event.t for event in result.events] == sorted(event.t for event in result.events)
