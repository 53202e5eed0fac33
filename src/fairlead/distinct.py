"""The values of an array, each once: what `np.unique` gives, which also asks whether some are masked.

To ask that, numpy reads in a package of its own, which takes as long as the files of a short run take to write.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray


def distinct(values: NDArray[Any]) -> NDArray[Any]:
    """The values in rising order, each once (k,). They are numbers without NaN."""
    ordered = np.sort(values, axis=None)
    first = np.ones(len(ordered), dtype=bool)
    first[1:] = ordered[1:] != ordered[:-1]
    return ordered[first]
