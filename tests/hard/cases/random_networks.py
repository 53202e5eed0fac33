"""Random networks of bodies rubbing on one another, under loads that swing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st

from tests.hard.drawing import many
from tests.hard.play import Play
from tests.hard.registry import case

STOP = 1.0  # s


@dataclass(frozen=True)
class Network:
    """Free bodies (log10 of mass, load in N, frequency in Hz), joined by contacts (a, b, limit in N) and springs."""

    bodies: tuple[tuple[int, int, int], ...]
    contacts: tuple[tuple[int, int, int], ...]
    springs: tuple[tuple[int, int], ...]
    stiction: float

    def netlist(self) -> str:
        """The scene. Links name bodies modulo their number; one from a body to itself is left out."""
        n = len(self.bodies)
        joins = [[f"m{k}.flange", f"f{k}.flange"] for k in range(n)]
        parts = []
        for k, (mass, load, hertz) in enumerate(self.bodies):
            wave = f"{{sine: {{amplitude: {load} N, frequency: {hertz} Hz}}}}"
            parts += [f"  m{k}: {{type: Mass, mass: 1e{mass} kg, position: 0 m, velocity: 0 m/s}}",
                      f"  f{k}: {{type: ForceSource, force: {wave}}}"]  # fmt: skip
        for j, (a, b, limit) in enumerate(self.pairs):
            curve = f"{{curve: coulomb, stiction: {self.stiction}, coulomb: 1}}"
            parts.append(f"  c{j}: {{type: Contact, normal_force: {limit} N, curve: {curve}}}")
            joins[a].append(f"c{j}.a")
            joins[b].append(f"c{j}.b")
        for j, (a, b) in enumerate(self.springs):
            if a % n != b % n:
                parts.append(f"  s{j}: {{type: SpringDamper, stiffness: 1 kN/m, damping: 1 N*s/m}}")
                joins[a % n].append(f"s{j}.a")
                joins[b % n].append(f"s{j}.b")
        tail = ["friction: {method: hold}", f"run: {{stop: {STOP} s, accuracy: 1e-5}}"]
        return "\n".join(["components:", *parts, "connections:", *(f"  - [{', '.join(j)}]" for j in joins), *tail])

    @property
    def pairs(self) -> list[tuple[int, int, int]]:
        """Contacts between different bodies."""
        n = len(self.bodies)
        return [(a % n, b % n, limit) for a, b, limit in self.contacts if a % n != b % n]

    def impulse(self, t: np.ndarray) -> np.ndarray:
        """Impulse of all loads [N s]."""
        total = np.zeros_like(t)
        for _, load, hertz in self.bodies:
            rate = 2 * np.pi * hertz
            total += load / rate * (1 - np.cos(rate * t))
        return total


def networks(most: int) -> st.SearchStrategy[Network]:
    """Networks of up to so many bodies and twice as many contacts."""
    index = st.integers(0, most - 1)
    body = st.tuples(st.integers(-2, 2), st.integers(0, 50), st.integers(1, 4))
    return st.builds(
        Network,
        bodies=st.lists(body, min_size=2, max_size=most).map(tuple),
        contacts=st.lists(st.tuples(index, index, st.integers(1, 30)), min_size=1, max_size=2 * most).map(tuple),
        springs=st.lists(st.tuples(index, index), max_size=most).map(tuple),
        stiction=st.sampled_from([1.0, 1.5]),
    )


def is_friction(play: Play, network: Network) -> None:
    """Momentum is the impulse of the loads; forces are within their limits, and at them where something slides."""
    result = play.run(network.netlist())
    masses = [10.0 ** body[0] for body in network.bodies]
    momentum = sum(m * result[f"m{k}.v"] for k, m in enumerate(masses))
    size = sum(load for _, load, _ in network.bodies) / 10 + 0.1
    play.near("momentum", momentum, network.impulse(result.t), 1e-3 * size)
    if play.treatment == "lugre":
        return
    fast = play.by(1e-5, 5 * play.creep)
    for j, (_, _, limit) in enumerate(network.pairs):
        force, slip = result[f"c{j}.friction"], result[f"c{j}.slip"]
        play.check(np.abs(force).max() <= network.stiction * limit * (1 + 1e-5), f"c{j} carries more than its stiction")
        sliding = (np.abs(slip) > fast) & (result.side == 0)
        play.near(f"friction of c{j} while it slides", (force * np.sign(slip))[sliding], limit, 1e-6 * limit)


ENGINES = ("rodas", "stepping", "ida")


@case({"20": {"examples": 20, "most": 5}}, engines=ENGINES, cost="fair", budget=120.0)
@case({"200": {"examples": 200, "most": 12}}, engines=("rodas", "stepping"), cost="slow", budget=400.0)
def random_networks(play: Play, examples: int, most: int) -> None:
    """Networks of up to 5 (12) bodies with masses over four decades and up to 10 (24) contacts between them, in any
    arrangement, circles included, with springs, under loads that swing; drawn from a fixed seed.

    Oracle: momentum is the impulse of the loads; no contact carries more than its stiction; what slides has its
    sliding friction against the slip; energy adds up.
    """
    many(play, networks(most), is_friction, examples)
