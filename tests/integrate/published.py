"""Problems with published reference solutions, written by hand as `Problem`s: only `integrate` is imported.

Source of problems and solutions: F. Mazzia, C. Magherini, Test Set for Initial Value Problem Solvers, release 2.4,
University of Bari, 2008 (https://archimede.uniba.it/~testset), which goes back to W. Lioen, J. de Swart (CWI, 1998)
and E. Hairer, G. Wanner, Solving Ordinary Differential Equations II. Digits as in its Fortran files, computed with
RADAU, RADAU5 or PSIDE at tolerances of 1e-12 to 1e-19.

Each function takes the accuracy and returns a `Published`.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fairlead.integrate.textbook import TextbookProblem, textbook


@dataclass(frozen=True)
class Published:
    """A problem, when it ends, and what is known about its end."""

    problem: TextbookProblem
    stop: float
    reference: np.ndarray
    scale: np.ndarray
    """Errors count relative to |reference| + scale."""
    original: Callable[[np.ndarray], np.ndarray] = lambda y: y
    """From our unknowns to those of the source."""
    first_step: float | None = None

    def error(self, y: np.ndarray) -> float:
        """Largest error at the end, relative."""
        return float(np.max(np.abs(self.original(y) - self.reference) / (np.abs(self.reference) + self.scale)))


Laws = tuple[Callable[..., None], Callable[..., None]]


def mass_action(species: int, reactions: dict[str, float]) -> Laws:
    """rhs and jacobian of a reaction network, `"1 + 3 > 2": rate`, species counted from 1; 0 is the outside.

    A reaction with rate k goes on at k times the product of what stands on its left.
    """
    left, change, rates = [], np.zeros((species, len(reactions))), np.array(list(reactions.values()))
    for r, text in enumerate(reactions):
        before, after = ([int(s) - 1 for s in side.split("+")] for side in text.split(">"))
        left.append([s for s in before if s >= 0])
        for s in before:
            change[s, r] -= s >= 0
        for s in after:
            change[s, r] += s >= 0

    def rhs(t, y, z, f):
        f[:] = change @ (rates * [np.prod(y[substances]) for substances in left])

    def jacobian(t, y, z, J, ft):
        slopes = np.zeros((len(left), species))
        for r, substances in enumerate(left):
            for k, s in enumerate(substances):
                slopes[r, s] += rates[r] * np.prod(y[substances[:k] + substances[k + 1 :]])
        J[:] = change @ slopes

    return rhs, jacobian


def robertson(accuracy: float) -> Published:
    """Three reactions of very different speed, to t = 1e11."""
    laws = mass_action(3, {"1 > 2": 0.04, "2 + 2 > 2 + 3": 3e7, "2 + 3 > 1 + 3": 1e4})
    absolute = accuracy * np.array([1e-7, 1e-12, 1.0])
    problem = textbook([1.0, 0.0, 0.0], *laws, absolute=absolute, relative=accuracy)
    reference = np.array([0.2083340149701255e-07, 0.8333360770334713e-13, 0.9999999791665050])
    return Published(problem, 1e11, reference, np.zeros(3), first_step=1e-4)


def hires(accuracy: float) -> Published:
    """High irradiance response of photomorphogenesis: eight reactants (Schaefer, 1975)."""
    laws = mass_action(8, {
        "0 > 1": 0.0007, "1 > 2": 1.71, "2 > 1": 0.43, "3 > 1": 8.32, "2 > 4": 8.32, "3 > 4": 1.71, "4 > 3": 0.43,
        "5 > 3": 0.035, "4 > 6": 0.69, "5 > 6": 1.71, "6 > 5": 0.43, "6 + 8 > 7": 280.0, "7 > 5 + 8": 0.43,
        "7 > 6 + 8": 0.69, "7 > 8": 0.69,
    })  # fmt: skip
    reference = np.array([
        0.7371312573325668e-3, 0.1442485726316185e-3, 0.5888729740967575e-4, 0.1175651343283149e-2,
        0.2386356198831331e-2, 0.6238968252742796e-2, 0.2849998395185769e-2, 0.2850001604814231e-2,
    ])  # fmt: skip
    problem = textbook([1, 0, 0, 0, 0, 0, 0, 0.0057], *laws, absolute=1e-4 * accuracy, relative=accuracy)
    return Published(problem, 321.8122, reference, np.zeros(8))


def pollution(accuracy: float) -> Published:
    """Air pollution: 25 reactions of 20 species (Verwer, SIAM J. Sci. Comput. 15:1243, 1994)."""
    laws = mass_action(20, {
        "1 > 2 + 3": 0.35, "2 + 4 > 1": 26.6, "5 + 2 > 6 + 1": 1.23e4, "7 > 5 + 5 + 8": 8.6e-4, "7 > 8": 8.2e-4,
        "7 + 6 > 8 + 5": 1.5e4, "9 > 10 + 8 + 5": 1.3e-4, "9 + 6 > 11": 2.4e4, "11 + 2 > 1 + 10 + 12": 1.65e4,
        "11 + 1 > 13": 9e3, "13 > 11 + 1": 0.022, "10 + 2 > 14 + 1": 1.2e4, "14 > 7 + 5": 1.88,
        "1 + 6 > 15": 1.63e4, "3 > 4": 4.8e6, "4 > 16": 3.5e-4, "4 > 3": 0.0175, "16 > 6 + 6": 1e8,
        "16 > 3": 4.44e11, "17 + 6 > 18 + 5": 1.24e3, "19 > 2": 2.1, "19 > 1 + 3": 5.78, "1 + 4 > 19": 0.0474,
        "19 + 1 > 20": 1.78e3, "20 > 19 + 1": 3.12,
    })  # fmt: skip
    start = np.zeros(20)
    start[[1, 3, 6, 7, 8, 16]] = 0.2, 0.04, 0.1, 0.3, 0.01, 0.007
    reference = np.array([
        0.5646255480022769e-01, 0.1342484130422339e+00, 0.4139734331099427e-08, 0.5523140207484359e-02,
        0.2018977262302196e-06, 0.1464541863493966e-06, 0.7784249118997964e-01, 0.3245075353396018e+00,
        0.7494013383880406e-02, 0.1622293157301561e-07, 0.1135863833257075e-07, 0.2230505975721359e-02,
        0.2087162882798630e-03, 0.1396921016840158e-04, 0.8964884856898295e-02, 0.4352846369330103e-17,
        0.6899219696263405e-02, 0.1007803037365946e-03, 0.1772146513969984e-05, 0.5682943292316392e-04,
    ])  # fmt: skip
    problem = textbook(start, *laws, absolute=1e-8 * accuracy, relative=accuracy)
    # The sixteenth is 4e-17: nothing of it is left beside the weight of 1e-8 times the accuracy.
    return Published(problem, 60.0, reference, np.full(20, 1e-8))


def van_der_pol(accuracy: float) -> Published:
    """A relaxation oscillator, (1 - y^2) y' over 1e-6."""
    epsilon = 1e-6

    def rhs(t, y, z, f):
        f[0], f[1] = y[1], ((1 - y[0] ** 2) * y[1] - y[0]) / epsilon

    def jacobian(t, y, z, J, ft):
        J[0, 1] = 1.0
        J[1, 0], J[1, 1] = (-2 * y[0] * y[1] - 1) / epsilon, (1 - y[0] ** 2) / epsilon

    problem = textbook([2.0, 0.0], rhs, jacobian, absolute=accuracy, relative=accuracy)
    return Published(problem, 2.0, np.array([0.1706167732170483e1, -0.8928097010247975]), np.zeros(2))


