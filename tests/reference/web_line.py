"""The web line of models/machines: balances of material and of momentum, written out and integrated by scipy."""

import numpy as np
from scipy.integrate import solve_ivp

STIFFNESS, WIDTH, THICK, DENSITY, CORE, CHUCKS = 1e6, 1.0, 1e-3, 800.0, 0.076, 0.5
ARM, ROLLER = 0.4, 0.06


def inertia(radius):
    """Of a roll with its chucks, as a hollow cylinder of web."""
    return CHUCKS + DENSITY * WIDTH * np.pi / 2 * (radius**4 - CORE**4)


def taken(v, behind, ahead):
    """Material that a roller passes on: with the strain of where it comes from."""
    return v / (1 + behind) if v >= 0 else v / (1 + ahead)


def web_line(stop, taper, gain, damping):
    """Times and rows: tensions before and after the dancer's roller, angle, tension at the winder, both radii.

    The state has the area of both rolls over 2 pi as radii squared: what a metre takes off is its thickness times it.
    """

    def parts(y):
        turned, _, first, second, third, _, angle, *_, wound, _ = y
        side = 1.5 + ARM * angle
        strains = side / first - 1, side / second - 1, 3 / third - 1
        radii = 0.4 - THICK * turned / (2 * np.pi), 0.08 + THICK * wound / (2 * np.pi)
        return strains, [max(STIFFNESS * e, 0.0) for e in strains], radii

    def rates(t, y):
        _, unwinds, _, _, _, spins, angle, swings, summed, slow, _, winds = y
        (e1, e2, e3), (t1, t2, t3), (large, small) = parts(y)
        nip = 0.1 * np.interp(t, [0, 1, 6, 44, 49], [0, 0, 60, 60, 5])
        q0, q1 = taken(large * unwinds, 2e-4, e1), taken(ROLLER * spins, e1, e2)
        q2, q3 = taken(nip, e2, e3), taken(small * winds, e3, 0.0)
        wants = -gain * angle + summed - gain * 0.3 * (angle - slow) / 0.03 - 300 * large
        brake = min(wants, 0.0)
        motor = 300 * (1 - taper * (1 - CORE / small)) * small
        return [
            unwinds, (brake + large * t1) / inertia(large), q0 - q1, q1 - q2, q2 - q3, ROLLER * (t2 - t1) / 0.02,
            swings, (240 - ARM * (t1 + t2) - damping * swings) / 3, -gain / 2 * angle + (brake - wants),
            (angle - slow) / 0.03, winds, (motor - small * t3 - 0.05 * winds) / inertia(small),
        ]  # fmt: skip

    loose = 1 + 300 / STIFFNESS
    start = [0, 0, 1.5 / loose, 1.5 / loose, 3 / loose, 0, 0, 0, 0, 0, 0, 0]
    found = solve_ivp(rates, (0, stop), start, "LSODA", rtol=1e-9, atol=1e-11, max_step=0.02)
    rows = [[*parts(y)[1], y[6], *parts(y)[2]] for y in found.y.T]
    return found.t, np.array(rows).T
