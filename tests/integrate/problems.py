"""Problems with a closed form, written by hand as `Problem`s: only `integrate` is imported."""

from __future__ import annotations

from typing import Any

import numpy as np

from fairlead.integrate.textbook import TextbookProblem, textbook

HELD, FORWARD, BACKWARD = 0, 1, 2
HOLD_RATE = 1e3
"""1/tau of the row d(v_rel)/dt = -v_rel/tau of a held contact."""


def nonlinear_ode(**settings: Any) -> tuple[TextbookProblem, Any]:
    """y0' = -y0^2 y1, y1' = cos t - (y1 - 2 - sin t): y0 = 1/(1 + 2 t + 1 - cos t), y1 = 2 + sin t."""

    def rhs(t, y, z, f):
        f[0] = -(y[0] ** 2) * y[1]
        f[1] = np.cos(t) - (y[1] - 2 - np.sin(t))

    def jacobian(t, y, z, J, ft):
        J[0, 0], J[0, 1], J[1, 1] = -2 * y[0] * y[1], -(y[0] ** 2), -1.0
        ft[1] = -np.sin(t) + np.cos(t)

    def exact(t):
        return np.array([1 / (2 + 2 * t - np.cos(t)), 2 + np.sin(t)])

    return textbook(exact(0.0), rhs, jacobian, **settings), exact


def stiff_follower(**settings: Any) -> tuple[TextbookProblem, Any]:
    """y' = -rate (y - cos t) - sin t, from far off: y goes to cos t in no time."""
    rate = 1e8

    def rhs(t, y, z, f):
        f[0] = -rate * (y[0] - np.cos(t)) - np.sin(t)

    def jacobian(t, y, z, J, ft):
        J[0, 0] = -rate
        ft[0] = -rate * np.sin(t) - np.cos(t)

    def exact(t):
        return np.array([np.cos(t)])

    return textbook([1.5], rhs, jacobian, **settings), exact


def index_one_dae(**settings: Any) -> tuple[TextbookProblem, Any]:
    """y' = y z, 0 = z^3 + z - c(t) with c = s^3 + s, s = cos t: y = exp(sin t), z = cos t."""

    def rhs(t, y, z, f):
        s = np.cos(t)
        f[0] = y[0] * y[1]
        f[1] = y[1] ** 3 + y[1] - s**3 - s

    def jacobian(t, y, z, J, ft):
        s, rate = np.cos(t), -np.sin(t)
        J[0, 0], J[0, 1], J[1, 1] = y[1], y[0], 3 * y[1] ** 2 + 1
        ft[1] = -(3 * s**2 + 1) * rate

    def exact(t):
        return np.array([np.exp(np.sin(t)), np.cos(t)])

    return textbook(exact(0.0), rhs, jacobian, algebraic=[1], **settings), exact


def bent_dae(**settings: Any) -> tuple[TextbookProblem, Any]:
    """y' = z, 0 = y^2 z + z^3 - c(t), whose slope in z depends on the state: y = 2 + sin t, z = cos t."""

    def rhs(t, y, z, f):
        s, c = 2 + np.sin(t), np.cos(t)
        f[0] = y[1]
        f[1] = y[0] ** 2 * y[1] + y[1] ** 3 - s**2 * c - c**3

    def jacobian(t, y, z, J, ft):
        s, c = 2 + np.sin(t), np.cos(t)
        J[0, 1] = 1.0
        J[1, 0], J[1, 1] = 2 * y[0] * y[1], y[0] ** 2 + 3 * y[1] ** 2
        ft[1] = -2 * s * c**2 + (s**2 + 3 * c**2) * np.sin(t)

    def exact(t):
        return np.array([2 + np.sin(t), np.cos(t)])

    return textbook(exact(0.0), rhs, jacobian, algebraic=[1], **settings), exact


