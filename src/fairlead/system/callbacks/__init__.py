"""The callbacks of a System, compiled once for all models: they call kernels in order and gather what those say.

Given the context (system/compiled/context.py) and addresses of kernels; nothing of Python at run time.
Does  evaluation.py has the right-hand side, derivatives.py the Jacobian and the mass matrix, switching.py guards and
      times, recorded.py the outputs; rigid_clusters.py keeps track of contacts that hold in a circle,
      algebraic_rates.py of nodes without inertia.
Says  `table.callbacks()`: addresses by the names of `integrate.problem.CALLBACKS`.
"""
