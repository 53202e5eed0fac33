"""The engine `stepping`: the zones of the end of a step are found with it; what a switch inside makes wrong is bounded.

A machine is what has zones: a contact, a stop, a rope, a table, a relay. A zone is one set of laws of it, and a guard
tells when it changes to another. A step is of one of two kinds (engine.py, `rule.locates`):

    inside     zones are found together with the end of the step, which may have switches inside. Most files are of this
    located    zones are those of the start, and the step ends at its first switch: up to 40 machines
               (`Run.most_located`), unless the step is fixed or theta is above 1/2. Its own file is located_step.py;
               theta_step.py, linearise.py, residual.py, third_order.py and step_error.py serve both

docs/stepping.md is the page on its error. memory/of_methods.py says what every field of `rule`, `exchange` and
`contacts` means; the one met most is `rule.gap`, half the length of the step before. In the order of a step:

    trial.py            a step is tried, and accepted or repeated (repeated.py)
    theta_step.py       it is solved: linearise.py has J, M and W, residual.py says what is left, active_set.py which
                        guards are violated and which zones follow; slip_fronts.py guesses more, which saves passes,
                        and row_cache.py saves factorisations; neighbours.py plans once who holds what
    jump_inside.py      a law that jumps in it is put right there; of a row that is not known the step ends at the jump
                        (jump_at_end.py)
    third_order.py      its end is moved by the error of its rule
    step_error.py       its error: of smooth motion, of limits passed inside (limit_violation.py; response.py says what
                        a missed force does), of one that ends at its switch (located_step.py). Two estimates that all
                        methods share may raise it: events/given_apart.py and point/swings.py
    switch_inside.py    a switch whose impulse is missed, and passed_over.py a guard that rises and falls again: the
                        step must end there instead; other_zones.py says what laws give in other zones
    dense_output.py     its end and its rows inside, without slip of what holds
    history.py          the length of the next step, and the slopes that its error needs
"""
