"""A valve-driven motor with dry and viscous friction, written out once more in a few lines of numpy.

    x'' = w^2 (u - x) - 2 z w x'                                             spool
    (V/beta) p_a' = K x f(p_s - p_a) - D n - C_i (p_a - p_b) - C_e p_a        f(d) = d/(d^2 + p_cr^2)^(1/4)
    (V/beta) p_b' = -K x f(p_b - p_t) + D n + C_i (p_a - p_b) - C_e p_b       n: speed of the shaft
    J n' = D (p_a - p_b) - c n - dry - load

for x >= 0 and n > 0, which is all that is needed once the drive turns. The sampled PI controller reads the line speed
R n/gear at sample k, and by choice uses that of sample k - 1. Integrated with the classical Runge-Kutta method.
"""

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Drive:
    """Numbers of a winch drive in SI."""

    supply: float = 180e5
    tank: float = 2e5
    rated_flow: float = 40e-3 / 60
    rated_drop: float = 35e5
    critical: float = 1e5
    spool: float = 2 * math.pi * 60
    spool_damping: float = 0.7
    displacement: float = 125e-6 / (2 * math.pi)
    volume: float = 1e-3
    modulus: float = 1e9
    inertia: float = 0.025 + 1150 / 30**2
    internal: float = 4e-12
    external: float = 4e-13
    viscous: float = 0.05
    dry: float = 6.0
    gear: float = 30.0
    radius: float = 0.65

    @property
    def conductance(self) -> float:
        """Flow per root of pressure drop, fully open."""
        return self.rated_flow / math.sqrt(self.rated_drop)

    def no_load_speed(self, opening: float) -> float:
        """Shaft speed without any load, by the square-root law [rad/s]."""
        return self.conductance * opening * math.sqrt((self.supply - self.tank) / 2) / self.displacement

    @property
    def stall_torque(self) -> float:
        """Torque of the oil at rest [N m]."""
        return self.displacement * (self.supply - self.tank)

    @property
    def natural_frequency(self) -> float:
        """Of the shaft on the oil, with the valve closed [rad/s]."""
        return self.displacement * math.sqrt(2 * self.modulus / (self.volume * self.inertia))

    def rate(self, y: np.ndarray, command: float, pull: float) -> np.ndarray:
        """Time derivative of (x, x', p_a, p_b, n)."""
        x, v, a, b, n = y
        drop_a, drop_b = self.supply - a, b - self.tank
        into = self.conductance * x * drop_a / (drop_a**2 + self.critical**2) ** 0.25
        out = self.conductance * x * drop_b / (drop_b**2 + self.critical**2) ** 0.25
        across = self.internal * (a - b)
        soft = self.modulus / self.volume
        load = pull * self.radius / self.gear + self.dry + self.viscous * n
        return np.array([
            v, self.spool**2 * (command - x) - 2 * self.spool_damping * self.spool * v,
            soft * (into - self.displacement * n - across - self.external * a),
            soft * (-out + self.displacement * n + across - self.external * b),
            (self.displacement * (a - b) - load) / self.inertia,
        ])  # fmt: skip


@dataclass(frozen=True)
class SampledPi:
    """The controller, with the anti-windup time half of the integral time."""

    period: float = 0.01
    gain: float = 0.3
    integral_time: float = 0.3
    feed_forward: float = 1 / 1.15
    slew: float = 2.0
    delayed: bool = False

    def run(self, drive: Drive, stop: float, pull, reference, steps: int = 40) -> tuple[np.ndarray, np.ndarray]:
        """Times of the steps and line speeds there. The drive begins with its shaft just turning."""
        y = np.array([0.05, 0.0, 110e5, 85e5, 0.05])
        seen, integral, command = 0.0, 0.0, 0.0
        h, t, told = self.period / steps, [0.0], [y[4] * drive.radius / drive.gear]
        for k in range(round(stop / self.period)):
            begin = k * self.period
            measured = y[4] * drive.radius / drive.gear
            error = reference(begin) - (seen if self.delayed else measured)
            wanted = self.feed_forward * reference(begin) + self.gain * error + integral
            most = self.slew * self.period
            command = min(max(min(max(wanted, -1.0), 1.0), command - most), command + most)
            integral += self.period * (
                self.gain / self.integral_time * error + (command - wanted) / (self.integral_time / 2)
            )
            seen = measured
            for i in range(steps):
                force = pull(begin + (i + 0.5) * h)
                a = drive.rate(y, command, force)
                b = drive.rate(y + h / 2 * a, command, force)
                c = drive.rate(y + h / 2 * b, command, force)
                d = drive.rate(y + h * c, command, force)
                y = y + h / 6 * (a + 2 * b + 2 * c + d)
                t.append(begin + (i + 1) * h)
                told.append(y[4] * drive.radius / drive.gear)
        return np.array(t), np.array(told)
