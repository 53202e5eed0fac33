"""Where things lie in the flat memory that kernels and driver share.

z, the vector every law reads from:

    [ y (n) | signals (m) | reactions (r) | 0 | t | accelerations (n) ]

w, the vector every law adds to:  [ rows of f (n) | reactions (r) | dump ].

One BLOCK of int64 per class variant describes its instances to its kernel: counts and the addresses
of its tables of indices and numbers. The names below are positions in that block.
"""

from __future__ import annotations

# Positions in a kernel's block (int64 each). Addresses point to C-contiguous arrays.
PAR = 0  # float64 (count, NP)   parameters
IN_INDEX = 1  # int64 (count, NI)    where in z an input lies
IN_COEF = 2  # float64 (count, NI)   ratio of the kinematic group
IN_OFFSET = 3  # float64 (count, NI)  offset of the group, or the value of an unconnected input
MACHINES = 4  # int64 (count, NM)    positions in `zones`: the zone, then the piece of each table
TABLE_BASE = 5  # int64 (count, NT)  where in `tables` a table starts
SIG_INDEX = 6  # int64 (count, NS)   where in z an output signal goes (or the dump)
FLOW_INDEX = 7  # int64 (count, NF)  where in w a flow, rate or balance goes
FLOW_COEF = 8  # float64 (count, NF)
LEDGER_INDEX = 9  # int64 (2,)       where in w dissipated and supplied power go
D_SIGNALS = 10  # offsets (counts of float64) into the vector of partial derivatives
D_FLOWS = 11
D_LEDGER = 12
D_MASS = 13
GUARDS = 14  # offset into the guard vector
OUTPUTS = 15  # offset into the vector of all outputs
BLOCK = 16

# What a kernel is asked to do. `out` is z for SIGNALS, w for FLOWS, LEDGER and SLIP, else the vector named.
SIGNALS, FLOWS, LEDGER, PARTIALS_SIGNALS, PARTIALS_FLOWS, PARTIALS_LEDGER, MASS, SLIP, GUARD, OUTPUT = range(10)

DISSIPATED, SUPPLIED = "dissipated", "supplied"
NOT_IN_FORCE = -1.0  # the value of a guard slot the zone in force does not use