def coulomb_oscillator(**settings: Any) -> tuple[TextbookProblem, Any]:
    """m = 1, k = 4, friction 0.5 that only reverses: x0 = 2, amplitude falls by 2 F/k each half period.

    While the spring force at a turning point exceeds the friction the block never sticks; the guard is
    the speed.
    """
    stiffness, friction, start = 4.0, 0.5, 2.0
    omega = np.sqrt(stiffness)

    def rhs(t, y, z, f):
        f[0], f[1] = y[1], -stiffness * y[0] - (friction if z[0] == FORWARD else -friction)

    def jacobian(t, y, z, J, ft):
        J[0, 1], J[1, 0] = 1.0, -stiffness

    def guards(t, y, z, g):
        g[0] = -y[1] if z[0] == FORWARD else y[1]

    def switch(t, y, z, fired):
        z[0] = BACKWARD if z[0] == FORWARD else FORWARD

    def exact(t):
        half = int(t * omega / np.pi)
        sign = -1.0 if half % 2 == 0 else 1.0
        shift = -sign * friction / stiffness
        amplitude = start - (2 * half + 1) * friction / stiffness
        phase = t * omega - half * np.pi
        return np.array([shift - sign * amplitude * np.cos(phase), sign * amplitude * omega * np.sin(phase)])

    problem = textbook(
        [start, 0.0], rhs, jacobian, guards=guards, switch=switch, zones=[BACKWARD], guard_machine=[0],
        machine_names=["pad"], zone_names={0: ("held", "forward", "backward")}, **settings,
    )  # fmt: skip
    return problem, exact


def belt_block(  # noqa: C901, one problem, all its laws
    mass: float = 1.0,
    stiffness: float = 100.0,
    belt: float = 0.2,
    stiction: float = 10.0,
    sliding: float = 6.0,
    start: tuple[float, float] | None = None,
    compile: bool = False,
    **settings: Any,
) -> TextbookProblem:
    """A block on a belt, held back by a spring: y = x, v, lambda (force of the belt on the block)."""

    def rhs(t, y, z, f):
        f[0], f[1] = y[1], -stiffness * y[0] + y[2]
        if z[0] == 0:
            f[2] = -(y[1] - belt) * 1e3
        elif z[0] == 1:
            f[2] = y[2] + sliding
        else:
            f[2] = y[2] - sliding

    def jacobian(t, y, z, J, ft):
        J[0, 1], J[1, 0], J[1, 2] = 1.0, -stiffness, 1.0
        if z[0] == 0:
            J[2, 1] = -1e3
        else:
            J[2, 2] = 1.0

    def mass_matrix(z, M):
        M[0, 0], M[1, 1] = 1.0, mass
        if z[0] == 0:
            M[2, 1] = 1.0

    def guards(t, y, z, g):
        g[:] = -1.0
        if z[0] == 0:
            g[0], g[1] = y[2] - stiction, -y[2] - stiction
        elif z[0] == 1:
            g[2] = belt - y[1]
        else:
            g[3] = y[1] - belt

    def switch(t, y, z, fired):
        if z[0] == 0:
            z[0] = 2 if fired[0] == 0 else 1
        else:
            z[0] = 0

    def slip(t, y, z, r):
        if z[0] == 0:
            r[2] = -(y[1] - belt)
            return 1
        return 0

    initial = (0.0, belt) if start is None else start
    tight: dict[str, Any] = {"absolute": [1e-8, 1e-7, 1e-6], "relative": 1e-8, "guard_tolerance": 1e-9}
    given = tight | settings
    return textbook(
        [*initial, 0.0], rhs, jacobian, mass_matrix, guards=guards, switch=switch, slip=slip, zones=[HELD],
        guard_machine=[0] * 4, algebraic=[2], unknown_names=["x", "v", "lambda"], machine_names=["pad"],
        guard_names=["breaks forward", "breaks backward", "stops", "stops"],
        zone_names={0: ("held", "forward", "backward")}, compile=compile, **given,
    )  # fmt: skip


