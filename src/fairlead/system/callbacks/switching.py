"""Guards, the zones to which they lead, what held contacts let slip, and the times at which something is due.

Written in the subset of Python of `lowering.py`; names in capitals are positions, see `layout.py`.
"""


def guards(ctx, t, y, g):
    """All guards; -1 where the zone in force has none."""
    if ctx[GUARDS_READ] == 0:
        look(ctx, t, y)
    if ctx[GUARDS_READ] > 0:
        accelerate(ctx, t, y)
    ask(ctx, GUARD, g)
    if ctx[N_CIRCLES] > 0:
        guard_shares(ctx, t, y, g)


def swings(ctx, t, y, angles):
    """What sines are taken of that no error of a step knows."""
    look(ctx, t, y)
    ask(ctx, SWINGS, angles)


def switch(ctx, t, y, fired, n_fired):
    """Follow the fired guards; of several of one instance the first counts. How many have fired."""
    follow_guards(ctx, fired, n_fired)
    return n_fired


def follow_guards(ctx, fired, n_fired):
    """Put the zones in force to which these guards lead, one for each instance."""
    place, to, machines, zones = i8(ctx[GUARD_PLACE]), i8(ctx[GUARD_TO]), i8(ctx[GUARD_MACHINES]), i8(ctx[ZONES])
    last = -1
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
    """-gap on the rows of relations of positions, zero elsewhere; of nodes without inertia what is off balance.

    As a relation counts a stop that touches, where one side moves as given or is in a relation. Two other bodies that
    touch stay as they are.
    """
    slips(ctx, t, y, GAP, r)
    loose = i8(ctx[LOOSE])
    for k in range(0, ctx[N_LOOSE]):
        r[loose[k]] = 0.0
    if ctx[N_RATED] > 0:
        evaluate(ctx, t, y)
        off_balance(ctx, r)


def slips(ctx, t, y, mode, r):
    """Ask the held contacts for their slip at (t, y)."""
    look(ctx, t, y)
    for i in range(0, ctx[N]):
        r[i] = 0.0
    ask(ctx, mode, r)


def next_time(ctx, t):
    """When something is due next: what is due together with t is not. The end of a piece in force, or a sample."""
    now = t + 2e-15 * abs(t)  # as in at_time
    place, zones, tables = i8(ctx[TIME_PLACE]), i8(ctx[ZONES]), f8(ctx[TABLES])
    soonest = 1e309  # read as infinity
    for k in range(0, ctx[N_TIME]):
        at, zone = place[TIME * k + TIME_TABLE], zones[place[TIME * k + TIME_ZONE]]
        right = tables[at + STRIDE * zone + RIGHT]
        if right > now:
            soonest = min(soonest, right)
    period, count, begun = f8(ctx[SAMPLE_PERIOD]), i8(ctx[SAMPLE_COUNT]), f8(ctx[SAMPLE_START])
    for k in range(0, ctx[N_SAMPLED]):
        sample = begun[0] + count[k] * period[k]
        if sample > now:
            soonest = min(soonest, sample)
    return soonest


def settle_told(ctx, t, y):
    """Put the zones of parts that only tell signals in force that follow from what is given at t.

    A sample that falls on a step of a source reads what the source has then; without this a dead zone or a table on
    the way would be read in the zone of before, which is neither what was nor what is.
    """
    told, fired, g = i8(ctx[TOLD_GUARDS]), i8(ctx[TOLD_FIRED]), f8(ctx[GUARDS_NOW])
    busy = 1
    for _ in range(0, ctx[N_TOLD] + 1):
        if busy == 1:
            look(ctx, t, y)
            if ctx[GUARDS_READ] > 0:
                accelerate(ctx, t, y)
            ask(ctx, GUARD, g)
            n_fired = 0
            for k in range(0, ctx[N_TOLD]):
                if g[told[k]] > 0.0:
                    fired[n_fired] = told[k]
                    n_fired += 1
            busy = 0
            if n_fired > 0:
                busy = 1
                follow_guards(ctx, fired, n_fired)


def sample_as_given(ctx, t, y):
    """Take samples with the zones of signals as they follow from what is given at t; those in force settle later."""
    zones, kept = i8(ctx[ZONES]), i8(ctx[ZONES_KEPT])
    for k in range(0, ctx[N_MACHINES]):
        kept[k] = zones[k]
    settle_told(ctx, t, y)
    take_samples(ctx, t, y)
    for k in range(0, ctx[N_MACHINES]):
        zones[k] = kept[k]


def at_time(ctx, t, y):
    """Take what was set, move to the pieces that hold from t on, sample what is due; samplers read what was before.

    What is due within a few digits of the last place is due at one instant: a pulse at 0.1 s + 5 * 0.1 s ends the time
    before a sample at 12 * 0.05 s, or after it, as they are rounded.
    """
    now = t + 2e-15 * abs(t)
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
            if tables[table + STRIDE * zones[machine] + RIGHT] <= now:
                zones[machine] += 1
                changed = 1
    if ctx[N_SAMPLED] > 0:
        if changed * ctx[N_TOLD] > 0:
            sample_as_given(ctx, t, y)
        else:
            take_samples(ctx, t, y)
        changed = 1
    return changed
