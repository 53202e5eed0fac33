"""Signals by rank, flows of all, reactions and rows x' = v at (t, y): the right-hand side.

Written in the subset of Python of `lowering.py`; names in capitals are positions, see `layout.py`.
"""


def look(ctx, t, y):
    """What laws read at (t, y): unknowns, time, signals; fills z."""
    z = f8(ctx[Z])
    for i in range(0, ctx[N]):
        z[i] = y[i]
    if ctx[N_GIVEN_PLACES] > 0:
        average(ctx)
    give_motions(ctx, t)
    if ctx[N_GIVEN_PLACES] > 0:
        put_average(ctx)
    make_calls(ctx, SIGNALS, ctx[SCHEDULE], ctx[N_GIVEN], ctx[N_SCHEDULE], f8(ctx[Z]))


def give_motions(ctx, t):
    """The time, and the motions that are given then, in z."""
    z = f8(ctx[Z])
    z[ctx[T_AT]] = t
    make_calls(ctx, SIGNALS, ctx[SCHEDULE], 0, ctx[N_GIVEN], z)


def make_calls(ctx, mode, table, first, end, out):
    """Have kernels write their answers to `mode` to `out`: the calls from first to before end of a table of them."""
    z, zones, tables = f8(ctx[Z]), i8(ctx[ZONES]), f8(ctx[TABLES])
    kernels, blocks, calls = i8(ctx[KERNELS]), ctx[BLOCKS], i8(table)
    for s in range(first, end):
        b, start, stop = calls[CALL * s], calls[CALL * s + CALL_FIRST], calls[CALL * s + CALL_END]
        block = i8(blocks + WORD * BLOCK * b)
        call_kernel(kernels[b], mode, block, start, stop, z, zones, tables, out)


def average(ctx):
    """Where a mean over a step is asked for: what its ends have in it of the positions and speeds that are given."""
    step, z, places, mean = f8(ctx[MEAN]), f8(ctx[Z]), i8(ctx[GIVEN_PLACES]), f8(ctx[GIVEN_MEAN])
    if step[2] + step[3] > 0.0:
        give_motions(ctx, step[0])
        for k in range(0, ctx[N_GIVEN_PLACES]):
            mean[k] = step[2] * z[places[k]]
        give_motions(ctx, step[1])
        for k in range(0, ctx[N_GIVEN_PLACES]):
            mean[k] += step[3] * z[places[k]]


def put_average(ctx):
    """The mean in their place, and whether it is another than they are here."""
    step, z, places, mean = f8(ctx[MEAN]), f8(ctx[Z]), i8(ctx[GIVEN_PLACES]), f8(ctx[GIVEN_MEAN])
    if step[2] + step[3] > 0.0:
        step[4] = 0.0
        for k in range(0, ctx[N_GIVEN_PLACES]):
            value = mean[k] + (1.0 - step[2] - step[3]) * z[places[k]]
            if abs(value - z[places[k]]) > 1e-15 * abs(value):  # more than rounding
                step[4] = 1.0
            z[places[k]] = value


def ask(ctx, mode, out):
    """Have every kernel that has an answer to `mode` write it to `out`."""
    kernels, blocks, total = i8(ctx[KERNELS]), ctx[BLOCKS], ctx[N_BLOCKS]
    z, zones, tables, counts = f8(ctx[Z]), i8(ctx[ZONES]), f8(ctx[TABLES]), i8(ctx[COUNTS])
    for b in range(0, total):
        count = counts[total * mode + b]
        if count > 0:
            call_kernel(kernels[b], mode, i8(blocks + WORD * BLOCK * b), 0, count, z, zones, tables, out)


def evaluate(ctx, t, y):
    """Signals, flows and reactions at (t, y): fills z and w, without the ledger."""
    look(ctx, t, y)
    n, w, rest = ctx[N], f8(ctx[W]), f8(ctx[F_REST])
    for i in range(0, n + ctx[N_REACTIONS] + 1):
        w[i] = rest[i]
    ask(ctx, FLOWS, w)
    if ctx[N_CIRCLES] > 0:
        add_shares(ctx, t, y)
    if ctx[N_LIGHT_TERMS] > 0:
        support_light(ctx, w)
    react(ctx, w)
    pairs = i8(ctx[PAIRS])
    for k in range(0, ctx[N_PAIRS]):
        w[pairs[PAIR * k + PAIR_X]] = y[pairs[PAIR * k + PAIR_V]]
    if ctx[N_ACCELERATED] > 0:
        of_accelerations(ctx, y, w)


def react(ctx, w):
    """Reactions at prescribed nodes, and what rates of balances are in the balances of nodes without inertia."""
    if ctx[N_PARTS] > 0:
        gather(ctx, w)
    n, z = ctx[N], f8(ctx[Z])
    mass, at = f8(ctx[REACTION_MASS]), i8(ctx[REACTION_A])
    for r in range(0, ctx[N_REACTIONS]):
        z[ctx[REACTION_AT] + r] = w[n + r] + mass[r] * z[at[r]]
    if ctx[N_RATED] > 0:
        add_rates(ctx, w)


