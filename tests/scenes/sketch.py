"""A netlist in the making: components and joins in the order in which they are drawn."""

from __future__ import annotations

import random
from dataclasses import dataclass, field

METHODS = ("karnopp", "binding", "saturation", "tanh", "lugre", "reset_integrator", "elastoplastic", "dahl")
"""Treatments of sticking beside `hold`. Each with each curve is a kernel of its own, so they take few curves."""


@dataclass
class Sketch:
    """What a scene is made of; `number` and `pick` draw from its own stream, which the seed alone decides."""

    kind: str
    seed: int
    size: int | None = None
    parts: dict[str, str] = field(default_factory=dict)
    joins: list[tuple[str, ...]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.random = random.Random(f"{self.kind} {self.seed}")

    def number(self, least: float, most: float) -> str:
        """A number between the two, every order of magnitude as likely, with four digits: no two are equal."""
        return f"{least * (most / least) ** self.random.random():.4g}"

    def pick(self, *choices):
        """One of the choices."""
        return self.random.choice(choices)

    def many(self, *counts: int) -> int:
        """How many bodies: one of these counts, or the size that was asked for."""
        drawn = self.pick(*counts)
        return self.size or drawn

    def maybe(self, share: float) -> bool:
        """True in this share of all cases."""
        return self.random.random() < share

    def add(self, name: str, kind: str, **parameters: str) -> str:
        """Draw a component, once, and say what it is called. Parameters are text as in a netlist."""
        listed = "".join(f", {key}: {value}" for key, value in parameters.items())
        self.parts[name] = f"{{type: {kind}{listed}}}"
        return name

    def join(self, *ports: str) -> None:
        """Join ports."""
        self.joins.append(ports)

    def wave(self, size: float, unit: str) -> str:
        """Something in time of about this size: it swings, comes and goes, or rises."""
        a, f = self.number(0.5 * size, 1.5 * size), self.number(0.5, 4)
        start, rise = self.number(0.05, 0.3), self.number(0.05, 0.4)
        return self.pick(
            f"{{sine: {{amplitude: {a} {unit}, frequency: {f} Hz, phase: {self.number(0.1, 3)} rad}}}}",
            f"{{ramp: {{to: {a} {unit}, over: {rise} s, start: {start} s}}}}",
            f"{{step: {{to: {a} {unit}, at: {start} s}}}}",
            f"{{trapezoid: {{to: {a} {unit}, start: {start} s, rise: {rise} s, stay: {rise} s, fall: {rise} s}}}}",
            f"{{drift: {{rate: {a} {unit}/s}}, sine: {{amplitude: {a} {unit}, frequency: {f} Hz}}}}",
        )

    def curve(self, method: str | None = None) -> str:
        """A friction curve; contacts with a method other than `hold` take one of two."""
        mu = float(self.number(0.1, 0.7))
        rest = f"{mu * float(self.number(1.05, 1.6)):.4g}"
        coulomb = f"{{curve: coulomb, stiction: {rest}, coulomb: {mu}}}"
        stribeck = f"{{curve: stribeck, stiction: {rest}, coulomb: {mu}, velocity: {self.number(5, 100)} mm/s}}"
        if method not in (None, "hold"):
            return self.pick(coulomb, stribeck)
        peak = f"{float(rest) * 1.1:.4g}"
        at = self.number(10, 80)
        hump = f"{{curve: hump, stiction: {mu}, peak: {peak}, peak_velocity: {at} mm/s, coulomb: {mu}}}"
        viscous = f"{{curve: viscous, coulomb: {mu}, rate: {self.number(0.1, 2)} s/m}}"
        return self.pick(f"{mu}", coulomb, stribeck, hump, viscous)

    def text(self, *, friction: str, run: str, every: str) -> str:
        """The netlist. Everything is recorded."""
        lines = ["schema: 1", f"name: {self.kind}_{self.seed}", "components:"]
        lines += [f"  {name}: {text}" for name, text in self.parts.items()]
        lines += ["connections:", *(f"  - [{', '.join(ports)}]" for ports in self.joins)]
        lines += [f"friction: {{{friction}}}", f"run: {{{run}}}", f'record: {{every: {every}, signals: ["*"]}}']
        return "\n".join(lines) + "\n"
