"""The engine `rodas`: Rosenbrock methods, every switch located.

A method of one step (one_step.py): it takes a step in frozen zones, with its error and its interpolant.
"""