def gather(ctx, w):
    """Forces on parts of bodies are forces on the bodies; what is left of them on a part is its inertia."""
    rows, coef, z = i8(ctx[PARTS]), f8(ctx[PARTS_COEF]), f8(ctx[Z])
    for k in range(0, ctx[N_PARTS]):
        row, whole, a = rows[OF_PART * k + PART_ROW], rows[OF_PART * k + PART_WHOLE], rows[OF_PART * k + PART_A]
        w[whole] += coef[PART_COEFS * k + PART_SIGN] * w[row]
        w[row] -= coef[PART_COEFS * k + PART_MASS] * z[a]


def of_accelerations(ctx, y, w):
    """Rows m v' = m a and 0 = forces - m a, where the acceleration is an unknown."""
    rows, inertia = i8(ctx[ACCELERATED]), f8(ctx[ACCELERATED_MASS])
    for k in range(0, ctx[N_ACCELERATED]):
        v, a = rows[ACCELERATED_ROW * k + ACCELERATED_V], rows[ACCELERATED_ROW * k + ACCELERATED_A]
        w[v] = inertia[k] * y[a]
        w[a] -= inertia[k] * y[a]


def accelerate(ctx, t, y):
    """As evaluate, and the accelerations in force, for guards and outputs."""
    evaluate(ctx, t, y)
    divide(ctx)


def accelerate_shown(ctx, t, y):
    """Signals, and the accelerations and reactions that outputs read which are shown; others are not right."""
    look(ctx, t, y)
    w, rest = f8(ctx[W]), f8(ctx[F_REST])
    for i in range(0, ctx[N] + ctx[N_REACTIONS] + 1):
        w[i] = rest[i]
    make_calls(ctx, FLOWS, ctx[SHOWN_FLOWS], 0, ctx[N_SHOWN_FLOWS], w)
    react(ctx, w)
    divide(ctx)


def divide(ctx):
    """Accelerations in z: the rows of w by what they move."""
    z, w, inverse, first = f8(ctx[Z]), f8(ctx[W]), f8(ctx[INVERSE_MASS]), ctx[ACCELERATION_AT]
    for i in range(0, ctx[N]):
        z[first + i] = w[i] * inverse[i]


def take_samples(ctx, t, y):
    """Give the discrete variables of all instances that are due at t their next values."""
    evaluate(ctx, t, y)
    kernels, blocks, places = i8(ctx[SAMPLE_KERNELS]), ctx[BLOCKS], i8(ctx[SAMPLED])
    z, zones, tables = f8(ctx[Z]), i8(ctx[ZONES]), f8(ctx[TABLES])
    period, count, begun = f8(ctx[SAMPLE_PERIOD]), i8(ctx[SAMPLE_COUNT]), f8(ctx[SAMPLE_START])
    for k in range(0, ctx[N_SAMPLED]):
        if begun[0] + count[k] * period[k] <= t + 2e-15 * abs(t):  # as in at_time
            b, i = places[SAMPLED_ROW * k + SAMPLED_BLOCK], places[SAMPLED_ROW * k + SAMPLED_INSTANCE]
            call_kernel(kernels[k], SAMPLE, i8(blocks + WORD * BLOCK * b), i, i + 1, z, zones, tables, z)
            count[k] += 1


def rhs(ctx, t, y, f):
    """f(t, y) in the zones in force."""
    evaluate(ctx, t, y)
    w = f8(ctx[W])
    ask(ctx, LEDGER, w)
    for i in range(0, ctx[N]):
        f[i] = w[i]


def forces(ctx, t, y, f):
    """f(t, y) as rhs, but zero in the rows of the ledger."""
    evaluate(ctx, t, y)
    w = f8(ctx[W])
    for i in range(0, ctx[N]):
        f[i] = w[i]


def ahead(ctx, t, y, f):
    """What f has more with given motions on the chord of a step than with them where they are at t.

    Asked are only the laws that follow a given motion, on the chord and then at t; other rows are zero.
    """
    look(ctx, t, y)
    follow(ctx)
    n, w = ctx[N], f8(ctx[W])
    for i in range(0, n):
        f[i] = w[i]
    give_motions(ctx, t)
    make_calls(ctx, SIGNALS, ctx[FOLLOWING], 0, ctx[N_FOLLOWING], f8(ctx[Z]))
    follow(ctx)
    for i in range(0, n):
        f[i] -= w[i]


def follow(ctx):
    """Into w what laws give that follow a given motion; those that do not are no part of it."""
    w = f8(ctx[W])
    for i in range(0, ctx[N] + ctx[N_REACTIONS] + 1):
        w[i] = 0.0
    make_calls(ctx, FLOWS, ctx[FOLLOWING_FLOWS], 0, ctx[N_FOLLOWING_FLOWS], w)
    react(ctx, w)
