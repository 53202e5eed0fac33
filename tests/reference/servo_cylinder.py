"""The hunting servo cylinder of models/machines, its equations written out and integrated by scipy."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

MASS, STICTION, STRIBECK, MODULUS, SUPPLY, TANK, AIR = 200.0, 1500.0, 10e-3, 1e9, 150e5, 1e5, 1e5
CAP, RING = np.pi * 0.05**2 / 4, np.pi * (0.05**2 - 0.028**2) / 4
LAND, BORE = 12e-3 / 60 / np.sqrt(35e5), 0.62 * np.pi * 0.02**2 / 4 * np.sqrt(2 / 870)
WANTED, STROKE, DEAD = 0.15, 0.3, 0.2e-3


def edge(drop):
    """The root of a drop, laminar below 1 bar."""
    return drop / (drop**2 + 1e10) ** 0.25


def through(opening, drop):
    """Flow through a land and the bore behind it, at the drop over both."""
    if opening * drop == 0:
        return 0.0
    ends = sorted((0.0, drop))
    first = brentq(lambda d: opening * LAND * edge(d) - BORE * edge(drop - d), *ends, xtol=1e-3, rtol=1e-13)
    return opening * LAND * edge(first)


def servo_cylinder(stop, gain, integral_time, share):
    """Times and places of the piston, and how often it broke away or came to rest.

    `share` is the level of sliding over that of sticking. The state is x, v, both pressures and the integral.
    """

    def push(y):
        return CAP * y[2] - RING * y[3] - (CAP - RING) * AIR

    def rates(_, y, way):
        x, v, a, b, integral = y
        u = np.clip(gain * (WANTED - x) + integral, -1, 1)
        to_a = through(u, SUPPLY - a) if u > 0 else -through(-u, a - TANK)
        to_b = -through(u, b - TANK) if u > 0 else through(-u, SUPPLY - b)
        rubs = STICTION * (share + (1 - share) * np.exp(-((v / STRIBECK) ** 2)))
        rise_a = MODULUS / (DEAD + CAP * x) * (to_a - CAP * v)
        rise_b = MODULUS / (DEAD + RING * (STROKE - x)) * (to_b + RING * v)
        moves = (v, (push(y) - way * rubs) / MASS) if way else (0.0, 0.0)
        return [*moves, rise_a, rise_b, gain / integral_time * (WANTED - x)]

    def ends(_, y, way):
        return way * y[1] if way else STICTION - abs(push(y))

    ends.terminal, ends.direction = True, -1
    t, y, way, rows, switches = 0.0, np.array([0.148, 0, 60e5, 87e5, 0]), 0, [], 0
    while t < stop:
        found = solve_ivp(rates, (t, stop), y, "LSODA", args=(way,), events=ends, rtol=1e-8,
                          atol=[1e-10, 1e-9, 1, 1, 1e-9], max_step=5e-3, first_step=1e-6)  # fmt: skip
        rows.append(np.stack([found.t, found.y[0]]))
        t, y = found.t[-1], found.y[:, -1].copy()
        if found.status != 1:
            break
        switches += 1
        if way:
            y[1] = 0.0
        way = 0 if way and abs(push(y)) < STICTION else int(np.sign(push(y)))
    t, x = np.concatenate(rows, axis=1)
    return t, x, switches
