"""Where things lie in the flat memory that kernels and callbacks share.

z, the vector every law reads from:

    [ y (n) | signals (m) | reactions (r) | 0 | t | accelerations (n) | dump | what rests ]

w, the vector every law adds to:  [ rows of f (n) | reactions (r) | dump ].

One BLOCK of int64 per class variant describes its instances to its kernel: counts and the addresses
of its tables of indices and numbers. The names below are positions in that block.
"""

from __future__ import annotations

WORD = 8  # bytes of an int64: addresses count in bytes, positions in words
STRIDE, RIGHT = 8, 1  # numbers in a row of a table, and where its right border is; see component/piecewise.py

# Positions in a kernel's block (int64 each), in this order. Addresses point to C-contiguous arrays.
(
    PAR,  # float64 (count, NP)   parameters
    IN_INDEX,  # int64 (count, NI)    where in z an input lies
    IN_COEF,  # float64 (count, NI)   ratio of the kinematic group
    IN_OFFSET,  # float64 (count, NI)  offset of the group, or the value of an unconnected input
    MACHINES,  # int64 (count, NM)    positions in `zones`: the zone, then the piece of each table
    TABLE_BASE,  # int64 (count, NT)  where in `tables` a table starts
    SIG_INDEX,  # int64 (count, NS)   where in z an output signal goes (or the dump)
    FLOW_INDEX,  # int64 (count, NF)  where in w a flow, rate or balance goes
    FLOW_COEF,  # float64 (count, NF)
    LEDGER_INDEX,  # int64 (2,)       where in w dissipated and supplied power go
    D_SIGNALS,  # offsets (counts of float64) into the vector of partial derivatives
    D_FLOWS,
    D_LEDGER,
    D_MASS,
    GUARDS,  # offset into the guard vector
    OUTPUTS,  # offset into the vector of all outputs
    SWING_FIRST,  # offset into the vector of what sines are taken of
    IN_COEF_STEP,  # numbers from one instance to the next in IN_COEF: NI, or 0 where all have those of the first
    IN_OFFSET_STEP,  # the same in IN_OFFSET
    FLOW_COEF_STEP,  # the same in FLOW_COEF
    BLOCK,
) = range(21)

# What a kernel is asked to do. `out` is z for SIGNALS, w for FLOWS, LEDGER, SLIP and DRIFT, else the vector named.
# Partial derivatives that are one number in all zones, whatever the inputs, are asked for once: FIXED_.
SIGNALS, FLOWS, LEDGER, PARTIALS_SIGNALS, PARTIALS_FLOWS, PARTIALS_LEDGER, MASS, SLIP, GUARD, OUTPUT, SAMPLE = range(11)
FIXED_SIGNALS, FIXED_FLOWS, FIXED_LEDGER, DRIFT = range(11, 15)
MEMBERS = 15  # of guards that are groups, one after another: (count, members) numbers from the beginning of `out`
GAP = 16  # as SLIP, of relations of positions that are kept, and of stops how far open they are
SWINGS = 17  # what sines are taken of that no error of a step knows, see swings.py
MODES = 18

DISSIPATED, SUPPLIED, STORED_ENERGY = "dissipated", "supplied", "stored"
OUTPUT_LINES = (STORED_ENERGY, DISSIPATED, SUPPLIED)  # follow the outputs of every instance
NOT_IN_FORCE = -1.0  # the value of a guard slot the zone in force does not use

