"""The callbacks of a System, compiled once for all models: they call kernels in order and gather what those say.

Given the context (system/compiled/context.py) and addresses of kernels; nothing of Python at run time.
Does  driver.py has the callbacks; rigid_clusters.py keeps track of contacts that hold in a circle, algebraic_rates.py
      of nodes without inertia.
Says  `callbacks()`: addresses by the names of `integrate.problem.CALLBACKS`.
"""
