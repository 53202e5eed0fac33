"""The engine `stepping`: the zones of the end of a step are found with it; what a switch inside makes wrong is bounded.

A machine is what has zones: a contact, a stop, a rope, a table, a relay. A zone is one set of laws of it, and a guard
tells when it changes to another. Up to 40 machines (`Run.most_located`) a step ends at every switch instead, and zones
are frozen inside a step.

docs/stepping.md is the page on its error. trial.py tries a step, and accepts it or has it repeated. theta_step.py
solves it: residual.py says what is left, active_set.py which zones, row_cache.py saves factorisations, third_order.py
moves the end. step_error.py is its error, to which located_step.py adds where every step ends at its switch;
switch_inside.py and passed_over.py say where a step with switches inside must end instead. history.py chooses the
length of the next step, and keeps the slopes that its error needs. Who holds what is planned once (neighbours.py).
"""