# Positions in the context, the int64 vector that every callback gets, in this order. Sizes first, then
# addresses of C-contiguous arrays. ROW of `int64 (k, ROW)` is how long a row is, see below.
(
    N,  # unknowns
    N_SIGNALS,
    N_REACTIONS,
    N_BLOCKS,  # kernels, one per class variant
    N_SCHEDULE,  # calls of kernels for signals, in order of rank
    N_GUARDS,
    N_PAIRS,  # kinematic rows x' = v
    N_PROGRAM,  # multiply-adds that assemble the Jacobian from partial derivatives
    N_JACOBIAN,  # stored entries of df/dy
    N_WORK,  # length of the accumulators the program adds to
    N_MASS,
    N_MASS_PROGRAM,
    N_HOLDS,
    N_TIME,  # machines that follow time
    N_SELECTED,  # recorded outputs
    N_STORED,  # instances that state their stored energy
    T_AT,  # where in z the time lies
    ACCELERATION_AT,  # where in z the accelerations begin
    REACTION_AT,  # where in z the reactions begin
    ALWAYS_HELD,  # hold rows that hold in every zone
    Z,  # float64, see the top
    W,
    ZONES,
    TABLES,
    KERNELS,  # int64 (blocks,)       addresses of kernels
    BLOCKS,  # int64 (blocks, BLOCK)
    COUNTS,  # int64 (MODES, blocks) instances to ask, by what they are asked
    SCHEDULE,  # int64 (schedule, CALL)
    PAIRS,  # int64 (pairs, PAIR)
    INVERSE_MASS,  # float64 (n,)          1/M of rows with mass, else 0
    REACTION_MASS,  # float64 (reactions,)  mass at a prescribed node
    REACTION_A,  # int64 (reactions,)    where in z its acceleration lies
    PARTIALS,  # float64               partial derivatives; the first is 1
    WORK,  # float64               the first is 1, then d(signal)/dy, d(signal)/dt, df/dy, df/dt
    PROGRAM,  # int64 (program, ADD)
    PROGRAM_COEF,  # float64 (program,)
    JACOBIAN_AT,  # where in work df/dy begins; df/dt follows it. A number like the first, not an address
    MASS_STATIC,  # float64 (mass,)
    MASS_PROGRAM,  # int64 (k, MASS_ADD)
    MASS_COEF,  # float64 (k,)
    N_LIGHT_PARTS,  # nodes without inertia that rows hold more than once, see light_holds.py
    LIGHT_PARTS,  # int64 (parts, LIGHT_PART)
    LIGHT_ROWS,  # int64 (rows, LIGHT_ROW)
    LIGHT_ENTRIES,  # int64 (entries, LIGHT_ENTRY)
    LIGHT_COEF,  # float64 (entries,)     what the partial derivative counts
    LIGHT_PLACES,  # int64 (.,)          where in M a row has the speeds with inertia of its part
    LIGHT_SUPPORTS,  # int64 (supports, SUPPORT)  accelerations of supports in those rows
    LIGHT_SUPPORTS_COEF,  # float64 (supports,)  what its partial derivative counts
    N_LIGHT_TERMS,  # rows that may have an acceleration of a support: LIGHT_TERMS int64 (terms, LIGHT_TERM)
    LIGHT_TERMS,
    LIGHT_AT,  # where among the partial derivatives begins what these rows have more of it than their kernels say
    LIGHT_WORK,  # float64 (.,)          scratch: the rows of a part, speeds and accelerations of supports
    LIGHT_GIVEN,  # int64 (.,)           scratch: the speed that a row gives, or -1
    HOLDS,  # int64 (holds, HOLD)
    N_LOOSE,
    LOOSE,  # int64 (loose,)         rows of stops between bodies none of which moves as given
    GUARD_PLACE,  # int64 (guards, GUARD_ROW)  zone position (or -1), first entry of its class in GUARD_TO, slots, slot
    GUARD_TO,  # int64 (., TO)         zone it leads to (-1: none), machine, step of a table's piece
    GUARD_MACHINES,  # int64 (guards,)   first position in `zones` of the instance
    N_TOLD,
    TOLD_GUARDS,  # int64 (told,)          guards of parts that only tell signals, where anything is sampled
    TOLD_FIRED,  # int64 (told,)           scratch: those of them that are above zero
    GUARDS_NOW,  # float64 (guards,)       scratch
    N_MACHINES,
    ZONES_KEPT,  # int64 (machines,)       scratch: zones in force while samples are taken
    TIME_PLACE,  # int64 (time, TIME)    position in zones, base in tables, pieces
    OUTPUTS_ALL,  # float64 (all,)
    SELECTED,  # int64 (recorded,)     position in all outputs, or -1 - position in z
    STORED,  # int64 (stored,)       positions in all outputs
    N_SAMPLED,  # instances with sample times
    SAMPLED,  # int64 (sampled, SAMPLED_ROW)
    SAMPLE_PERIOD,  # float64 (sampled,)   s
    SAMPLE_COUNT,  # int64 (sampled,)     samples taken
    SAMPLE_START,  # float64 (1,)         time of the first sample
    SAMPLE_KERNELS,  # int64 (sampled,)     addresses of what takes the samples: a kernel, or plain Python
    N_CIRCLES,  # contacts that may close a circle of held ones, see redundancy.py
    N_CIRCLE_BODIES,
    N_CIRCLE_NODES,
    CIRCLE_AT,  # where among the partial derivatives their factors begin, then those of the bodies
    CIRCLE_PAIRS,  # int64 (circles, CIRCLE)
    CIRCLE_COEF,  # float64 (circles, CIRCLE_COEFS)  coefficients of a and b, sense, factor g
    CIRCLE_ZONES,  # int64 (., CIRCLE_ZONE)  by zone: whether it holds, its guard on the slip (or -1), its direction
    CIRCLE_SEEN,  # int64 (circles,)     zone for which the rest was found
    CIRCLE_STILL,  # int64 (circles,)    1 for a contact that slides in name only
    CIRCLE_BODIES,  # int64 (bodies, BODY)
    CIRCLE_PINS,  # float64 (bodies,)    factor of a share that is pinned to zero
    CIRCLE_NODES,  # int64 (nodes, NODE)  what it hangs on; the node above in its union, what that hangs on, size
    CIRCLE_RATIO,  # float64 (nodes,)    its speed over that of the node above
    GUARD_INERTIA,  # float64 (guards,)
    TAU,  # float64 (1,)           time constant of a held contact, s
    FIXED_DONE,  # int64 (1,)           1 once the fixed partial derivatives were asked for
    N_FIXED,  # multiply-adds with fixed factors only
    FIXED,  # int64 (fixed, ADD)     those
    FIXED_COEF,  # float64 (fixed,)
    N_MOVING,  # places of work that the program adds to
    MOVING,  # int64 (moving,)       those
    MOVING_BASE,  # float64 (moving,)     what the fixed multiply-adds put there
    GUARDS_READ,  # 1 if a guard reads an acceleration or a reaction
    F_REST,  # float64 (n + reactions + 1,)  what parts at rest that are left out add to w
    WHOLE,  # for a part: the context of the whole; else 0
    WHOLE_Y,  # float64 (n of the whole,)  its unknowns, those that rest as they are
    REACTIONS_READ,  # 1 if a law reads a reaction, or contacts may close a circle
    N_PROGRAM_FORCES,  # multiply-adds before those of the ledger
    N_MOVING_FORCES,  # places before those of the ledger
    KEPT,  # int64 (n,)            where the unknowns of a part lie in the whole
    KEPT_MACHINES,  # int64 (machines,)     and its positions in zones
    N_KEPT_MACHINES,
    CARRIED,  # int64 (carried, CARRIED_ROW)
    CARRIED_COEF,  # float64 (carried, CARRIED_COEFS)
    N_CARRIED,
    WHOLE_ZONES,  # those of the whole
    WHOLE_W,
    SLIP_SHOWN,  # 1 if an output may follow the slip of what is carried
    RATES_SHOWN,  # whether an output that is shown reads an acceleration or a reaction, see below
    N_ACCELERATED,  # bodies whose acceleration is an unknown
    ACCELERATED,  # int64 (accelerated, ACCELERATED_ROW)  their speed and their acceleration
    ACCELERATED_MASS,  # float64 (accelerated,)
    N_PARTS,  # balances of parts of bodies, see parts_of_bodies.py
    PARTS,  # int64 (parts, OF_PART)  row of the balance; that of the body in w; where in z its acceleration lies
    PARTS_COEF,  # float64 (parts, PART_COEFS)  how often it counts in that of the body; mass
    N_RATED,  # nodes without inertia whose balance has its rate beside it, see algebraic_nodes.py
    RATED,  # int64 (rated, RATED_NODE)  row of the balance; where in z tau times its rate lies; 1 if it may jump
    N_RATED_JOINS,
    RATED_JOINS,  # int64 (joins, JOIN)  position in zones (or -1), zone in which it joins; 1 if softly; members
    RATED_MEMBERS,  # int64 (.,)          rated nodes that a join joins, from its first to before its last
    RATED_WEIGHTS,  # float64 (.,)        what the join takes in there over what it does at others; 0 if not known
    N_RATED_TERMS,
    RATED_TERMS,  # int64 (terms, TERM)  rated nodes i, j: the row of i may have the rate of the balance of j
    RATED_AT,  # where among the partial derivatives their shares begin
    RATED_KNOWN,  # int64 (rated,)        1 where something holds the node, 2 where only softly, 0 where nothing does
    RATED_ROOT,  # int64 (rated,)         the node whose row stands for all that move with it
    RATED_MODE,  # float64 (rated,)       its virtual speed over that of the root
    N_SET,  # numbers that are set from outside, see compiled/opened.py
    SET_DUE,  # int64 (1,)            1 once one of them was set
    SET_AT,  # int64 (set,)          their addresses
    SET_VALUES,  # float64 (set,)        what they are from the next time event on
    N_GIVEN,  # of the calls for signals, the first ones: motions that are given in time
    N_GIVEN_PLACES,
    GIVEN_PLACES,  # int64 (given,)       where in z their positions and speeds lie
    GIVEN_MEAN,  # float64 (given,)       scratch
    MEAN,  # float64 (5,)           two times; the weights of what is given then; whether the mean differs
    N_FOLLOWING,  # calls for the signals, and for the flows, of what reads a given motion or follows what does
    N_FOLLOWING_FLOWS,
    FOLLOWING,  # int64 (following, CALL)
    FOLLOWING_FLOWS,  # int64 (., CALL)
    N_SHOWN_FLOWS,  # calls for the flows that give the accelerations and reactions that outputs that are shown read
    SHOWN_FLOWS,  # int64 (., CALL)
    CONTEXT,
) = range(148)

