"""The structs of linear systems."""

from __future__ import annotations

from fairlead.integrate.memory.struct import Struct

MATRICES = Struct(
    copies=("n", "differential", "quadrature",),
    integers=(
        "n_jacobian", "n_mass", "jacobian_fresh",
    ),
    reals={
        "jacobian": "n_jacobian", "mass": "n_mass",
    },
    indices={
        "jacobian_starts": "n_plus_1", "jacobian_rows": "n_jacobian", "mass_starts": "n_plus_1",
        "mass_rows": "n_mass", "mass_columns": "n_mass", "diagonal_slope": "n", "diagonal_mass": "n",
        "of_balance": "n",
    },
)  # fmt: skip
"""J and M along their patterns."""

REDUCED = Struct(
    copies=("n", "n_reduced", "differential", "quadrature",),
    integers=(
        "n_positions", "n_quadrature_rows", "n_quadrature_entries", "n_entries",
        # which matrix is factored there, whether its factors are good
        "reduced_kind", "reduced_valid",
    ),
    numbers=(
        "reduced_scale",
    ),
    reals={
        "jacobian_used": "n_jacobian", "mass_used": "n_mass", "reduced_x": "n_reduced", "reduced_b": "n_reduced",
        "position_ratio": "n_positions", "position_share": "n_positions", "quadrature_share": "n_quadrature_rows",
    },
    indices={
        # pivot order
        "row_order": "n_reduced",
        # what J and M put into each column of the reduced matrix, and what follows from it
        "entry_starts": "n_reduced_plus_1", "entry_source": "n_entries", "entry_place": "n_entries",
        "entry_kind": "n_entries", "jacobian_column": "n_jacobian", "mass_column": "n_mass",
        "position": "n_positions", "position_speed": "n_positions", "position_slope": "n_positions",
        "position_mass": "n_positions", "quadrature_row": "n_quadrature_rows", "quadrature_mass": "n_quadrature_rows",
        "quadrature_starts": "n_quadrature_rows_plus_1", "quadrature_entry": "n_quadrature_entries",
        "quadrature_column": "n_quadrature_entries",
    },
)  # fmt: skip
"""The reduced matrix: what is left of W when positions and quadratures follow (condensing.py)."""

FACTORS = Struct(
    copies=("n",),
    integers=(
        "n_reduced", "n_matrix", "dense", "culprit",
        # columns of the last factorisation
        "n_redone", "n_perturbed", "most_perturbed", "factorisations", "solves", "replans",
        "no_pivots",  # 1: for the matrix that asked for other pivots there are none, it is singular
    ),
    numbers=(
        "factored_h", "factored_theta", "mass_factor",
    ),
    reals={
        "column_scale": "n", "row_scale": "n", "factor_work": "n", "matrix": "n_matrix", "lower": "n_lower",
        "upper": "n_upper", "perturbation": "n_reduced", "perturbed_columns": "perturbed_reduced",
        "capacitance": "perturbed_square", "handed": "most_perturbed", "pivot": "n_reduced",
        "reduced_residual": "n_reduced",
    },
    indices={
        "jacobian_place": "n_jacobian", "mass_place": "n_mass", "column_order": "n_reduced",
        # patterns of W, of L (without diagonal) and of U
        "matrix_starts": "n_reduced_plus_1", "matrix_rows": "n_matrix", "lower_starts": "n_reduced_plus_1",
        "lower_rows": "n_lower", "upper_starts": "n_reduced_plus_1", "upper_rows": "n_upper",
        "using_starts": "n_reduced_plus_1", "using_columns": "n_upper", "row_place": "n", "waiting": "n_reduced",
        "pivot_rows": "n", "dirty": "n_reduced", "perturbed": "most_perturbed", "capacitance_order": "most_perturbed",
    },
)  # fmt: skip
"""W assembled, and its factors: a full matrix, or the plan of a sparse factorisation."""
