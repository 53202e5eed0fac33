"""The compiled model: frozen arrays that many runs share, and one run's own memory.

Given arrays, assembly, numbering and the callbacks.
Does  build.py puts them together, of the whole or of a part; context.py writes all addresses into one vector;
      asking.py calls the callbacks from Python; named_parts.py and out_of_range.py name parts for remarks and messages.
Says  `System` (frozen) and `Instance` (a System in one run), by the shape of `integrate.problem.Problem`.
"""
