"""What a compiled kernel reads and writes: stored with its machine code, so a warm start needs no SymPy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from fairlead.kernels.layout import OUTPUT_LINES

Sum = list[tuple[int, float]]
"""Inputs by place, and their coefficients, see dependence.py."""
PIECES = "01cv"
"""What the piece of a table in force is: zero, one, any other constant, anything else."""
OF_GUARD = ""
"""Stands for a guard where otherwise the name of an output does."""


@dataclass(frozen=True)
class Structure:
    """What a kernel reads and writes, by position. Keys of inputs are those of `component/trace.py`."""

    inputs: list[str]
    parameters: list[str]
    tables: list[str]
    time_tables: list[str]
    zones: list[str]
    machines: int
    outputs: list[str]
    zeros: list[str]  # outputs that are zero, whatever happens
    unfit: dict[str, str]  # outputs that cannot feed an input or prescribe a motion, and why
    targets: list[str]  # "port:a", "own:force": where flows, rates and balances go
    ledger: list[str]
    d_signals: list[tuple[int, int]]  # (output, input) of every derivative that may be non-zero
    d_flows: list[tuple[int, int]]
    d_ledger: list[tuple[int, int]]
    mass: list[tuple[str, int]]  # (unknown, input) of the mass entries of hold rows
    holds: dict[str, list[str]]  # unknown -> zones that hold
    rigid: list[str]  # unknowns of those that take an impulse of any size where they hold
    pairs: dict[str, dict[str, float]]  # unknown -> port -> coefficient of its speed in the slip, see `held_pairs`
    ratios: dict[str, dict[str, str]]  # likewise, of a tie whose coefficients are made of parameters: port -> text
    senses: dict[str, float]  # unknown -> what a port takes in over that coefficient, for an unknown of one
    guards: dict[str, list[dict[str, Any]]]  # zone -> its guards in slot order
    slots: int
    flow_inputs: dict[str, dict[str, list[str]]]  # zone -> target -> input keys it depends on
    reaches: dict[str, dict[str, str]]  # zone -> table -> input or expression it is read at
    fixed_signals: list[int]  # places in d_signals of derivatives that are one number, in all zones
    fixed_flows: list[int]
    fixed_ledger: list[int]
    linear: bool  # no derivative of a flow depends on an input: linear as long as the zones are frozen
    curved: list[int]  # places in outputs of those with a derivative that does
    guards_read: bool  # a guard reads an acceleration or a reaction
    late: list[int]  # places in all outputs of those that read one
    stores: bool  # an instance may have stored energy
    modes: list[int]  # what it has an answer to, of what a kernel may be asked (layout.py)
    reads: dict[str, dict[str, dict[str, Any]]]  # zone -> kinds of its pieces -> what depends on what (dependence.py)
    members: int  # most members that the groups among the guards of one zone have together
    carries: list[tuple[str, float]]  # factors of the ratio of speeds where it takes a node along: ("", number) first,
    # then (key, power) of parameters ("p:radius") and inputs; empty for a class that carries nothing
    inverse_masses: dict[str, str]  # parameter -> the port whose body it is one over the mass of
    sines: list[tuple[int, int]]  # places in parameters of (amplitude, angular frequency) of what swings in time
    swings: list[str]  # by what a sine is taken of: the output that has it, or OF_GUARD (swings.py)
    shares_left: list[tuple[str, str]]  # of friction when a contact lets go, see `break_away`
    rebounds: dict[str, tuple[int, float]]  # unknown that rebounds -> place of its share in parameters or -1, number
    positions: dict[str, list[str]]  # unknown that keeps a relation of positions -> the ports it reads
    stops: dict[str, list[str]]  # unknown that holds where a place is met, and knows how far off that is -> its ports
    dampings: dict[str, str]  # port -> text of what it takes in more for a speed of its own, where that is fixed
    joins: dict[str, list[dict[str, Any]]]  # zone -> what joins speeds in it, of a kernel with rates (flow_rates.py)
    yields: list[str]  # ports at which a state yields to the motion, so that a jump there is not one of positions alone
    unrated: dict[str, str]  # port -> what hinders knowing the rate of what it takes in
    silent: bool  # passes power at its ports and declares no energy
    period: str = ""  # the parameter that gives the sample period; empty without sampling

    @property
    def place_tables(self) -> list[str]:
        """Tables that are read at a place, not in time."""
        return [path for path in self.tables if path not in self.time_tables]

    @property
    def all_outputs(self) -> list[str]:
        """What an instance gives when asked for its outputs: these, then its lines of the energy ledger."""
        return [*self.outputs, *OUTPUT_LINES]