def akzo_nobel(accuracy: float) -> Published:
    """A chemical process with an equilibrium that depends on the state: y6 = Ks y1 y4 (index 1)."""
    k1, k2, k3, k4, equilibrium, transfer, solubility = 18.7, 0.58, 0.09, 0.42, 34.4, 3.3, 115.83
    supply = 0.9 / 737.0

    def rhs(t, y, z, f):
        root = np.sqrt(y[1])
        r1, r2, r3 = k1 * y[0] ** 4 * root, k2 * y[2] * y[3], k2 / equilibrium * y[0] * y[4]
        r4, r5 = k3 * y[0] * y[3] ** 2, k4 * y[5] ** 2 * root
        f[0], f[1] = -2 * r1 + r2 - r3 - r4, -0.5 * r1 - r4 - 0.5 * r5 + transfer * (supply - y[1])
        f[2], f[3], f[4] = r1 - r2 + r3, -r2 + r3 - 2 * r4, r2 - r3 + r5
        f[5] = solubility * y[0] * y[3] - y[5]

    def jacobian(t, y, z, J, ft):
        root = np.sqrt(y[1])
        slopes = np.zeros((5, 6))
        slopes[0, 0], slopes[0, 1] = 4 * k1 * y[0] ** 3 * root, 0.5 * k1 * y[0] ** 4 / root
        slopes[1, 2], slopes[1, 3] = k2 * y[3], k2 * y[2]
        slopes[2, 0], slopes[2, 4] = k2 / equilibrium * y[4], k2 / equilibrium * y[0]
        slopes[3, 0], slopes[3, 3] = k3 * y[3] ** 2, 2 * k3 * y[0] * y[3]
        slopes[4, 5], slopes[4, 1] = 2 * k4 * y[5] * root, 0.5 * k4 * y[5] ** 2 / root
        J[:5] = np.array([
            [-2, 1, -1, -1, 0], [-0.5, 0, 0, -1, -0.5], [1, -1, 1, 0, 0], [0, -1, 1, -2, 0], [0, 1, -1, 0, 1],
        ]) @ slopes  # fmt: skip
        J[1, 1] -= transfer
        J[5, 0], J[5, 3], J[5, 5] = solubility * y[3], solubility * y[0], -1.0

    start = [0.444, 0.00123, 0.0, 0.007, 0.0, solubility * 0.444 * 0.007]
    reference = np.array([
        0.1150794920661702, 0.1203831471567715e-2, 0.1611562887407974, 0.3656156421249283e-3,
        0.1708010885264404e-1, 0.4873531310307455e-2,
    ])  # fmt: skip
    problem = textbook(start, rhs, jacobian, algebraic=[5], absolute=1e-3 * accuracy, relative=accuracy)
    return Published(problem, 180.0, reference, np.zeros(6))


