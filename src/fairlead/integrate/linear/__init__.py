"""Linear systems W x = b with W = s M - J, and the matrix of a consistent point, along one fixed pattern.

Given `linear`: J and M (`matrices`), the plan of elimination (`reduced`, `factors`), which ordering.py and
      condensing.py make once for a problem, from its patterns alone.
Does  factorise_step, factorise_consistent, solve, solve_motion, solve_checked (systems.py); products with J and M
(products.py).
Says  DONE, SINGULAR with the unknown to blame in `culprit`, or INACCURATE: other pivots are needed (replan.py).
"""
