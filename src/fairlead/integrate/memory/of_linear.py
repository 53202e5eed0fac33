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

CORE = Struct(
    copies=("n", "n_core", "differential", "quadrature",),
    integers=(
        "n_positions", "n_meters", "n_meter_entries", "n_entries",
        # which matrix is factored there, whether its factors are good
        "core_kind", "core_valid",
    ),
    numbers=(
        "core_scale",
    ),
    reals={
        "jacobian_used": "n_jacobian", "mass_used": "n_mass", "core_x": "n_core", "core_b": "n_core",
        "position_ratio": "n_positions", "position_share": "n_positions", "meter_share": "n_meters",
    },
    indices={
        # pivot order
        "row_order": "n_core",
        # what J and M put into each column of the core, and what follows from the core
        "entry_starts": "n_core_plus_1", "entry_source": "n_entries", "entry_place": "n_entries",
        "entry_kind": "n_entries", "jacobian_column": "n_jacobian", "mass_column": "n_mass",
        "position": "n_positions", "position_speed": "n_positions", "position_slope": "n_positions",
        "position_mass": "n_positions", "meter": "n_meters", "meter_mass": "n_meters",
        "meter_starts": "n_meters_plus_1", "meter_entry": "n_meter_entries", "meter_column": "n_meter_entries",
    },
)  # fmt: skip
"""The core of W: what is left of it when positions and quadratures follow (condensing.py)."""

FACTORS = Struct(
    copies=("n",),
    integers=(
        "n_core", "n_matrix", "dense", "culprit",
        # columns of the last factorisation
        "n_redone", "n_perturbed", "most_perturbed", "factorisations", "solves", "replans",
        "no_pivots",  # 1: for the matrix that asked for other pivots there are none, it is singular
    ),
    numbers=(
        "factored_h", "factored_theta", "mass_factor",
    ),
    reals={
        "column_scale": "n", "row_scale": "n", "factor_work": "n", "matrix": "n_matrix", "lower": "n_lower",
        "upper": "n_upper", "perturbation": "n_core", "perturbed_columns": "perturbed_core",
        "capacitance": "perturbed_square", "handed": "most_perturbed", "pivot": "n_core", "core_residual": "n_core",
    },
    indices={
        "jacobian_place": "n_jacobian", "mass_place": "n_mass", "column_order": "n_core",
        # patterns of W, of L (without diagonal) and of U
        "matrix_starts": "n_core_plus_1", "matrix_rows": "n_matrix", "lower_starts": "n_core_plus_1",
        "lower_rows": "n_lower", "upper_starts": "n_core_plus_1", "upper_rows": "n_upper",
        "using_starts": "n_core_plus_1", "using_columns": "n_upper", "row_place": "n", "waiting": "n_core",
        "pivot_rows": "n", "dirty": "n_core", "perturbed": "most_perturbed", "capacitance_order": "most_perturbed",
    },
)  # fmt: skip
"""W assembled, and its factors: a full matrix, or the plan of a sparse factorisation."""
