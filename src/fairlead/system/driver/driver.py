"""The callbacks of a System: they call kernels in order and gather what those say.

Plain functions over flat memory, in the small subset of Python that `lowering.py` makes into machine
code; compiled once, not once per model. Names in capitals are positions, see `layout.py`.

    rhs        signals by rank, flows of all, reactions; rows x' = v; ledger
    jacobian   the same, then partial derivatives of all kernels, then one list of multiply-adds that
               eliminates the signals: work[a] += coefficient * partials[b] * work[c]; what never changes
               of either is done once
    slopes     as jacobian, without the rows of the ledger, which stand last in that list
    shares     of held contacts that close a circle: see redundancy.py
    spread     of a part, what the whole is that it stands for: see restriction.py
"""

from __future__ import annotations

import functools
from pathlib import Path

from fairlead.native import Build, Native, digest, load_or_compile
from fairlead.system.driver.algebraic_rates import add_rates, find_known, find_roots, off_balance, share_rates
from fairlead.system.driver.rigid_clusters import add_shares, guard_shares, look_around, regroup, unite

SPREAD = "spread"
"""The one that no engine calls."""
SIGNATURES = {
    "rhs": (("I8", "float", "F8", "F8"), "None"),
    "forces": (("I8", "float", "F8", "F8"), "None"),
    "jacobian": (("I8", "float", "F8", "F8", "F8"), "None"),
    "slopes": (("I8", "float", "F8", "F8", "F8"), "None"),
    "mass": (("I8", "F8"), "None"),
    "guards": (("I8", "float", "F8", "F8"), "None"),
    "switch": (("I8", "float", "F8", "I8", "int"), "int"),
    "slip": (("I8", "float", "F8", "F8"), "int"),
    "drift": (("I8", "float", "F8", "F8"), "None"),
    "gap": (("I8", "float", "F8", "F8"), "None"),
    "next_time": (("I8", "float"), "float"),
    "at_time": (("I8", "float", "F8"), "int"),
    "outputs": (("I8", "float", "F8", "F8"), "None"),
    SPREAD: (("I8", "float", "F8", "F8"), "None"),
}


def look(ctx, t, y):
    """What laws read at (t, y): unknowns, time, signals; fills z."""
    z = f8(ctx[Z])
    for i in range(0, ctx[N]):
        z[i] = y[i]
    if ctx[N_GIVEN_PLACES] > 0:
        average(ctx)
    call_signals(ctx, t, 0, ctx[N_GIVEN])
    if ctx[N_GIVEN_PLACES] > 0:
        put_average(ctx)
    call_signals(ctx, t, ctx[N_GIVEN], ctx[N_SCHEDULE])


def call_signals(ctx, t, first, end):
    """Have the kernels give their signals at t, in these calls."""
    z, zones, tables = f8(ctx[Z]), i8(ctx[ZONES]), f8(ctx[TABLES])
    kernels, blocks, schedule = i8(ctx[KERNELS]), ctx[BLOCKS], i8(ctx[SCHEDULE])
    z[ctx[T_AT]] = t
    for s in range(first, end):
        b, start, stop = schedule[CALL * s], schedule[CALL * s + CALL_FIRST], schedule[CALL * s + CALL_END]
        block = i8(blocks + WORD * BLOCK * b)
        call_kernel(kernels[b], SIGNALS, block, start, stop, z, zones, tables, z)


