"""Functional mock-up units: a model as a library of its own, for a master of a co-simulation without Python.

    export(model, "belt.fmu", version=3)        the file; see docs/fmu.md

An FMU is a run as it stands before its start (`image.py`: its memory, with what is an address written down), the loop
and the laws in machine code for any processor of the architecture (`machine_code.py`), and a wrapper in C (`c/`). A C
compiler links them (`compiler.py`), and they are packed with a description (`description.py`, `archive.py`).

Given a Stepping (`outside.py`). Does what its `advance` does, in C: the same loop on the same memory. Says `UsageError`
for what cannot go along (`refusals.py`).
"""

from fairlead.fmu.export import export

__all__ = ["export"]
