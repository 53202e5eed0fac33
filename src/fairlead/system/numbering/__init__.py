"""Which unknown, signal or reaction lies where in z and w, how large one of it counts, and where it begins.

Given the flat model and the structures of its kernels.
Does  unknowns.py numbers, ranks.py orders signals, sizes.py and tolerances.py give weights, initial.py start values;
      contact_cycles.py finds which contacts may close a circle when they hold, as that adds unknowns.
Says  `Numbering`, `Scales`, start values of unknowns by name. Knows no array of a kernel.
"""
