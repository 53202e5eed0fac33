"""What the driver does for held contacts that close a circle (the equations are in redundancy.py).

Bodies that contacts hold together are a union, found anew whenever one of those contacts changes its zone:
every node of it knows one above it and its own speed over that of the other; the top node knows what the union
hangs on. Written in the subset of Python of `lowering.py`, as driver.py is.
"""

from __future__ import annotations


def unite(ctx, t, y):
    """Join nodes over the contacts that hold, smaller unions under larger ones.

    A circle round which the speeds agree only at rest (gears) holds its union at rest.
    """
    zones, partials, at = i8(ctx[ZONES]), f8(ctx[PARTIALS]), ctx[CIRCLE_AT]
    pairs, coef, table = i8(ctx[CIRCLE_PAIRS]), f8(ctx[CIRCLE_COEF]), i8(ctx[CIRCLE_ZONES])
    seen, nodes, ratio = i8(ctx[CIRCLE_SEEN]), i8(ctx[CIRCLE_NODES]), f8(ctx[CIRCLE_RATIO])
    for k in range(0, ctx[N_CIRCLE_NODES]):
        nodes[4 * k + 1] = k
        nodes[4 * k + 2] = nodes[4 * k]
        nodes[4 * k + 3] = 1
    for j in range(0, ctx[N_CIRCLES]):
        seen[j] = 0
        if pairs[7 * j + 5] >= 0:
            seen[j] = zones[pairs[7 * j + 5]]
        held = table[2 * (pairs[7 * j + 6] + seen[j])]
        partials[at + j] = held * coef[4 * j + 3]
        a, b, slip_a, slip_b = pairs[7 * j + 1], pairs[7 * j + 2], coef[4 * j], coef[4 * j + 1]
        while nodes[4 * a + 1] != a:
            slip_a = slip_a * ratio[a]
            a = nodes[4 * a + 1]
        while nodes[4 * b + 1] != b:
            slip_b = slip_b * ratio[b]
            b = nodes[4 * b + 1]
        if held == 1 and a == b and abs(slip_a + slip_b) > 1e-9 * (abs(slip_a) + abs(slip_b)):
            nodes[4 * a + 2] = AT_REST
        if nodes[4 * a + 3] < nodes[4 * b + 3]:
            a, b, slip_a, slip_b = b, a, slip_b, slip_a
        if held == 1 and nodes[4 * b + 2] > nodes[4 * a + 2]:
            nodes[4 * a + 2] = nodes[4 * b + 2]
        if held == 1 and a != b:
            nodes[4 * b + 1] = a
            ratio[b] = -slip_a / slip_b
            nodes[4 * a + 3] += nodes[4 * b + 3]


def look_around(ctx, t, y):
    """See which contacts slide in name only, and pin the share of the top body of a union that hangs on nothing."""
    partials, at, inertia = f8(ctx[PARTIALS]), ctx[CIRCLE_AT], f8(ctx[GUARD_INERTIA])
    pairs, coef, table = i8(ctx[CIRCLE_PAIRS]), f8(ctx[CIRCLE_COEF]), i8(ctx[CIRCLE_ZONES])
    seen, still = i8(ctx[CIRCLE_SEEN]), i8(ctx[CIRCLE_STILL])
    nodes, ratio = i8(ctx[CIRCLE_NODES]), f8(ctx[CIRCLE_RATIO])
    for j in range(0, ctx[N_CIRCLES]):
        a, b, slip_a, slip_b = pairs[7 * j + 1], pairs[7 * j + 2], coef[4 * j], coef[4 * j + 1]
        while nodes[4 * a + 1] != a:
            slip_a = slip_a * ratio[a]
            a = nodes[4 * a + 1]
        while nodes[4 * b + 1] != b:
            slip_b = slip_b * ratio[b]
            b = nodes[4 * b + 1]
        still[j] = 0
        guard = table[2 * (pairs[7 * j + 6] + seen[j]) + 1]
        if guard >= 0:
            if a == b and abs(slip_a + slip_b) <= 1e-9 * (abs(slip_a) + abs(slip_b)):
                still[j] = 1
            if a == b and nodes[4 * a + 2] == AT_REST:
                still[j] = 1
            # A share that is wrong waits until every acceleration is right.
            inertia[guard] = (1.0 - (1.0 - 1e-9) * still[j]) / coef[4 * j + 3]
    bodies, pins = i8(ctx[CIRCLE_BODIES]), f8(ctx[CIRCLE_PINS])
    for k in range(0, ctx[N_CIRCLE_BODIES]):
        partials[at + ctx[N_CIRCLES] + k] = 0.0
        top = bodies[2 * k]
        if nodes[4 * top + 1] == top and nodes[4 * top + 2] == FREE:
            partials[at + ctx[N_CIRCLES] + k] = pins[k]


def regroup(ctx, t, y):
    """Find the unions anew if a contact that makes them is not in the zone it was seen in."""
    zones, pairs, seen, changed = i8(ctx[ZONES]), i8(ctx[CIRCLE_PAIRS]), i8(ctx[CIRCLE_SEEN]), 0
    for j in range(0, ctx[N_CIRCLES]):
        zone = 0
        if pairs[7 * j + 5] >= 0:
            zone = zones[pairs[7 * j + 5]]
        if zone != seen[j]:
            changed = 1
    if changed == 1:
        unite(ctx, t, y)
        look_around(ctx, t, y)


def add_shares(ctx, t, y):
    """What contacts of circles have more in their rows while they hold, and the rows of the shares."""
    regroup(ctx, t, y)
    partials, at, n = f8(ctx[PARTIALS]), ctx[CIRCLE_AT], ctx[N]
    pairs, coef, z, w = i8(ctx[CIRCLE_PAIRS]), f8(ctx[CIRCLE_COEF]), f8(ctx[Z]), f8(ctx[W])
    for j in range(0, ctx[N_CIRCLES]):
        force, a, b = pairs[7 * j], pairs[7 * j + 3], pairs[7 * j + 4]
        apart = partials[at + j] * (coef[4 * j + 2] * y[force] - coef[4 * j] * z[a] - coef[4 * j + 1] * z[b])
        w[force] += apart
        if a < n:
            w[a] += coef[4 * j] * apart
        if b < n:
            w[b] += coef[4 * j + 1] * apart
    bodies = i8(ctx[CIRCLE_BODIES])
    for k in range(0, ctx[N_CIRCLE_BODIES]):
        body = bodies[2 * k + 1]
        w[body] += -partials[at + ctx[N_CIRCLES] + k] * y[body]


def guard_shares(ctx, t, y, g):
    """The guards that end sliding in name: the slip speed that what is missing to the limit would build up in tau."""
    regroup(ctx, t, y)
    pairs, coef, table = i8(ctx[CIRCLE_PAIRS]), f8(ctx[CIRCLE_COEF]), i8(ctx[CIRCLE_ZONES])
    z, seen, still, tau = f8(ctx[Z]), i8(ctx[CIRCLE_SEEN]), i8(ctx[CIRCLE_STILL]), f8(ctx[TAU])
    for j in range(0, ctx[N_CIRCLES]):
        if still[j] == 1:
            force = coef[4 * j + 2] * y[pairs[7 * j]]
            share = coef[4 * j] * z[pairs[7 * j + 3]] + coef[4 * j + 1] * z[pairs[7 * j + 4]]
            guard = table[2 * (pairs[7 * j + 6] + seen[j]) + 1]
            g[guard] = tau[0] * coef[4 * j + 3] * (abs(force) - sign(force) * share)
