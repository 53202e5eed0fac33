"""Functional mock-up units and C libraries: a model that runs without Python, in a co-simulation or a program.

    export(model, "belt.fmu", version=3)        the file; see docs/fmu.md
    export_library(model, "belt")               a shared library with a C header; see docs/coupling.md

An FMU is a run as it stands before its start (`image.py`: its memory, with what is an address written down), the loop
and the laws in machine code for any processor of an architecture (`machine_code.py`), and a wrapper in C (`c/`). A C
compiler links them (`compiler.py`), for each system that is asked for (`platforms.py`), and they are packed with a
description (`description.py`, `archive.py`).

Given a Stepping (`outside.py`). Does what its `advance` does, in C: the same loop on the same memory. Says `UsageError`
for what cannot go along (`refusals.py`).
"""

from fairlead.fmu.export import export
from fairlead.fmu.library import export_library

__all__ = ["export", "export_library"]