def transistor_amplifier(accuracy: float) -> Published:
    """Two transistors, five capacitors, eight nodes: M is singular and not diagonal (index 1; Rentrop, 1989).

    The capacitors C1, C3, C5 lie between two nodes. Unknowns here: the voltage of the nodes 1, 4, 7
    (algebraic), of 3 and 6, and the voltages 2 - 1, 5 - 4, 8 - 7 of those capacitors.
    """
    supply, thermal, gain, saturation, resistance = 6.0, 0.026, 0.99, 1e-6, 9000.0
    capacity = np.array([1e-6, 2e-6, 3e-6, 4e-6, 5e-6])
    nodes = np.eye(8)  # of the source, from our unknowns
    nodes[1, 0] = nodes[4, 3] = nodes[7, 6] = 1.0

    def voltages(y):
        return nodes @ y

    def currents(u):
        one, two = (saturation * (np.exp((u[b] - u[e]) / thermal) - 1) for b, e in ((1, 2), (4, 5)))
        return one, two

    def rhs(t, y, z, f):
        u = voltages(y)
        one, two = currents(u)
        f[0] = (u[0] - 0.1 * np.sin(200 * np.pi * t)) / 1000.0
        f[1] = (2 * u[1] - supply) / resistance + (1 - gain) * one
        f[2] = u[2] / resistance - one
        f[3] = (u[3] - supply) / resistance + gain * one
        f[4] = (2 * u[4] - supply) / resistance + (1 - gain) * two
        f[5] = u[5] / resistance - two
        f[6] = (u[6] - supply) / resistance + gain * two
        f[7] = u[7] / resistance

    def jacobian(t, y, z, J, ft):
        u = voltages(y)
        by_node = np.diag(np.array([9, 2, 1, 1, 2, 1, 1, 1]) / resistance)
        for b, e, c, current in zip((1, 4), (2, 5), (3, 6), currents(u), strict=True):
            slope = (current + saturation) / thermal
            for row, share in ((b, 1 - gain), (e, -1.0), (c, gain)):
                by_node[row, b] += share * slope
                by_node[row, e] -= share * slope
        J[:] = by_node @ nodes
        ft[0] = -0.02 * np.pi * np.cos(200 * np.pi * t)

    def mass(z, M):
        for first, c in ((0, 0), (3, 2), (6, 4)):
            M[first, first + 1], M[first + 1, first + 1] = capacity[c], -capacity[c]
        M[2, 2], M[5, 5] = -capacity[1], -capacity[3]

    reference = np.array([
        -0.5562145012262709e-2, 0.3006522471903042e1, 0.2849958788608128e1, 0.2926422536206241e1,
        0.2704617865010554e1, 0.2761837778393145e1, 0.4770927631616772e1, 0.1236995868091548e1,
    ])  # fmt: skip
    start = np.linalg.solve(nodes, [0.0, 3.0, 3.0, 6.0, 3.0, 3.0, 6.0, 0.0])
    problem = textbook(start, rhs, jacobian, mass, algebraic=[0, 3, 6], absolute=accuracy, relative=accuracy)
    return Published(problem, 0.2, reference, np.ones(8), original=voltages)


