"""Where things lie in the flat memory that kernels and driver share.

z, the vector every law reads from:

    [ y (n) | signals (m) | reactions (r) | 0 | t | accelerations (n) | dump | what rests ]

w, the vector every law adds to:  [ rows of f (n) | reactions (r) | dump ].

One BLOCK of int64 per class variant describes its instances to its kernel: counts and the addresses
of its tables of indices and numbers. The names below are positions in that block.
"""

from __future__ import annotations

WORD = 8  # bytes of an int64: addresses count in bytes, positions in words
STRIDE, RIGHT = 8, 1  # numbers in a row of a table, and where its right border is; see component/piecewise.py

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
IN_COEF_STEP = 16  # numbers from one instance to the next in IN_COEF: NI, or 0 where all have those of the first
IN_OFFSET_STEP = 17  # the same in IN_OFFSET
FLOW_COEF_STEP = 18  # the same in FLOW_COEF
BLOCK = 19

# What a kernel is asked to do. `out` is z for SIGNALS, w for FLOWS, LEDGER, SLIP and DRIFT, else the vector named.
# Partial derivatives that are one number in all zones, whatever the inputs, are asked for once: FIXED_.
SIGNALS, FLOWS, LEDGER, PARTIALS_SIGNALS, PARTIALS_FLOWS, PARTIALS_LEDGER, MASS, SLIP, GUARD, OUTPUT, SAMPLE = range(11)
FIXED_SIGNALS, FIXED_FLOWS, FIXED_LEDGER, DRIFT = range(11, 15)
MEMBERS = 15  # of guards that are groups, one after another: (count, members) numbers from the beginning of `out`
GAP = 16  # as SLIP, of relations of positions that are kept
MODES = 17

DISSIPATED, SUPPLIED, STORED_ENERGY = "dissipated", "supplied", "stored"
OUTPUT_LINES = (STORED_ENERGY, DISSIPATED, SUPPLIED)  # follow the outputs of every instance
NOT_IN_FORCE = -1.0  # the value of a guard slot the zone in force does not use

