"""The arrays that kernels read and write: blocks of instances, and tables beside them.

Given the numbering, and the kernels with their structures.
Does  blocks.py lays out the instances of a class variant; timing.py, switching.py, outputs.py, shown.py and
      recording.py lay out what follows time, what a guard leads to, what is recorded; working.py lays out memory to
      write to; plain_python.py puts a controller in Python behind an address.
Says  `Block`, and arrays by the names of layout.py. Knows no equation.
"""
