"""Which contacts let go when a load jumps: those that a build-up of the load would have overloaded, in its order.

Oracles: closed forms; ramps of 10 and 1 us, in which `rodas` meets one contact after another; and, where nothing falls,
Gauss's principle of least constraint: of all forces within their limits those that leave the least sum
(f - C^T s) M^-1 (f - C^T s),  by scipy's bounded least squares.
"""

import numpy as np
import pytest
import scipy.optimize

import fairlead
from fairlead.integrate import Run, integrate
from tests.reference.held_network import random_network
from tests.scenes.jumps import AT, jump

ENGINES = ("rodas", "stepping", "ida")
PILE = """
components:
  ground: {{type: Ground}}
  low: {{type: Mass, mass: 1 kg}}
  middle: {{type: Mass, mass: 1 kg}}
  top: {{type: Mass, mass: 1 kg}}
  c0: {{type: Contact, normal_force: 30 N, curve: {{curve: coulomb, coulomb: 0.20, stiction: 0.21}}}}
  c1: {{type: Contact, normal_force: 20 N, curve: {{curve: coulomb, coulomb: 0.30, stiction: 0.32}}}}
  c2: {{type: Contact, normal_force: 10 N, curve: {{curve: coulomb, coulomb: 0.50, stiction: 0.65}}}}
  push: {{type: ForceSource, force: {force}}}
connections:
  - [ground.flange, c0.a]
  - [c0.b, low.flange, c1.a]
  - [c1.b, middle.flange, c2.a]
  - [c2.b, top.flange, push.flange]
run: {{stop: 1.1 s, accuracy: 1e-6, engine: {engine}}}
record: {{every: 10 ms}}
"""
SHAFTS = """
components:
  r1: {{type: Inertia, moment: 0.7 kg*m^2}}
  r2: {{type: Inertia, moment: 0.7 kg*m^2}}
  r3: {{type: Inertia, moment: 0.7 kg*m^2}}
  left: {{type: Clutch, radius: 0.13 m, normal_force: 97 N, curve: {{curve: coulomb, coulomb: 0.4, stiction: 0.5}}}}
  right: {{type: Clutch, radius: 0.13 m, normal_force: 97 N, curve: {{curve: coulomb, coulomb: 0.4, stiction: 0.5}}}}
  drive: {{type: TorqueSource, torque: {torque}}}
  load: {{type: TorqueSource, torque: {against}}}
connections:
  - [r1.shaft, left.a, drive.shaft]
  - [left.b, r2.shaft, right.a]
  - [right.b, r3.shaft, load.shaft]
run: {{stop: 1 s, accuracy: {accuracy}, engine: {engine}}}
"""
TORQUES = {
    "jump": ("{{step: {{to: {}10 N*m, at: 0.3 s}}}}"),
    "ramp": ("{{ramp: {{to: {}10 N*m, over: 0.7 s, start: 0.1 s}}}}"),
    "from the start": "{}10 N*m",
}


def needs(engine):
    """Skip where the library of an engine is missing."""
    if engine == "ida":
        pytest.importorskip("sksundae.ida", reason="needs scikit-sundae: pip install 'fairlead[ida]'")


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("force", "time"), [("{step: {to: 6.45 N, at: 0.1 s}}", 1.0), ("6.45 N", 1.1)], ids=["jump", "from the start"]
)
def test_the_contact_that_a_build_up_meets_first_lets_go_and_relieves_the_others(scene, engine, force, time):
    """The load reaches 6.3 N, the limit of the lowest, first; then 6 N remain there, and no other sees its limit."""
    needs(engine)
    result = scene(PILE.format(force=force, engine=engine)).run(out=None)
    ends = [result[f"{body}.x"][-1] for body in ("low", "middle", "top")]
    assert ends == pytest.approx([0.5 * (6.45 - 6.0) / 3 * time**2] * 3, rel=1e-4)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("torque", TORQUES)
@pytest.mark.parametrize("accuracy", ["1e-3", "1e-5"])
def test_what_is_symmetric_stays_symmetric(scene, engine, torque, accuracy):
    """Equal shafts, equal clutches, equal torques against each other: the shaft in the middle has no way to turn."""
    needs(engine)
    goes = TORQUES[torque]
    text = SHAFTS.format(torque=goes.format(""), against=goes.format("-"), accuracy=accuracy, engine=engine)
    result = scene(text).run(out=None)
    assert abs(result["r2.speed"][-1]) < 1e-6
    assert result["r1.speed"][-1] == pytest.approx(-result["r3.speed"][-1], rel=1e-6)
    assert result["r1.speed"][-1] > 0.5


def changes(text, tmp_path, bodies=8):
    """By how much the jump and the ramps change the speeds of the bodies."""
    path = tmp_path / "jump.yaml"
    path.write_text(text, encoding="utf-8")
    result = fairlead.load(path).run(out=None)
    assert result.status == "finished", result.run["sentence"]
    before = np.searchsorted(result.t, AT - 1e-9) - 1
    names = [f"b{i}.v" for i in range(1, bodies) if f"b{i}.v" in result]
    return np.array([result[name][-1] - result[name][before] for name in names])


def judged(seed, tmp_path, engine="rodas"):
    """True where the jump is the limit of ramps, False where it is not; None where the two ramps disagree."""
    slow, fast = (changes(jump(seed, how, "rodas"), tmp_path) for how in ("10 us", "1 us"))
    largest = max(np.abs(fast).max(), 1e-6)
    if np.abs(slow - fast).max() > 0.15 * largest:  # of 100 us the slow ramp takes 10, so a twentieth is its own
        return None
    return bool(np.abs(changes(jump(seed, "step", engine), tmp_path) - fast).max() <= 0.015 * largest + 1e-7)


@pytest.mark.parametrize("seed", range(12))
def test_a_jump_is_the_limit_of_ramps(seed, tmp_path):
    assert judged(seed, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "seeds"),
    [("rodas", range(12, 500)), ("stepping", range(60)), ("ida", range(60))],
)
def test_many_jumps_are_the_limit_of_ramps(engine, seeds, tmp_path):
    needs(engine)
    verdicts = {seed: judged(seed, tmp_path, engine) for seed in seeds}
    aside = [seed for seed, verdict in verdicts.items() if verdict is None]
    assert [seed for seed, verdict in verdicts.items() if verdict is False] == []
    assert len(aside) <= 0.02 * len(seeds), aside


@pytest.mark.parametrize("contacts", [12, 20])
@pytest.mark.parametrize("seed", range(4))
def test_where_nothing_falls_the_accelerations_are_those_of_least_constraint(scene, seed, contacts):
    network = random_network(seed, 12, contacts, 0.6, 1.0)
    outcome = integrate(scene(network.netlist()).system, Run(stop=1.0, max_steps=0))
    at = {name: k for k, name in enumerate(outcome.problem.unknown_names)}
    forces = np.array([outcome.y[at[f"c{j}.force"]] for j in range(contacts)])
    root = 1 / np.sqrt(network.masses)
    least = scipy.optimize.lsq_linear(
        root[:, None] * network.slips.T, root * network.loads, (-network.limits, network.limits), tol=1e-14
    )
    found, right = ((network.loads - network.slips.T @ s) / network.masses for s in (forces, least.x))
    assert found == pytest.approx(right, abs=1e-6 * np.abs(network.loads / network.masses).max())
