"""What callbacks do for nodes without inertia: which rates of balances count in which rows (see algebraic_nodes.py).

Who is joined to whom follows from the zones in force, anew at every evaluation. Written in the subset of Python of
`lowering.py`.
"""

from __future__ import annotations


def find_known(ctx):
    """Which nodes without inertia something holds: 1 a row, or a force by a speed; 2 only softly; 0 nothing."""
    joins, total = i8(ctx[RATED_JOINS]), ctx[N_RATED_JOINS]
    members, zones, known = i8(ctx[RATED_MEMBERS]), i8(ctx[ZONES]), i8(ctx[RATED_KNOWN])
    for k in range(0, ctx[N_RATED]):
        known[k] = 0
    softly, changed = 0, 1
    while softly < 2:
        changed = 0
        for j in range(0, total):
            holds = 0
            if joins[JOIN * j + JOIN_PLACE] < 0 or zones[joins[JOIN * j + JOIN_PLACE]] == joins[JOIN * j + JOIN_ZONE]:
                holds = 1
            if holds > 0 and joins[JOIN * j + JOIN_SOFTLY] == softly:
                left, last = 0, -1
                for e in range(joins[JOIN * j + JOIN_FIRST], joins[JOIN * j + JOIN_END]):
                    if known[members[e]] == 0:
                        left += 1
                        last = members[e]
                if left == 1:
                    known[last] = 1 + softly
                    changed = 1
        softly += 1
        if changed > 0:
            softly = 0


def find_roots(ctx):
    """Nodes that nothing holds and that move together: the one that stands for them, virtual speeds by its own."""
    nodes, joins = ctx[N_RATED], i8(ctx[RATED_JOINS])
    members, weights, zones = i8(ctx[RATED_MEMBERS]), f8(ctx[RATED_WEIGHTS]), i8(ctx[ZONES])
    known, root, mode = i8(ctx[RATED_KNOWN]), i8(ctx[RATED_ROOT]), f8(ctx[RATED_MODE])
    for k in range(0, nodes):
        root[k], mode[k] = k, 1.0
    for j in range(0, ctx[N_RATED_JOINS]):
        holds = 0
        if joins[JOIN * j + JOIN_PLACE] < 0 or zones[joins[JOIN * j + JOIN_PLACE]] == joins[JOIN * j + JOIN_ZONE]:
            holds = 1
        first = joins[JOIN * j + JOIN_FIRST]
        if holds > 0 and joins[JOIN * j + JOIN_END] == first + 2:
            a, b = members[first], members[first + 1]
            if known[a] == 0 and known[b] == 0 and root[a] != root[b] and weights[first] * weights[first + 1] != 0.0:
                factor, gone = -weights[first] * mode[a] / (weights[first + 1] * mode[b]), root[b]
                for k in range(0, nodes):
                    if root[k] == gone:
                        root[k] = root[a]
                        mode[k] *= factor


def share_rates(ctx):
    """Which rates of balances count in which rows, by who is joined to whom in the zones in force."""
    find_known(ctx)
    find_roots(ctx)
    known, root, mode = i8(ctx[RATED_KNOWN]), i8(ctx[RATED_ROOT]), f8(ctx[RATED_MODE])
    share, terms = f8(ctx[PARTIALS]), i8(ctx[RATED_TERMS])
    for e in range(0, ctx[N_RATED_TERMS]):
        i, j = terms[TERM * e + TERM_OF], terms[TERM * e + TERM_BY]
        share[ctx[RATED_AT] + e] = 0.0
        if i == j and known[i] == 2:
            share[ctx[RATED_AT] + e] = 0.001  # a microsecond beside tau
        if known[i] == 0 and known[j] == 0 and i == root[j]:
            share[ctx[RATED_AT] + e] = mode[j]


def add_rates(ctx, w):
    """Add to the balances of nodes without inertia their share of rates."""
    share_rates(ctx)
    rated, terms, share, z = i8(ctx[RATED]), i8(ctx[RATED_TERMS]), f8(ctx[PARTIALS]), f8(ctx[Z])
    for e in range(0, ctx[N_RATED_TERMS]):
        of, by = RATED_NODE * terms[TERM * e + TERM_OF], RATED_NODE * terms[TERM * e + TERM_BY]
        w[rated[of + RATED_ROW]] += share[ctx[RATED_AT] + e] * z[rated[by + RATED_RATE]]


def off_balance(ctx, r):
    """Set r, in rows of nodes whose speed no force tells, to tau times what is left of the balance."""
    w, rated, terms, tau = f8(ctx[W]), i8(ctx[RATED]), i8(ctx[RATED_TERMS]), f8(ctx[TAU])
    share, z, known, root = f8(ctx[PARTIALS]), f8(ctx[Z]), i8(ctx[RATED_KNOWN]), i8(ctx[RATED_ROOT])
    for k in range(0, ctx[N_RATED]):
        if known[k] == 0 and root[k] == k and rated[RATED_NODE * k + RATED_JUMPS] > 0:
            r[rated[RATED_NODE * k + RATED_ROW]] = tau[0] * w[rated[RATED_NODE * k + RATED_ROW]]
    for e in range(0, ctx[N_RATED_TERMS]):
        i, j = terms[TERM * e + TERM_OF], terms[TERM * e + TERM_BY]
        if known[i] == 0 and root[i] == i and rated[RATED_NODE * i + RATED_JUMPS] > 0:
            rate = z[rated[RATED_NODE * j + RATED_RATE]]
            r[rated[RATED_NODE * i + RATED_ROW]] -= tau[0] * share[ctx[RATED_AT] + e] * rate