def average(ctx):
    """Where a mean over a step is asked for: what its ends have in it of the positions and speeds that are given."""
    step, z, places, mean = f8(ctx[MEAN]), f8(ctx[Z]), i8(ctx[GIVEN_PLACES]), f8(ctx[GIVEN_MEAN])
    if step[2] + step[3] > 0.0:
        call_signals(ctx, step[0], 0, ctx[N_GIVEN])
        for k in range(0, ctx[N_GIVEN_PLACES]):
            mean[k] = step[2] * z[places[k]]
        call_signals(ctx, step[1], 0, ctx[N_GIVEN])
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
    n, z, w, rest = ctx[N], f8(ctx[Z]), f8(ctx[W]), f8(ctx[F_REST])
    for i in range(0, n + ctx[N_REACTIONS] + 1):
        w[i] = rest[i]
    ask(ctx, FLOWS, w)
    if ctx[N_CIRCLES] > 0:
        add_shares(ctx, t, y)
    mass, at = f8(ctx[REACTION_MASS]), i8(ctx[REACTION_A])
    for r in range(0, ctx[N_REACTIONS]):
        z[ctx[REACTION_AT] + r] = w[n + r] + mass[r] * z[at[r]]
    if ctx[N_RATED] > 0:
        add_rates(ctx, w)
    pairs = i8(ctx[PAIRS])
    for k in range(0, ctx[N_PAIRS]):
        w[pairs[PAIR * k + PAIR_X]] = y[pairs[PAIR * k + PAIR_V]]
    if ctx[N_ACCELERATED] > 0:
        of_accelerations(ctx, y, w)


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
    z, w, inverse, first = f8(ctx[Z]), f8(ctx[W]), f8(ctx[INVERSE_MASS]), ctx[ACCELERATION_AT]
    for i in range(0, ctx[N]):
        z[first + i] = w[i] * inverse[i]


def slips(ctx, t, y, mode, r):
    """Ask the held contacts for their slip at (t, y)."""
    look(ctx, t, y)
    for i in range(0, ctx[N]):
        r[i] = 0.0
    ask(ctx, mode, r)


def take_samples(ctx, t, y):
    """Give the discrete variables of all instances that are due at t their next values."""
    evaluate(ctx, t, y)
    kernels, blocks, places = i8(ctx[SAMPLE_KERNELS]), ctx[BLOCKS], i8(ctx[SAMPLED])
    z, zones, tables = f8(ctx[Z]), i8(ctx[ZONES]), f8(ctx[TABLES])
    period, count, begun = f8(ctx[SAMPLE_PERIOD]), i8(ctx[SAMPLE_COUNT]), f8(ctx[SAMPLE_START])
    for k in range(0, ctx[N_SAMPLED]):
        if begun[0] + count[k] * period[k] <= t:
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


def assemble(ctx, t, y, ledger, values, ft):
    """df/dy along the pattern, and df/dt; in the rows of the ledger anything, unless asked for."""
    if ctx[REACTIONS_READ] == 0:
        look(ctx, t, y)
    if ctx[REACTIONS_READ] > 0:
        evaluate(ctx, t, y)
    z, zones, tables, partials = f8(ctx[Z]), i8(ctx[ZONES]), f8(ctx[TABLES]), f8(ctx[PARTIALS])
    kernels, blocks = i8(ctx[KERNELS]), ctx[BLOCKS]
    if ctx[N_RATED] > 0:
        share_rates(ctx)
    done = i8(ctx[FIXED_DONE])
    if done[0] == 0:
        fix(ctx, t, y)
    schedule = i8(ctx[SCHEDULE])
    for s in range(0, ctx[N_SCHEDULE]):
        b, start, stop = schedule[CALL * s], schedule[CALL * s + CALL_FIRST], schedule[CALL * s + CALL_END]
        block = i8(blocks + WORD * BLOCK * b)
        call_kernel(kernels[b], PARTIALS_SIGNALS, block, start, stop, z, zones, tables, partials)
    ask(ctx, PARTIALS_FLOWS, partials)
    if ledger > 0:
        ask(ctx, PARTIALS_LEDGER, partials)
    work, program, coefficient = f8(ctx[WORK]), i8(ctx[PROGRAM]), f8(ctx[PROGRAM_COEF])
    moving, base = i8(ctx[MOVING]), f8(ctx[MOVING_BASE])
    places, steps = ctx[N_MOVING], ctx[N_PROGRAM]
    if ledger == 0:
        places, steps = ctx[N_MOVING_FORCES], ctx[N_PROGRAM_FORCES]
    for k in range(0, places):
        work[moving[k]] = base[k]
    for k in range(0, steps):
        to, by, source = program[ADD * k + ADD_TO], program[ADD * k + ADD_PARTIAL], program[ADD * k + ADD_FROM]
        work[to] += coefficient[k] * partials[by] * work[source]
    first, entries = ctx[JACOBIAN_AT], ctx[N_JACOBIAN]
    for i in range(0, entries):
        values[i] = work[first + i]
    for i in range(0, ctx[N]):
        ft[i] = work[first + entries + i]


