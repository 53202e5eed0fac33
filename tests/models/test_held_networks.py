"""Many stick and slip decisions at once: random trees and random networks with circles, up to 300 bodies.

What a settlement must have reached is checked against the definition of friction and numpy's least-norm solution.
"""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate import Run, Status, integrate
from tests.conftest import Scene
from tests.reference.held_network import Network, random_network

SIZES = [(20, 20), (20, 40), (100, 100), (100, 200), (300, 300), (300, 600)]
ROUNDING = 1e-7


def settled(scene: Scene, network: Network, engine: str = "rodas"):
    """System and outcome at the start, settled."""
    system = scene(network.netlist(engine=engine)).system
    outcome = integrate(system, Run(stop=1.0, max_steps=0, engine=engine))
    return outcome.problem, outcome


def forces_and_directions(system, outcome, contacts: int) -> tuple[np.ndarray, np.ndarray]:
    """Force of every contact [N], and 0 where it holds, else the sign of its sliding."""
    at = {name: k for k, name in enumerate(system.unknown_names)}
    zones = {name: system.zone_names(k)[system.zones[k]] for k, name in enumerate(system.machine_names)}
    signs = {"held": 0, "forward": 1, "backward": -1}
    forces = np.array([outcome.y[at[f"c{j}.force"]] for j in range(contacts)])
    return forces, np.array([signs[zones[f"c{j}"]] for j in range(contacts)])


@pytest.mark.parametrize(("strength", "stiction"), [(0.3, 1.0), (1.0, 1.3), (3.0, 1.0)])
@pytest.mark.parametrize(("bodies", "contacts"), SIZES)
def test_what_settles_is_friction(scene: Scene, bodies: int, contacts: int, strength: float, stiction: float) -> None:
    for seed in range(2 if bodies < 300 else 1):
        network = random_network(seed, bodies, contacts, strength, stiction)
        system, outcome = settled(scene, network)
        assert outcome.status == Status.MAX_STEPS, outcome.sentence  # settled, and no step allowed
        # One contact after another where the order matters.
        assert outcome.counters.settling_passes <= contacts * (1 if stiction > 1 else 1 / 3) + 20
        forces, sign = forces_and_directions(system, outcome, contacts)
        held, slips, limits = sign == 0, network.slips, network.limits
        assert np.all(np.abs(forces[held]) <= stiction * limits[held] * (1 + ROUNDING))
        assert forces[~held] == pytest.approx(sign[~held] * limits[~held], rel=1e-9)
        # Balance of momentum gives the accelerations; what holds has none, what slides goes along with its friction.
        accelerations = (network.loads - slips.T @ forces) / network.masses
        scale = np.abs(network.loads / network.masses).max()
        relative = slips @ accelerations
        assert np.abs(relative[held]).max(initial=0.0) <= ROUNDING * scale
        assert np.all(sign[~held] * relative[~held] >= -ROUNDING * scale)
        # Of all forces that do that, those of least sum of squares.
        carried = network.loads - slips[~held].T @ forces[~held] - network.masses * accelerations
        least = np.linalg.lstsq(slips[held].T, carried, rcond=1e-10)[0]
        assert forces[held] == pytest.approx(least, abs=1e-6 * max(1.0, np.abs(forces).max()))


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_two_settlements_of_one_network_are_bitwise_the_same(scene: Scene, engine: str) -> None:
    network = random_network(5, 100, 200, 1.0, 1.3)
    one, other = (settled(scene, network, engine)[1] for _ in range(2))
    assert one.y.tobytes() == other.y.tobytes()
    assert one.events.tobytes() == other.events.tobytes()


@pytest.mark.parametrize("accuracy", ["3e-2", "1e-4"])
def test_a_network_that_sticks_and_slips_does_the_same_at_every_accuracy(scene: Scene, accuracy: str) -> None:
    """Twenty bodies, forty contacts, loads that swing: some hundred switches, and none that does not settle."""
    text = random_network(0, 20, 40, 1.0, 1.3).netlist("2 s").splitlines()
    for k, line in enumerate(text):
        if "ForceSource" in line:
            name, size = line.split(":")[0], abs(float(line.split("force: ")[1].split(" N")[0]))
            wave = f"{{sine: {{amplitude: {size:.17g} N, frequency: {0.5 + 0.03 * k} Hz, phase: {k} rad}}}}"
            text[k] = f"{name}: {{type: ForceSource, force: {wave}}}"
    model = "\n".join(text) + "\n"
    ends = []
    for used in (accuracy, "1e-7"):
        system = scene(model.replace("1e-4", used)).system
        outcome = integrate(system, Run(stop=2.0))
        assert outcome.ok, outcome.sentence
        assert not outcome.chattering
        assert outcome.counters.replans == 0  # one order of pivots serves whatever holds
        at = [k for k, name in enumerate(system.unknown_names) if name.endswith(".x")]
        ends.append(outcome.y[at])
    assert ends[0] == pytest.approx(ends[1], abs=float(accuracy) * np.abs(ends[1]).max())


@pytest.mark.slow
@pytest.mark.parametrize("method", ["rodas5p", "rodas3p"])
@pytest.mark.parametrize("accuracy", ["1e-1", "3e-2", "1e-2", "1e-3"])
def test_a_hundred_blocks_run_at_every_accuracy(bundled, method: str, accuracy: str) -> None:
    """A force near its limit on a rough interpolant once sent a contact to and fro without end."""
    result = bundled("hundred_blocks", {"run.engine": "rodas", "run.method": method, "run.accuracy": accuracy})
    assert len(result.events) < 1500  # 1147 at 1e-5
