"""Coefficients of the Rosenbrock methods, checked against their order conditions at import.

One step of size h from y0, with W = M/(h gamma) - J:

    W K_i = f(t + c_i h, y0 + sum_j a_ij K_j) + M sum_j (C_ij/h) K_j + h d_i f_t
    y1    = y0 + sum_i m_i K_i,       error = sum_i e_i K_i
    y(s) = (1 - s) y0 + s (y1 + (1 - s)(D_0 + s (D_1 + s D_2))),  D_r = sum_i H_ri K_i

This is the form without products J K (Hairer, Wanner: Solving Ordinary Differential Equations II,
2nd ed. 1996, section IV.7). With G = (I/gamma - C)^-1 the classical coefficients are alpha = a G,
b = m G, beta = alpha + G, c = row sums of alpha, d = row sums of G.

Rodas5P: G. Steinebach, Construction of Rosenbrock-Wanner method Rodas5P and numerical benchmarks
within the Julia Differential Equations package, BIT Numer. Math. 63:27, 2023,
doi 10.1007/s10543-023-00967-x. Eight stages, order 5(4), stiffly accurate, dense output of order 4.

Rodas3P: G. Steinebach, Rosenbrock methods within OrdinaryDiffEq.jl - Overview, recent developments
and applications, Proceedings of the JuliaCon Conferences, 2024. Five stages (four evaluations),
order 3(2), stiffly accurate, dense output of order 3.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Tableau:
    """One method in the form of the module docstring; s stages."""

    name: str
    order: int
    error_order: int
    """Order of the embedded solution; the error estimate behaves as h^(error_order + 1)."""
    gamma: float
    a: NDArray[np.float64]
    """[s, s], strictly lower."""
    C: NDArray[np.float64]
    """[s, s], strictly lower."""
    m: NDArray[np.float64]
    e: NDArray[np.float64]
    H: NDArray[np.float64]
    """[3, s]; rows of zeros where the dense output has a lower degree."""

    @property
    def stages(self) -> int:
        """Number of stages s."""
        return len(self.m)

    @property
    def G(self) -> NDArray[np.float64]:
        """[s, s]: K = G k turns the classical stages k into those of this form.

        C is strictly lower, so row i of (I/gamma - C) G = I follows from those above it. BLAS is left out: it rounds
        in another way on another processor, and every step would follow.
        """
        rows: list[NDArray[np.float64]] = []
        for i, unit in enumerate(np.eye(self.stages)):
            rows.append(self.gamma * sum((self.C[i, j] * row for j, row in enumerate(rows)), start=unit))
        return np.array(rows)

    @property
    def c(self) -> NDArray[np.float64]:
        """[s]: where in the step each stage looks."""
        G, stages = self.G, range(self.stages)
        return np.array([math.fsum(float(row[j] * G[j, k]) for j in stages for k in stages) for row in self.a])

    @property
    def d(self) -> NDArray[np.float64]:
        """[s]: weight of f_t in each stage."""
        return np.array([math.fsum(row) for row in self.G.tolist()])

    def interpolation_weights(self, s: float) -> NDArray[np.float64]:
        """[s]: y(s) = y0 + sum_i w_i K_i."""
        inner = self.H[0] + s * (self.H[1] + s * self.H[2])
        return s * (self.m + (1 - s) * inner)


def order_conditions(
    tableau: Tableau, weights: NDArray[np.float64], s: float = 1.0
) -> list[tuple[int, float]]:
    """Residuals (order, value) of the order conditions of y0 + sum_i weights_i K_i at s h.

    All conditions of ordinary differential equations to order 4, the two of order 5 that involve no
    further products, and of index-1 problems the one of order 2 (Hairer, Wanner II, tables IV.7.1
    and VI.4.1): b beta^-1 alpha^2 = s^2.
    """
    G = tableau.G
    b = weights @ G
    alpha = tableau.a @ G
    beta = alpha + G
    c, cb = alpha.sum(axis=1), beta.sum(axis=1)
    at = s
    conditions = [
        (1, b.sum() - at),
        (2, b @ cb - at**2 / 2),
        (3, b @ c**2 - at**3 / 3),
        (3, b @ beta @ cb - at**3 / 6),
        (4, b @ c**3 - at**4 / 4),
        (4, b @ (c * (alpha @ cb)) - at**4 / 8),
        (4, b @ beta @ c**2 - at**4 / 12),
        (4, b @ beta @ beta @ cb - at**4 / 24),
        (5, b @ c**4 - at**5 / 5),
        (5, b @ beta @ beta @ beta @ cb - at**5 / 120),
        (2, b @ np.linalg.solve(beta, c**2) - at**2),
    ]
    return [(order, float(value)) for order, value in conditions]


def _lower(rows: Sequence[Sequence[float]], stages: int) -> NDArray[np.float64]:
    full = np.zeros((stages, stages))
    for i, row in enumerate(rows):
        full[i, : len(row)] = row
    return full


def _checked(tableau: Tableau) -> Tableau:
    """The tableau, once its solution, embedded solution and dense output satisfy their conditions.

    A digit lost in a coefficient would otherwise show as a method that works, one order too low.
    """
    cases = [(tableau.m, 1.0, tableau.order), (tableau.m - tableau.e, 1.0, tableau.error_order)]
    dense_order = min(tableau.order, 4)
    cases += [(tableau.interpolation_weights(s), s, dense_order) for s in (0.3, 0.7)]
    for weights, s, order in cases:
        worst = max(abs(value) for o, value in order_conditions(tableau, weights, s)[:-1] if o <= order)
        if worst > 1e-12:
            raise ArithmeticError(f"{tableau.name}: an order condition misses by {worst:.1e}")
    stiffly_accurate = abs(tableau.c[-1] - 1) + abs(tableau.d[-1])
    if stiffly_accurate > 1e-12:
        raise ArithmeticError(f"{tableau.name}: the last stage misses the end of the step")
    return tableau


_A5 = [-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946]

RODAS5P = _checked(
    Tableau(
        name="rodas5p",
        order=5,
        error_order=4,
        gamma=0.21193756319429014,
        a=_lower(
            [
                [],
                [3.0],
                [2.849394379747939, 0.45842242204463923],
                [-6.954028509809101, 2.489845061869568, -10.358996098473584],
                [2.8029986275628964, 0.5072464736228206, -0.3988312541770524, -0.04721187230404641],
                _A5,
                [*_A5, 1.0],
                [*_A5, 1.0, 1.0],
            ],
            8,
        ),
        C=_lower(
            [
                [],
                [-14.155112264123755],
                [-17.97296035885952, -2.859693295451294],
                [147.12150275711716, -1.41221402718213, 71.68940251302358],
                [165.43517024871676, -0.4592823456491126, 42.90938336958603, -5.961986721573306],
                [24.854864614690072, -3.0009227002832186, 47.4931110020768, 5.5814197821558125,
                 -0.6610691825249471],
                [30.91273214028599, -3.1208243349937974, 77.79954646070892, 34.28646028294783,
                 -19.097331116725623, -28.087943162872662],
                [37.80277123390563, -3.2571969029072276, 112.26918849496327, 66.9347231244047,
                 -40.06618937091002, -54.66780262877968, -9.48861652309627],
            ],
            8,
        ),
        m=np.array([*_A5, 1.0, 1.0, 1.0]),
        e=np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        H=np.array(
            [
                [25.948786856663858, -2.5579724845846235, 10.433815404888879, -2.3679251022685204,
                 0.524948541321073, 1.1241088310450404, 0.4272876194431874, -0.17202221070155493],
                [-9.91568850695171, -0.9689944594115154, 3.0438037242978453, -24.495224566215796,
                 20.176138334709044, 15.98066361424651, -6.789040303419874, -6.710236069923372],
                [11.419903575922262, 2.8879645146136994, 72.92137995996029, 80.12511834622643,
                 -52.072871366152654, -59.78993625266729, -0.15582684282751913, 4.883087185713722],
            ]
        ),
    )
)  # fmt: skip

RODAS3P = _checked(
    Tableau(
        name="rodas3p",
        order=3,
        error_order=2,
        gamma=1 / 3,
        a=_lower([[], [4 / 3], [], [2.90625, 3.375, 0.40625], [2.90625, 3.375, 0.40625]], 5),
        C=_lower(
            [
                [],
                [-4.0],
                [8.25, 6.75],
                [1.21875, -5.0625, -1.96875],
                [4.03125, -15.1875, -4.03125, 6.0],
            ],
            5,
        ),
        m=np.array([2.90625, 3.375, 0.40625, 0.0, 1.0]),
        e=np.array([0.0, 0.0, 0.0, -1.0, 1.0]),
        H=np.array(
            [
                [1.78125, 6.75, 0.15625, -6.0, -1.0],
                [4.21875, -15.1875, -3.09375, 9.0, 0.0],
                [0.0, 0.0, 0.0, 0.0, 0.0],
            ]
        ),
    )
)

TABLEAUS = {tableau.name: tableau for tableau in (RODAS5P, RODAS3P)}
