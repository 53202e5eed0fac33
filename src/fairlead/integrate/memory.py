"""The memory of a run: everything that it changes in one arena, and the addresses of what it needs.

    links      addresses: of all arrays, of the C functions of the problem, of their context
    arena      numbers, then arrays one after another, then what the callbacks of the problem change
    behind it  scratch arrays, which hold nothing between two steps

The compiled loop takes the address of the struct and nothing else: the links, and the numbers that follow at once. So
it compiles once for every problem, allocates nothing, and a run can leave it at any step and come back. What no run
changes (plans, patterns, the method) lies elsewhere, and runs share it; so do the buffers for what is recorded, which
Python empties.

There is no address in the arena, so that its bytes are the state of a run: copied to the same arena they take the run
back, copied to the arena of another run of the same problem they make that go on from here. Offsets become addresses
once, in the links, when an arena is made; an index in the loop then costs what it does in any array.

Everything here is eight bytes wide. `LAYOUT` is the one list: Python and compiled code read the same names.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

INTEGERS = (
    # sizes
    "n", "n_core", "n_positions", "n_meters", "n_meter_entries", "n_entries",
    "n_algebraic", "n_watched", "n_guards", "n_zones", "n_outputs", "n_jacobian", "n_mass", "n_matrix",
    "stages",
    "row_capacity", "event_capacity", "max_passes", "max_steps", "max_events",
    # settings
    "adaptive", "on_grid", "between", "most_inside", "on_chatter", "dense",
    # where the run is
    "phase", "crossed", "companion", "judged", "landing", "jacobian_fresh", "retried", "mended", "meters_off",
    "worst", "n_fired", "passes",
    "one_by_one", "rows", "events", "total_events", "grid_next", "inside", "inside_next",
    "stalls", "culprit", "stop_asked",
    # the settlement: which violators change, since which pass, the fewest there were, passes since, whether
    # guards have inertias
    "stage", "stage_from", "fewest", "waited", "weighs_guards",
    # impacts: whether any row takes impulses, and the unknowns of the energy ledger (-1: there is none)
    "takes_impulses", "rebounds", "n_moves", "n_balanced", "dropped", "dissipated_at", "supplied_at",
    # the order of release (release.py): whether friction of a contact falls as it lets go, whether the order was
    # asked for in this settlement, levels of load that are still out, whether zones have changed since the last of
    # them, whether there was nothing before
    "falling", "ordered", "levels", "level_due", "nothing_before",
    # the core of W: which matrix is factored there, whether its factors are good, columns of the last factorisation
    "core_kind", "core_valid", "skip_meters", "n_redone", "n_perturbed", "most_perturbed",
    # the part of the problem the loop works on: the step at which to look whether less would do, whether it is a
    # part, whether its rim has changed
    "narrow_at", "narrowed", "woken",
    # stepping only: whether it lands on every switch (located_step.py), whether J and M are those of the zones in
    # force, whether a surface that holds is accelerated, steps failed in a row, tries to land on a jump
    "locates", "linearised", "driven", "massless", "failed", "seeking", "linear", "newly_held", "unchecked",
    "expecting", "has_limits",
    "n_quadratures", "rows_slip", "any_stiff", "shown_apart", "samples", "block_steps",
    # stepping only: whether moves were taken back in this step (line_search.py), whether its matrix is that of zones or
    # values met on the way, whether other pivots were tried for that
    "searched", "midway", "replanned",
    "n_hold_mass", "n_hold_slope", "n_hold_share", "n_body_speed", "n_neighbours",
    # stepping only (known_rows.py): whether zones may not be those of J and M, in how many machines they differ, if
    # only known rows were exchanged, what was guessed in a step, what has turned out wrong, whether such a row caught
    "zones_differ", "n_exchanged", "rows_alone", "guessed", "distrusted", "caught_by_row", "limits_vary",
    "n_own_slopes", "n_own_masses", "n_known", "n_switched", "n_free_guards",
    # counters, in the order of counters.COUNTS
    "steps", "rejected_error", "rejected_nan", "rejected_companion", "rejected_switch", "rejected_cycling",
    "rejected_diverged", "rejected_singular", "rhs", "jacobians", "factorisations", "solves", "guards", "switches",
    "located", "settling_passes", "time_events", "replans", "partial_steps",
    "projections",
)  # fmt: skip
"""Whole numbers of the struct."""

CALLS = (
    "context", "call_rhs", "call_jacobian", "call_mass", "call_guards", "call_switch", "call_slip",
    "call_next_time", "call_at_time", "call_outputs", "call_forces", "call_drift", "call_slopes", "call_gap",
)  # fmt: skip
"""Addresses of C functions of the problem, and of their context."""

NUMBERS = (
    # settings
    "start", "stop", "every", "least_gap", "max_step", "first_step", "step_floor", "progress_floor", "dwell", "gamma",
    "error_exponent",
    # where the run is: the settled point at t, the trial step [t, t + h], the piece of it that is accepted
    "t", "h", "h_wanted", "h_next", "error", "last_error", "theta", "t_piece", "t_land", "t_next", "t_row",
    "t_release", "t_last_switch", "factored_h", "look", "least_look", "nearness", "core_scale", "growth", "t_growth",
    "fastest", "moved", "most_moved",
    # stepping only: theta asked for, its rise when zones cycle, theta in force, the step asked for, distances of the
    # slopes remembered, what was allowed in the last steps (steady_steps.py)
    "least_theta", "theta_raise", "theta_now", "factored_theta", "fixed_step", "gap", "gap_before",
    "t_jump", "t_switch", "t_bent", "allowed", "allowed_before",
)  # fmt: skip
"""Real numbers of the struct."""

VECTORS = {
    # unknowns (n each): the point, its derivative, the trial end, a point inside the step
    "y": "n", "slope": "n", "y_end": "n", "y_piece": "n", "y_probe": "n", "f": "n", "ft": "n", "b": "n",
    "x": "n", "u": "n", "v": "n", "residual": "n", "error_vector": "n", "weight": "n", "curvature": "n",
    "K": "stages_n", "D": "three_n",
    "absolute": "n", "relative": "n", "cap": "n", "column_scale": "n", "row_scale": "n", "factor_work": "n",
    # matrices along their patterns; `matrix` holds W or the matrix of the consistent point
    # stepping only: mean slopes of this step, of the one before and of the one before that; algebraic unknowns in the
    # middle of the one before
    "mean_slope": "n", "slope_before": "n", "slope_earlier": "n", "mean_before": "n", "move": "n",
    "patterns_met": "passes",
    "jacobian": "n_jacobian", "mass": "n_mass", "matrix": "n_matrix", "lower": "n_lower", "upper": "n_upper",
    "perturbation": "n_core", "perturbed_columns": "perturbed_core", "capacitance": "perturbed_square",
    "handed": "most_perturbed",
    "pivot": "n_core", "jacobian_used": "n_jacobian", "mass_used": "n_mass", "core_x": "n_core", "core_b": "n_core",
    "core_residual": "n_core", "position_ratio": "n_positions", "position_share": "n_positions",
    "meter_share": "n_meters",
    "known_slopes": "own_slopes_by_zone", "known_masses": "own_masses_by_zone", "known_constants": "machines_by_zone",
    # the method
    "a": "stages_stages", "C": "stages_stages", "c": "stages", "d": "stages", "m": "stages", "e": "stages",
    "H": "three_stages",
    # guards: at the point, at the left and right end of a bracket, and at a probe
    "g": "n_guards", "g_left": "n_guards", "g_right": "n_guards", "g_probe": "n_guards",
    "g_early": "n_guards", "g_ahead": "n_guards",
    "g_late": "n_guards", "g_end": "n_guards", "guard_tolerance": "n_guards",
    "guard_inertia": "n_guards", "wrong": "n_guards",
    # machines
    "switched_after": "n_zones", "last_toggle": "n_zones", "blocked_until": "n_zones", "held_inertia": "n_zones",
    "rank": "n_zones",
    # the order of release: the point just before, loads that are out and the shares of them that are left, rates of
    # guards by slips at both ends of a way, slips in the time of a level
    "y_before": "n", "f_before": "n", "out": "levels_n", "left": "levels",
    "rate": "n_guards", "rate_end": "n_guards", "fast_slip": "n_guards",
    # energy lost in impacts, by the row that held
    "lost": "n", "rebound": "n",
    # the point as it was settled at the start; of an event, how far from y it is shown
    "begun": "n", "apart": "n",
    # what was recorded
    "row_t": "row_capacity", "row_values": "rows_outputs", "event_t": "event_capacity",
}  # fmt: skip
"""Arrays of doubles, by the name of their length."""

INDICES = {
    "jacobian_starts": "n_plus_1", "jacobian_rows": "n_jacobian", "jacobian_place": "n_jacobian",
    "mass_starts": "n_plus_1", "mass_rows": "n_mass", "mass_columns": "n_mass", "mass_place": "n_mass",
    # relations of positions (position.py): a position, its speed, and its acceleration where that is an unknown
    "move_position": "n_moves", "move_speed": "n_moves", "move_acceleration": "n_moves",
    # nodes without inertia (balance.py): their positions and speeds
    "balanced_position": "n_balanced", "balanced_speed": "n_balanced",
    # the speed of an acceleration that is an unknown; of others they themselves
    "speed_of": "n",
    "differential": "n", "quadrature": "n", "unweighed": "n", "watched": "n", "takes_impulse": "n",
    # stepping only: unknowns whose error sets the step, the position of each speed (-1: none), rows that hold now,
    # zones at the start of the step; machines that switched in the trial (missed_impulse.py)
    "controlled": "n", "position_of": "n", "holds": "n", "of_massless": "n", "caught": "n", "rested": "n",
    "diagonal_slope": "n", "diagonal_mass": "n", "is_stiff": "n",
    "zones_at_start": "n_zones",
    "body_starts": "n_zones_plus_1", "body_speed": "n_body_speed", "body_position": "n_body_speed",
    "continuous": "n_guards", "limit_guard": "n_guards", "kink_guard": "n_guards",
    "may_hold": "n_guards",
    "may_jump": "n_guards", "suspects": "n_guards", "kind_is_smooth": "n_zones",
    "zones_probed": "n_zones", "first_guard": "n_zones", "met": "n_zones",
    "hold_row": "n_zones", "released": "n_zones", "released_by": "n_zones", "switched": "n_zones",
    "neighbour_starts": "n_zones_plus_1", "neighbours": "n_neighbours",
    "hold_mass": "n_hold_mass", "hold_mass_row": "n_hold_mass", "hold_mass_column": "n_hold_mass",
    "hold_mass_partner": "n_hold_mass", "hold_slope": "n_hold_slope", "hold_slope_row": "n_hold_slope",
    "hold_share": "n_hold_share", "hold_share_row": "n_hold_share", "hold_share_column": "n_hold_share",
    "own_row": "n_zones", "own_slope_starts": "n_zones_plus_1", "own_slopes": "n_own_slopes",
    "own_slope_columns": "n_own_slopes", "own_mass_columns": "n_own_masses",
    "own_mass_starts": "n_zones_plus_1", "own_masses": "n_own_masses", "known": "machines_by_zone",
    "zones_linearised": "n_zones", "own_kind": "n_zones", "only_kinks": "n_zones",
    "known_of_kind": "machines_by_zone", "exchanged_machines": "n_zones",
    # the order of release: by row who decides whether it holds, by machine whether its friction falls, unknowns that
    # move in the fast time, the level in which a slip began, guards that it has brought back to zero
    "holder": "n", "in_circle": "n", "falls": "n_zones", "is_speed": "n", "born": "n_guards", "came_back": "n_guards",
    "zones_just_before": "n_zones",
    "rim": "n_zones", "zones": "n_zones", "zones_before": "n_zones", "zones_history": "passes_zones",
    "fired": "n_guards", "guard_machine": "n_guards", "streak": "n_zones", "chatters": "n_zones",
    "switches_by_machine": "n_zones", "rejections_by_unknown": "n",
    "row_side": "row_capacity",
    "event_machine": "event_capacity", "event_before": "event_capacity", "event_after": "event_capacity",
    "event_guard": "event_capacity", "event_position": "event_capacity",
    # the plan of the sparse factorisation: pivot order, pattern of W, of L (without diagonal) and of U
    "row_order": "n_core", "column_order": "n_core", "matrix_starts": "n_core_plus_1", "matrix_rows": "n_matrix",
    "lower_starts": "n_core_plus_1", "lower_rows": "n_lower", "upper_starts": "n_core_plus_1", "upper_rows": "n_upper",
    "using_starts": "n_core_plus_1", "using_columns": "n_upper", "row_place": "n", "waiting": "n_core",
    "pivot_rows": "n", "dirty": "n_core", "perturbed": "most_perturbed", "capacitance_order": "most_perturbed",
    # what J and M put into each column of the core, and what follows from the core
    "entry_starts": "n_core_plus_1", "entry_source": "n_entries", "entry_place": "n_entries", "entry_kind": "n_entries",
    "jacobian_column": "n_jacobian", "mass_column": "n_mass",
    "position": "n_positions", "position_speed": "n_positions", "position_slope": "n_positions",
    "position_mass": "n_positions", "meter": "n_meters", "meter_mass": "n_meters", "meter_starts": "n_meters_plus_1",
    "meter_entry": "n_meter_entries", "meter_column": "n_meter_entries",
}  # fmt: skip
"""Arrays of whole numbers, by the name of their length."""

BUFFERS = ("row_t", "row_values", "row_side", *(f"event_{of}" for of in ("t", "machine", "before", "after", "guard",
           "position")))  # fmt: skip
"""Arrays for what is recorded."""
OF_INSTANCE = ("zones", "guard_inertia", "rebound", "absolute", "relative", "cap", "column_scale", "guard_tolerance")
"""Arrays that the instance of the problem has."""
SCRATCH = ("zones_history", "patterns_met")
"""Arrays that hold nothing between two steps, and are long."""

LAYOUT = np.dtype(
    [(f"at_{name}", "i8") for name in (*VECTORS, *INDICES)]
    + [(name, "i8") for name in (*CALLS, *INTEGERS)]
    + [(name, "f8") for name in NUMBERS],
    align=True,
)
"""The struct: at_<name> is the address of the array <name>."""
LINKS = 8 * (len(VECTORS) + len(INDICES) + len(CALLS))
"""Bytes of it that are addresses; the arena begins behind them."""
LINE = 64
"""Bytes of a line of the processor's cache; every array begins one."""


