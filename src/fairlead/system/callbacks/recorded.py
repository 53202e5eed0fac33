"""What is recorded: outputs, the stored energy, and of a part (active/part.py) the whole that it stands for.

Written in the subset of Python of `lowering.py`; names in capitals are positions, see `layout.py`.
"""


def outputs(ctx, t, y, out):
    """What is recorded, of the whole."""
    if ctx[WHOLE] == 0:
        show(ctx, t, y, out)
    if ctx[WHOLE] != 0:
        expand(ctx, t, y, f8(ctx[WHOLE_Y]))
        if ctx[SLIP_SHOWN] > 0:
            let_slip(ctx, t, y, f8(ctx[WHOLE_Y]))
        show(i8(ctx[WHOLE]), t, f8(ctx[WHOLE_Y]), out)


def show(ctx, t, y, out):
    """The recorded outputs, then the stored energy of all."""
    if ctx[RATES_SHOWN] == NO_RATES:
        look(ctx, t, y)
    if ctx[RATES_SHOWN] == ALL_RATES:
        accelerate(ctx, t, y)
    if ctx[RATES_SHOWN] == SOME_RATES:
        accelerate_shown(ctx, t, y)
    z, everything, selected, stored = f8(ctx[Z]), f8(ctx[OUTPUTS_ALL]), i8(ctx[SELECTED]), i8(ctx[STORED])
    ask(ctx, OUTPUT, everything)
    total = ctx[N_SELECTED]
    for k in range(0, total):
        source = selected[k]
        if source >= 0:
            out[k] = everything[source]
        if source < 0:
            out[k] = z[-1 - source]
    energy = 0.0
    for k in range(0, ctx[N_STORED]):
        energy += everything[stored[k]]
    out[total] = energy


def spread(ctx, t, y, of_whole):
    """The unknowns of the whole that a part stands for."""
    expand(ctx, t, y, of_whole)
    let_slip(ctx, t, y, of_whole)


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
