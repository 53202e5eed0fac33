"""Random networks of bodies and held contacts, and what their forces must be: no zones, no events, no shares."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

GROUND = -1


@dataclass(frozen=True)
class Network:
    """Bodies pulled by constant forces; contact j joins `pairs[j]`, the first of which may be the ground."""

    pairs: list[tuple[int, int]]
    masses: np.ndarray
    loads: np.ndarray
    limits: np.ndarray  # sliding friction [N]; stiction is `stiction` times that
    stiction: float

    def netlist(self, stop: str = "1 s", engine: str = "rodas") -> str:
        """The scene, without its first two lines."""
        bodies = range(len(self.masses))
        joins = {k: [f"m{k}.flange", f"f{k}.flange"] for k in bodies} | {GROUND: ["wall.flange"]}
        lines = ["components:", "  wall: {type: Ground}"]
        for k in bodies:
            lines.append(f"  m{k}: {{type: Mass, mass: {self.masses[k]:.17g} kg}}")
            lines.append(f"  f{k}: {{type: ForceSource, force: {self.loads[k]:.17g} N}}")
        curve = f"{{curve: coulomb, stiction: {self.stiction}, coulomb: 1}}"
        for j, (a, b) in enumerate(self.pairs):
            pressed = f"normal_force: {self.limits[j]:.17g} N"
            lines.append(f"  c{j}: {{type: Contact, method: hold, {pressed}, curve: {curve}}}")
            joins[a].append(f"c{j}.a")
            joins[b].append(f"c{j}.b")
        lines += ["connections:", *(f"  - [{', '.join(ports)}]" for ports in joins.values())]
        return "\n".join([*lines, f"run: {{stop: {stop}, accuracy: 1e-4, engine: {engine}}}"]) + "\n"

    @property
    def slips(self) -> np.ndarray:
        """C: the slips as sums of speeds (contacts, bodies)."""
        made = np.zeros((len(self.pairs), len(self.masses)))
        for j, (a, b) in enumerate(self.pairs):
            made[j, b] += 1
            if a != GROUND:
                made[j, a] -= 1
        return made


def random_network(seed: int, bodies: int, contacts: int, strength: float, stiction: float) -> Network:
    """A random tree hung on the ground, and further contacts between any two until there are as many as asked for.

    Masses, loads and limits range over two decades; `strength` is the size of the limits beside the loads.
    """
    rng = np.random.default_rng(seed)
    pairs = [(GROUND, 0), *((int(rng.integers(0, k)), k) for k in range(1, bodies))]
    while len(pairs) < contacts:
        a, b = rng.choice(bodies, 2, replace=False)
        pairs.append((GROUND if rng.random() < 0.2 else int(a), int(b)))
    return Network(
        pairs, 10 ** rng.uniform(-1, 1, bodies), rng.standard_normal(bodies) * 10 ** rng.uniform(-1, 1, bodies),
        strength * 10 ** rng.uniform(-1, 1, len(pairs)), stiction,
    )  # fmt: skip
