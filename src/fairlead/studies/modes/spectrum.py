"""Eigenvalues of a linearised model: frequency, damping, and which component takes part.

The participation of a state in a mode is |w_k v_k| with the left and the right eigenvector, w'v = 1 (Perez-Arriaga,
Verghese and Schweppe, IEEE Trans. PAS-101, 1982). It does not depend on units. States of one component are added up,
and the shares of a mode make 1. Of bodies that hold together positions share by stiffness, and speeds by inertia.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fairlead.studies.modes.linear import Linear

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
ROUNDING = 10 * float(np.finfo(float).eps)
"""What rounding changes in a balanced matrix, relative to its norm."""


@dataclass(frozen=True)
class Mode:
    """A mode of motion: its eigenvalue [1/s] with an imaginary part of 0 or above, and who takes part.

    `shape` is the change of every unknown, in the unit of each, the largest speed or state with size 1.
    """

    value: complex
    participation: dict[str, float]
    """Share of every component, the largest first; they make 1."""
    error: float
    """Of the eigenvalue by rounding [1/s]; a growth within it is none."""
    shape: Complex = field(repr=False, compare=False)

    @property
    def frequency(self) -> float:
        """Of the oscillation [Hz]; 0 for what creeps back or away."""
        return abs(self.value.imag) / (2 * math.pi)

    @property
    def damping(self) -> float:
        """Damping ratio: below 0 the mode grows, at 1 and above it does not oscillate."""
        return -self.value.real / abs(self.value)

    @property
    def growth(self) -> float:
        """Real part [1/s]: above 0 the mode grows by exp(growth t)."""
        return self.value.real


@dataclass(frozen=True)
class Zeros:
    """Eigenvalues that are zero within rounding: how many, and how slow each has to be at least [1/s].

    `offsets` of them belong to contacts that hold: the slip C x of each stays where it took hold, so that C is a left
    eigenvector of zero. `others` are the shares of components in all, the largest first, members of an array together.
    """

    count: int = 0
    offsets: int = 0
    below: float = 0.0
    others: dict[str, float] = field(default_factory=dict)


def modes_of(found: Linear) -> tuple[list[Mode], Zeros]:
    """The modes by falling period, and what is zero within rounding.

    Rounding of a matrix B changes an eigenvalue by |B| eps/|w'v|, with vectors of length 1; a double zero too, for its
    two vectors are nearly orthogonal. Where they are exactly orthogonal, as of two equal lags one after the other, the
    quotient says nothing, and what is known of a double eigenvalue holds: rounding changes it by |B| sqrt(eps).
    """
    from scipy.linalg import eig, matrix_balance

    if not len(found.matrix):
        return [], Zeros()
    balanced, scale = matrix_balance(found.matrix, permute=False)
    values, left, right = eig(balanced, left=True, right=True)
    scale, size = np.diag(scale)[:, None], max(float(np.linalg.norm(balanced)), found.pace)
    parallel = np.abs((left.conj() * right).sum(axis=0))
    errors = ROUNDING * size / np.where(parallel > ROUNDING, parallel, math.sqrt(ROUNDING))
    left, right = found.onto.T @ (left / scale), found.basis @ (right * scale)
    zero = np.abs(values) <= errors
    wanted = np.flatnonzero(~zero & (values.imag >= 0))
    wanted = wanted[np.argsort(np.abs(values[wanted]), kind="stable")]
    made = [Mode(complex(values[k]), _participation(found, left[:, k], right[:, k]), float(errors[k]),
                 _shape(found, right[:, k])) for k in wanted]  # fmt: skip
    return made, _zeros(found, left[:, zero], right[:, zero], errors[zero])


def _zeros(found: Linear, left: Complex, right: Complex, errors: Floats) -> Zeros:
    count = left.shape[1]
    if not count:
        return Zeros()
    shares: dict[str, float] = {}
    for k in range(count):
        for name, share in _participation(found, left[:, k], right[:, k]).items():
            of_array = name.partition("[")[0]
            shares[of_array] = shares.get(of_array, 0.0) + share / count
    offsets = min(int(found.equations.differential.sum()) - len(found.matrix), count)
    return Zeros(count, offsets, float(errors.max()), dict(sorted(shares.items(), key=lambda one: -one[1])))


def _participation(found: Linear, left: Complex, right: Complex) -> dict[str, float]:
    sizes = np.abs(left.conj() * right)
    owners = [name.rpartition(".")[0] for name, d in zip(found.equations.names, found.equations.differential,
                                                         strict=True) if d]  # fmt: skip
    shares: dict[str, float] = {}
    for owner, size in zip(owners, (sizes / sizes.sum()).tolist(), strict=True):
        shares[owner] = shares.get(owner, 0.0) + size
    return dict(sorted(shares.items(), key=lambda one: -one[1]))


def _shape(found: Linear, right: Complex) -> Complex:
    """The change of every unknown."""
    y: Complex = found.spread @ (found.onto @ right)
    largest = y[np.argmax(np.abs(np.where(found.equations.differential, y, 0)))]
    return y / largest