class State(NamedTuple):
    """Where a run is: a copy of its arena, and of the arrays that a replan put in place of others."""

    arena: NDArray[np.uint8]
    replaced: dict[str, NDArray[Any]]


class _Arrays(dict[str, np.ndarray]):
    """Arrays by name; those of the arena are views of it, made when first asked for."""

    def __init__(self, memory: NDArray[np.uint8], places: Mapping[str, int], lengths: Mapping[str, int]) -> None:
        super().__init__()
        self._memory, self._places, self._lengths = memory, places, lengths

    def __missing__(self, name: str) -> np.ndarray:
        at = self._places[name]
        kind = np.float64 if name in VECTORS else np.int64
        self[name] = self._memory[at : at + 8 * self._lengths[name]].view(kind)
        return self[name]


class Memory:
    """Links, arena and scratch of one run, owned by Python, and views of all arrays.

    `number[...]` reads and writes single values, `array[...]` the arrays, `piece` is what the problem changes.
    """

    def __init__(self, lengths: Mapping[str, int], given: Mapping[str, np.ndarray], room: int = 0) -> None:
        """Arrays by `lengths` (as named in VECTORS and INDICES), with `room` bytes for the problem.

        Arrays in `given` are used as they are and not changed; buffers, and what the instance has, wait for `point`.
        """
        length_of = {name: lengths[length] for name, length in (VECTORS | INDICES).items()}
        places, size = {}, _lines(LAYOUT.itemsize)
        elsewhere = {*given, *BUFFERS, *OF_INSTANCE, *SCRATCH}
        for name, length in length_of.items():
            if name not in elsewhere:
                places[name], size = size, size + _lines(8 * length)
        piece, size = size, size + _lines(room)
        for name in SCRATCH:
            places[name], size = size, size + _lines(8 * length_of[name])
        memory = np.zeros(size + LINE, dtype=np.uint8)
        memory = memory[-memory.ctypes.data % LINE :][:size]
        self.struct = memory[: LAYOUT.itemsize].view(LAYOUT)
        self.arena, self.piece = memory[LINKS : piece + room], memory[piece : piece + room]
        self.array: dict[str, np.ndarray] = _Arrays(memory, places, length_of)
        self.replaced: dict[str, np.ndarray] = {}
        self._first: dict[str, np.ndarray] = {}  # what stood where something was replaced
        links, base = memory[:LINKS].view(np.int64), memory.ctypes.data
        links[: len(length_of)] = [base + places.get(name, 0) for name in length_of]
        for name, array in given.items():
            self.point(name, array, np.float64 if name in VECTORS else np.int64)

    def point(self, name: str, array: np.ndarray, kind: Any) -> None:
        """Make `name` stand for `array`, in place if it already has the right type."""
        fitting = np.ascontiguousarray(array, dtype=kind)
        if fitting.size == 0:
            fitting = np.zeros(1, kind)[:0]
        self.array[name] = fitting
        self.struct[0][f"at_{name}"] = fitting.ctypes.data

    def replace(self, arrays: Mapping[str, np.ndarray]) -> None:
        """Put these in place of arrays of other lengths: an order of pivots that the run has come upon."""
        for name, array in arrays.items():
            self._first.setdefault(name, self.array[name])
            self.replaced[name] = array
            self.point(name, array, array.dtype)

    def save(self) -> State:
        """A copy of where the run is, between two steps."""
        return State(self.arena.copy(), {name: array.copy() for name, array in self.replaced.items()})

    def restore(self, state: State) -> None:
        """Go to where a run was that has the same problem and settings."""
        self.arena[:] = state.arena
        for name, array in self._first.items():
            self.point(name, array, array.dtype)
        self.replaced = {}
        self.replace({name: array.copy() for name, array in state.replaced.items()})

    @property
    def number(self) -> Any:
        """The struct as a record: number["t"]."""
        return self.struct[0]

    @property
    def address(self) -> int:
        """Where the struct is."""
        return int(self.struct.ctypes.data)


def _lines(size: int) -> int:
    """Bytes of so many whole lines that hold `size`."""
    return -(-size // LINE) * LINE