def stick_slip_times(
    mass: float = 1.0,
    stiffness: float = 100.0,
    belt: float = 0.2,
    stiction: float = 10.0,
    sliding: float = 6.0,
) -> tuple[float, float, float]:
    """First breakaway, slip time and stick time of `belt_block`, in closed form.

    slip 2 (pi - atan z)/omega, stick 2 dF/(k v_d) with z = dF/(v_d sqrt(k m)), dF the drop of friction.
    """
    drop, omega = stiction - sliding, np.sqrt(stiffness / mass)
    z = drop / (belt * np.sqrt(stiffness * mass))
    return stiction / (stiffness * belt), 2 * (np.pi - np.arctan(z)) / omega, 2 * drop / (stiffness * belt)


def pulled_block(**settings: Any) -> tuple[TextbookProblem, Any, float]:
    """A held block pulled by a spring whose end moves as d(t) = t + 0.2 sin 3 t; breaks at k d = stiction.

    m = 1, k = 4, stiction 3, sliding 2; afterwards x'' = k (d - x) - sliding, in closed form. Returns the
    problem, x(t) and the breakaway time.
    """
    k, stiction, sliding, swing, pulse = 4.0, 3.0, 2.0, 0.2, 3.0

    def drive(t):
        return t + swing * np.sin(pulse * t)

    def rhs(t, y, z, f):
        f[0], f[1] = y[1], k * (drive(t) - y[0]) - y[2]
        f[2] = -y[1] * HOLD_RATE if z[0] == HELD else y[2] - sliding

    def jacobian(t, y, z, J, ft):
        J[0, 1], J[1, 0], J[1, 2] = 1.0, -k, -1.0
        ft[1] = k * (1 + swing * pulse * np.cos(pulse * t))
        if z[0] == HELD:
            J[2, 1] = -HOLD_RATE
        else:
            J[2, 2] = 1.0

    def mass(z, M):
        M[0, 0] = M[1, 1] = 1.0
        M[2, 1] = 1.0 if z[0] == HELD else 0.0

    def guards(t, y, z, g):
        g[0] = y[2] - stiction if z[0] == HELD else -1.0

    def switch(t, y, z, fired):
        z[0] = FORWARD

    low, high = 0.0, 1.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if k * drive(middle) < stiction else (low, middle)
    breaks = high
    omega, forced = np.sqrt(k), k * swing / (k - pulse**2)

    def particular(t):
        return t - sliding / k + forced * np.sin(pulse * t)

    def particular_rate(t):
        return 1 + forced * pulse * np.cos(pulse * t)

    a, b = -particular(breaks), -particular_rate(breaks) / omega

    def exact(t):
        s = omega * (t - breaks)
        return particular(t) + a * np.cos(s) + b * np.sin(s)

    problem = textbook(
        [0.0, 0.0, 0.0], rhs, jacobian, mass, guards=guards, switch=switch, zones=[HELD], guard_machine=[0],
        algebraic=[2], **settings,
    )  # fmt: skip
    return problem, exact, breaks


def falling_ball(restitution: float = 0.5, height: float = 1.0, **settings: Any) -> TextbookProblem:
    """A ball dropped from `height` with g = 2 that rebounds with v -> -e v; y = x, v."""

    def rhs(t, y, z, f):
        f[0], f[1] = y[1], -2.0

    def jacobian(t, y, z, J, ft):
        J[0, 1] = 1.0

    def guards(t, y, z, g):
        g[0] = -y[0]

    def switch(t, y, z, fired):
        y[1] = -restitution * y[1]

    return textbook(
        [height, 0.0], rhs, jacobian, guards=guards, switch=switch, zones=[0], guard_machine=[0],
        machine_names=["floor"], **settings,
    )  # fmt: skip


def clock(guard: Any, **settings: Any) -> TextbookProblem:
    """y' = 1 from 0, and one machine that counts how often `guard(t, zone)` fired."""

    def rhs(t, y, z, f):
        f[0] = 1.0

    def jacobian(t, y, z, J, ft):
        pass

    def guards(t, y, z, g):
        g[0] = guard(y[0], z[0])

    def switch(t, y, z, fired):
        z[0] += 1

    return textbook(
        [0.0], rhs, jacobian, guards=guards, switch=switch, zones=[0], guard_machine=[0],
        machine_names=["counter"], **settings,
    )  # fmt: skip