# Positions in the context, the int64 vector that every callback of the driver gets. Sizes first, then
# addresses of C-contiguous arrays.
N = 0  # unknowns
N_SIGNALS = 1
N_REACTIONS = 2
N_BLOCKS = 3  # kernels, one per class variant
N_SCHEDULE = 4  # calls of kernels for signals, in order of rank
N_GUARDS = 5
N_PAIRS = 6  # kinematic rows x' = v
N_PROGRAM = 7  # multiply-adds that assemble the Jacobian from partial derivatives
N_JACOBIAN = 8  # stored entries of df/dy
N_WORK = 9  # length of the accumulators the program adds to
N_MASS = 10
N_MASS_PROGRAM = 11
N_HOLDS = 12
N_TIME = 13  # machines that follow time
N_SELECTED = 14  # recorded outputs
N_STORED = 15  # instances that state their stored energy
T_AT = 16  # where in z the time lies
ACCELERATION_AT = 17  # where in z the accelerations begin
REACTION_AT = 18  # where in z the reactions begin
ALWAYS_HELD = 19  # hold rows that hold in every zone
Z = 20  # float64, see the top
W = 21
ZONES = 22
TABLES = 23
KERNELS = 24  # int64 (blocks,)       addresses of kernels
BLOCKS = 25  # int64 (blocks, BLOCK)
COUNTS = 26  # int64 (MODES, blocks) instances to ask, by what they are asked
SCHEDULE = 27  # int64 (schedule, 3)   block, first instance, one past the last
PAIRS = 28  # int64 (pairs, 2)       unknown x, unknown v
INVERSE_MASS = 29  # float64 (n,)          1/M of rows with mass, else 0
REACTION_MASS = 30  # float64 (reactions,)  mass at a prescribed node
REACTION_A = 31  # int64 (reactions,)    where in z its acceleration lies
PARTIALS = 32  # float64               partial derivatives; the first is 1
WORK = 33  # float64               the first is 1, then d(signal)/dy, d(signal)/dt, df/dy, df/dt
PROGRAM = 34  # int64 (program, 3)    work[a] += coefficient * partials[b] * work[c]
PROGRAM_COEF = 35  # float64 (program,)
JACOBIAN_AT = 36  # where in work df/dy begins; df/dt follows it. A number like the first, not an address
MASS_STATIC = 37  # float64 (mass,)
MASS_PROGRAM = 38  # int64 (k, 2)          mass[a] += coefficient * partials[b]
MASS_COEF = 39  # float64 (k,)
HOLDS = 40  # int64 (holds, 2)      position in zones, zone that holds
GUARD_PLACE = 41  # int64 (guards, 4)    zone position (or -1), first entry of its class in GUARD_TO, slots, slot
GUARD_TO = 42  # int64 (., 3)          zone it leads to (-1: none), machine, step of a table's piece
GUARD_MACHINES = 43  # int64 (guards,)   first position in `zones` of the instance
TIME_PLACE = 44  # int64 (time, 3)       position in zones, base in tables, pieces
OUTPUTS_ALL = 45  # float64 (all,)
SELECTED = 46  # int64 (recorded,)     position in all outputs, or -1 - position in z
STORED = 47  # int64 (stored,)       positions in all outputs
N_SAMPLED = 48  # instances with sample times
SAMPLED = 49  # int64 (sampled, 2)     block, instance
SAMPLE_PERIOD = 50  # float64 (sampled,)   s
SAMPLE_COUNT = 51  # int64 (sampled,)     samples taken
SAMPLE_START = 52  # float64 (1,)         time of the first sample
SAMPLE_KERNELS = 53  # int64 (sampled,)     addresses of what takes the samples: a kernel, or plain Python
N_CIRCLES = 54  # contacts that may close a circle of held ones, see redundancy.py
N_CIRCLE_BODIES = 55
N_CIRCLE_NODES = 56
CIRCLE_AT = 57  # where among the partial derivatives their factors begin, then those of the bodies
CIRCLE_PAIRS = 58  # int64 (circles, 7)   force, nodes a and b, where in z their shares lie, machine or -1, first zone
CIRCLE_COEF = 59  # float64 (circles, 4)  coefficients of a and b, sense, factor g
CIRCLE_ZONES = 60  # int64 (., 2)        by zone: whether it holds, the guard on the slip that ends it (or -1)
CIRCLE_SEEN = 61  # int64 (circles,)     zone for which the rest was found
CIRCLE_STILL = 62  # int64 (circles,)    1 for a contact that slides in name only
CIRCLE_BODIES = 63  # int64 (bodies, 2)   node, share
CIRCLE_PINS = 64  # float64 (bodies,)    factor of a share that is pinned to zero
CIRCLE_NODES = 65  # int64 (nodes, 4)    what it hangs on; the node above in its union, what that hangs on, size
CIRCLE_RATIO = 66  # float64 (nodes,)    its speed over that of the node above
GUARD_INERTIA = 67  # float64 (guards,)
TAU = 68  # float64 (1,)           time constant of a held contact, s
FIXED_DONE = 69  # int64 (1,)           1 once the fixed partial derivatives were asked for
N_FIXED = 70  # multiply-adds with fixed factors only
FIXED = 71  # int64 (fixed, 3)       those
FIXED_COEF = 72  # float64 (fixed,)
N_MOVING = 73  # places of work that the program adds to
MOVING = 74  # int64 (moving,)       those
MOVING_BASE = 75  # float64 (moving,)     what the fixed multiply-adds put there
GUARDS_READ = 76  # 1 if a guard reads an acceleration or a reaction
F_REST = 77  # float64 (n + reactions + 1,)  what parts at rest that are left out add to w
WHOLE = 78  # for a part: the context of the whole; else 0
WHOLE_Y = 79  # float64 (n of the whole,)  its unknowns, those that rest as they are
REACTIONS_READ = 80  # 1 if a law reads a reaction, or contacts may close a circle
N_PROGRAM_FORCES = 81  # multiply-adds before those of the ledger
N_MOVING_FORCES = 82  # places before those of the ledger
KEPT = 83  # int64 (n,)            where the unknowns of a part lie in the whole
KEPT_MACHINES = 84  # int64 (machines,)     and its positions in zones
N_KEPT_MACHINES = 85
CARRIED = 86  # int64 (carried, 5)    x and v in the whole; where in z position, rate, acceleration of the carrier lie
CARRIED_COEF = 87  # float64 (carried, 5)  ratio of positions, offset, ratio of rates, ratio times mass, 1/bond
N_CARRIED = 88
WHOLE_ZONES = 89  # those of the whole
WHOLE_W = 90
SLIP_SHOWN = 91  # 1 if an output may follow the slip of what is carried
RATES_SHOWN = 92  # 1 if an output that is shown reads an acceleration or a reaction
N_ACCELERATED = 93  # bodies whose acceleration is an unknown
ACCELERATED = 94  # int64 (accelerated, 2) their speed and their acceleration
ACCELERATED_MASS = 95  # float64 (accelerated,)
N_RATED = 96  # nodes without inertia whose balance has its rate beside it, see algebraic_nodes.py
RATED = 97  # int64 (rated, 3)       row of the balance; where in z tau times its rate lies; 1 if it may jump
N_RATED_JOINS = 98
RATED_JOINS = 99  # int64 (joins, 5)       position in zones (or -1), zone in which it joins; 1 if softly; members
RATED_MEMBERS = 100  # int64 (.,)          rated nodes that a join joins, from its first to before its last
RATED_WEIGHTS = 101  # float64 (.,)        what the join takes in there over what it does at others; 0 if not known
N_RATED_TERMS = 102
RATED_TERMS = 103  # int64 (terms, 2)      rated nodes i, j: the row of i may have the rate of the balance of j
RATED_AT = 104  # where among the partial derivatives their shares begin
RATED_KNOWN = 105  # int64 (rated,)        1 where something holds the node, 2 where only softly, 0 where nothing does
RATED_ROOT = 106  # int64 (rated,)         the node whose row stands for all that move with it
RATED_MODE = 107  # float64 (rated,)       its virtual speed over that of the root
N_SET = 108  # numbers that are set from outside, see compiled/opened.py
SET_DUE = 109  # int64 (1,)            1 once one of them was set
SET_AT = 110  # int64 (set,)          their addresses
SET_VALUES = 111  # float64 (set,)        what they are from the next time event on
N_GIVEN = 112  # of the calls for signals, the first ones: motions that are given in time
N_GIVEN_PLACES = 113
GIVEN_PLACES = 114  # int64 (given,)       where in z their positions and speeds lie
GIVEN_MEAN = 115  # float64 (given,)       scratch
MEAN = 116  # float64 (5,)           two times; the weights of what is given then; whether the mean differs
CONTEXT = 117

FREE, DRIVEN, AT_REST = range(3)  # what a union of bodies hangs on
