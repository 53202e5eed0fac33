"""The active subsystem: what must be computed while the rest stands still or is taken along.

Given a System, and the facts of its kernels: what every value and guard depends on (kernels/dependence.py).
Does  rest.py finds what stands still, entrained.py what is taken along, both from the equations; partition.py draws the
      boundary, restriction.py makes a System of what moves, part.py prolongs its state to the whole.
Says  `Subsystem`, which an engine asks for what to compute and when to give back (`integrate.problem`).
"""
