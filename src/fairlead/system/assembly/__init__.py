"""The equations of the whole: how partial derivatives of kernels become df/dy and M, and whether they suffice.

Given blocks and numbering.
Does  jacobian.py and program.py plan df/dy, mass.py plans M, redundancy.py adds rows for contacts that hold in a
      circle, algebraic_nodes.py finds nodes without inertia; determinacy.py says what no equation determines,
      by incidence.py and matching.py.
Says  `Program`, `Pattern`, arrays for the callbacks; ModelError with the unknowns that nothing determines.
"""
