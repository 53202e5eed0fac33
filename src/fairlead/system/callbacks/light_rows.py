"""Rows that hold nodes without inertia beside rows that give their speeds: what elimination leaves of them.

See `light_holds.py`. Written in the subset of Python of `lowering.py`; names in capitals are positions, see
`layout.py`.
"""


def eliminate_light(ctx, part):
    """The rows of a part by elimination, in work: speeds, then accelerations of supports; and the speed a row gives.

    What elimination leaves of an entry is rounding below 1e-9 of the largest entry that its row had.
    """
    partials, parts, at = f8(ctx[PARTIALS]), i8(ctx[LIGHT_PARTS]), LIGHT_PART * part
    rows, entries, coef = i8(ctx[LIGHT_ROWS]), i8(ctx[LIGHT_ENTRIES]), f8(ctx[LIGHT_COEF])
    supports, ratio = i8(ctx[LIGHT_SUPPORTS]), f8(ctx[LIGHT_SUPPORTS_COEF])
    work, given = f8(ctx[LIGHT_WORK]), i8(ctx[LIGHT_GIVEN])
    begin, light, speeds = parts[at + PART_BEGIN], parts[at + PART_LIGHT], parts[at + PART_WIDTH]
    first, end = parts[at + PART_SUPPORT], parts[at + PART_SUPPORT_END]
    width = speeds + end - first
    for i in range(0, parts[at + PART_END] - begin):
        row = LIGHT_ROW * (begin + i)
        for c in range(0, width):
            work[width * i + c] = 0.0
        least = 0.0
        for e in range(rows[row + LIGHT_FIRST], rows[row + LIGHT_END]):
            slope = coef[e] * partials[entries[LIGHT_ENTRY * e + ENTRY_PARTIAL]]
            work[width * i + entries[LIGHT_ENTRY * e + ENTRY_SLOT]] += slope
            least = max(least, 1e-9 * abs(slope))
        for e in range(first, end):
            if supports[SUPPORT * e + SUPPORT_OF] == i:
                work[width * i + speeds + e - first] = ratio[e] * partials[supports[SUPPORT * e + SUPPORT_PARTIAL]]
        for q in range(0, i):
            if given[q] >= 0:
                share = work[width * i + given[q]] / work[width * q + given[q]]
                for c in range(0, width):
                    work[width * i + c] -= share * work[width * q + c]
                work[width * i + given[q]] = 0.0
        given[i] = -1
        largest = least
        for c in range(0, light):
            if abs(work[width * i + c]) > largest:
                largest = abs(work[width * i + c])
                given[i] = c
        if given[i] < 0:
            for c in range(light, speeds):
                if abs(work[width * i + c]) <= least:
                    work[width * i + c] = 0.0


def hold_light(ctx, values):
    """The rows in M of what holds nodes without inertia beside rows that give their speeds."""
    parts, rows, places = i8(ctx[LIGHT_PARTS]), i8(ctx[LIGHT_ROWS]), i8(ctx[LIGHT_PLACES])
    work, given = f8(ctx[LIGHT_WORK]), i8(ctx[LIGHT_GIVEN])
    for k in range(0, ctx[N_LIGHT_PARTS]):
        eliminate_light(ctx, k)
        at = LIGHT_PART * k
        begin, light, speeds = parts[at + PART_BEGIN], parts[at + PART_LIGHT], parts[at + PART_WIDTH]
        width = speeds + parts[at + PART_SUPPORT_END] - parts[at + PART_SUPPORT]
        for i in range(0, parts[at + PART_END] - begin):
            if given[i] < 0:
                first = rows[LIGHT_ROW * (begin + i) + LIGHT_PLACE] - light
                for c in range(light, speeds):
                    values[places[first + c]] += work[width * i + c]


def weigh_supports(ctx):
    """How much more these rows have of accelerations of supports than their kernels say, by the zones in force.

    None is left in a row that gives a speed, and what elimination leaves in another.
    """
    parts, supports, ratio = i8(ctx[LIGHT_PARTS]), i8(ctx[LIGHT_SUPPORTS]), f8(ctx[LIGHT_SUPPORTS_COEF])
    partials, work, given = f8(ctx[PARTIALS]), f8(ctx[LIGHT_WORK]), i8(ctx[LIGHT_GIVEN])
    ask(ctx, MASS, partials)
    for k in range(0, ctx[N_LIGHT_PARTS]):
        eliminate_light(ctx, k)
        at = LIGHT_PART * k
        speeds, first, end = parts[at + PART_WIDTH], parts[at + PART_SUPPORT], parts[at + PART_SUPPORT_END]
        term, width = ctx[LIGHT_AT] + parts[at + PART_TERM], speeds + end - first
        for i in range(0, parts[at + PART_END] - parts[at + PART_BEGIN]):
            for e in range(first, end):
                partials[term] = 0.0
                if supports[SUPPORT * e + SUPPORT_OF] == i:
                    partials[term] = ratio[e] * partials[supports[SUPPORT * e + SUPPORT_PARTIAL]]
                if given[i] < 0:
                    partials[term] -= work[width * i + speeds + e - first]
                term += 1


def support_light(ctx, w):
    """Add to these rows what they have more of accelerations of supports."""
    weigh_supports(ctx)
    z, terms, partials = f8(ctx[Z]), i8(ctx[LIGHT_TERMS]), f8(ctx[PARTIALS])
    for e in range(0, ctx[N_LIGHT_TERMS]):
        w[terms[LIGHT_TERM * e + TERM_ROW]] += partials[ctx[LIGHT_AT] + e] * z[terms[LIGHT_TERM * e + TERM_Z]]
