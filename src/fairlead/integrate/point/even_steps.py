"""Step sizes are rounded to few digits, so that the last digits of an error do not set the times of all later steps.

An error estimate is known to some digits only: it is a difference of nearly equal numbers. A step size that follows
from it to the last digit hands these errors on: to the times of all later steps, to the place of the next switch
inside its step, to the error of that step, and with it to the next step size. In a run with many switches that grows
from one to the next, until another order of sums has the run go another way. Rounded to few digits the step is
the same, and so are all later times, which are sums of few digits and exact.

Rounded is by the splitting of Veltkamp (Dekker, Numer. Math. 18:224, 1971), which needs no more than two products.
"""

from __future__ import annotations

from math import isfinite, sqrt

from fairlead.integrate.memory.foreign import compiled

COARSE = 2.0**43 + 1.0
"""Leaves 10 binary digits: a step is changed by 0.05 % at most."""
COARSER = 2.0**48 + 1.0
"""Leaves 5, changed by 3 % at most: where no factors are kept from one step to the next (`rodas`)."""
FINE = 2.0**27 + 1.0
"""Leaves 26 binary digits, of a step that is to end at a switch."""
ONE_DIGIT = 2.0**52 + 1.0


@compiled
def root_of_power(h):
    """The power of the root of two next to `h`: of a step that follows from y'' alone, whose digits are few.

    Where laws are stiff, y'' is the square of a large number times what rounding leaves.
    """
    return sqrt(rounded(h * h, ONE_DIGIT)) if h < 1e150 else h


@compiled
def rounded(h, splitter):
    """`h` to the binary digits that the splitter leaves; what is beyond all steps stays as it is."""
    high = splitter * h
    return high - (high - h) if isfinite(high) else h