def jacobian(ctx, t, y, values, ft):
    """df/dy along the pattern, and df/dt."""
    assemble(ctx, t, y, 1, values, ft)


def slopes(ctx, t, y, values, ft):
    """As jacobian, with anything in the rows of the ledger."""
    assemble(ctx, t, y, 0, values, ft)


def fix(ctx, t, y):
    """What never changes in the Jacobian, done once: fixed partial derivatives, and multiply-adds of them alone."""
    partials = f8(ctx[PARTIALS])
    ask(ctx, FIXED_SIGNALS, partials)
    ask(ctx, FIXED_FLOWS, partials)
    ask(ctx, FIXED_LEDGER, partials)
    work, program, coefficient = f8(ctx[WORK]), i8(ctx[FIXED]), f8(ctx[FIXED_COEF])
    for i in range(1, ctx[N_WORK]):
        work[i] = 0.0
    for k in range(0, ctx[N_FIXED]):
        to, by, source = program[ADD * k + ADD_TO], program[ADD * k + ADD_PARTIAL], program[ADD * k + ADD_FROM]
        work[to] += coefficient[k] * partials[by] * work[source]
    moving, base = i8(ctx[MOVING]), f8(ctx[MOVING_BASE])
    for k in range(0, ctx[N_MOVING]):
        base[k] = work[moving[k]]
    done = i8(ctx[FIXED_DONE])
    done[0] = 1


def mass(ctx, values):
    """M along its pattern: inertias, and the rows of held contacts."""
    partials, static = f8(ctx[PARTIALS]), f8(ctx[MASS_STATIC])
    ask(ctx, MASS, partials)
    for i in range(0, ctx[N_MASS]):
        values[i] = static[i]
    program, coefficient = i8(ctx[MASS_PROGRAM]), f8(ctx[MASS_COEF])
    for k in range(0, ctx[N_MASS_PROGRAM]):
        values[program[MASS_ADD * k + MASS_TO]] += coefficient[k] * partials[program[MASS_ADD * k + MASS_PARTIAL]]


def guards(ctx, t, y, g):
    """All guards; -1 where the zone in force has none."""
    if ctx[GUARDS_READ] == 0:
        look(ctx, t, y)
    if ctx[GUARDS_READ] > 0:
        accelerate(ctx, t, y)
    ask(ctx, GUARD, g)
    if ctx[N_CIRCLES] > 0:
        guard_shares(ctx, t, y, g)


def switch(ctx, t, y, fired, n_fired):
    """Follow the fired guards; of several of one instance the first counts."""
    place, to, machines, zones = i8(ctx[GUARD_PLACE]), i8(ctx[GUARD_TO]), i8(ctx[GUARD_MACHINES]), i8(ctx[ZONES])
    changed, last = 0, -1
    for k in range(0, n_fired):
        row = GUARD_ROW * fired[k]
        first = machines[fired[k]]
        fresh = 1
        if first == last:
            fresh = 0
        if fresh == 1:
            last = first
            zone = 0
            if place[row + GUARD_ZONE] >= 0:
                zone = zones[place[row + GUARD_ZONE]]
            entry = TO * (place[row + GUARD_FIRST] + zone * place[row + GUARD_SLOTS] + place[row + GUARD_SLOT])
            machine, to_zone = first + to[entry + TO_MACHINE], to[entry + TO_ZONE]
            if to_zone >= 0:
                zones[machine] = to_zone
            if to_zone < 0:
                zones[machine] += to[entry + TO_PIECE]
            changed += 1
    return changed


