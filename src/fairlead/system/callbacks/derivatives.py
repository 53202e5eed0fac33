"""The Jacobian df/dy and the mass matrix, along their patterns.

Partial derivatives of all kernels come first, then one list of multiply-adds that eliminates the signals:
work[a] += coefficient * partials[b] * work[c]. What never changes of either is done once (`fix`). The rows of the
ledger stand last in that list, so `slopes` stops before them.

Written in the subset of Python of `lowering.py`; names in capitals are positions, see `layout.py`.
"""


def jacobian(ctx, t, y, values, ft):
    """df/dy along the pattern, and df/dt."""
    assemble(ctx, t, y, 1, values, ft)


def slopes(ctx, t, y, values, ft):
    """As jacobian, with anything in the rows of the ledger."""
    assemble(ctx, t, y, 0, values, ft)


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
    if ctx[N_LIGHT_TERMS] > 0:
        weigh_supports(ctx)
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
    if ctx[N_LIGHT_PARTS] > 0:
        hold_light(ctx, values)
