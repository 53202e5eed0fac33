"""What callbacks do for held contacts that close a circle (the equations are in redundancy.py).

Bodies that contacts hold together are a union, found anew whenever one of those contacts changes its zone:
every node of it knows one above it and its own speed over that of the other; the top node knows what the union
hangs on. Written in the subset of Python of `lowering.py`.
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
        nodes[NODE * k + NODE_ABOVE] = k
        nodes[NODE * k + NODE_UNION_HANGS_ON] = nodes[NODE * k + NODE_HANGS_ON]
        nodes[NODE * k + NODE_SIZE] = 1
    for j in range(0, ctx[N_CIRCLES]):
        row, own = CIRCLE * j, CIRCLE_COEFS * j
        seen[j] = 0
        if pairs[row + CIRCLE_MACHINE] >= 0:
            seen[j] = zones[pairs[row + CIRCLE_MACHINE]]
        held = table[CIRCLE_ZONE * (pairs[row + CIRCLE_FIRST] + seen[j]) + CIRCLE_HOLDS]
        partials[at + j] = held * coef[own + COEF_FACTOR]
        a, b, slip_a, slip_b = pairs[row + CIRCLE_A], pairs[row + CIRCLE_B], coef[own + COEF_A], coef[own + COEF_B]
        while nodes[NODE * a + NODE_ABOVE] != a:
            slip_a = slip_a * ratio[a]
            a = nodes[NODE * a + NODE_ABOVE]
        while nodes[NODE * b + NODE_ABOVE] != b:
            slip_b = slip_b * ratio[b]
            b = nodes[NODE * b + NODE_ABOVE]
        if held == 1 and a == b and abs(slip_a + slip_b) > 1e-9 * (abs(slip_a) + abs(slip_b)):
            nodes[NODE * a + NODE_UNION_HANGS_ON] = AT_REST
        if nodes[NODE * a + NODE_SIZE] < nodes[NODE * b + NODE_SIZE]:
            a, b, slip_a, slip_b = b, a, slip_b, slip_a
        if held == 1 and nodes[NODE * b + NODE_UNION_HANGS_ON] > nodes[NODE * a + NODE_UNION_HANGS_ON]:
            nodes[NODE * a + NODE_UNION_HANGS_ON] = nodes[NODE * b + NODE_UNION_HANGS_ON]
        if held == 1 and a != b:
            nodes[NODE * b + NODE_ABOVE] = a
            ratio[b] = -slip_a / slip_b
            nodes[NODE * a + NODE_SIZE] += nodes[NODE * b + NODE_SIZE]


def look_around(ctx, t, y):
    """See which contacts slide in name only, and pin the share of the top body of a union that hangs on nothing.

    Those do of which both ends move as one, or are at rest: each in a union of its own, too, as a brake on a shaft that
    gears of two ratios lock.
    """
    partials, at, inertia = f8(ctx[PARTIALS]), ctx[CIRCLE_AT], f8(ctx[GUARD_INERTIA])
    pairs, coef, table = i8(ctx[CIRCLE_PAIRS]), f8(ctx[CIRCLE_COEF]), i8(ctx[CIRCLE_ZONES])
    seen, still = i8(ctx[CIRCLE_SEEN]), i8(ctx[CIRCLE_STILL])
    nodes, ratio = i8(ctx[CIRCLE_NODES]), f8(ctx[CIRCLE_RATIO])
    for j in range(0, ctx[N_CIRCLES]):
        row, own = CIRCLE * j, CIRCLE_COEFS * j
        a, b, slip_a, slip_b = pairs[row + CIRCLE_A], pairs[row + CIRCLE_B], coef[own + COEF_A], coef[own + COEF_B]
        while nodes[NODE * a + NODE_ABOVE] != a:
            slip_a = slip_a * ratio[a]
            a = nodes[NODE * a + NODE_ABOVE]
        while nodes[NODE * b + NODE_ABOVE] != b:
            slip_b = slip_b * ratio[b]
            b = nodes[NODE * b + NODE_ABOVE]
        still[j] = 0
        guard = table[CIRCLE_ZONE * (pairs[row + CIRCLE_FIRST] + seen[j]) + CIRCLE_GUARD]
        if guard >= 0:
            if a == b and abs(slip_a + slip_b) <= 1e-9 * (abs(slip_a) + abs(slip_b)):
                still[j] = 1
            if min(nodes[NODE * a + NODE_UNION_HANGS_ON], nodes[NODE * b + NODE_UNION_HANGS_ON]) == AT_REST:
                still[j] = 1
            # A share that is wrong waits until every acceleration is right.
            inertia[guard] = (1.0 - (1.0 - 1e-9) * still[j]) / coef[own + COEF_FACTOR]
    bodies, pins = i8(ctx[CIRCLE_BODIES]), f8(ctx[CIRCLE_PINS])
    for k in range(0, ctx[N_CIRCLE_BODIES]):
        partials[at + ctx[N_CIRCLES] + k] = 0.0
        top = bodies[BODY * k + BODY_NODE]
        if nodes[NODE * top + NODE_ABOVE] == top and nodes[NODE * top + NODE_UNION_HANGS_ON] == FREE:
            partials[at + ctx[N_CIRCLES] + k] = pins[k]


def regroup(ctx, t, y):
    """Find the unions anew if a contact that makes them is not in the zone it was seen in."""
    zones, pairs, seen, changed = i8(ctx[ZONES]), i8(ctx[CIRCLE_PAIRS]), i8(ctx[CIRCLE_SEEN]), 0
    for j in range(0, ctx[N_CIRCLES]):
        row = CIRCLE * j
        zone = 0
        if pairs[row + CIRCLE_MACHINE] >= 0:
            zone = zones[pairs[row + CIRCLE_MACHINE]]
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
        row, own = CIRCLE * j, CIRCLE_COEFS * j
        force, a, b = pairs[row + CIRCLE_FORCE], pairs[row + CIRCLE_SHARE_A], pairs[row + CIRCLE_SHARE_B]
        beyond_a = coef[own + COEF_SENSE] * y[force] - coef[own + COEF_A] * z[a]
        apart = partials[at + j] * (beyond_a - coef[own + COEF_B] * z[b])
        w[force] += apart
        if a < n:
            w[a] += coef[own + COEF_A] * apart
        if b < n:
            w[b] += coef[own + COEF_B] * apart
    bodies = i8(ctx[CIRCLE_BODIES])
    for k in range(0, ctx[N_CIRCLE_BODIES]):
        body = bodies[BODY * k + BODY_SHARE]
        w[body] += -partials[at + ctx[N_CIRCLES] + k] * y[body]


def guard_shares(ctx, t, y, g):
    """The guards that end sliding in name: the slip speed that what is missing to the limit would build up in tau.

    A zone tells which way its friction acts; the force in y may still be that of the zone before, under an impulse.
    """
    regroup(ctx, t, y)
    pairs, coef, table = i8(ctx[CIRCLE_PAIRS]), f8(ctx[CIRCLE_COEF]), i8(ctx[CIRCLE_ZONES])
    z, seen, still, tau = f8(ctx[Z]), i8(ctx[CIRCLE_SEEN]), i8(ctx[CIRCLE_STILL]), f8(ctx[TAU])
    for j in range(0, ctx[N_CIRCLES]):
        row, own = CIRCLE * j, CIRCLE_COEFS * j
        if still[j] == 1:
            force = coef[own + COEF_SENSE] * y[pairs[row + CIRCLE_FORCE]]
            a, b = pairs[row + CIRCLE_SHARE_A], pairs[row + CIRCLE_SHARE_B]
            share = coef[own + COEF_A] * z[a] + coef[own + COEF_B] * z[b]
            zone = CIRCLE_ZONE * (pairs[row + CIRCLE_FIRST] + seen[j])
            way = sign(force)
            if table[zone + CIRCLE_DIRECTION] != 0:
                way = table[zone + CIRCLE_DIRECTION] * abs(way)
            g[table[zone + CIRCLE_GUARD]] = tau[0] * coef[own + COEF_FACTOR] * (abs(force) - way * share)
