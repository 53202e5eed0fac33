"""The engine `stepping`: the zones of the end of a step are found with it; what a switch inside makes wrong is bounded.

docs/stepping.md is the page on its error. trial.py tries a step, and accepts it or has it repeated. theta_step.py
solves it: residual.py says what is left, active_set.py which zones, row_cache.py saves factorisations, third_order.py
moves the end. step_error.py is its error; switch_inside.py says where it must end instead; located_step.py ends it at
every switch. history.py keeps what the next step needs. Who holds what is planned once (neighbours.py).
"""