# Positions in a row of an array, and how long such a row is: column c of row k is at ROW * k + c.
CALL_BLOCK, CALL_FIRST, CALL_END, CALL = range(4)  # of SCHEDULE: block, first instance, one past the last
PAIR_X, PAIR_V, PAIR = range(3)  # of PAIRS
ADD_TO, ADD_PARTIAL, ADD_FROM, ADD = range(4)  # of PROGRAM, FIXED: work[to] += coefficient * partials * work[from]
MASS_TO, MASS_PARTIAL, MASS_ADD = range(3)  # of MASS_PROGRAM: mass[to] += coefficient * partials
# Of LIGHT_PARTS: first row, one past the last, speeds without inertia, which come first, all speeds, first support, one
# past the last, and where the terms begin, row by row.
PART_BEGIN, PART_END, PART_LIGHT, PART_WIDTH, PART_SUPPORT, PART_SUPPORT_END, PART_TERM, LIGHT_PART = range(8)
LIGHT_FIRST, LIGHT_END, LIGHT_PLACE, LIGHT_ROW = range(4)  # of LIGHT_ROWS: entries, and where its places begin
ENTRY_SLOT, ENTRY_PARTIAL, LIGHT_ENTRY = range(3)  # of LIGHT_ENTRIES
SUPPORT_OF, SUPPORT_PARTIAL, SUPPORT = range(3)  # of LIGHT_SUPPORTS: its row in the part, and the partial derivative
TERM_ROW, TERM_Z, LIGHT_TERM = range(3)  # of LIGHT_TERMS: the row of f, and where in z the acceleration is
HOLD_PLACE, HOLD_ZONE, HOLD = range(3)  # of HOLDS: position in zones, zone that holds
GUARD_ZONE, GUARD_FIRST, GUARD_SLOTS, GUARD_SLOT, GUARD_ROW = range(5)  # of GUARD_PLACE
TO_ZONE, TO_MACHINE, TO_PIECE, TO = range(4)  # of GUARD_TO
TIME_ZONE, TIME_TABLE, TIME_PIECES, TIME = range(4)  # of TIME_PLACE
SAMPLED_BLOCK, SAMPLED_INSTANCE, SAMPLED_ROW = range(3)  # of SAMPLED
ACCELERATED_V, ACCELERATED_A, ACCELERATED_ROW = range(3)  # of ACCELERATED
PART_ROW, PART_WHOLE, PART_A, OF_PART = range(4)  # of PARTS
PART_SIGN, PART_MASS, PART_COEFS = range(3)  # of PARTS_COEF
# Of CIRCLE_PAIRS: force, nodes a and b, where in z their shares lie, machine or -1, its first row in CIRCLE_ZONES.
CIRCLE_FORCE, CIRCLE_A, CIRCLE_B, CIRCLE_SHARE_A, CIRCLE_SHARE_B, CIRCLE_MACHINE, CIRCLE_FIRST, CIRCLE = range(8)
COEF_A, COEF_B, COEF_SENSE, COEF_FACTOR, CIRCLE_COEFS = range(5)  # of CIRCLE_COEF
CIRCLE_HOLDS, CIRCLE_GUARD, CIRCLE_DIRECTION, CIRCLE_ZONE = range(4)  # of CIRCLE_ZONES
BODY_NODE, BODY_SHARE, BODY = range(3)  # of CIRCLE_BODIES
NODE_HANGS_ON, NODE_ABOVE, NODE_UNION_HANGS_ON, NODE_SIZE, NODE = range(5)  # of CIRCLE_NODES
RATED_ROW, RATED_RATE, RATED_JUMPS, RATED_NODE = range(4)  # of RATED
JOIN_PLACE, JOIN_ZONE, JOIN_SOFTLY, JOIN_FIRST, JOIN_END, JOIN = range(6)  # of RATED_JOINS
TERM_OF, TERM_BY, TERM = range(3)  # of RATED_TERMS
# Of CARRIED: x and v in the whole; where in z position, rate and acceleration of the carrier lie.
CARRIED_X, CARRIED_V, CARRIER_X, CARRIER_V, CARRIER_A, CARRIED_ROW = range(6)
# Of CARRIED_COEF: ratio of positions, offset, ratio of rates, ratio times mass, 1/bond.
RATIO_X, OFFSET_X, RATIO_V, RATIO_MASS, INVERSE_BOND, CARRIED_COEFS = range(6)

FREE, DRIVEN, AT_REST = range(3)  # what a union of bodies hangs on

# Of RATES_SHOWN: no output that is shown reads one, all have to be found, or those that SHOWN_FLOWS give.
NO_RATES, ALL_RATES, SOME_RATES = range(3)