@functools.cache
def ring_circuit() -> TextbookProblem:  # noqa: C901, one problem, all its laws
    """The laws of `ring_modulator`, compiled once: a run takes a hundred thousand evaluations."""
    c, cs, cp, r, rp, lh, ls1, ls2, ls3 = 1.6e-8, 2e-12, 1e-8, 25e3, 50.0, 4.45, 2e-3, 5e-4, 5e-4
    rg1, rg2, rg3, ri, rc, gamma, delta = 36.3, 17.3, 17.3, 50.0, 600.0, 40.67286402e-9, 17.7493332
    # The linear part, and the diodes: voltages `across` y and the second input, currents `into` the rows.
    linear = np.zeros((15, 15))
    for i, j, value in (
        (0, 7, 1 / c), (0, 9, -0.5 / c), (0, 10, 0.5 / c), (0, 13, 1 / c), (0, 0, -1 / (r * c)),
        (1, 8, 1 / c), (1, 11, -0.5 / c), (1, 12, 0.5 / c), (1, 14, 1 / c), (1, 1, -1 / (r * c)),
        (2, 9, 1 / cs), (3, 10, -1 / cs), (4, 11, 1 / cs), (5, 12, -1 / cs), (6, 6, -1 / (rp * cp)),
        (7, 0, -1 / lh), (8, 1, -1 / lh),
        (9, 0, 0.5 / ls2), (9, 2, -1 / ls2), (9, 9, -rg2 / ls2),
        (10, 0, -0.5 / ls3), (10, 3, 1 / ls3), (10, 10, -rg3 / ls3),
        (11, 1, 0.5 / ls2), (11, 4, -1 / ls2), (11, 11, -rg2 / ls2),
        (12, 1, -0.5 / ls3), (12, 5, 1 / ls3), (12, 12, -rg3 / ls3),
        (13, 0, -1 / ls1), (13, 13, -(ri + rg1) / ls1), (14, 1, -1 / ls1), (14, 14, -(rc + rg1) / ls1),
    ):  # fmt: skip
        linear[i, j] = value
    across, into = np.zeros((4, 15)), np.zeros((15, 4))
    for diode, (plus, minus, side) in enumerate((((2,), (4, 6), -1), ((5,), (3, 6), -1), ((3, 4, 6), (), 1),
                                                 ((6,), (2, 5), 1))):  # fmt: skip
        across[diode, list(plus)], across[diode, list(minus)] = 1.0, -1.0
        into[6, diode] = -side / cp
    for row, out_of, in_by in ((2, 0, 3), (3, 2, 1), (4, 2, 0), (5, 1, 3)):
        into[row, out_of], into[row, in_by] = -1 / cs, 1 / cs
    drive = np.array([-1.0, -1.0, 1.0, 1.0])

    def rhs(t, y, z, f):
        second = 2.0 * math.sin(2e4 * math.pi * t)
        for i in range(15):
            f[i] = 0.0
            for j in range(15):
                f[i] += linear[i, j] * y[j]
        for d in range(4):
            voltage = drive[d] * second
            for j in range(2, 7):
                voltage += across[d, j] * y[j]
            current = gamma * (math.exp(delta * voltage) - 1.0)
            for i in range(2, 7):
                f[i] += into[i, d] * current
        f[13] += 0.5 * math.sin(2e3 * math.pi * t) / ls1

    def jacobian(t, y, z, J, ft):
        second, rate = 2.0 * math.sin(2e4 * math.pi * t), 4e4 * math.pi * math.cos(2e4 * math.pi * t)
        for i in range(15):
            for j in range(15):
                J[i, j] = linear[i, j]
        for d in range(4):
            voltage = drive[d] * second
            for j in range(2, 7):
                voltage += across[d, j] * y[j]
            slope = gamma * delta * math.exp(delta * voltage)
            for i in range(2, 7):
                ft[i] += into[i, d] * slope * drive[d] * rate
                for j in range(2, 7):
                    J[i, j] += into[i, d] * slope * across[d, j]
        ft[13] += 1e3 * math.pi * math.cos(2e3 * math.pi * t) / ls1

    return textbook(np.zeros(15), rhs, jacobian, compile=True)


def ring_modulator(accuracy: float) -> Published:
    """A circuit with four diodes that mixes 1 kHz with 10 kHz (Horneber, 1976): seven voltages, eight currents."""
    reference = np.array([
        -0.2339057358486745e-1, -0.7367485485540825e-2, 0.2582956709291169, -0.4064465721283450, -0.4039455665149794,
        0.2607966765422943, 0.1106761861269975, 0.2939904342435596e-6, -0.2840029933642329e-7, 0.7267198267264553e-3,
        0.7929487196960840e-3, -0.7255283495698965e-3, -0.7941401968526521e-3, 0.7088495416976114e-4,
        0.2390059075236570e-4,
    ])  # fmt: skip
    scale = np.array([1.0] * 7 + [1e-3] * 8)  # volts and milliamperes
    tolerances = {"absolute": accuracy * scale, "relative": np.full(15, accuracy)}
    return Published(dataclasses.replace(ring_circuit(), **tolerances), 1e-3, reference, scale)
