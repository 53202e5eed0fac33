"""Bodies on a plate that moves as given: when they leave it and when they land, without rebound.

Nothing of fairlead is used: roots of closed forms, and an integrator that is told when.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

G = 9.81


def flights(amplitude, frequency, stop, g=G):
    """(leaves, lands) of every flight without rebound: it leaves where a w cos w t = -g, and falls freely."""
    pace = 2 * np.pi * frequency

    def plate(t):
        return amplitude / pace * (1 - np.cos(pace * t))

    def pressed(t):
        return amplitude * pace * np.cos(pace * t) + g

    grid = np.arange(0.0, stop, 1e-5)
    found, t = [], 0.0
    while True:
        later = grid[grid > t + 1e-9]
        falls = later[:-1][(pressed(later[:-1]) > 0) & (pressed(later[1:]) <= 0)]
        if pressed(t + 1e-9) <= 0:
            leaves = t
        elif len(falls):
            leaves = brentq(pressed, falls[0], falls[0] + 1e-5)
        else:
            return found
        place, speed = plate(leaves), amplitude * np.sin(pace * leaves)

        def gap(s, place=place, speed=speed, leaves=leaves):
            return place + speed * (s - leaves) - g / 2 * (s - leaves) ** 2 - plate(s)

        later = grid[grid > leaves + 1e-3]
        meets = later[:-1][(gap(later[:-1]) > 0) & (gap(later[1:]) <= 0)]
        if not len(meets):
            return found
        t = brentq(gap, meets[0], meets[0] + 1e-5)
        found.append((leaves, t))


def hops(pace):
    """Times at which the foot meets the plate and leaves it, by an integrator that is told when: nothing else is known.

    In flight the foot, without inertia, goes back to its length; on the plate the spring and the damper push.
    """
    stiff, slow = 5000.0, 20.0

    def plate(t):
        return (1.0 / pace * (1 - np.cos(pace * t)), np.sin(pace * t)) if pace > 0 else (0.0, 0.0)

    def flight(t, s):
        return s[1], -G, s[1] - stiff / slow * (s[2] - s[0])

    def push(t, s):
        return stiff * (plate(t)[0] - s[0]) + slow * (plate(t)[1] - s[1])

    def stance(t, s):
        return s[1], -G + push(t, s), plate(t)[1]

    def meets(t, s):
        return s[2] - plate(t)[0]

    meets.terminal = push.terminal = True
    meets.direction = push.direction = -1
    t, state, found, flies = 0.0, np.array([0.1, 0.0, 0.1]), [], True
    while t < 0.8:
        way = solve_ivp(flight if flies else stance, (t, 0.8), state, events=meets if flies else push,
                        method="DOP853", rtol=1e-11, atol=1e-13, max_step=1e-3)  # fmt: skip
        t, state, flies = way.t[-1], way.y[:, -1], not flies
        if way.status == 1:
            found.append(t)
    return np.array(found)