def slip(ctx, t, y, r):
    """-slip on the rows that hold, as far as an impulse takes it away, zero elsewhere; how many rows hold."""
    zones, holds = i8(ctx[ZONES]), i8(ctx[HOLDS])
    held = ctx[ALWAYS_HELD]
    for k in range(0, ctx[N_HOLDS]):
        if zones[holds[HOLD * k + HOLD_PLACE]] == holds[HOLD * k + HOLD_ZONE]:
            held += 1
    if held > 0:
        slips(ctx, t, y, SLIP, r)
    if held == 0:
        for i in range(0, ctx[N]):
            r[i] = 0.0
    return held


def drift(ctx, t, y, r):
    """-slip on the rows that hold, whatever it is, zero elsewhere."""
    slips(ctx, t, y, DRIFT, r)


def gap(ctx, t, y, r):
    """-gap on the rows of relations of positions, zero elsewhere; of nodes without inertia what is off balance."""
    slips(ctx, t, y, GAP, r)
    if ctx[N_RATED] > 0:
        evaluate(ctx, t, y)
        off_balance(ctx, r)


def next_time(ctx, t):
    """The end of the piece in force that comes first."""
    place, zones, tables = i8(ctx[TIME_PLACE]), i8(ctx[ZONES]), f8(ctx[TABLES])
    soonest = 1e309  # read as infinity
    for k in range(0, ctx[N_TIME]):
        at, zone = place[TIME * k + TIME_TABLE], zones[place[TIME * k + TIME_ZONE]]
        right = tables[at + STRIDE * zone + RIGHT]
        if right > t:
            soonest = min(soonest, right)
    period, count, begun = f8(ctx[SAMPLE_PERIOD]), i8(ctx[SAMPLE_COUNT]), f8(ctx[SAMPLE_START])
    for k in range(0, ctx[N_SAMPLED]):
        sample = begun[0] + count[k] * period[k]
        if sample > t:
            soonest = min(soonest, sample)
    return soonest


def at_time(ctx, t, y):
    """Take what was set, move to the pieces that hold from t on, sample what is due; samplers read what was before."""
    place, zones, tables = i8(ctx[TIME_PLACE]), i8(ctx[ZONES]), f8(ctx[TABLES])
    due, at, values = i8(ctx[SET_DUE]), i8(ctx[SET_AT]), f8(ctx[SET_VALUES])
    changed = due[0]
    for k in range(0, changed * ctx[N_SET]):
        number = f8(at[k])
        number[0] = values[k]
    due[0] = 0
    for k in range(0, ctx[N_TIME]):
        machine, table = place[TIME * k + TIME_ZONE], place[TIME * k + TIME_TABLE]
        for _ in range(0, place[TIME * k + TIME_PIECES]):
            if tables[table + STRIDE * zones[machine] + RIGHT] <= t:
                zones[machine] += 1
                changed = 1
    if ctx[N_SAMPLED] > 0:
        take_samples(ctx, t, y)
        changed = 1
    return changed


def expand(ctx, t, y, of_whole):
    """The unknowns of the whole at (t, y) of a part of it: what it keeps, and what is carried at its carrier's pace."""
    look(ctx, t, y)
    zones, of_all, kept, machines = i8(ctx[ZONES]), i8(ctx[WHOLE_ZONES]), i8(ctx[KEPT]), i8(ctx[KEPT_MACHINES])
    for i in range(0, ctx[N]):
        of_whole[kept[i]] = y[i]
    for k in range(0, ctx[N_KEPT_MACHINES]):
        of_all[machines[k]] = zones[k]
    z, carried, coef = f8(ctx[Z]), i8(ctx[CARRIED]), f8(ctx[CARRIED_COEF])
    for k in range(0, ctx[N_CARRIED]):
        row, ratio = CARRIED_ROW * k, CARRIED_COEFS * k
        x, v = carried[row + CARRIED_X], carried[row + CARRIED_V]
        of_whole[x] = coef[ratio + RATIO_X] * z[carried[row + CARRIER_X]] + coef[ratio + OFFSET_X]
        of_whole[v] = coef[ratio + RATIO_V] * z[carried[row + CARRIER_V]]


