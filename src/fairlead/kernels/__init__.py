"""One compiled kernel for every class variant: its laws, traced once, as machine code that loops over all instances.

Given the declaration of a class and what the trace of its laws says (`fairlead.component`).
Does  facts.py numbers what a kernel reads and writes, text.py writes it out, lowering.py makes machine code of that,
      kernel.py keeps both in the cache; dependence.py, break_away.py, flow_rates.py find facts of a law from its trace.
Says  `Kernel`: its address and its `Structure`. layout.py is the one description of the memory it works on.
Knows no model: a kernel is the same whatever scene it serves.
"""
