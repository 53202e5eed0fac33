"""FMUs of other makers inside a model (FMI 2 and 3, co-simulation).

Owns what an FMU is (description.py, variables.py, clocks.py), which of its variables are signals and in which units
(signals.py, units.py), what is set before its start (starts.py), the process it runs in (process.py here; there
worker.py, instance.py, events.py and groups.py), and the block that stands for it in a model (block.py).

Contract: reading a description runs no code of the FMU. That code runs in a process of its own only, which
`ForeignProcess` starts when a run asks for it and it is allowed; every wait for it has a limit, at which the process
and all it has started are ended.
"""
