"""The engine `stepping`: the zones of the end of a step are found with it; what a switch inside makes wrong is bounded.

docs/stepping.md is the page on its error. trial.py tries a step; theta_step.py solves it, with zones by active_set.py;
step_error.py, overload.py, missed_impulse.py and unseen_guards.py judge it; located_step.py ends it at a switch where
that must be; known_rows.py and exchange.py save factorisations. Plans of who holds what are made once (neighbours.py).
"""
