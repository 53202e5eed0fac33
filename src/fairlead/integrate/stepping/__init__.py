"""The engine `stepping`: the zones of the end of a step are found with it; what a switch inside makes wrong is bounded.

A machine is what has zones: a contact, a stop, a rope, a table, a relay. A zone is one set of laws of it, and a guard
tells when it changes to another. Up to 40 machines (`Run.most_located`) a step ends at every switch instead, and zones
are frozen inside a step; not so with a fixed step, or with a theta above 1/2 (engine.py, `rule.locates`).

docs/stepping.md is the page on its error. In the order of a step:

    trial.py            a step is tried, and accepted or repeated (repeated.py)
    theta_step.py       it is solved: linearise.py has J, M and W, residual.py says what is left, guards_of_step.py what
                        is violated, active_set.py which zones follow; row_cache.py saves factorisations; neighbours.py
                        plans once who holds what
    jump_inside.py      a law that jumps in it is put right there; of a row that is not known the step ends at the jump
                        (jump_at_end.py)
    third_order.py      its end is moved by the error of its rule
    step_error.py       its error: of smooth motion, of limits passed inside (limit_violation.py; response.py says what
                        a missed force does), of one that ends at its switch (located_step.py)
    switch_inside.py    a switch whose impulse is missed, and passed_over.py a guard that rises and falls again: the
                        step must end there instead; other_zones.py says what laws give in other zones
    dense_output.py     its end and its rows inside, without slip of what holds
    history.py          the length of the next step, and the slopes that its error needs
"""