def let_slip(ctx, t, y, of_whole):
    """Add to what is carried the slip with which its bond accelerates it."""
    if ctx[N_CARRIED] > 0:
        accelerate(ctx, t, y)
        evaluate(i8(ctx[WHOLE]), t, of_whole)
    z, w, carried, coef = f8(ctx[Z]), f8(ctx[WHOLE_W]), i8(ctx[CARRIED]), f8(ctx[CARRIED_COEF])
    for k in range(0, ctx[N_CARRIED]):
        row, ratio = CARRIED_ROW * k, CARRIED_COEFS * k
        v, rate = carried[row + CARRIED_V], z[carried[row + CARRIER_A]]
        of_whole[v] += (w[v] - coef[ratio + RATIO_MASS] * rate) * coef[ratio + INVERSE_BOND]


def show(ctx, t, y, out):
    """The recorded outputs, then the stored energy of all."""
    if ctx[RATES_SHOWN] == 0:
        look(ctx, t, y)
    if ctx[RATES_SHOWN] > 0:
        accelerate(ctx, t, y)
    z, everything, selected, stored = f8(ctx[Z]), f8(ctx[OUTPUTS_ALL]), i8(ctx[SELECTED]), i8(ctx[STORED])
    ask(ctx, OUTPUT, everything)
    total = ctx[N_SELECTED]
    for k in range(0, total):
        source = selected[k]
        if source >= 0:
            out[k] = everything[source]
        if source < 0:
            out[k] = z[-1 - source]
    out[total] = 0.0
    for k in range(0, ctx[N_STORED]):
        out[total] += everything[stored[k]]


def spread(ctx, t, y, of_whole):
    """The unknowns of the whole that a part stands for."""
    expand(ctx, t, y, of_whole)
    let_slip(ctx, t, y, of_whole)


def outputs(ctx, t, y, out):
    """What is recorded, of the whole."""
    if ctx[WHOLE] == 0:
        show(ctx, t, y, out)
    if ctx[WHOLE] != 0:
        expand(ctx, t, y, f8(ctx[WHOLE_Y]))
        if ctx[SLIP_SHOWN] > 0:
            let_slip(ctx, t, y, f8(ctx[WHOLE_Y]))
        show(i8(ctx[WHOLE]), t, f8(ctx[WHOLE_Y]), out)


SHARED = (
    unite, look_around, regroup, add_shares, guard_shares, find_known, find_roots, share_rates, add_rates, off_balance,
    call_signals, average, put_average, look, ask, of_accelerations, evaluate, accelerate, slips, take_samples, fix,
    assemble, expand, let_slip, show,
)  # fmt: skip


@functools.cache
def callbacks() -> Native:
    """The compiled driver; `address` holds the C address of every callback."""
    here, kernels = Path(__file__).parent, Path(__file__).parents[2] / "kernels"
    files = sorted(here.glob("*.py")) + [kernels / f"{name}.py" for name in ("lowering", "lowered_values", "layout")]
    sources = [file.read_text(encoding="utf-8") for file in files]
    return load_or_compile(digest(*sources), _build)


def _build() -> Build:
    from fairlead.kernels.lowering import lower_together

    here = globals()
    functions = {name: (here[name], *signature) for name, signature in SIGNATURES.items()}
    return Build({}, dict(lower_together(functions, SHARED)))
