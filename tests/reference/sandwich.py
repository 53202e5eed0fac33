"""A hose between a moving device and a core: two contacts in series, by Moreau's time-stepping.

    device  x_d(t) = A sin(w t), prescribed
    hose    m_h v_h' = -k_h x_h - c_h v_h - T_1 + T_2
    core    m_c v_c' = -k_c x_c - c_c v_c       - T_2
    T_1 in N_1 mu_1(|u_1|) Sgn(u_1),  u_1 = v_h - v_d          Sgn(0) = [-1, 1]
    T_2 in N_2 mu_2(|u_2|) Sgn(u_2),  u_2 = v_c - v_h

Sgn is set-valued: a contact that sticks carries whatever holds it, up to its limit. There are no zones
and no events here. Each step of length h asks for the impulses P of both contacts such that the speeds
at the end of the step and the impulses satisfy the law,

    M' (v+ - v) = h F(midpoint) + G^T P,     -P_j in h N_j mu_j Sgn(u_j+),

which for two contacts is solved to rounding by projected Gauss-Seidel: P_j is the impulse that would bring
u_j to zero, cut off at the limit. Springs and dampers are taken at the midpoint (M' contains their h-terms),
mu at the slip before the step. The method knows nothing of when a contact changes, so it is of first order in
h, and it converges to the set-valued law: halving h must halve the distance to the truth.

Source: Moreau, Unilateral contact and dry friction in finite freedom dynamics (1988); Acary and Brogliato,
Numerical Methods for Nonsmooth Dynamical Systems (2008), chapter 10. Stribeck's curve with the square.
Defaults: the bundled model `sandwich`.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray


@dataclass(frozen=True)
class Sandwich:
    """Hose and core at rest at t = 0; SI. Contacts: (normal force, stiction, coulomb, Stribeck velocity)."""

    amplitude: float = 0.020
    frequency: float = 0.5
    masses: tuple[float, float] = (0.4, 1.05)
    stiffness: tuple[float, float] = (2e3, 20e3)
    damping: tuple[float, float] = (5.0, 30.0)
    outer: tuple[float, float, float, float] = (100.0, 0.40, 0.35, 0.020)
    inner: tuple[float, float, float, float] = (90.0, 0.50, 0.40, 0.020)

    def positions(self, stop: float, step: float, every: float) -> NDArray[np.float64]:
        """Rows (t, x_hose, x_core) [s, m] from 0 to `stop` [s] in steps of `step`, kept `every` so often."""
        keep = round(every / step)
        numbers = np.array([*self.masses, *self.stiffness, *self.damping, *self.outer, *self.inner])
        return _march(numbers, self.amplitude, 2 * np.pi * self.frequency, step, round(stop / step), keep)


@njit
def _limit(contact, slip):
    normal, stiction, coulomb, velocity = contact
    return normal * (coulomb + (stiction - coulomb) * np.exp(-((slip / velocity) ** 2)))


@njit
def _march(numbers, amplitude, w, h, steps, keep):
    m_h, m_c, k_h, k_c, c_h, c_c = numbers[:6]
    outer, inner = numbers[6:10], numbers[10:14]
    x_h = x_c = v_h = v_c = p_1 = p_2 = 0.0
    # Midpoint rule: force at x + h (v + v+)/4, (v + v+)/2, so M' = M + h c/2 + h^2 k/4.
    e_h, e_c = m_h + h * c_h / 2 + h * h * k_h / 4, m_c + h * c_c / 2 + h * h * k_c / 4
    rows = np.zeros((steps // keep + 1, 3))
    for n in range(steps):
        v_d, device = amplitude * w * np.cos(w * n * h), amplitude * w * np.cos(w * (n + 1) * h)
        free_h = v_h - h * (k_h * (x_h + h * v_h / 2) + c_h * v_h) / e_h
        free_c = v_c - h * (k_c * (x_c + h * v_c / 2) + c_c * v_c) / e_c
        most_1, most_2 = h * _limit(outer, v_h - v_d), h * _limit(inner, v_c - v_h)
        for _ in range(200):
            old_1, old_2 = p_1, p_2
            # Impulse on the hose from the device: what makes v_h+ = v_d, given the inner impulse.
            p_1 = min(max(e_h * (free_h - device) + p_2, -most_1), most_1)
            u_2 = free_c - (free_h + (-p_1) / e_h)
            p_2 = min(max(u_2 / (1 / e_h + 1 / e_c), -most_2), most_2)
            if abs(p_1 - old_1) + abs(p_2 - old_2) < 1e-15 * (most_1 + most_2):
                break
        new_h, new_c = free_h + (p_2 - p_1) / e_h, free_c - p_2 / e_c
        x_h += h * (v_h + new_h) / 2
        x_c += h * (v_c + new_c) / 2
        v_h, v_c = new_h, new_c
        if (n + 1) % keep == 0:
            rows[(n + 1) // keep] = (n + 1) * h, x_h, x_c
    return rows
