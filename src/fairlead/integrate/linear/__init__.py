"""Linear systems: order of elimination, condensing, sparse factors, fresh pivots. Knows a matrix, no problem."""
